"""How a surface is made over a layering: its mesh, and its heights."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Floats
from plyfold.clock import UNWATCHED, Watch
from plyfold.errors import InputError, PrecisionError
from plyfold.layering.layering import Layering
from plyfold.layering.orders.intersections import IntersectingLayering
from plyfold.mesh.cells import DEFAULT_TRIANGLES, CellTriangulation, refuse_broken, triangulate_cells
from plyfold.mesh.refine import given_outline, is_moved
from plyfold.surface.chords import split_chords
from plyfold.surface.glue import LiftedMesh, cusps_of
from plyfold.surface.heights import DEFAULT_STIFFNESS, PinKey, SpreadCloth, smooth_heights
from plyfold.surface.stairs import Steps, heights_of_stairs, with_cusps_apart, with_steps

__all__ = ["Making", "raised", "steps_of"]


@dataclass(frozen=True)
class Making:
    """What :func:`plyfold.lift` was asked for, to be asked for again; see there.

    Parameters
    ----------
    triangles : int
    max_area : float or None
    stiffness : float
    pins : mapping
    flat : float
        How many times as stiff the cloth is where nothing overlaps.
    """

    triangles: int = DEFAULT_TRIANGLES
    max_area: float | None = None
    stiffness: float = DEFAULT_STIFFNESS
    pins: Mapping[PinKey, float] = field(default_factory=dict)
    flat: float = 1.0


def steps_of(layering: Layering | IntersectingLayering, making: Making, watch: Watch = UNWATCHED) -> Steps:
    """Return the triangles over the cells of a layering, with steps at cusps."""
    drawn = layering.immersion.arrangement
    cells = triangulate_cells(drawn, making.max_area, making.triangles, watch)
    if isinstance(layering, Layering):
        return _with_steps(cells, drawn)
    # Steps would be cut by the chords between sheets that pass through each other.
    _refuse_touching(drawn)
    cells = split_chords(cells, layering.intersections[:, 0])
    refuse_broken(drawn, cells)
    return Steps.none(cells)


def _refuse_touching(drawn: Arrangement) -> None:
    """Refuse sheets that pass through each other along borders that may not be there on the given points."""
    if is_moved(drawn):
        given = given_outline(drawn).points
        raise InputError(
            "a surface that passes through itself can be lifted only if its outline does not touch itself",
            where=given[(given != drawn.exact_points).any(axis=1)],
            hint="move the strands apart there",
        )


def _with_steps(cells: CellTriangulation, drawn: Arrangement) -> Steps:
    """Return the cells with steps at cusps, or as they are where double precision has no room for steps."""
    cusps = cells.places_of(cusps_of(drawn))
    with suppress(PrecisionError):
        steps = with_steps(cells, cusps)
        if steps.cells is not cells:
            refuse_broken(drawn, steps.cells)
        return steps
    apart = with_cusps_apart(cells, cusps)
    refuse_broken(drawn, apart)
    return Steps.none(apart)


def raised(  # noqa: PLR0913 - a mesh, and what is asked of its heights
    mesh: LiftedMesh,
    steps: Steps,
    gap: float,
    making: Making,
    *,
    watch: Watch = UNWATCHED,
    thickness: Floats | None = None,
    spread: SpreadCloth | None = None,
) -> Floats:
    """Return the vertices of a mesh with their heights, (v, 3); bodies of some thickness round them keep the gap.

    The cloth may be spread already, if there are no steps and nothing is pinned.
    """
    points = steps.cells.points
    smooth = partial(
        smooth_heights, stiffness=making.stiffness, pins=making.pins, flat=making.flat, spread=spread, watch=watch
    )
    heights = heights_of_stairs(points, mesh, steps.outer, gap, smooth, thickness=thickness)
    return np.column_stack([points[mesh.planar_vertex], heights])
