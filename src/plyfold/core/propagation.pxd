# C types of `propagation.py`.
cimport cython
from libc.stdint cimport int64_t

cdef int _LETTERS

@cython.final
cdef class Parts:
    cdef Py_ssize_t labels
    cdef const int64_t[::1] label, block
    cdef readonly int64_t[::1] part
    cdef int64_t[::1] to_come, waiting, stack

    cpdef int begin(
        self, const int64_t[::1] label, const int64_t[::1] block, Py_ssize_t labels, int64_t[::1] room
    ) except -1
    cpdef int join(self, const int64_t[::1] letters, Py_ssize_t size) except -1
    cpdef int64_t of(self, int64_t letter) except? -1
    cdef int _join_blocks(self, const int64_t[::1] letters, Py_ssize_t size) except -1
    cdef int _join_crossing(self, const int64_t[::1] letters, Py_ssize_t size) except -1
    cdef Py_ssize_t _pass(self, int64_t here, Py_ssize_t top) except? -1
    cpdef Py_ssize_t list_in(
        self, const int64_t[::1] letters, Py_ssize_t size, int64_t[::1] listed, int64_t[::1] start
    ) except? -1
    cdef Py_ssize_t _place_parts(self, int64_t[::1] start) except? -1

@cython.final
cdef class Propagation:
    cdef readonly Parts parts
    cdef readonly Py_ssize_t letters, labels, walked
    cdef readonly int64_t[::1] partner, chosen, stop, removed_by, found
    cdef object step
    cdef const int64_t[::1] border, label, block, minus, first
    cdef int64_t[::1] after, before, due, is_due
    cdef Py_ssize_t noted, next_due, n_due, n_found, steps
    cdef int64_t reach
    cdef bint on_left

    cpdef int begin(
        self,
        const int64_t[::1] border,
        const int64_t[::1] label,
        const int64_t[::1] block,
        const int64_t[::1] minus,
        const int64_t[::1] first,
        int64_t[::1] partner,
        int64_t[::1] room,
    ) except -1
    cpdef int64_t narrow(self) except? -1
    cpdef int64_t narrow_further(self, const int64_t[::1] letters) except? -1
    cdef int64_t _settle_all(self) except? -1
    cpdef Py_ssize_t letters_in_play(self) except? -1
    cdef int _close_rings(self) except -1
    cdef int _link(self, int64_t letter, int64_t following) except -1
    cdef int64_t _take_due(self) except? -1
    cdef int _put_due(self, int64_t label) except -1
    cdef int64_t _settle(self, int64_t label) except? -1
    cdef int _remove(self, int64_t letter, int64_t label) except -1
    cdef int _draw_chord(self, int64_t label, int64_t minus, int64_t plus) except -1
    cdef Py_ssize_t _find_misfits(self, int64_t label) except? -1
    cdef int _note(self, int64_t letter) except -1
    cdef int _find_sharing_border(self, int64_t plus) except -1
    cdef int _find_across_gap(self, int64_t label, int64_t minus) except -1
    cdef int _walk_out(self, int64_t label, int64_t minus) except -1
    cdef int _count(self, Py_ssize_t letters) except -1
    cdef int _find_reach(self, int64_t label, int64_t minus) except -1
    cdef int _find_beyond(self, int64_t other, int64_t minus) except -1
    cdef int64_t _steps_to(self, int64_t letter, int64_t minus) noexcept

cpdef Py_ssize_t room_for_parts(Py_ssize_t labels) noexcept
cpdef Py_ssize_t room_for_propagation(Py_ssize_t letters, Py_ssize_t labels) noexcept
