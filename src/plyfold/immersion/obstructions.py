"""Why there is no immersion, as numbers alone show: an impossible cusp, the turning number, a winding number (§2.4)."""

from __future__ import annotations

import numpy as np

from plyfold.arrangement.arrangement import Arrangement, require_one_loop
from plyfold.arrangement.general_position import InContact
from plyfold.arrangement.places import place_in_cell, places_of_visits
from plyfold.arrangement.polylines import polygon_turning_number
from plyfold.arrangement.spikes import tips
from plyfold.arrays import Ints
from plyfold.errors import InputError
from plyfold.graphs import components
from plyfold.immersion.shorter_lobes import place_of_turning
from plyfold.obstruction import Obstruction

__all__ = [
    "clusters_of_loops",
    "impossible_cusp",
    "impossible_turning",
    "is_visibly_no_disk",
    "is_visibly_no_surface",
    "loops_apart",
    "may_bound_disk",
    "negative_winding",
    "require_curve_without_cusps",
    "touches_as_no_disk",
    "visible_obstruction",
]


def require_curve_without_cusps(arranged: Arrangement, what: str) -> None:
    """Refuse an outline of several loops, or with cusps, for what is there for one curve without cusps alone."""
    require_one_loop(arranged, what)
    if arranged.cusp_index.any():
        where = tuple((x, y) for x, y in arranged.marks.tolist())
        hint = "find_immersion, immersions and count_immersions take cusps"
        raise InputError(f"{what} is there for curves without cusps alone", where, hint=hint)


def may_bound_disk(arranged: Arrangement) -> bool:
    """Tell whether every surface bounded by an outline is a disk: one boundary, and Euler characteristic 1."""
    return arranged.n_loops == 1 == arranged.euler_characteristic


def is_visibly_no_disk(arranged: Arrangement) -> bool:
    """Tell whether numbers alone show that an outline bounds no disk, without looking for the place."""
    return not may_bound_disk(arranged) or bool(arranged.winding.min() < 0) or len(_impossible_cusps(arranged)) > 0


def touches_as_no_disk(found: InContact) -> bool:
    """Tell whether the given points of an outline in contact show that it bounds no disk, however little they move.

    A loop without spikes turns by less than half a turn at each point. So its directions change little in small moves,
    and it turns as often as before; for a disk, once and the turns that are too many at its cusps, or as often
    backward. And inside each face of the given points there is a place round which it goes on winding as it does.
    """
    outline = found.left
    if outline.n_loops > 1 or tips(outline).any():
        return outline.n_loops > 1
    if abs(polygon_turning_number(outline.points)) != 1 + int(outline.cusps[0].sum()):
        return True
    return bool(found.noding.winding.min() < 0 < found.noding.winding.max())


def visible_obstruction(arranged: Arrangement, connected: bool = False) -> Obstruction | None:
    """Return what numbers alone show to be in the way of an immersion, if anything; or of one in a single piece."""
    found = impossible_cusp(arranged)
    found = impossible_turning(arranged, connected) if found is None else found
    found = negative_winding(arranged) if found is None else found
    return loops_apart(arranged) if found is None and connected else found


def is_visibly_no_surface(arranged: Arrangement, connected: bool = False) -> bool:
    """Tell whether numbers alone show that an outline bounds no surface, or none in one piece, without the place."""
    return (
        len(_impossible_cusps(arranged)) > 0
        or _cluster_that_turns_wrong(arranged, connected) is not None
        or bool(arranged.winding.min() < 0)
        or (connected and loops_apart(arranged) is not None)
    )


def _impossible_cusps(arranged: Arrangement) -> Ints:
    """Return the visits at cusps with too few sheets on their left: one more than the index is needed."""
    if not arranged.cusp_index.any():
        return np.empty(0, dtype=np.int64)
    sheets = arranged.winding[arranged.left_cell[arranged.border_after]]
    return np.flatnonzero((arranged.cusp_index > 0) & (sheets < arranged.cusp_index + 1))


