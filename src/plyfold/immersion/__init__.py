"""Immersed disks: the dual tree, Blank's words, groupings, sheets and gluing (§2 of the paper)."""

from plyfold.immersion.blank_word import BlankWord, Letter, blank_word
from plyfold.immersion.compare import changed_borders, flip_distance
from plyfold.immersion.cutting import irreducible_kernels
from plyfold.immersion.immersion import Group, Immersion
from plyfold.immersion.solve import (
    best_immersion,
    bounds_disk,
    count_immersions,
    find_immersion,
    immersions,
    nth_immersion,
    sample_immersion,
)

__all__ = [
    "BlankWord",
    "Group",
    "Immersion",
    "Letter",
    "best_immersion",
    "blank_word",
    "bounds_disk",
    "changed_borders",
    "count_immersions",
    "find_immersion",
    "flip_distance",
    "immersions",
    "irreducible_kernels",
    "nth_immersion",
    "sample_immersion",
]
