# C types of `rings.py`.
cimport cython
from libc.stdint cimport int64_t

cdef int _LEFT_OVER, _NO_OWN

@cython.final
cdef class Rings:
    cdef readonly const int64_t[::1] corners, bottom, size
    cdef readonly int64_t[::1] around, own_a, own_b, at, place
    cdef int64_t borders
    cpdef int fill(self) except -1
    cpdef int64_t own_port(self, int64_t top, int64_t bottom) except -10
    cpdef int note_end(self, int64_t seam, int64_t at, int64_t place) except -1

@cython.final
cdef class Work:
    cdef readonly const int64_t[::1] start, size, seam, in_tree, own
    cdef int64_t[::1] missing, sum_port, sum_upper, open_around, ready, stack
    cdef Py_ssize_t top
    cdef int64_t reason
    cpdef int count(self) except -1

@cython.final
cdef class Found:
    cdef readonly int64_t[::1] upper, port, because
    cdef readonly int64_t failed

@cython.final
cdef class State:
    cdef readonly Rings rings
    cdef readonly Work work
    cdef readonly Found found

cpdef int close_rings(State state) except -1
cdef int _write_names(Work work, Found found) except -1
cdef int _find_whole_seams(State state) except -1
cdef int _fail(State state, int64_t at) except -1
cdef int64_t _find_last_seam(State state, int64_t at) except -2
cdef int64_t _walk_round(State state, int64_t at, int64_t place, int64_t lower) except? -2
cdef Py_ssize_t _know(Rings rings, Work work, int64_t seam, Py_ssize_t waiting) except -1
cdef int _is_closed(State state, int64_t at) except -1
cdef int _recall_pairs(State state) except -1
cdef bint _is_settled(Rings rings, Work work, int64_t at) except -1
cdef int _glue(Work work, Found found, int64_t seam, int64_t port, int64_t sheet) except -1
cdef int _conclude(State state) except -1
cdef int _keep_order(Work work, Found found, int64_t seam, int64_t port, int64_t sheet) except -1
cdef int _go_round(State state, int64_t at, int64_t place, int64_t port, int64_t sheet) except -1
cpdef int64_t step(State state, int64_t at, int64_t place, int64_t sheet, int onward) except? -2
cdef int _join(State state, int64_t at, int64_t place, int64_t here, int64_t there) except -1
