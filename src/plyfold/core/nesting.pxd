# C types of `nesting.py`.
cimport cython
from libc.stdint cimport int64_t, uint8_t

from plyfold.core.cells cimport follow_darts, root_of
from plyfold.core.numbers cimport Numbers
from plyfold.core.signs cimport exact_sign, rest_of_difference, rest_of_product

cdef int _GROUP, _RAYS
cdef double _FAR, _PLACE_ERROR, _UNDERFLOW, _LEAST, _LARGEST, _SHARE_ERROR

@cython.final
cdef class Bridges:
    cdef int64_t[::1] dart, beyond, is_bounded, left, whole
    cdef double[::1] real
    cdef Py_ssize_t bridges, count

    cdef int put(
        self, Py_ssize_t foot, int64_t edge, double along, int64_t tie, int64_t at, int64_t loop, double x, double y
    ) except -1

cpdef double share_along(double start, double end, double between) except? -2

@cython.final
cdef class Nesting:
    cdef const double[::1] points
    cdef const int64_t[::1] first_point, first_visit, edge, partner
    cdef const uint8_t[::1] ccw
    cdef object step
    cdef Py_ssize_t n, loops, groups, leaves
    cdef int64_t[::1] loop, loop_of_visit, group, first_border, is_known, stack, outer, order
    cdef readonly int64_t[::1] leftmost, is_convex
    cdef readonly Numbers corner, unsure
    cdef Numbers near
    cdef double[::1] box, side
    cdef double x, y, least, low, high
    cdef int64_t own
    cdef bint is_rounded

    cdef int _number_loops(self) except -1
    cdef int _find_groups(self) except -1
    @cython.locals(furthest=int64_t[::1])
    cdef int _find_corners(self) except -1
    cdef bint _is_further_left(self, Py_ssize_t point, Py_ssize_t other) except -1
    cdef Py_ssize_t _end(self, Py_ssize_t edge) except -1
    cdef Py_ssize_t _before(self, Py_ssize_t point) except -1
    cpdef int meet(self, const int64_t[::1] corner, int is_rounded, int64_t[::1] met) except -1
    cdef int _fill_boxes(self) except -1
    cdef int _fill_group(self, Py_ssize_t group) except -1
    cdef int _halve(self, Py_ssize_t low, Py_ssize_t high, Py_ssize_t axis) except -1
    cdef int _select(self, Py_ssize_t low, Py_ssize_t high, Py_ssize_t place, Py_ssize_t axis) except -1
    cdef double _along(self, Py_ssize_t group, Py_ssize_t axis) except? -2
    cdef int _join_boxes(self, Py_ssize_t node) except -1
    cdef int _put_box(self, Py_ssize_t node, double low_x, double low_y, double high_x, double high_y) except -1
    cdef int _look(self, Py_ssize_t node) except -1
    cdef bint _is_nearer(self, Py_ssize_t one, Py_ssize_t other) except -1
    cdef int _pass_edge(self, Py_ssize_t edge) except -1
    cdef int _find_span(self, Py_ssize_t edge) except -1
    cdef int64_t _first(self, Py_ssize_t ray) except? -2
    cpdef int find_turns(self) except -1
    cpdef int join(
        self,
        Bridges found,
        int64_t[::1] following,
        const int64_t[::1] corner,
        const int64_t[::1] met,
        const int64_t[::1] passed,
    ) except -1
    cdef int64_t _is_upward(self, Py_ssize_t edge) except -1
    cdef int _go_round(self, Py_ssize_t dart, int64_t group, int64_t[::1] following) except -1
    cdef int _put_feet(
        self, Bridges found, Py_ssize_t ray, Py_ssize_t corner, int64_t visits, Py_ssize_t edge, int64_t passed
    ) except -1
    cdef Py_ssize_t _visits_before(self, Py_ssize_t point) except -1
    cdef Py_ssize_t _border(self, Py_ssize_t loop, Py_ssize_t passed) except -1
    cdef Py_ssize_t _after(self, Py_ssize_t visit) except -1
    cdef int _wind_along(self, int64_t[::1] left) except -1
    cdef int _wind_group(self, Py_ssize_t loop, int64_t height, int64_t[::1] left) except -1
    cdef int _raise(self, Py_ssize_t loop, int64_t height, int64_t[::1] left) except -1
    cdef int64_t _rise(self, Py_ssize_t visit, Py_ssize_t partner, int64_t[::1] left) except? -2
    cdef Py_ssize_t _border_before(self, Py_ssize_t visit) except -1
    cpdef int count_turns(self, int64_t[::1] turning) except -1
