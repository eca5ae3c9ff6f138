"""Layerings: vertical orders of the sheets that lift an immersed disk into a layered surface (§3 of the paper)."""

from plyfold.layering.casing import embed_cased
from plyfold.layering.counting import count_layerings
from plyfold.layering.layering import Layering
from plyfold.layering.listing import layerings
from plyfold.layering.nicest import nicest_layering
from plyfold.layering.search import Progress, find_layering, first_layering

__all__ = [
    "Layering",
    "Progress",
    "count_layerings",
    "embed_cased",
    "find_layering",
    "first_layering",
    "layerings",
    "nicest_layering",
]
