"""Outlines of other libraries: paths of matplotlib, and paths of trimesh, such as sections of meshes."""

from __future__ import annotations

from typing import Any

import numpy as np

from plyfold.arrays import Floats

__all__ = ["loops_of_path"]

# Curved parts of a path are as fine as if its drawing were so many pixels across.
_PIXELS = 2000


def loops_of_path(value: object) -> list[Floats] | None:
    """Return the loops of a path of another library, curves flattened; None if it is no such path.

    Parameters
    ----------
    value : object
        A ``Path`` of matplotlib, of which open parts are closed; or a ``Path2D`` or ``Path3D`` of trimesh, whose third
        coordinate is a third column.

    Returns
    -------
    list of (n, 2) or (n, 3) arrays, or None

    Examples
    --------
    >>> from matplotlib.path import Path
    >>> [len(loop) for loop in loops_of_path(Path([(0, 0), (4, 0), (0, 3), (0, 0)], closed=True))]
    [4]
    """
    if hasattr(value, "to_polygons") and hasattr(value, "vertices"):
        return _loops_of_matplotlib(value)
    if hasattr(value, "discrete") and hasattr(value, "entities"):
        return [np.asarray(line, dtype=np.float64) for line in value.discrete]
    return None


def _loops_of_matplotlib(path: Any) -> list[Floats]:
    from matplotlib.transforms import Affine2D

    if (
        not len(path.vertices) or not np.isfinite(path.vertices).all()
    ):  # which matplotlib would leave out without a word
        return [np.asarray(path.vertices)]
    whole = path.deepcopy()
    whole.should_simplify = False
    # Curves are flattened for pixels. Powers of two change no digit.
    size = float(np.ptp(path.vertices, axis=0).max(initial=0.0))
    scale = 2.0 ** np.ceil(np.log2(_PIXELS / size)) if size > 0 else 1.0
    return [np.asarray(loop) / scale for loop in whole.to_polygons(Affine2D().scale(scale))]
