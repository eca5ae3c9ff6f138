# C types of `rounder.py`.
from libc.stdint cimport int64_t

from plyfold.core.sides cimport distance, next_side, previous_side
from plyfold.core.turns cimport ExactPoints, turn

cdef int _LEFT, _RIGHT, _AT_A_TIME
cdef double _CLEARLY

cdef class Corners:
    cdef ExactPoints points
    cdef const double[::1] unit

cdef class Triangles:
    cdef int64_t[::1] start, room, beyond, name, named

cdef class Cut:
    cdef Corners corners
    cdef Triangles triangles
    cdef Py_ssize_t half, n_removed, n_steps
    cdef int64_t[::1] room, chains, removed, side, corner, outer, name, sizes

cpdef Py_ssize_t open_cuts(
    Corners corners, Triangles triangles, const int64_t[::1] one, const int64_t[::1] other
) except -1
cdef Py_ssize_t _open(Cut cut, Py_ssize_t one, Py_ssize_t other) except -1
cdef int _glue(Triangles triangles, Py_ssize_t side, Py_ssize_t other, Py_ssize_t name) except -1
cdef Py_ssize_t _next(Cut cut, int chain) except? -2
cdef Py_ssize_t _corner(Cut cut, int chain) except? -2
cdef bint _widen(Cut cut, int chain, Py_ssize_t witness) except -1
cdef int _remove(Cut cut, int chain, Py_ssize_t side) except -1
cdef int _widen_at_foot(Cut cut) except -1
cdef bint _climb(Cut cut, Py_ssize_t foot) except -1
cdef int _next_chain(Cut cut, Py_ssize_t left, Py_ssize_t right) except? -2
cdef int _step(Cut cut, int chain, Py_ssize_t corner) except -1
cdef int _rebuild(Cut cut, Py_ssize_t foot) except -1
cpdef bint wants_flip(Corners corners, Py_ssize_t u, Py_ssize_t b, Py_ssize_t v, Py_ssize_t a) except -1
cdef double _sine_of_both(const double[::1] unit, Py_ssize_t u, Py_ssize_t b, Py_ssize_t v, Py_ssize_t a) except? -2
