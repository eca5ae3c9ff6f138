"""What every mesh file is written from: triangles with names, colours, texture coordinates and other shapes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal, TypeAlias, get_args

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Floats, Ints
from plyfold.disk.motion import Motion
from plyfold.errors import InputError, PrecisionError
from plyfold.options import refuse_unless_flag

if TYPE_CHECKING:
    from plyfold.disk.unwrap import UnwoundDisk
    from plyfold.surface.lift import Surface
    from plyfold.surface.thicken import Solid

__all__ = [
    "Colouring",
    "Material",
    "Model",
    "model_of_disk",
    "model_of_solid",
    "model_of_surface",
    "single_precision",
    "split_vertices",
    "vertex_normals",
]

Colouring: TypeAlias = Literal["layers", "sheets"]

# 32-bit numbers must be at least so many times finer than what is to be seen.
_FINER = 10
# What is to be seen of a drawing, as a fraction of its size.
_DETAIL = 1e-3
# Shapes from the flat drawing to the disk are so many that no cloth folds over on the straight way between them, up to
# a number; larger surfaces do without those between.
_MOST_SHAPES = 17
_MANY_VERTICES = 20_000


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


def model_of_surface(surface: Surface, colours: Colouring = "layers", unwrapped: bool | None = None) -> Model:
    """Return the model of a surface.

    Parameters
    ----------
    surface : Surface
    colours : {"layers", "sheets"}
        A colour for each layer, in smooth transition, or for each sheet.
    unwrapped : bool, optional
        Give texture coordinates in the unwound disk, and the shapes ``flat`` and ``disk``; by default if double
        precision can hold that disk.

    Returns
    -------
    Model

    Raises
    ------
    InputError
        If the colouring is unknown, or ``unwrapped`` neither true, false nor None.
    PrecisionError
        If the disk is asked for, and double precision cannot hold it.

    Examples
    --------
    >>> from plyfold import lift
    >>> model_of_surface(lift([(0, 0), (1, 0), (0, 1)], max_area=1.0), unwrapped=False).materials
    (Material(name='sheet_0_level_1', colour='#2f7fc1'),)
    """
    _refuse_colouring(colours)
    if unwrapped is not None:
        refuse_unless_flag("unwrapped", unwrapped)
    uv, shapes = _unwrapped(surface, unwrapped)
    return Model(
        vertices=surface.vertices,
        faces=surface.faces,
        material=surface.sheet,
        materials=_materials(surface),
        smooth=np.zeros(len(surface.faces), dtype=np.int64),
        closed=False,
        detail=_DETAIL * _size(surface.vertices),
        colours=_layer_colours(surface) if colours == "layers" else None,
        uv=uv,
        shapes=shapes,
    )


def model_of_disk(unwound: UnwoundDisk) -> Model:
    """Return the model of an immersed disk flat on the table, a material for each sheet; its shapes lead to the disk.

    Examples
    --------
    >>> from plyfold import unwrap
    >>> list(model_of_disk(unwrap([(0, 0), (1, 0), (0, 1)], max_area=1.0)).shapes)
    ['unwinding 1', 'unwinding 2', 'unwinding 3', 'disk']
    """
    from plyfold.colours import sheet_colour

    flat, *others = _shapes(unwound).items()
    return Model(
        vertices=flat[1],
        faces=unwound.faces,
        material=unwound.sheet,
        materials=tuple(Material(f"sheet_{i}", sheet_colour(i)) for i in range(unwound.immersion.n_sheets)),
        smooth=np.zeros(len(unwound.faces), dtype=np.int64),
        closed=False,
        detail=_DETAIL * _size(unwound.plane),
        uv=unwound.uv,
        shapes=dict(others),
    )


def model_of_solid(solid: Solid, colours: Colouring = "layers", unwrapped: bool | None = None) -> Model:
    """Return the model of a solid; see :func:`model_of_surface`. Its walls are not smoothed."""
    surface = solid.surface
    model = model_of_surface(surface, colours, unwrapped)
    up = np.repeat([solid.thickness / 2, -solid.thickness / 2], len(surface.vertices))[:, None] * (0.0, 0.0, 1.0)
    walls = len(solid.faces) - 2 * len(surface.faces)
    return Model(
        vertices=solid.vertices,
        faces=solid.faces,
        material=solid.sheet,
        materials=model.materials,
        smooth=np.concatenate([np.zeros(2 * len(surface.faces), dtype=np.int64), 1 + np.arange(walls) // 2]),
        closed=True,
        detail=min(model.detail, solid.thickness),
        colours=_twice(model.colours),
        uv=_twice(model.uv),
        shapes={name: np.tile(places, (2, 1)) + up for name, places in model.shapes.items()},
    )


def vertex_normals(vertices: Floats, faces: Ints) -> Floats:
    """Return the unit normal at each vertex, shape (n, 3): that of the triangles around it, weighted by area.

    Where their area is lost in rounding, it points up.

    Examples
    --------
    >>> vertex_normals(np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)]), np.array([(0, 1, 2)])).tolist()
    [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]
    """
    a, b, c = (vertices / _size(vertices))[faces].swapaxes(0, 1)
    summed = _summed_at_vertices(np.cross(b - a, c - a), faces, len(vertices))
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


def _unwrapped(surface: Surface, wanted: bool | None) -> tuple[Floats | None, dict[str, Floats]]:
    """Return texture coordinates, and the surface flat on the table, on its way to a disk, and as that disk."""
    if wanted is False:
        return None, {}
    try:
        unwound = surface.unwrap()
    except PrecisionError:
        if wanted:
            raise
        return None, {}
    return unwound.uv, _shapes(unwound)


def _shapes(unwound: UnwoundDisk) -> dict[str, Floats]:
    """Return the disk flat on the table, on its way to be round, and round."""
    motion = Motion(unwound)
    if len(unwound.plane) < _MANY_VERTICES:
        drawn, *between, disk = motion.shapes(_MOST_SHAPES)
    else:
        drawn, between, disk = unwound.plane, [], motion.disk
    named = {"flat": drawn, **{f"unwinding {number + 1}": shape for number, shape in enumerate(between)}, "disk": disk}
    return {name: np.pad(shape, ((0, 0), (0, 1))) for name, shape in named.items()}


def _refuse_colouring(colours: str) -> None:
    if not isinstance(colours, str) or colours not in get_args(Colouring):
        raise InputError(f"there is no colouring by {colours!r}", hint=f"use one of {', '.join(get_args(Colouring))}")


def _materials(surface: Surface) -> tuple[Material, ...]:
    from plyfold.colours import sheet_colour

    levels = surface.layering.level.tolist()
    return tuple(Material(f"sheet_{i}_level_{level}", sheet_colour(i)) for i, level in enumerate(levels))


def _layer_colours(surface: Surface) -> Floats:
    """Return the colour of each vertex: the mean over the triangles around it, each in the colour of its layer."""
    from plyfold.colours import layer_colour, rgb

    level = surface.layering.level
    shades = np.array([rgb(layer_colour(number + 1, int(level.max()))) for number in range(level.max())])
    total = _summed_at_vertices(shades[level[surface.sheet] - 1], surface.faces, len(surface.vertices))
    return np.asarray(total / np.bincount(surface.faces.ravel(), minlength=len(total))[:, None])


def _summed_at_vertices(values: Floats, faces: Ints, count: int) -> Floats:
    """Return for each vertex the sum of the rows that belong to the triangles around it."""
    corners = faces.ravel()
    return np.stack([np.bincount(corners, np.repeat(column, 3), minlength=count) for column in values.T], axis=1)


def _size(vertices: Floats) -> float:
    return float(np.ptp(vertices, axis=0).max())


def _twice(values: Floats | None) -> Floats | None:
    return None if values is None else np.tile(values, (2, 1))
