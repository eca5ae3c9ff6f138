# C types of `turns.py`.
from plyfold.core.signs cimport quick_sign, rest_of_product

cdef double _LEAST, _LARGEST

cdef class ExactPoints:
    cdef readonly const double[::1] places
    cdef object exact
    cdef double[::1] scratch
    cdef bint has_scratch

cpdef int turn(ExactPoints points, Py_ssize_t a, Py_ssize_t b, Py_ssize_t c) except? -2
cdef bint _is_moderate(double x, double y) noexcept
cdef int _exact_turn(ExactPoints points, double ax, double ay, double bx, double by, double cx, double cy) except? -2
cdef int _add_product(ExactPoints points, Py_ssize_t size, double one, double other) except -1
cdef int _add_exactly(ExactPoints points, Py_ssize_t size, double number) except -1
