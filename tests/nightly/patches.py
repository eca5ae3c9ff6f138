"""Patches of bodies that face a viewer, and everything that must hold for one.

Each is a surface in space, so its outline, with its cusps, must bound one with that Euler characteristic. Where it does
not cut itself, the levels that its depths give must be levels, and the surface with its over and under must be found.
"""

import numpy as np

import plyfold as pf
from bodies import Patch, levels_beside
from plyfold.errors import GeneralPositionError
from plyfold.layering.levels.equations import level_equations
from reference.mesh_outlines import marked
from reference.triangles import meeting_pairs

MOST_TO_LIFT = 30
"""Points of outlines up to which lifted surfaces are tested for triangles that meet, where that is asked for."""


def judge_patch(patch: Patch, lift: bool = False) -> bool:
    """Everything that must hold for a patch, and if that is asked for, for the surface lifted in its order.

    False where its outline is not in general position.
    """
    outline = pf.Outline(patch.outline, patch.cusps)
    judge_mesh(patch, outline)
    try:
        arranged = pf.arrange(outline, general_position="raise")
    except GeneralPositionError:
        return False
    assert arranged.euler_characteristic == patch.chi
    judge_immersion(pf.find_immersion(arranged, connected=True), patch)
    if not patch.cuts_itself:
        itself = judge_depths(patch, arranged)
        if lift and len(outline) <= MOST_TO_LIFT:
            judge_lift(itself)
    return True


def judge_mesh(patch: Patch, outline: pf.Outline) -> None:
    """The mesh, seen from above, has the outline that the generator says."""
    found = pf.Outline.from_mesh(patch.vertices[:, :2], patch.faces)
    rows = np.split(found.rows, found.first_point[1:-1])
    assert marked(rows, found.cusps) == marked(patch.loops, outline.cusps)


def judge_immersion(found: pf.Immersion | pf.Obstruction, patch: Patch) -> None:
    """There is a surface in one piece, and it is as it should be."""
    assert isinstance(found, pf.Immersion), str(found)
    found.check()
    assert found.euler_characteristic == patch.chi
    assert [piece.loops for piece in found.pieces] == [tuple(range(len(patch.loops)))]


def judge_depths(patch: Patch, arranged: pf.Arrangement) -> pf.Layering:
    """The depths of the patch are levels, and among the surfaces with its over and under is itself; return it."""
    level = depth_levels(patch, arranged)
    assert level_equations(arranged).hold(level)
    over = casing(arranged, level)
    alike = list(pf.embeddings(arranged, over=over))
    (itself,) = [found for found in alike if found.border_level.tolist() == level.tolist()]
    itself.check()
    assert itself.casing.tolist() == over.tolist()
    assert itself.immersion.euler_characteristic == patch.chi
    assert len(itself.immersion.pieces) == 1
    if len(alike) == 1:
        assert pf.embed_cased(arranged, over).border_level.tolist() == level.tolist()
    return itself


def judge_lift(found: pf.Layering) -> None:
    """The lifted surface has no two triangles that meet, and seen from above it has the outline and its cusps."""
    surface = pf.lift(found, triangles=100)
    surface.check()
    assert not meeting_pairs(surface.vertices, surface.faces)
    outline, seen = found.immersion.arrangement.outline, pf.Outline.from_mesh(surface.vertices, surface.faces)
    assert seen.n_loops == outline.n_loops
    assert set(map(tuple, outline.points.tolist())) <= set(map(tuple, seen.points.tolist()))
    assert places_of_cusps(seen) == places_of_cusps(outline)


def places_of_cusps(outline: pf.Outline) -> list[tuple[float, ...]]:
    """The points that are cusps, with their indices."""
    index = np.concatenate(outline.cusps)
    return sorted((x, y, m) for (x, y), m in zip(outline.points.tolist(), index.tolist(), strict=True) if m)


def depth_levels(patch: Patch, arranged: pf.Arrangement) -> np.ndarray:
    """The levels of all borders: each at a place on the edge on which it starts, before it or the edge ends."""
    outline, start = arranged.outline, arranged.start_visit
    edge = outline.first_point[arranged.loop_of_border]
    visited = start >= 0
    edge[visited] = arranged.visit_edge[start[visited]]
    begin, end = outline.points[edge], outline.points[outline.next_point[edge]]
    begin[visited] = arranged.visit_point[start[visited]]
    following = start[arranged.next_border]
    at_once = np.flatnonzero(visited & (following > start))
    at_once = at_once[arranged.visit_edge[following[at_once]] == edge[at_once]]
    end[at_once] = arranged.visit_point[following[at_once]]
    # Between a cusp and the foot of a bridge at one vertex a border is no longer than a point: as the one that follows.
    at = np.where((begin == end).all(axis=1), arranged.next_border, np.arange(arranged.n_borders))
    level, winding = levels_beside(patch, edge[at], (begin + end)[at] / 2)
    assert winding.tolist() == arranged.winding[arranged.left_cell].tolist()
    return level


def casing(arranged: pf.Arrangement, level: np.ndarray) -> np.ndarray:
    """Over and under by visits: at a crossing, the borders beside its top cell are before one strand, after the other.

    Marks are crossed by nothing.
    """
    before, after, ccw = level[arranged.border_before], level[arranged.border_after], arranged.ccw
    at_top = np.where(ccw, before, after)
    return at_top > at_top[arranged.partner]
