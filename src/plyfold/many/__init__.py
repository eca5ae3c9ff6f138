"""Many outlines at once: tables of verdicts, triangles and polygons of all, and files of any size."""
