# C types of `many.py`.
cimport cython
from libc.stdint cimport int64_t

from plyfold.core.verdict cimport PlainCurve

cdef int _NO, _YES, _NOT_TOLD

@cython.locals(curve=PlainCurve)
cpdef int decide_each(
    const double[::1] points, const int64_t[::1] start, int64_t[::1] told, int64_t[::1] figures, object step
) except -1
