# C types of `marks.py`.
cimport cython
from libc.stdint cimport int64_t, uint8_t

@cython.final
cdef class Marked:
    cdef int64_t[::1] partner, first_visit, left, moved, visit, border
    cdef uint8_t[::1] ccw

cpdef Py_ssize_t insert_marks(
    Marked marked,
    const int64_t[::1] partner,
    const uint8_t[::1] ccw,
    const int64_t[::1] first_visit,
    const int64_t[::1] left,
    const int64_t[::1] loop,
    const int64_t[::1] at,
) except -1
cdef int _join_visits(const int64_t[::1] partner, const uint8_t[::1] ccw, Marked marked) except -1
