"""Closed curves that cross themselves: immersed disks, their layerings, and the surfaces they bound.

>>> import plyfold as pf
>>> ramp = pf.Curve([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)])
>>> pf.bounds_disk(ramp), pf.count_immersions(ramp)
(True, 1)
"""

from plyfold import errors, gallery
from plyfold.arrangement import Arrangement, arrangement
from plyfold.curve import Curve
from plyfold.immersion import Immersion, bounds_disk, count_immersions, find_immersion, immersions
from plyfold.io import read
from plyfold.layering import Layering, find_layering
from plyfold.obstruction import Obstruction
from plyfold.surface import Surface, lift

__version__ = "0.1.0"

__all__ = [
    "Arrangement",
    "Curve",
    "Immersion",
    "Layering",
    "Obstruction",
    "Surface",
    "arrangement",
    "bounds_disk",
    "count_immersions",
    "errors",
    "find_immersion",
    "find_layering",
    "gallery",
    "immersions",
    "lift",
    "read",
]