def impossible_cusp(arranged: Arrangement) -> Obstruction | None:
    """Return the obstruction of a cusp that cannot be one, if there is such: the first of them.

    A surface that winds m times more than one sees round a point of its boundary lies there m + 1 times on itself.
    """
    wrong = _impossible_cusps(arranged)
    if not len(wrong):
        return None
    visit = int(wrong[0])
    border = int(arranged.border_after[visit])
    sheets, index = int(arranged.winding[arranged.left_cell[border]]), int(arranged.cusp_index[visit])
    place = f"the start of border {border}"
    if arranged.outline is not None:
        point = int(arranged.visit_edge[visit])
        place = f"point {int(arranged.outline.rows[point])}"
        # At the tip of a spike one sees an angle of a full turn, which strands that are moved apart turn round.
        index -= int(tips(arranged.given)[point]) if arranged.given is not None else 0
    where = places_of_visits(arranged, [visit])
    needed = int(arranged.cusp_index[visit]) + 1
    sentence = (
        f"No cusp of index {index} can be at {place}: it needs {needed} sheets on its left, and there "
        f"{'is' if sheets == 1 else 'are'} {sheets}."
    )
    return Obstruction("cusp", sentence, where, sheets, arranged)


def clusters_of_loops(arranged: Arrangement) -> Ints:
    """Return a number for each loop: the same for loops that cross, or of which some lie inside others.

    What loops of different clusters bound has nothing to do with each other.
    """
    if arranged.n_loops == 1:
        return np.zeros(1, dtype=np.int64)
    group = arranged.group_of_loop
    feet = group[arranged.loop_of_border[arranged.bridges // 2]]
    return components(int(group.max()) + 1, *feet.T)[group]


def impossible_turning(arranged: Arrangement, connected: bool = False) -> Obstruction | None:
    """Return the obstruction of loops that turn too often, or by an odd number too few times, if there are such.

    The outline of a connected surface that lies flat turns 2 times less 2 for each handle and 1 for each of its loops.
    So c loops bound something only if they turn c times, or less by an even number; one piece, if 2 − c times, or less.
    """
    members = _cluster_that_turns_wrong(arranged, connected)
    if members is None:
        return None
    sentence, chi = _turning_in_words(arranged, members, connected), int(arranged.loop_characteristics[members].sum())
    return Obstruction("turning number", sentence, place_of_turning(arranged), chi, arranged)


def _cluster_that_turns_wrong(arranged: Arrangement, connected: bool) -> Ints | None:
    """Return the first loops that have to do with each other and cannot bound anything, as often as they turn."""
    cluster = clusters_of_loops(arranged)
    loops, chi = np.bincount(cluster), np.zeros(int(cluster.max()) + 1, dtype=np.int64)
    np.add.at(chi, cluster, arranged.loop_characteristics)
    wrong = np.flatnonzero((chi > (2 - loops if connected else loops)) | ((loops - chi) % 2 == 1))
    return np.flatnonzero(cluster == wrong[0]) if len(wrong) else None


def _turning_in_words(arranged: Arrangement, members: Ints, connected: bool) -> str:
    loops = len(members)
    turning = sum(arranged.turning_numbers[loop] for loop in members.tolist())
    cusps = turning - int(arranged.loop_characteristics[members].sum())
    some = f" of {arranged.n_loops}" if loops < arranged.n_loops else ""
    who = "curve turns" if arranged.n_loops == 1 else f"{loops}{some} curves together turn"
    at_cusps = f", {cusps} of them at cusps" if cusps else ""
    what = "a surface in one piece" if connected and loops > 1 else "a surface"
    most = 2 - loops if connected else loops
    apart = "apart from cusps, " if cusps else ""
    often = {1: "once"}.get(most, f"{most} times")
    turns = {1: "once"}.get(turning, f"{turning} times")
    return f"The {who} {turns}{at_cusps}; {apart}what bounds {what} turns {often}, or less by an even number."


def loops_apart(arranged: Arrangement) -> Obstruction | None:
    """Return the obstruction of loops that cannot bound one piece, because no sheet reaches from some to the others."""
    clusters = int(clusters_of_loops(arranged).max()) + 1
    if clusters == 1:
        return None
    sentence = f"No surface in one piece: the curves lie in {clusters} places apart from each other."
    return Obstruction("pieces", sentence, (), clusters, arranged)


def negative_winding(arranged: Arrangement) -> Obstruction | None:
    """Return the obstruction of a negative winding number, if there is one: the lowest of them."""
    lowest = int(np.argmin(arranged.winding))
    winding = int(arranged.winding[lowest])
    if winding >= 0:
        return None
    who = "curve winds" if arranged.n_loops == 1 else "curves wind"
    sentence = f"The {who} {winding} times around a cell, and cloth cannot cover it a negative number of times."
    where = (place_in_cell(arranged, lowest),) if arranged.outline else ()
    return Obstruction("negative winding", sentence, where, winding, arranged)
