# C types of `gluing.py`.
cimport cython
from libc.stdint cimport int32_t, int64_t, uint8_t
from plyfold.core.cells cimport join, number_joined

cdef int _NO_SEAM

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
cpdef int number_pieces(Gluing gluing, int64_t[::1] joined, int64_t[::1] piece) except -1
cpdef int add_characteristics(
    Gluing gluing,
    const int64_t[::1] around,
    const int64_t[::1] index,
    const int64_t[::1] after,
    const int64_t[::1] piece,
    int64_t[::1] total,
) except -1
cdef int _add_on_left(
    Gluing gluing, int64_t seam, const int64_t[::1] piece, int64_t[::1] total, int64_t number
) except -1
cpdef int find_corners(
    const int64_t[::1] partner,
    const uint8_t[::1] ccw,
    const int64_t[::1] before,
    const int64_t[::1] after,
    int64_t[::1] around,
) except -1
@cython.locals(upper=int64_t, lower=int64_t, sets_out=bint, on_left=bint)
cpdef int find_corners_at_feet(
    const int64_t[::1] foot,
    const int64_t[::1] dart,
    const int64_t[::1] before,
    const int64_t[::1] after,
    int64_t borders,
    int64_t[::1] around,
) except -1
