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

from plyfold.arrays import Floats, Ints
from plyfold.core.buffers import all_flat
from plyfold.core.sweep import Drawing, sweep_over
from plyfold.core.turns import points_for_turns
from plyfold.errors import PlyfoldError, PrecisionError
from plyfold.flat.sweep_line import TILTS, SweepPlan, sweep_order, sweep_plan
from plyfold.halfedges import GluedTriangles, twins_of_edges
from plyfold.immersion.immersion import Immersion
from plyfold.mesh.begun import drawings_of
from plyfold.mesh.refine import borders_at_points, drawn_outline, given_outline, is_moved
from plyfold.mesh.sheets import seams_of, twisted_bridges
from plyfold.predicates import orient

__all__ = ["sweep_as_drawn", "sweep_triangles"]


def sweep_triangles(immersion: Immersion) -> GluedTriangles:
    """Return triangles on the points of an immersion's outline, by number, that make the immersed surface.

    Parameters
    ----------
    immersion : Immersion
        Of a drawing.

    Returns
    -------
    GluedTriangles
        n − 2χ triangles, where χ is the Euler characteristic; counter-clockwise, exactly, where the outline's points
        were given; only if strands touch there, some may have no area. Several edges may join two cusps.

    Notes
    -----
    O((n + k) log n), and for each vertex that splits an interval the number of strands above it in the surface.

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> found = sweep_triangles(find_immersion([(0, 0), (4, 0), (1, 1), (0, 4)]))
    >>> found.faces.tolist(), found.twin.tolist()
    ([[0, 2, 3], [0, 1, 2]], [5, -1, -1, -1, -1, 0])
    """
    if not is_moved(immersion.arrangement):
        return sweep_as_drawn(immersion)
    given = given_outline(immersion.arrangement).points
    for drawn in drawings_of(immersion.arrangement):
        for tilt in TILTS:
            found = _swept_triangles(replace(immersion, arrangement=drawn), tilt, given)
            if len(found.faces) == _expected(immersion) and (orient(*given[found.faces].swapaxes(0, 1)) >= 0).all():
                return found
    raise PrecisionError(
        "touching strands were moved apart by more than there is room for",
        where=given[(given != immersion.arrangement.exact_points).any(axis=1)][:1],
        hint="move these points by hand",
    )


def sweep_as_drawn(immersion: Immersion) -> GluedTriangles:
    """Return triangles on the points that an immersion's outline is drawn with, by number: moved ones if any were.

    They are counter-clockwise there, exactly.
    """
    found = _swept_triangles(immersion, TILTS[0], None)
    if len(found.faces) == _expected(immersion):
        return found
    where = given_outline(immersion.arrangement).points[:1]
    raise PlyfoldError("internal check failed: the triangles make the surface", where=where)


def _expected(immersion: Immersion) -> int:
    """Return the number of triangles on the points of an outline."""
    return len(given_outline(immersion.arrangement)) - 2 * immersion.arrangement.euler_characteristic


def _swept_triangles(immersion: Immersion, tilt: float, given: Floats | None) -> GluedTriangles:
    """Return the triangles that are found by a line of some tilt, as is right on the points that are drawn, or given.

    They are all, unless moved strands confuse the line.
    """
    plan = sweep_plan(immersion.arrangement, twisted_bridges(immersion), tilt)
    drawing, points = _swept_drawing(immersion, plan), points_for_turns(plan.exact)
    corners = points if given is None else points_for_turns(given)
    # Room for one more: if there were more, that would be seen.
    faces, sides = np.empty((2, _expected(immersion) + 1, 3), dtype=np.int64)
    try:
        found = sweep_over(drawing, points, corners, given is not None, *all_flat(faces, sides))
    except IndexError:
        if given is None:
            raise
        found = 0
    return GluedTriangles(faces[:found], twins_of_edges(sides[:found].ravel()))


def _swept_drawing(immersion: Immersion, plan: SweepPlan) -> Drawing:
    """Return the drawing of an immersion for a line that sweeps over it."""
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
    around = *borders_at_points(arrangement), np.concatenate(drawn_outline(arrangement).cusps)
    turned = _edges_before_bridges(plan, rank, preceding)
    feet = bridge_of_foot, bridge_at, plan.above, turned, arrangement.n_borders + plan.bridges
    gluing = immersion.own_sheet, seams.row, seams.table
    return Drawing(*all_flat(*places, plan.following, preceding, *visits, *around, *feet, *gluing))


def _edges_before_bridges(plan: SweepPlan, rank: Ints, preceding: Ints) -> Ints:
    """Return how many edges of its first foot lie behind the line, above each bridge.

    A bridge runs to the left from a leftmost vertex. What else is behind the line there is above it, all or nothing.
    """
    foot = plan.first_foot
    behind = sum((rank[end[foot]] < rank[foot]).astype(np.int64) for end in (preceding, plan.following))
    return np.asarray(behind if plan.tilt < 0 else np.zeros(len(foot), dtype=np.int64))
