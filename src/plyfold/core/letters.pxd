# C types of `letters.py`.
cimport cython
from libc.stdint cimport int64_t

from plyfold.core.cell_tree cimport CellTree
from plyfold.core.numbers cimport Numbers

cdef int64_t _NONE, _FREE

@cython.final
cdef class Letters:
    cdef readonly Py_ssize_t labels
    cdef Py_ssize_t n_plus, mask, n_arcs
    cdef CellTree tree
    cdef Numbers plus
    cdef const int64_t[::1] wanted
    cdef int64_t[::1] is_on_way, arc, last_arc, direction, potential, before, place, key, last, next
    cdef readonly int64_t[::1] cells, border, label, block, minus, first, partner

    @cython.locals(rest=int64_t[::1])
    cpdef Py_ssize_t walk(self, CellTree tree, const int64_t[::1] wanted, int64_t[::1] room) except -1
    cdef int _mark_ways(self) except -1
    cdef int _walk(self) except -1
    cdef int64_t _on_way(self, int64_t cell) except? -1
    cdef int _enter(self, int64_t cell) except -1
    cdef int _leave(self, int64_t cell) except -1
    cdef int64_t _slot(self, int64_t potential) except -1
    cdef int _join_to(self, int64_t slot, int64_t border, int is_later) except -1
    cpdef int sort(self, int64_t[::1] room) except -1
    cdef int _count_on_borders(self) except -1
    cdef int _put(self, int64_t border, int64_t label) except -1
    cdef int _find_block(self, int64_t letter, int64_t label) except -1

cdef Py_ssize_t _size_of_table(Py_ssize_t cells) noexcept
cpdef Py_ssize_t room_for_arcs(Py_ssize_t cells, Py_ssize_t borders) noexcept
cpdef Py_ssize_t room_for_letters(Py_ssize_t letters) noexcept
