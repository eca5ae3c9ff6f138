# C types of `lowering.py`.
cimport cython

@cython.locals(lower=double, here=double, number=Py_ssize_t)
cpdef int lower_row(
    double[::1] numbers, Py_ssize_t place, Py_ssize_t source, Py_ssize_t size, double more
) except -1
@cython.locals(number=Py_ssize_t)
cpdef int copy_row(
    double[::1] numbers, Py_ssize_t place, Py_ssize_t source, Py_ssize_t size, double more
) except -1
