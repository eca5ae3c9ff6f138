# C types of `numbers.py`.
cimport cython
from libc.stdint cimport int64_t

cdef Py_ssize_t _LEAST

@cython.final
cdef class Numbers:
    cdef readonly int64_t[::1] data
    cdef Py_ssize_t room
    cdef readonly Py_ssize_t size

    cpdef int begin(self, int64_t[::1] data, Py_ssize_t room) except -1
    cpdef int append(self, int64_t number) except -1
    @cython.locals(larger=int64_t[::1])
    cdef int _grow(self) except -1
    cpdef object as_array(self)
