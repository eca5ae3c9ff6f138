# C types of `elimination.py`.
cimport cython
from libc.stdint cimport int32_t, int64_t

@cython.final
cdef class Triangle:
    cdef const int32_t[::1] first, row, parent
    cdef const double[::1] value, scale
    cdef double[::1] column

@cython.final
cdef class Paths:
    cdef const int64_t[::1] start
    cdef const int32_t[::1] node
    cdef const double[::1] value

cpdef int elimination_tree(
    const int32_t[::1] first, const int32_t[::1] row, const int32_t[::1] place, const int32_t[::1] at,
    int32_t[::1] parent, int32_t[::1] above
) except -1
cpdef int lengths_of_paths(
    const int32_t[::1] parent, const int64_t[::1] leaves, int64_t[::1] length
) except -1
cpdef int walk_paths(
    Triangle triangle, const int64_t[::1] leaves, int32_t[::1] node, double[::1] value
) except -1
cpdef int multiply_paths(
    Paths paths, const int64_t[::1] columns, const int64_t[::1] others, double[::1] product
) except -1
cdef Py_ssize_t _common_end(Paths paths, Py_ssize_t one, Py_ssize_t other) except -1
cdef double _end_product(Paths paths, Py_ssize_t one_end, Py_ssize_t other_end, Py_ssize_t count) except? -1
