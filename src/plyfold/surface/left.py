"""The boundary of a surface: that of its outline, or what is left of it where the outline touches itself."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrangement.polylines import polygon_turning_numbers
from plyfold.arrays import Floats, Ints
from plyfold.graphs import components
from plyfold.halfedges import ends_of
from plyfold.mesh.refine import is_moved
from plyfold.mesh.strips import loop_left

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
    arrangement, mesh = surface.layering.immersion.arrangement, (surface.vertices[:, :2], surface.faces)
    loops = np.split(surface.boundary, surface.first_boundary[1:-1])
    points, cusps = zip(*(loop_left(arrangement, *mesh, loop) for loop in loops), strict=True)
    return list(points), list(cusps)


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
