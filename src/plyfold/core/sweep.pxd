# C types of `sweep.py`.
from libc.stdint cimport int64_t

from plyfold.core.monotone cimport MonotonePolygons
from plyfold.core.skip_list cimport SkipList
from plyfold.core.turns cimport ExactPoints, turn

cdef int _AT_A_TIME

cdef class Drawing:
    cdef const int64_t[::1] order, rank, following, preceding, partner, visit_edge, before, after, arriving, leaving
    cdef const int64_t[::1] cusp, bridge_of_foot, bridge_at, above, before_bridge, bridge_border
    cdef const int64_t[::1] own_sheet, row, beyond

cdef class StrandsOnLine:
    cdef Py_ssize_t made
    cdef int64_t[::1] room, node, border, edge

cdef class IntervalsOnLine:
    cdef Py_ssize_t made
    cdef int64_t[::1] room, of_edge, upper_edge, bottom, top

    cdef Py_ssize_t begin(self) except -1

cdef class Sweep:
    cdef Drawing drawing
    cdef ExactPoints points
    cdef Py_ssize_t n
    cdef SkipList nodes
    cdef StrandsOnLine strands
    cdef IntervalsOnLine intervals
    cdef MonotonePolygons polygons

cdef Py_ssize_t _count_starts(Drawing drawing, Py_ssize_t n) except -1
cdef Py_ssize_t _count_turns(Drawing drawing, Py_ssize_t n) except -1
cpdef Py_ssize_t sweep_over(
    Drawing drawing, ExactPoints points, ExactPoints given, bint is_flat, int64_t[::1] faces, int64_t[::1] sides
) except -1
cdef int _pass_vertex(Sweep sweep, Py_ssize_t vertex) except -1
cdef int _begin_bridge(Sweep sweep, Py_ssize_t foot) except -1
cdef int _cross(Sweep sweep, Py_ssize_t visit) except -1
cdef bint _runs_ahead(Drawing drawing, Py_ssize_t edge) except -1
cdef Py_ssize_t _border_behind(Drawing drawing, Py_ssize_t visit, Py_ssize_t edge) except? -2
cdef int _replace(Sweep sweep, Py_ssize_t old, Py_ssize_t new, Py_ssize_t vertex) except -1
cdef int _take_over(Sweep sweep, Py_ssize_t old, Py_ssize_t new, Py_ssize_t vertex) except -1
cdef Py_ssize_t _border_at(Drawing drawing, Py_ssize_t edge, Py_ssize_t vertex) except? -2
cdef int _begin(Sweep sweep, Py_ssize_t vertex, bint convex) except -1
cdef Py_ssize_t _place_below(Sweep sweep, Py_ssize_t vertex) except -1
cdef bint _is_above(Sweep sweep, Py_ssize_t vertex, Py_ssize_t edge) except -1
cdef Py_ssize_t _interval_around(Sweep sweep, Py_ssize_t sheet, Py_ssize_t place) except? -2
cdef Py_ssize_t _insert(Sweep sweep, Py_ssize_t edge, Py_ssize_t vertex, Py_ssize_t place) except -1
cdef Py_ssize_t _link(Sweep sweep, Py_ssize_t edge, Py_ssize_t border, Py_ssize_t place) except -1
cdef int _end(Sweep sweep, Py_ssize_t vertex, bint convex) except -1
cdef int _wind(Sweep sweep, Py_ssize_t vertex, bint comes, bint goes) except -1
cdef bint _is_convex(Sweep sweep, Py_ssize_t vertex) except -1
cdef Py_ssize_t _place_at_cusp(Sweep sweep, Py_ssize_t vertex, bint comes, bint goes) except? -2
cdef Py_ssize_t _first_at_cusp(Sweep sweep, Py_ssize_t vertex, bint comes, bint goes) except? -2
cdef Py_ssize_t _sheet_above(
    Drawing drawing, Py_ssize_t vertex, Py_ssize_t sheet, bint whole, bint on_left
) except? -2
cdef int _join(Sweep sweep, Py_ssize_t interval, Py_ssize_t polygon, Py_ssize_t upper_edge) except -1
cdef int _move_edges(Sweep sweep, Py_ssize_t vertex, Py_ssize_t place, bint comes, bint goes) except -1
cdef int _meet(Sweep sweep, Py_ssize_t interval, Py_ssize_t vertex, int side) except -1
cdef int _split(Sweep sweep, Py_ssize_t interval, Py_ssize_t fresh, Py_ssize_t vertex) except -1
cdef int _cut(Sweep sweep, Py_ssize_t interval, Py_ssize_t vertex) except -1
