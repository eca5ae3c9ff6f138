# C types of `seams.py`.
from libc.stdint cimport int32_t, int64_t

cdef class GluedSeams:
    cdef const int64_t[::1] start, own, first_left, first_right, sheets_left
    cdef const int32_t[::1] glued_to

cpdef int first_fault(GluedSeams seams, const int64_t[::1] around, int32_t[::1] taken) except -1
cdef int _fault_along(GluedSeams seams, Py_ssize_t seam, int32_t[::1] taken) except -1
cdef bint _agree(GluedSeams seams, int64_t a_top, int64_t a_bottom, int64_t b_top, int64_t b_bottom) except -1
