# C types of `monotone.py`.
from libc.stdint cimport int64_t

from plyfold.core.turns cimport ExactPoints, turn

cdef class MonotonePolygons:
    cdef ExactPoints points
    cdef bint is_flat
    cdef int64_t[::1] room, last, side, vertex, before, edge, faces, sides
    cdef Py_ssize_t n_polygons, n_entries, n_edges, rung
    cdef readonly Py_ssize_t n_triangles

    cdef Py_ssize_t new_edge(self) except -1
    cdef Py_ssize_t begin(self, Py_ssize_t vertex) except -1
    cdef Py_ssize_t begin_behind(self, Py_ssize_t polygon) except -1
    cdef int _push(self, Py_ssize_t polygon, Py_ssize_t vertex, Py_ssize_t before, Py_ssize_t edge) except -1
    cdef int add(self, Py_ssize_t polygon, Py_ssize_t vertex, int side, Py_ssize_t edge) except -1
    cdef int close(self, Py_ssize_t polygon, Py_ssize_t vertex, Py_ssize_t near, Py_ssize_t far) except -1
    cdef Py_ssize_t _cut_off(
        self, Py_ssize_t polygon, Py_ssize_t vertex, Py_ssize_t edge, Py_ssize_t last_edge
    ) except? -2
    cdef bint _is_cut(self, Py_ssize_t entry, Py_ssize_t vertex, bint is_above, bint faces_chain) except -1
    cdef int _add_triangle(self, Py_ssize_t entry, Py_ssize_t vertex, bint is_above, Py_ssize_t edge) except -1
    cdef bint _is_cut_flat(self, Py_ssize_t far, Py_ssize_t near, Py_ssize_t vertex, bint faces_chain) except -1
    cdef bint _is_same(self, Py_ssize_t one, Py_ssize_t other) except -1
