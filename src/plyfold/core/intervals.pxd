# C types of `intervals.py`.
cimport cython
from libc.stdint cimport int64_t

cdef int64_t _BITS, _WORDS, _LITTLE

@cython.final
cdef class Intervals:
    cdef const int64_t[::1] wall, first, bound, plus, block
    cdef readonly int64_t[::1] fits
    cdef int64_t[::1] entry, next_entry, next_wall, row_of, row, start, lowest, words
    cdef Py_ssize_t places, low, high, rows, noted
    cdef object step, ask

    cpdef bint has(self, Py_ssize_t start, Py_ssize_t end) except -1
    cdef bint _is_entered(self, Py_ssize_t start, int64_t wall, Py_ssize_t end) except -1
    cdef bint _reaches(self, Py_ssize_t place, int64_t post) except -1
    cdef int _find_walls(self) except -1
    cdef int _fill_row(self, Py_ssize_t place, int64_t wall) except -1
    cdef bint _add_chord(self, Py_ssize_t chord, int64_t bound, int64_t plus) except -1
    cdef int _clear_row(self) except -1
    cdef int _add_post(self, int64_t post) except -1
    cdef int64_t _bit(self, int64_t number) noexcept
    cdef int _widen(self, Py_ssize_t low, Py_ssize_t high) except -1
    cdef int _add_row(self, int64_t number) except -1
    cdef int _keep_row(self) except -1
    cdef int _grow(self, Py_ssize_t size) except -1
