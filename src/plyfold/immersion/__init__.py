"""Immersed disks: the dual tree, Blank's words, groupings, sheets and gluing (§2 of the paper)."""

from plyfold.immersion.immersion import Group, Immersion
from plyfold.immersion.solve import bounds_disk, count_immersions, find_immersion, immersions

__all__ = ["Group", "Immersion", "bounds_disk", "count_immersions", "find_immersion", "immersions"]
