"""STL: bare triangles in 32-bit numbers, for printers."""

from __future__ import annotations

import numpy as np

from plyfold.io.mesh.model import Model, single_precision

__all__ = ["stl"]


def stl(model: Model) -> bytes:
    """Return the model as a binary STL; coordinates are rounded to 32 bits."""
    facets = np.zeros(len(model.faces), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    corners = model.vertices[model.faces]
    size = np.ptp(model.vertices, axis=0).max()
    normal = np.cross((corners[:, 1] - corners[:, 0]) / size, (corners[:, 2] - corners[:, 0]) / size)
    facets["normal"] = normal / np.linalg.norm(normal, axis=1, keepdims=True)
    facets["corners"] = single_precision(model.vertices, model.detail)[model.faces]
    return b"plyfold".ljust(80) + np.uint32(len(facets)).tobytes() + facets.tobytes()
