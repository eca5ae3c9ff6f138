"""The boundary of a surface: that of its outline, or what is left of it where the outline touches itself."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrangement.polylines import polygon_turning_numbers
from plyfold.arrays import Floats, Ints
from plyfold.graphs import components
from plyfold.halfedges import ends_of
from plyfold.mesh.refine import is_moved
from plyfold.surface.glue import cusps_of

if TYPE_CHECKING:
    from plyfold.surface.lift import Surface

__all__ = ["kinds_of", "loops_of", "may_touch"]


def may_touch(surface: Surface) -> bool:
    """Whether points of the outline were moved apart: then the surface is what is left of one, and may touch itself.

    It is cut where it was thin, and without what was nothing but thin.
    """
    return is_moved(surface.layering.immersion.arrangement)


def loops_of(surface: Surface) -> tuple[list[Floats], list[Ints]]:
    """Return the given points along each loop of the boundary, and the index of the cusp at each."""
    outline = surface.outline
    if not may_touch(surface):
        return list(outline.loops), list(outline.cusps)
    place, given = _numbers(surface.vertices[:, :2]), _numbers(outline.points)
    index = np.zeros(len(place), dtype=np.int64)
    for point in cusps_of(surface.layering.immersion.arrangement).tolist():
        index[surface.cusps[place[surface.cusps] == given[point]]] = np.concatenate(outline.cusps)[point]
    corners = [loop[np.isin(place[loop], given)] for loop in np.split(surface.boundary, surface.first_boundary[1:-1])]
    return [surface.vertices[loop, :2] for loop in corners], [index[loop] for loop in corners]


def kinds_of(surface: Surface) -> list[tuple[int, int]]:
    """Return the number of boundary loops and the Euler characteristic of each connected piece of the surface.

    Of what is left of a surface it is that of flat surfaces with these loops: how often they turn, less their cusps.
    """
    if not may_touch(surface):
        return [(len(piece.loops), piece.euler_characteristic) for piece in surface.layering.immersion.pieces]
    loops, cusps = loops_of(surface)
    turns = polygon_turning_numbers(np.concatenate(loops), np.cumsum([0, *map(len, loops)]))
    euler = np.array(turns) - [index.sum() for index in cusps]
    piece = components(len(surface.vertices), *ends_of(surface.faces))
    piece_of_loop = piece[surface.boundary[surface.first_boundary[:-1]]]
    return [
        (int(np.count_nonzero(piece_of_loop == number)), int(euler[piece_of_loop == number].sum()))
        for number in np.unique(piece_of_loop)
    ]


def _numbers(points: Floats) -> Floats:
    """Return points as complex numbers, which are compared faster than rows."""
    return np.asarray(np.ascontiguousarray(points).view(np.complex128).ravel())
