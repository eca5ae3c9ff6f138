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
from plyfold.arrangement import Arrangement, arrangement
from plyfold.arrangement.gauss import GaussCode
from plyfold.arrangement.loops import loop_turning_numbers
from plyfold.curve import Curve
from plyfold.flat import Covered, coverage, decompose, triangulate
from plyfold.immersion import (
    BlankWord,
    Immersion,
    best_immersion,
    blank_word,
    bounds_disk,
    changed_borders,
    count_immersions,
    find_immersion,
    flip_distance,
    immersions,
    irreducible_kernels,
    sample_immersion,
)
from plyfold.io import read
from plyfold.layering import (
    IntersectingLayering,
    Layering,
    count_layerings,
    embed_cased,
    find_layering,
    layerings,
    least_intersecting_layering,
    nicest_layering,
)
from plyfold.layering.embedding import count_embeddings, embeddings, find_embedding
from plyfold.layering.layered_surface import (
    LayeredSurface,
    count_layered_surfaces,
    find_layered_surface,
    layered_surfaces,
)
from plyfold.obstruction import Obstruction, Unknown
from plyfold.surface import Surface, UnwoundDisk, lift, map_disk, unwrap

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
    "arrangement",
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
