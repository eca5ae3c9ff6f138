"""A drawing as a line comes to it that sweeps over its surface: the order of events, and how sheets are glued."""

from __future__ import annotations

import numpy as np

from plyfold.arrays import Ints
from plyfold.core.buffers import all_flat
from plyfold.core.sweep import Drawing
from plyfold.flat.sweep_line import SweepPlan, sweep_order
from plyfold.immersion.immersion import Immersion
from plyfold.mesh.refine import borders_at_points, drawn_outline
from plyfold.mesh.sheets import seams_of

__all__ = ["swept_drawing"]


def swept_drawing(immersion: Immersion, plan: SweepPlan) -> Drawing:
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
