# C types of `cells.py`.
from libc.stdint cimport int64_t

cpdef Py_ssize_t walk_cells(
    const int64_t[::1] following, int64_t outer, int64_t[::1] darts, int64_t[::1] start, int64_t[::1] cell
) except -1
cpdef int join_lakes(
    const int64_t[::1] lake, const int64_t[::1] other, int64_t[::1] joined, int64_t[::1] joins
) except -1
cpdef int sum_down(const int64_t[::1] highest_first, const int64_t[::1] drain, int64_t[::1] total) except -1
cdef int64_t _representative(int64_t[::1] joined, int64_t member) except -1
