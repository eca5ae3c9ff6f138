"""What every mesh file is written from: triangles with names, colours, texture coordinates and other shapes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Floats, Ints
from plyfold.errors import PrecisionError

__all__ = [
    "DETAIL",
    "Material",
    "Model",
    "single_precision",
    "size_of",
    "split_vertices",
    "summed_at_vertices",
    "vertex_normals",
]

# What is to be seen of a drawing, as a fraction of its size.
DETAIL = 1e-3

# 32-bit numbers must be at least so many times finer than what is to be seen.
_FINER = 10


@dataclass(frozen=True)
class Material:
    """The name and the colour, ``"#rrggbb"``, of a part."""

    name: str
    colour: str


@dataclass(frozen=True, eq=False)
class Model:
    """Triangles in space and all that a file can say of them; z points up.

    Parameters
    ----------
    vertices : (n, 3) float
    faces : (m, 3) int
        Counter-clockwise seen from the outside, or from above.
    material : (m,) int
        The part that each triangle belongs to.
    materials : tuple of Material
        One for each part.
    smooth : (m,) int
        Triangles with the same number are shaded as one smooth surface.
    closed : bool
        Whether they bound a solid.
    detail : float
        A length that must still be seen after rounding.
    colours : (n, 3) float or None
        Red, green and blue of each vertex, 0 to 1 as on the screen; None if each part has the colour of its material.
    uv : (n, 2) float or None
        Texture coordinates, v up.
    shapes : mapping of str to (n, 3) float
        Other places of the vertices, by name.
    """

    vertices: Floats
    faces: Ints
    material: Ints
    materials: tuple[Material, ...]
    smooth: Ints
    closed: bool
    detail: float
    colours: Floats | None = None
    uv: Floats | None = None
    shapes: Mapping[str, Floats] = field(default_factory=dict)


def vertex_normals(vertices: Floats, faces: Ints) -> Floats:
    """Return the unit normal at each vertex, shape (n, 3): that of the triangles around it, weighted by area.

    Where their area is lost in rounding, it points up.

    Examples
    --------
    >>> vertex_normals(np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)]), np.array([(0, 1, 2)])).tolist()
    [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]
    """
    a, b, c = (vertices / size_of(vertices))[faces].swapaxes(0, 1)
    summed = summed_at_vertices(np.cross(b - a, c - a), faces, len(vertices))
    summed[(summed == 0).all(axis=1)] = 0.0, 0.0, 1.0
    return np.asarray(summed / np.linalg.norm(summed, axis=1, keepdims=True))


def single_precision(values: Floats, detail: float) -> npt.NDArray[np.float32]:
    """Return coordinates rounded to 32 bits.

    Raises
    ------
    PrecisionError
        If they are too large or too small for that, or rounding would hide the detail.
    """
    largest = float(np.abs(values).max())
    least, most = (float(x) for x in (np.finfo(np.float32).tiny, np.finfo(np.float32).max))
    if not (largest < most and least < detail and _FINER * np.spacing(np.float32(largest)) < detail):
        raise PrecisionError(
            "the 32-bit numbers of this format cannot hold the mesh",
            where=values[:1],
            hint="move it to the origin, scale it, or write .obj, .ply or .3mf",
        )
    return values.astype("<f4")


def split_vertices(faces: Ints, key: Ints) -> tuple[Ints, Ints, Ints]:
    """Double vertices that have triangles with different keys.

    Returns the vertex that each new one comes from, the triangles with the numbers of new vertices, and the key of
    each new vertex; they are in the order of their keys.

    Examples
    --------
    >>> source, corners, key = split_vertices(np.array([(0, 1, 2), (0, 2, 3)]), np.array([5, 6]))
    >>> source.tolist(), corners.tolist(), key.tolist()
    ([0, 1, 2, 0, 2, 3], [[0, 1, 2], [3, 4, 5]], [5, 5, 5, 6, 6, 6])
    """
    count = int(faces.max()) + 1
    if (key == key[0]).all():
        return np.arange(count), faces, np.full(count, key[0])
    known, corner = np.unique(key[:, None] * count + faces, return_inverse=True)
    return known % count, corner.reshape(-1, 3), known // count


def summed_at_vertices(values: Floats, faces: Ints, count: int) -> Floats:
    """Return for each vertex the sum of the rows that belong to the triangles around it."""
    corners = faces.ravel()
    return np.stack([np.bincount(corners, np.repeat(column, 3), minlength=count) for column in values.T], axis=1)


def size_of(vertices: Floats) -> float:
    """Return the longest side of the box around vertices."""
    return float(np.ptp(vertices, axis=0).max())
