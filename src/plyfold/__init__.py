"""Closed curves that cross themselves: immersed disks, their layerings, and the surfaces they bound.

>>> import plyfold as pf
>>> ramp = pf.Curve([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)])
>>> pf.bounds_disk(ramp), pf.count_immersions(ramp)
(True, 1)
"""

import sys as _sys

# `python -m plyfold` is looking for plyfold.__main__: Ctrl-C has to end it quietly already.
if _sys.argv[:1] == ["-m"] and _sys.orig_argv[-len(_sys.argv)] in ("plyfold", "-mplyfold"):
    import plyfold_command as _command

    _command.end_at_interrupts()

from plyfold import errors, gallery
from plyfold.arrangement.arrangement import Arrangement, arrange
from plyfold.arrangement.gauss import GaussCode
from plyfold.arrangement.loops import loop_turning_numbers
from plyfold.disk.unwrap import UnwoundDisk, map_disk, unwrap
from plyfold.flat.coverage import Covered, coverage
from plyfold.flat.decompose import decompose
from plyfold.flat.triangulate import triangulate
from plyfold.immersion.blank_word import BlankWord, blank_word
from plyfold.immersion.compare import changed_borders, flip_distance
from plyfold.immersion.cutting import irreducible_kernels
from plyfold.immersion.immersion import Immersion
from plyfold.immersion.solve import (
    best_immersion,
    bounds_disk,
    count_immersions,
    find_immersion,
    immersions,
    sample_immersion,
)
from plyfold.io.reading import read
from plyfold.layering.embedding import count_embeddings, embeddings, find_embedding
from plyfold.layering.layering import Layering
from plyfold.layering.levels.casing import embed_cased
from plyfold.layering.levels.layered_surface import (
    LayeredSurface,
    count_layered_surfaces,
    find_layered_surface,
    layered_surfaces,
)
from plyfold.layering.orders.counting import count_layerings
from plyfold.layering.orders.intersections import IntersectingLayering, least_intersecting_layering
from plyfold.layering.orders.listing import layerings
from plyfold.layering.orders.nicest import nicest_layering
from plyfold.layering.orders.search import find_layering
from plyfold.obstruction import Obstruction, Unknown
from plyfold.outline.curve import Curve
from plyfold.surface.lift import Surface, lift

__version__ = "0.3.0"

__all__ = [
    "Arrangement",
    "BlankWord",
    "Covered",
    "Curve",
    "GaussCode",
    "Immersion",
    "IntersectingLayering",
    "LayeredSurface",
    "Layering",
    "Obstruction",
    "Surface",
    "Unknown",
    "UnwoundDisk",
    "arrange",
    "best_immersion",
    "blank_word",
    "bounds_disk",
    "changed_borders",
    "count_embeddings",
    "count_immersions",
    "count_layered_surfaces",
    "count_layerings",
    "coverage",
    "decompose",
    "embed_cased",
    "embeddings",
    "errors",
    "find_embedding",
    "find_immersion",
    "find_layered_surface",
    "find_layering",
    "flip_distance",
    "gallery",
    "immersions",
    "irreducible_kernels",
    "layered_surfaces",
    "layerings",
    "least_intersecting_layering",
    "lift",
    "loop_turning_numbers",
    "map_disk",
    "nicest_layering",
    "read",
    "sample_immersion",
    "triangulate",
    "unwrap",
]
