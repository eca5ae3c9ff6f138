"""Mesh files, which know a model and no surface: GLB, OBJ, PLY, STL and 3MF."""
