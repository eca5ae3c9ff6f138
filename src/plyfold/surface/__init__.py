"""The surface: triangulated cells, glued sheets, smooth heights, mesh files (§4 of the paper)."""
