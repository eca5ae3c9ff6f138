"""Triangles: the cells of the drawing, refined and mended, and copied for each sheet."""
