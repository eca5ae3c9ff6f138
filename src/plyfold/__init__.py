"""Closed curves that cross themselves: immersed disks, their layerings, and the surfaces they bound.

>>> import plyfold as pf
>>> ramp = pf.Curve([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)])
>>> pf.bounds_disk(ramp), pf.count_immersions(ramp)
(True, 1)
"""

import lazy_loader

# The names are listed in the stub beside this file; a room is loaded when one of its names is first asked for.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

__version__ = "0.3.0"
