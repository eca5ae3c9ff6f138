"""Layerings: vertical orders of the sheets that lift an immersed disk into a layered surface (§3 of the paper)."""

from plyfold.layering.layering import Layering, Progress, find_layering, first_layering

__all__ = ["Layering", "Progress", "find_layering", "first_layering"]
