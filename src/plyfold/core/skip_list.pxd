# C types of `skip_list.py`.
from libc.stdint cimport int64_t

cdef double _GOLDEN

cdef class SkipList:
    cdef readonly int64_t[::1] above, below, height
    cdef int64_t[::1] room
    cdef readonly Py_ssize_t size
    cdef readonly int levels

    cdef int _choose_heights(self) except -1
    cpdef int link(self, Py_ssize_t node, Py_ssize_t place) except -1
    cpdef int unlink(self, Py_ssize_t node) except -1
