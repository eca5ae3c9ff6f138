# C types of `mending.py`.
from libc.stdint cimport int64_t

from plyfold.core.sides cimport distance, next_side, previous_side
from plyfold.core.turns cimport ExactPoints, turn

cdef int _FREE, _GIVEN, _LONGEST_WALK, _AT_A_TIME
cdef double _SINE, _FAR, _THIN

cdef class EdgedMesh:
    cdef readonly Py_ssize_t n_points, n_triangles
    cdef double[::1] places
    cdef int64_t[::1] on, start, beyond, piece, cell
    cdef ExactPoints points

cdef class Mending:
    cdef EdgedMesh mesh
    cdef const int64_t[::1] first, last
    cdef double finest
    cdef double[::1] place
    cdef Py_ssize_t ring, head, n_waiting, n_cavity, n_edges
    cdef int64_t[::1] room, waiting, waits, cavity, inside, edge, edge_from, edge_to, edge_beyond, edge_piece, spoke

    cdef int64_t[::1] _row(self, Py_ssize_t number)

cpdef bint is_to_mend(Mending work, Py_ssize_t triangle) except -1
cpdef bint mend(Mending work, const int64_t[::1] sharp) except -1
cdef Py_ssize_t _next_waiting(Mending work) except -1
cdef int _wait(Mending work, Py_ssize_t triangle) except -1
cdef Py_ssize_t _side_to_mend(Mending work, Py_ssize_t triangle) except? -2
cdef double _cross(EdgedMesh mesh, Py_ssize_t a, Py_ssize_t b, Py_ssize_t c) except? -1
cdef bint _is_left_alone(Mending work, Py_ssize_t side) except -1
cdef bint _is_across_corner(Mending work, Py_ssize_t u, Py_ssize_t v) except -1
cdef bint _is_strip(Mending work, Py_ssize_t side) except -1
cdef double _look_along(Mending work, Py_ssize_t point, Py_ssize_t towards, Py_ssize_t piece) except? -1
cdef bint _improve(Mending work, Py_ssize_t side) except -1
cdef int _find_place(Mending work, Py_ssize_t side) except -1
cdef Py_ssize_t _walk(EdgedMesh mesh, Py_ssize_t triangle, Py_ssize_t point) except? -1
cdef bint _is_left(EdgedMesh mesh, Py_ssize_t side, Py_ssize_t point) except -1
cdef double _distance(EdgedMesh mesh, Py_ssize_t a, Py_ssize_t b) except? -1
cdef Py_ssize_t _add_point(Mending work, Py_ssize_t triangle, Py_ssize_t new) except? -2
cdef Py_ssize_t _open_cavity(Mending work, Py_ssize_t triangle, Py_ssize_t point, Py_ssize_t base) except? -2
cdef bint _note_edge(Mending work, Py_ssize_t side, Py_ssize_t point) except -1
cdef int _keep_edges(Mending work) except -1
cdef bint _is_in_circle(EdgedMesh mesh, Py_ssize_t triangle, Py_ssize_t point) except -1
cdef bint _is_near(EdgedMesh mesh, Py_ssize_t side, Py_ssize_t point) except -1
cdef int _close(Mending work) except -1
cdef bint _is_open(Mending work, Py_ssize_t point, int bases) except -1
cdef Py_ssize_t _fill(Mending work, Py_ssize_t point) except? -2
cdef Py_ssize_t _one_more(EdgedMesh mesh, Py_ssize_t cell) except -1
cdef int _put(Mending work, Py_ssize_t triangle, Py_ssize_t i, Py_ssize_t point) except -1
cdef bint _split_edge(Mending work, Py_ssize_t side) except -1
cdef int _place_between(EdgedMesh mesh, Py_ssize_t u, Py_ssize_t v, Py_ssize_t new) except -1
