"""What a mesh file says of a surface, and of a solid."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, TypeAlias, get_args

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Floats, Ints
from plyfold.colours import layer_colour, rgb, sheet_colour
from plyfold.disk.motion import shapes_of_disk
from plyfold.errors import InputError, PlyfoldError, PrecisionError
from plyfold.io.mesh.model import DETAIL, Material, Model, size_of, summed_at_vertices
from plyfold.options import refuse_unless_flag
from plyfold.ragged import next_in_rows

if TYPE_CHECKING:
    import trimesh

    from plyfold.surface.lift import Surface
    from plyfold.surface.thicken import Solid

__all__ = ["Colouring", "model_of_solid", "model_of_surface", "smooth_parts", "trimesh_of"]

Colouring: TypeAlias = Literal["layers", "sheets"]


def model_of_surface(surface: Surface, colours: Colouring = "layers", unwrapped: bool | None = None) -> Model:
    """Return the model of a surface.

    Parameters
    ----------
    surface : Surface
    colours : {"layers", "sheets"}
        A colour for each layer, in smooth transition, or for each sheet.
    unwrapped : bool, optional
        Give texture coordinates in the unwound disk, and the shapes ``flat`` and ``disk``; by default if the surface is
        a disk and double precision can hold it unwound.

    Returns
    -------
    Model

    Raises
    ------
    InputError
        If the colouring is unknown, ``unwrapped`` neither true, false nor None, or the disk is asked for of a surface
        that is none.
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
        detail=DETAIL * size_of(surface.vertices),
        colours=_layer_colours(surface) if colours == "layers" else None,
        uv=uv,
        shapes=shapes,
    )


def model_of_solid(solid: Solid, colours: Colouring = "layers", unwrapped: bool | None = None) -> Model:
    """Return the model of a solid; see :func:`model_of_surface`. Its walls are not smoothed."""
    surface, tips = solid.surface, solid.tips
    model = model_of_surface(surface, colours, unwrapped)
    upward = solid.thickness[:, None] / 2
    up = np.concatenate([upward, -np.delete(upward, tips, axis=0)]) * (0.0, 0.0, 1.0)
    return Model(
        vertices=solid.vertices,
        faces=solid.faces,
        material=solid.sheet,
        materials=model.materials,
        smooth=smooth_parts(solid),
        closed=True,
        detail=min(model.detail, float(solid.thickness[solid.thickness > 0].min())),
        colours=None if model.colours is None else _twice(model.colours, tips),
        uv=None if model.uv is None else _twice(model.uv, tips),
        shapes={name: _twice(places, tips) + up for name, places in model.shapes.items()},
    )


def smooth_parts(solid: Solid) -> Ints:
    """Return the number of the smooth face that each triangle is part of: 0 of both sides, and one for each wall."""
    surface = solid.surface
    # The ends of walls that are tips take a triangle off.
    pointed = np.isin(surface.boundary, solid.tips).astype(np.int64)
    walls = 2 - pointed - pointed[next_in_rows(surface.first_boundary)]
    return np.append(np.zeros(2 * len(surface.faces), dtype=np.int64), np.repeat(1 + np.arange(len(walls)), walls))


def trimesh_of(model: Model) -> trimesh.Trimesh:
    """Return a model as a mesh of the library trimesh, its vertices and triangles in the same order."""
    try:
        import trimesh
    except ImportError as error:
        raise PlyfoldError("a mesh of trimesh needs that library", hint="pip install trimesh") from error
    shades = np.array([rgb(material.colour) for material in model.materials])[model.material]
    return trimesh.Trimesh(
        vertices=model.vertices,
        faces=model.faces,
        face_attributes={"sheet": model.material},
        vertex_colors=None if model.colours is None else _bytes(model.colours),
        face_colors=_bytes(shades) if model.colours is None else None,
        process=False,
    )


def _bytes(colours: Floats) -> npt.NDArray[np.uint8]:
    return np.rint(255 * colours).astype(np.uint8)


def _unwrapped(surface: Surface, wanted: bool | None) -> tuple[Floats | None, dict[str, Floats]]:
    """Return texture coordinates, and the surface flat on the table, on its way to a disk, and as that disk."""
    if wanted is False or (wanted is None and not surface.is_disk):
        return None, {}
    try:
        unwound = surface.unwrap()
    except PrecisionError:
        if wanted:
            raise
        return None, {}
    return unwound.uv, shapes_of_disk(unwound)


def _refuse_colouring(colours: str) -> None:
    if not isinstance(colours, str) or colours not in get_args(Colouring):
        raise InputError(f"there is no colouring by {colours!r}", hint=f"use one of {', '.join(get_args(Colouring))}")


def _materials(surface: Surface) -> tuple[Material, ...]:
    levels = surface.layering.level.tolist()
    return tuple(Material(f"sheet_{i}_level_{level}", sheet_colour(i)) for i, level in enumerate(levels))


def _layer_colours(surface: Surface) -> Floats:
    """Return the colour of each vertex: the mean over the triangles around it, each in the colour of its layer."""
    level = surface.layering.level
    shades = np.array([rgb(layer_colour(number + 1, surface.n_layers)) for number in range(surface.n_layers)])
    total = summed_at_vertices(shades[level[surface.sheet] - 1], surface.faces, len(surface.vertices))
    return np.asarray(total / np.bincount(surface.faces.ravel(), minlength=len(total))[:, None])


def _twice(values: Floats, tips: Ints) -> Floats:
    """Return the values of a surface's vertices for those of a solid; its lower side lacks the tips."""
    return np.concatenate([values, np.delete(values, tips, axis=0)])
