"""Proofs by inspection: a mesh is a surface, lies over its outline, and does not cut itself.

The checks read nothing but the finished mesh and the curve, share no code with the rest of the library, and decide by
integers, by comparisons of doubles and by exact signs, with no tolerance. What passes is right, however it was made.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
