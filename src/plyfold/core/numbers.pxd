# C types of `numbers.py`.
from libc.stdint cimport int64_t

cdef class Numbers:
    cdef object array
    cdef int64_t[::1] data
    cdef Py_ssize_t room
    cdef readonly Py_ssize_t size

    cpdef int append(self, int64_t number) except -1
    cdef int _grow(self) except -1
    cpdef object as_array(self)
