# C types of `visits.py`.
cimport cython
from libc.stdint cimport int64_t, uint8_t

from plyfold.core.numbers cimport Numbers

cdef double _PARAMETER_ERROR, _UNDERFLOW, _FAR

@cython.final
cdef class VisitsAlong:
    cdef const double[::1] points
    cdef const int64_t[::1] following, edge
    cdef double[::1] place, error
    cdef int64_t[::1] order, first, rank
    cdef Py_ssize_t k
    cdef readonly Numbers unsure

    cpdef int sort(
        self,
        const double[::1] points,
        const int64_t[::1] following,
        const int64_t[::1] edge,
        int64_t[::1] order,
        double[::1] real,
        int64_t[::1] whole,
    ) except -1
    cdef int _find_place(self, Py_ssize_t visit, Py_ssize_t edge, Py_ssize_t other) except -1
    cdef int _note_place(self, Py_ssize_t visit, double above, double below, double error) except -1
    cdef int _sort(self) except -1
    cdef int _put(self, Py_ssize_t visit, Py_ssize_t edge) except -1
    cdef int _sort_edge(self, Py_ssize_t low, Py_ssize_t high) except -1
    cdef int _sink(self, Py_ssize_t low, Py_ssize_t at, Py_ssize_t gap) except -1
    cdef bint _is_apart(self, Py_ssize_t visit, Py_ssize_t other) except -1
    cpdef int join(
        self,
        const uint8_t[::1] from_right,
        int64_t[::1] visit_edge,
        int64_t[::1] partner,
        uint8_t[::1] ccw,
        double[::1] point,
    ) except -1
