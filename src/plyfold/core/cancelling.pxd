# C types of `cancelling.py`.
cimport cython
from libc.stdint cimport int64_t

from plyfold.core.lowering cimport copy_row, lower_row

cdef int64_t _NONE, _STEPS

cpdef Py_ssize_t cancel_neighbours(int64_t[::1] code, int64_t[::1] place, int64_t[::1] mate) except -1
@cython.locals(outside=int64_t[::1])
cpdef int find_faces(const int64_t[::1] mate, int64_t[::1] face) except -1

@cython.final
cdef class Costs:
    cdef object step, ask
    cdef const int64_t[::1] code
    cdef const double[::1] price
    cdef Py_ssize_t letters, done, used
    cdef int64_t[::1] begin, place, head, later
    cdef double[::1] extra, rows

    cdef Py_ssize_t _alphabet(self) except -1
    cdef int _make_room(self) except -1
    cdef int _fill(self) except -1
    cdef int _keep_row(self, Py_ssize_t letter) except -1
    cdef int _fill_row(self, Py_ssize_t letter) except -1
    cdef int _lower(self, Py_ssize_t letter, Py_ssize_t middle, double cost) except -1
    cdef int _count(self, Py_ssize_t steps) except -1
    cpdef double of(self, Py_ssize_t start, Py_ssize_t end) except -1
    @cython.locals(stack=int64_t[::1])
    cpdef int find_mates(self, int64_t[::1] mate) except -1
    cdef Py_ssize_t _mate_of(self, Py_ssize_t start, Py_ssize_t end) except -1
    cdef Py_ssize_t _next(self, Py_ssize_t letter, int64_t code) except -1
