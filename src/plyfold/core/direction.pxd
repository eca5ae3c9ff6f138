# C types of `direction.py`.
cimport cython
from libc.stdint cimport int64_t, uint8_t

from plyfold.core.signs cimport exact_sign

cpdef int64_t outer_dart_of_points(const double[::1] points, const int64_t[::1] visit_edge) except -1
cdef Py_ssize_t _border_at(const int64_t[::1] visit_edge, int64_t point) except -1

@cython.final
cdef class CurveDirection:
    cdef readonly int64_t outer, turning, lowest
    cdef readonly bint turned_round

    cpdef int settle(
        self, int64_t[::1] partner, uint8_t[::1] ccw, int64_t outer, bint is_directed, int64_t[::1] left
    ) except -1
    cdef int64_t _wind(self, const uint8_t[::1] ccw, int64_t[::1] left) except? -1
    cdef int _turn_round(self, int64_t[::1] partner, uint8_t[::1] ccw) except -1

cdef int64_t _whitney_turning_number(
    const int64_t[::1] partner, const uint8_t[::1] ccw, int64_t outer
) except? -1
