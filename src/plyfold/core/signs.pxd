# C types of `signs.py`.
cdef int _OPEN
cdef double _ORIENT_ERROR, _UNDERFLOW, _SMALL_PRODUCT, _LARGE_PRODUCT, _SPLITTER

cpdef int quick_sign(
    double ax, double ay, double bx, double by, double cx, double cy, double dx, double dy
) except? -2
cpdef int exact_sign(
    double ax, double ay, double bx, double by, double cx, double cy, double dx, double dy
) except? -2
cdef int _sign_of_products(
    double ax, double ay, double bx, double by, double cx, double cy, double dx, double dy
) noexcept
cdef bint _is_exact_product(double a, double b, double c, double d) noexcept
cpdef double rest_of_difference(double a, double b) noexcept
cdef double _product(double one, double other) noexcept
cpdef double rest_of_product(double one, double other) noexcept
