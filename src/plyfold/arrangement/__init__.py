"""Crossings, borders, cells, winding numbers and turning number of a closed curve (§2.1 of the paper)."""

from plyfold.arrangement.core import Arrangement, arrangement, polygon_turning_number, winding_number

__all__ = ["Arrangement", "arrangement", "polygon_turning_number", "winding_number"]
