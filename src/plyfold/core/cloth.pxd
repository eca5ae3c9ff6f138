# C types of `cloth.py`.
cimport cython
from libc.stdint cimport int32_t, int64_t

from plyfold.core.sewing cimport BorderSeams, Crossings, NamedTree, sew
from plyfold.core.sweep cimport Drawing, sweep_over
from plyfold.core.turns cimport ExactPoints
from plyfold.core.verdict cimport PlainCurve

cdef int _UNTOLD, _CLOCKWISE, _YES
cdef double _TILT, _ERROR, _PARAMETER_ERROR, _UNDERFLOW, _TINY_PRODUCT, _FAR
cdef Py_ssize_t _MOST_SEAMS

@cython.final
cdef class CutDisk:
    cdef PlainCurve curve
    cdef Py_ssize_t n, k, borders, cells, sheets, seams, events
    cdef int64_t highest
    cdef const double[::1] points
    cdef double[::1] reach, error, nearest
    cdef int32_t[::1] upper, names, scratch
    cdef int64_t[::1] own, first_sheet, start, joined, is_named, around, at_start, at_end, unknown, sum_unknown
    cdef int64_t[::1] off_tree, order, event, rank, preceding, cusp, bridge_at, nothing, border_at, before, after
    cdef int64_t[::1] row, beyond

    cdef Py_ssize_t count_sheets(self) except -1
    @cython.locals(seams=BorderSeams, shorts=int32_t[::1])
    cdef int sew(self) except -1
    @cython.locals(named=NamedTree)
    cdef NamedTree _named_tree(self)
    @cython.locals(crossings=Crossings)
    cdef Crossings _crossings(self)
    cdef int64_t[::1] _border_row(self)
    cdef int _find_corners(self) except -1
    cdef int _count_unknown(self) except -1
    cdef int find_order(self) except -1
    cdef int _note(self, Py_ssize_t event, double reach, double error) except -1
    cdef int _find_reach(self, Py_ssize_t visit, Py_ssize_t edge, Py_ssize_t other) except -1
    cdef int _sort(self) except -1
    cdef int _sink(self, Py_ssize_t place, Py_ssize_t size) except -1
    cdef int _settle(self) except -1
    cdef int _sort_exactly(self, Py_ssize_t start, Py_ssize_t stop) except -1
    cdef object _exact_reach(self, Py_ssize_t event)
    cdef object _exact_point(self, Py_ssize_t point)
    cdef object _exact_crossing(self, Py_ssize_t edge, Py_ssize_t other)
    @cython.locals(points=ExactPoints)
    cdef Py_ssize_t triangles(self, int64_t[::1] faces, int64_t[::1] sides) except -1
    @cython.locals(drawing=Drawing)
    cdef Drawing _drawing(self)
    cdef int _find_ranks(self) except -1
    cdef int _find_neighbours(self) except -1
    cdef int _find_borders(self) except -1
    cdef int _find_beyond(self) except -1
    cdef int _cross_border(self, Py_ssize_t border) except -1

@cython.locals(curve=PlainCurve, disk=CutDisk)
cpdef Py_ssize_t cut_into_triangles(
    const double[::1] points, object step, int64_t[::1] faces, int64_t[::1] sides
) except? -3
