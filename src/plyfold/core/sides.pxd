# C types of `sides.py`.
cdef extern from "math.h":
    cpdef double sqrt(double x)

cpdef Py_ssize_t next_side(Py_ssize_t side) except? -2
cpdef Py_ssize_t previous_side(Py_ssize_t side) except? -2
cpdef double distance(double x, double y) except? -1
