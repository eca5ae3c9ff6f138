"""The surface: triangulated cells, glued sheets, smooth heights, mesh files (§4 of the paper)."""

from plyfold.surface.surface import Surface, lift
from plyfold.surface.unwrap import UnwoundDisk, map_disk, unwrap

__all__ = ["Surface", "UnwoundDisk", "lift", "map_disk", "unwrap"]
