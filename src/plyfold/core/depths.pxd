# C types of `depths.py`.
from libc.stdint cimport int64_t

cdef class DepthBuffer:
    cdef double[::1] depth
    cdef int64_t[::1] triangle
    cdef Py_ssize_t columns, rows
    cdef double left, right

cdef class Slope:
    cdef double x, y, slope, rise

cdef class SeenTriangle:
    cdef double ax, ay, az, bx, by, bz, cx, cy, cz
    cdef double turn, right, up, lowest, highest
    cdef Slope ab, bc, ca

cpdef int fill_depths(DepthBuffer buffer, const double[::1] corners) except -1
cpdef int count_hidden(
    DepthBuffer buffer, const double[::1] projection, const double[::1] points, int64_t[::1] hidden
) except -1
cdef int _read(SeenTriangle triangle, const double[::1] corners, Py_ssize_t start) except -1
cdef int _fill_rows(DepthBuffer buffer, SeenTriangle triangle, Py_ssize_t number) except -1
cdef int _fill_row(DepthBuffer buffer, SeenTriangle triangle, Py_ssize_t number, Py_ssize_t row) except -1
cdef int _set_edge(Slope edge, double turn, double ax, double ay, double bx, double by) except -1
cdef int _narrow(DepthBuffer buffer, Slope edge, double row) except -1
cdef Py_ssize_t _first_above(double number, Py_ssize_t most) except -1
cdef Py_ssize_t _count_up_to(double number, Py_ssize_t most) except -1
cdef Py_ssize_t _whole(double number) except? -1
