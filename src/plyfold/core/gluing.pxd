# C types of `gluing.py`.
cimport cython
from libc.stdint cimport int32_t, int64_t

@cython.final
cdef class Gluing:
    cdef const int64_t[::1] own, start, left_sheet, left_sheets, right_sheet
    cdef const int32_t[::1] glued_to

cpdef int first_wrong_seam(Gluing gluing, int32_t[::1] mark) except -1
cdef int _reach(Gluing gluing, Py_ssize_t seam, int64_t sheet, int32_t[::1] mark) except -1
cpdef int agree_around(Gluing gluing, const int64_t[::1] around) except -1
cdef bint _carries_own(Gluing gluing, Py_ssize_t bottom, Py_ssize_t top, Py_ssize_t across) except -1
cdef int64_t _count(Gluing gluing, Py_ssize_t seam) except -1
cdef int64_t _up(Gluing gluing, Py_ssize_t seam, int64_t sheet) except -1
cpdef int wind_round(
    Gluing gluing, const int64_t[::1] index, const int64_t[::1] before, const int64_t[::1] after
) except -1
cdef int64_t _sheet_below(Gluing gluing, Py_ssize_t border, int64_t upper) except? -2
cdef int64_t _count_differing(Gluing gluing, Py_ssize_t before, Py_ssize_t after) except -1
