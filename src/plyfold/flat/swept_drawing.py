"""A drawing as a line comes to it that sweeps over its surface: the order of events, and how sheets are glued."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from plyfold.arrays import Ints
from plyfold.flat.sweep_line import SweepPlan, sweep_order
from plyfold.immersion.immersion import Immersion
from plyfold.mesh.refine import borders_at_points, drawn_outline
from plyfold.mesh.sheets import seams_of

__all__ = ["SweptDrawing", "swept_drawing"]


class SweptDrawing(NamedTuple):
    """What is swept: the order of events, and the gluing.

    ``order`` is that of :func:`sweep_order`, and ``rank`` the place of each vertex in it; ``following`` and
    ``preceding`` are its neighbours on its loop. Bridges have edges and ends of their own, numbered after all vertices.
    ``arriving`` and ``leaving`` are the borders that end and begin at each vertex, or the one that it is on;
    ``before`` and ``after`` those at each visit. ``cusp`` is the index of each vertex, ``bridge_of_foot`` the bridge
    whose second foot is at each visit, ``bridge_at`` the one whose first foot is at each vertex, or −1. Of bridges,
    ``above`` tells which begin above the edge that their second foot is on, and ``before_bridge`` to how many edges of
    its first foot one turns from right above there, counter-clockwise, before one turns to the bridge. ``flat`` is 1 if
    triangles may be flat. The sheet beyond a dart, seen from a sheet on its left, is ``beyond[row[dart] + sheet]``, or
    −1.
    """

    order: Ints
    rank: Ints
    following: Ints
    preceding: Ints
    partner: Ints
    visit_edge: Ints
    arriving: Ints
    leaving: Ints
    before: Ints
    after: Ints
    cusp: Ints
    bridge_of_foot: Ints
    bridge_at: Ints
    above: Ints
    before_bridge: Ints
    flat: Ints
    bridge_border: Ints
    own_sheet: Ints
    row: Ints
    beyond: Ints


def swept_drawing(immersion: Immersion, plan: SweepPlan, may_be_flat: bool) -> SweptDrawing:
    """Return the drawing of an immersion for a line that sweeps over it; tell whether triangles may be flat."""
    arrangement, n, bridges = immersion.arrangement, plan.n_vertices, len(plan.bridges)
    order = sweep_order(plan)
    rank = np.empty(n + len(arrangement.partner), dtype=np.int64)
    rank[order] = np.arange(len(order))
    seams = seams_of(immersion)
    arriving, leaving = borders_at_points(arrangement)
    bridge_of_foot, bridge_at = np.full(len(arrangement.partner), -1), np.full(n, -1)
    bridge_of_foot[plan.second_foot], bridge_at[plan.first_foot] = np.arange(bridges), np.arange(bridges)
    preceding = np.empty(n, dtype=np.int64)
    preceding[plan.following[:n]] = np.arange(n)
    return SweptDrawing(
        order=order,
        rank=np.concatenate([rank[:n], rank[plan.first_foot], rank[n + plan.second_foot]]),
        following=plan.following,
        preceding=preceding,
        partner=arrangement.partner,
        visit_edge=arrangement.visit_edge,
        arriving=arriving,
        leaving=leaving,
        before=arrangement.border_before,
        after=arrangement.border_after,
        cusp=np.concatenate(drawn_outline(arrangement).cusps),
        bridge_of_foot=bridge_of_foot,
        bridge_at=bridge_at,
        above=plan.above,
        before_bridge=_edges_before_bridges(plan, rank, preceding),
        flat=np.array([int(may_be_flat)]),
        bridge_border=arrangement.n_borders + plan.bridges,
        own_sheet=immersion.own_sheet,
        row=seams.row,
        beyond=seams.table,
    )


def _edges_before_bridges(plan: SweepPlan, rank: Ints, preceding: Ints) -> Ints:
    """Return how many edges of its first foot lie behind the line, above each bridge.

    A bridge runs to the left from a leftmost vertex. What else is behind the line there is above it, all or nothing.
    """
    foot = plan.first_foot
    behind = sum((rank[end[foot]] < rank[foot]).astype(np.int64) for end in (preceding, plan.following))
    return np.asarray(behind if plan.tilt < 0 else np.zeros(len(foot), dtype=np.int64))
