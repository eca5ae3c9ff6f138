# C types of `sewing.py`.
cimport cython
from libc.stdint cimport int32_t, int64_t

@cython.final
cdef class NamedTree:
    cdef const int64_t[::1] parent, link, partner, winding, first_sheet
    cdef int32_t[::1] name
    cdef int64_t[::1] named, waiting

@cython.final
cdef class Crossings:
    cdef const int64_t[::1] around, at_start, at_end
    cdef int64_t[::1] unknown, sum_unknown, ready
    cdef int32_t[::1] scratch

@cython.final
cdef class BorderSeams:
    cdef const int64_t[::1] start
    cdef int32_t[::1] upper
    cdef int64_t[::1] own

cpdef int sew(NamedTree tree, Crossings crossings, BorderSeams seams) except -1
cpdef int number_sheets(BorderSeams seams, const int64_t[::1] first_sheet) except -1
cdef int _name_sheets(NamedTree tree, BorderSeams seams, Py_ssize_t cell) except -1
cdef int _complete(Crossings crossings, BorderSeams seams) except -1
cdef Py_ssize_t _note_seam(Crossings crossings, Py_ssize_t border, Py_ssize_t crossing, Py_ssize_t size) except -1
cdef int _find_seam(Crossings crossings, BorderSeams seams, Py_ssize_t border, Py_ssize_t crossing) except -1
cdef int _find_lower(
    BorderSeams seams, Crossings crossings, Py_ssize_t border, Py_ssize_t bottom, Py_ssize_t top, Py_ssize_t other_top
) except -1
cdef int _find_upper(
    BorderSeams seams, Py_ssize_t border, Py_ssize_t bottom, Py_ssize_t other_top, Py_ssize_t other_bottom
) except -1
