"""Layerings: vertical orders of the sheets that lift an immersed disk into a layered surface (§3 of the paper)."""

from plyfold.layering.layering import Layering, find_layering

__all__ = ["Layering", "find_layering"]
