# C types of `cells.py`.
cimport cython
from libc.stdint cimport int64_t, uint8_t

cpdef Py_ssize_t walk_cells(
    const int64_t[::1] following, int64_t outer, int64_t[::1] darts, int64_t[::1] start, int64_t[::1] cell
) except -1
cpdef int number_components(
    const int64_t[::1] start, const int64_t[::1] end, int64_t[::1] joined, int64_t[::1] number
) except -1
cpdef int join(int64_t[::1] joined, int64_t one, int64_t other) except -1
cpdef int number_joined(int64_t[::1] joined, int64_t[::1] number) except -1
cpdef int64_t root_of(int64_t[::1] joined, int64_t member) except -1
@cython.locals(before=int64_t[::1], after=int64_t[::1])
cpdef int follow_darts(
    const int64_t[::1] partner,
    const uint8_t[::1] ccw,
    const int64_t[::1] first_visit,
    int64_t[::1] following,
    int64_t[::1] room,
) except -1
@cython.locals(cycle=int64_t[::1], joined=int64_t[::1], number=int64_t[::1])
cpdef Py_ssize_t walk_joined_cells(
    const int64_t[::1] following,
    const int64_t[::1] outside,
    const int64_t[::1] same_cell,
    int64_t[::1] darts,
    int64_t[::1] start,
    int64_t[::1] cell,
) except -1
cdef Py_ssize_t _walk_cycles(const int64_t[::1] following, int64_t[::1] cycle, int64_t[::1] joined) except -1
cdef int _join_cycles(int64_t[::1] joined, int64_t one, int64_t other) except -1
@cython.locals(size=int64_t[::1], is_listed=int64_t[::1])
cpdef int list_darts(
    const int64_t[::1] following, const int64_t[::1] cell, Py_ssize_t cells, int64_t[::1] darts, int64_t[::1] start
) except -1
