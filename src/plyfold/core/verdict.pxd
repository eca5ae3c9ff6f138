# C types of `verdict.py`.
cimport cython
from libc.stdint cimport int64_t, uint8_t

from plyfold.core.cell_tree cimport CellTree, room_for_tree
from plyfold.core.cells cimport follow_darts, walk_cells
from plyfold.core.direction cimport CurveDirection, outer_dart_of_points
from plyfold.core.letters cimport Letters, room_for_arcs, room_for_letters
from plyfold.core.meetings cimport Meetings, count_groups
from plyfold.core.propagation cimport Propagation, room_for_propagation
from plyfold.core.vertices cimport count_vertices, is_tiny
from plyfold.core.visits cimport VisitsAlong

cdef int _NO, _YES, _NOT_TOLD
cdef Py_ssize_t _BLOCK

@cython.final
cdef class PlainCurve:
    cdef readonly Py_ssize_t n, k, borders, cells, letters
    cdef readonly Meetings meetings
    cdef readonly VisitsAlong visits
    cdef readonly CurveDirection direction
    cdef readonly CellTree tree
    cdef readonly Letters word
    cdef readonly Propagation propagation
    cdef const double[::1] points
    cdef Py_ssize_t n_whole, n_real, n_bytes
    cdef int64_t[::1] following, scratch, whole
    cdef double[::1] real
    cdef uint8_t[::1] bytes
    cdef readonly double[::1] point
    cdef readonly uint8_t[::1] ccw
    cdef readonly int64_t[::1] visit_edge, partner, left, next_dart, cell_of_dart, cell_darts, cell_start, winding

    cpdef bint draw(self, const double[::1] points) except -1
    cdef int _find_crossings(self, Py_ssize_t groups) except -1
    @cython.locals(
        edge=int64_t[::1], order=int64_t[::1], from_right=uint8_t[::1], places=double[::1], whole=int64_t[::1]
    )
    cdef bint _sort_visits(self) except -1
    @cython.locals(room=int64_t[::1])
    cdef int64_t[::1] take_whole(self, Py_ssize_t size)
    @cython.locals(room=double[::1])
    cdef double[::1] take_real(self, Py_ssize_t size)
    @cython.locals(room=uint8_t[::1])
    cdef uint8_t[::1] take_bytes(self, Py_ssize_t size)
    cpdef int find_direction(self) except -1
    @cython.locals(whole_curve=int64_t[::1])
    cpdef int find_cells(self) except -1
    @cython.locals(room=int64_t[::1])
    cpdef int write_word(self) except -1
    @cython.locals(room=int64_t[::1], word=Letters)
    cpdef int has_grouping(self) except? -2

@cython.locals(curve=PlainCurve)
cpdef int decide(const double[::1] points, object step) except? -2
