# C types of `halving.py`.
cimport cython
from libc.stdint cimport int64_t

from plyfold.core.sides cimport next_side

@cython.final
cdef class HalvedMesh:
    cdef int64_t[::1] corner, twin, origin, target, ends
    cdef double[::1] x, y, way
    cdef readonly Py_ssize_t triangles, vertices
    cdef Py_ssize_t given

cpdef Py_ssize_t halve_towards(
    HalvedMesh mesh, double finest, double growth, const double[::1] excess, Py_ssize_t most
) except -1
cdef bint _is_too_long(
    HalvedMesh mesh, Py_ssize_t triangle, double finest, double growth, double excess
) except -1
cdef bint _halve_at(HalvedMesh mesh, Py_ssize_t triangle) except -1
cdef int _halve(HalvedMesh mesh, Py_ssize_t side) except -1
cdef Py_ssize_t _split(HalvedMesh mesh, Py_ssize_t side, Py_ssize_t middle) except -1
cdef Py_ssize_t _longest(HalvedMesh mesh, Py_ssize_t triangle) except -1
cdef double _length(HalvedMesh mesh, Py_ssize_t side) except? -1
cdef double _distance(HalvedMesh mesh, Py_ssize_t start, Py_ssize_t end) except? -1
