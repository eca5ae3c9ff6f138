"""The surface: glued sheets in space, smooth heights, solids (§4 of the paper)."""
