"""Triangles on the points of an immersed surface, found by a line that sweeps over the surface and not over the plane.

On the surface, the points below a sweeping line are intervals that end on two edges of the boundary: an edge that runs
to the right below, one that runs to the left above. They are known by their edges, so a vertex on the line is found at
once, however many sheets lie over it. Only a vertex from which both edges lead ahead begins something new. If it is a
convex corner that is an interval of its own; if it is reflex, it splits an interval, and which one is seen by walking
up from the vertex through the gluing: from its own sheet over every border to the sheet beyond, until one ends there.
Bridges by which the gluing changes sheets lie on the line as well.

At a cusp, the line meets the surface several times: the vertex is inside of intervals, on sheets all around it. There,
what is above it of one goes on with what is below it of the one next to it, round the cusp.

The part of the surface that was swept is cut into monotone polygons, whose triangles are found on the way
(``core/monotone.py``).

If touching strands were moved apart, the line sweeps over the moved ones; but triangles are cut off as is right on the
points as given, for what is a corner of little more than no angle here may be one of a little less there.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from plyfold.arrays import Ints
from plyfold.core.buffers import all_flat, flat
from plyfold.core.sweep import Drawing, sweep_over
from plyfold.core.turns import exact_points
from plyfold.errors import PlyfoldError, PrecisionError
from plyfold.flat.sweep_line import TILTS, SweepPlan, sweep_order, sweep_plan
from plyfold.immersion.immersion import Immersion
from plyfold.mesh.begun import drawings_of
from plyfold.mesh.refine import borders_at_points, drawn_outline, given_outline, is_moved
from plyfold.mesh.sheets import seams_of, twisted_bridges
from plyfold.predicates import orient

__all__ = ["sweep_triangles"]


def sweep_triangles(immersion: Immersion) -> Ints:
    """Return triangles on the points of an immersion's outline, by number, that make the immersed surface.

    Parameters
    ----------
    immersion : Immersion
        Of a drawing.

    Returns
    -------
    (n − 2χ, 3) int
        Counter-clockwise, exactly, where the outline's points were given; only if strands touch there, some may have no
        area. χ is the Euler characteristic.

    Notes
    -----
    O((n + k) log n), and for each vertex that splits an interval the number of strands above it in the surface.

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> sweep_triangles(find_immersion([(0, 0), (4, 0), (1, 1), (0, 4)])).tolist()
    [[0, 2, 3], [0, 1, 2]]
    """
    given = given_outline(immersion.arrangement).points
    triangles = len(given) - 2 * immersion.arrangement.euler_characteristic
    if not is_moved(immersion.arrangement):
        faces = _swept_triangles(immersion, TILTS[0])
        if len(faces) == triangles:
            return faces
        raise PlyfoldError("internal check failed: the triangles make the surface", where=given[:1])
    for drawn in drawings_of(immersion.arrangement):
        for tilt in TILTS:
            faces = _swept_triangles(replace(immersion, arrangement=drawn), tilt)
            if len(faces) == triangles and (orient(*given[faces].swapaxes(0, 1)) >= 0).all():
                return faces
    raise PrecisionError(
        "touching strands were moved apart by more than there is room for",
        where=given[(given != immersion.arrangement.exact_points).any(axis=1)][:1],
        hint="move these points by hand",
    )


def _swept_triangles(immersion: Immersion, tilt: float) -> Ints:
    """Return the triangles that are found by a line of some tilt: all, unless moved strands confuse it."""
    plan = sweep_plan(immersion.arrangement, twisted_bridges(immersion), tilt)
    points = given = exact_points(plan.exact)
    moved = is_moved(immersion.arrangement)
    if moved:
        given = exact_points(given_outline(immersion.arrangement).points)
    # Room for one more: if there were more, that would be seen.
    faces = np.empty((plan.n_vertices - 2 * immersion.arrangement.euler_characteristic + 1, 3), dtype=np.int64)
    try:
        return faces[: sweep_over(_drawing(immersion, plan), points, given, moved, flat(faces))]
    except IndexError:
        if moved:
            return faces[:0]
        raise


def _drawing(immersion: Immersion, plan: SweepPlan) -> Drawing:
    arrangement, n, bridges = immersion.arrangement, plan.n_vertices, len(plan.bridges)
    order = sweep_order(plan)
    rank = np.empty(n + len(arrangement.partner), dtype=np.int64)
    rank[order] = np.arange(len(order))
    seams = seams_of(immersion)
    bridge_of_foot, bridge_at = np.full(len(arrangement.partner), -1), np.full(n, -1)
    bridge_of_foot[plan.second_foot], bridge_at[plan.first_foot] = np.arange(bridges), np.arange(bridges)
    preceding = np.empty(n, dtype=np.int64)
    preceding[plan.following[:n]] = np.arange(n)
    places = order, np.concatenate([rank[:n], rank[plan.first_foot], rank[n + plan.second_foot]])
    visits = arrangement.partner, arrangement.visit_edge, arrangement.border_before, arrangement.border_after
    feet = bridge_of_foot, bridge_at, plan.above, arrangement.n_borders + plan.bridges
    around = *borders_at_points(arrangement), np.concatenate(drawn_outline(arrangement).cusps)
    gluing = immersion.own_sheet, seams.row, seams.table
    return Drawing(*all_flat(*places, plan.following, preceding, *visits, *around, *feet, *gluing))
