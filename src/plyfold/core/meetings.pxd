# C types of `meetings.py`.
cimport cython
from libc.stdint cimport int64_t

from plyfold.core.numbers cimport Numbers
from plyfold.core.signs cimport quick_sign

cdef int _GROUP, _PAIRS
cdef double _FAR

@cython.final
cdef class Meetings:
    cdef readonly Numbers crossings, touches
    cdef readonly Py_ssize_t exact_signs
    cdef object step
    cdef Py_ssize_t n, leaves, pairs
    cdef const int64_t[::1] following
    cdef double[::1] ends, box
    cdef int64_t[::1] heading

    @cython.locals(rest=int64_t[::1])
    cpdef int find(
        self, const double[::1] points, const int64_t[::1] following, double[::1] real, int64_t[::1] whole
    ) except -1
    cdef int _fill_edges(self, const double[::1] points) except -1
    cdef int _fill_groups(self) except -1
    cdef int _fill_leaf(self, Py_ssize_t node) except -1
    cdef int _heading(self, Py_ssize_t edge) except -1
    cdef int _join(self, Py_ssize_t node) except -1
    cdef int _within(self, Py_ssize_t node) except -1
    cdef int _between(self, Py_ssize_t node, Py_ssize_t other) except -1
    cdef bint _are_apart(self, Py_ssize_t node, Py_ssize_t other) except -1
    cdef bint _are_one_strand(self, Py_ssize_t node, Py_ssize_t other) except -1
    cdef int _meet_edges(self, Py_ssize_t node, Py_ssize_t other) except -1
    cdef int _meet_one(self, Py_ssize_t edge, Py_ssize_t node, Py_ssize_t start, Py_ssize_t stop) except -1
    cdef int _meet(self, Py_ssize_t edge, Py_ssize_t other) except -1
    cdef int _side(self, Py_ssize_t edge, Py_ssize_t other, int end) except? -2
    cdef int _touch(self, Py_ssize_t edge, Py_ssize_t other, int side, int end) except -1

cpdef Py_ssize_t count_groups(Py_ssize_t edges) noexcept
cdef int _way(double start, double end) noexcept
cdef bint _is_between(double start, double number, double end) noexcept
