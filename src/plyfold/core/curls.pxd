# C types of `curls.py`.
cimport cython
from libc.stdint cimport int64_t, uint8_t

@cython.final
cdef class Curls:
    cdef int64_t[::1] partner, first_visit, cell, winding, border
    cdef uint8_t[::1] ccw
    cdef Py_ssize_t cells, borders, visits

@cython.locals(moved=int64_t[::1])
cpdef int draw_curls(
    Curls drawn,
    const int64_t[::1] partner,
    const uint8_t[::1] ccw,
    const int64_t[::1] index,
    const int64_t[::1] first_visit,
    const int64_t[::1] cell,
    const int64_t[::1] winding,
) except -1
cdef int _draw_curl(Curls drawn, int64_t index, int64_t above, int64_t bottom) except -1
