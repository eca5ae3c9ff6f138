# C types of `cell_tree.py`.
cimport cython
from libc.stdint cimport int64_t

from plyfold.core.cells cimport root_of

@cython.final
cdef class CellTree:
    cdef Py_ssize_t cells, borders, n_saddles
    cdef const int64_t[::1] cell_of_dart, next_dart, winding
    cdef readonly int64_t[::1] parent, link, ascends, along, bend, first_child, next_sibling, turning
    cdef int64_t[::1] pit, joined, shore, stack, saddle, next_shore, rising, between, order, behind, is_listed

    @cython.locals(rest=int64_t[::1])
    cpdef int begin(
        self,
        const int64_t[::1] cell_of_dart,
        const int64_t[::1] next_dart,
        const int64_t[::1] winding,
        int64_t[::1] room,
    ) except -1
    cpdef int flood(self) except -1
    cdef int _find_pit(self, int64_t cell) except -1
    cdef int _find_saddles(self) except -1
    cdef Py_ssize_t _find_borders_between(self) except -1
    @cython.locals(count=int64_t[::1])
    cdef Py_ssize_t _sort_by_winding(self, Py_ssize_t size) except -1
    cdef int _note_saddle(self, int64_t border) except -1
    cdef int _turn_to_root(self) except -1
    cdef int _evert(self, int64_t cell, int64_t above, int64_t border) except -1
    cpdef int measure(self) except -1
    cdef int _sort_from_root(self) except -1
    cdef int _find_turnings(self) except -1
    cdef int _find_children(self, int64_t cell) except -1
    cdef int64_t _exit_of(self, int64_t cell) except -1

cpdef Py_ssize_t room_for_tree(Py_ssize_t cells, Py_ssize_t borders) noexcept
