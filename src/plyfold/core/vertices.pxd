# C types of `vertices.py`.
from plyfold.core.signs cimport quick_sign

cdef double _LARGEST, _TINY

cpdef Py_ssize_t without_closing_point(const double[::1] points) except -1
cpdef Py_ssize_t count_vertices(const double[::1] points) except -1
cdef bint _has_corner(const double[::1] points, Py_ssize_t n) except -1
cpdef bint is_tiny(const double[::1] points) except -1
