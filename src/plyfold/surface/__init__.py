"""The surface: triangulated cells, glued sheets, smooth heights, mesh files (§4 of the paper)."""

from plyfold.surface.surface import Surface, lift

__all__ = ["Surface", "lift"]
