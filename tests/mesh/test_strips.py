"""Cells and gluing on the given points of outlines that touch themselves."""

import itertools
from collections import Counter
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

import plyfold as pf
from plyfold.arrangement.noding import strands_of
from plyfold.errors import PrecisionError
from plyfold.mesh.cells import triangulate_cells
from plyfold.mesh.refine import is_moved
from plyfold.mesh.sheets import glue_copies
from plyfold.mesh.strips import loop_left, strips_of
from touching import grown_outlines

TRIANGLES = [(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)]
KEYHOLE = [(0, 0), (6, 0), (6, 6), (0, 6), (0, 2), (2, 2), (2, 4), (4, 4), (4, 2), (2, 2), (0, 2)]
NECK = [(0, 0), (2, 0), (2, 1), (4, 1), (4, 0), (6, 0), (6, 2), (4, 2), (4, 1), (2, 1), (2, 2), (0, 2)]
# A ribbon that passes over itself, all of whose crossings are at vertices.
RAMP = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (5, -3), (5, 0), (5, 5), (8, 5), (8, 1), (5, 1), (3, 1), (0, 1)]
TOUCHING = {"triangles": TRIANGLES, "keyhole": KEYHOLE, "neck": NECK, "ramp": RAMP}
PIECES = {"triangles": 2, "keyhole": 1, "neck": 2, "ramp": 1}


def glued(outline, triangles=0):
    """Return the first surface with an outline, flat, as points, triangles and loops of vertices."""
    immersion = pf.find_immersion(outline)
    cells = triangulate_cells(immersion.arrangement, triangles=triangles)
    mesh = glue_copies(immersion, cells)
    return immersion, cells.points[mesh.planar_vertex], mesh.faces, np.split(mesh.boundary, mesh.first_boundary[1:-1])


def doubled_area(points):
    x, y = ([Fraction(number) for number in column] for column in np.asarray(points).T.tolist())
    return sum(x[i - 1] * y[i] - x[i] * y[i - 1] for i in range(len(x)))


def runs(loops, places):
    """Return how often each segment between neighbouring places on a line is run, backwards counted as negative."""
    found = Counter()
    for loop in loops:
        for start, end in zip(loop, [*loop[1:], loop[0]], strict=True):
            (ax, ay), (bx, by) = start, end
            on_edge = [
                (x, y)
                for x, y in places
                if (bx - ax) * (y - ay) == (by - ay) * (x - ax)
                and min(ax, bx) <= x <= max(ax, bx)
                and min(ay, by) <= y <= max(ay, by)
            ]
            on_edge.sort(key=lambda place: (place[0] - ax) * (bx - ax) + (place[1] - ay) * (by - ay))
            for one, other in itertools.pairwise(on_edge):
                found[min(one, other), max(one, other)] += 1 if one < other else -1
    return {segment: times for segment, times in found.items() if times}


@pytest.mark.parametrize("name", TOUCHING)
def test_pieces_on_the_given_points(name):
    immersion, places, faces, loops = glued(TOUCHING[name])
    assert is_moved(immersion.arrangement)
    assert len(loops) == PIECES[name]
    assert set(map(tuple, TOUCHING[name])) <= set(map(tuple, places.tolist()))
    corners = places[faces]
    assert all(doubled_area(triangle) > 0 for triangle in corners)
    assert sum(map(doubled_area, corners)) == doubled_area(TOUCHING[name])


def test_a_pinch_is_two_vertices_in_one_place():
    _, places, faces, loops = glued(TRIANGLES)
    assert len(faces) == 2
    assert len(places) == 6
    assert [sorted(places[loop].tolist()) for loop in loops] == [
        [[0, 0], [1, 1], [2, 0]],
        [[0, 2], [1, 1], [2, 2]],
    ]
    pinched = np.flatnonzero((places == (1, 1)).all(axis=1))
    assert len(pinched) == 2
    assert not set(faces[0]) & set(faces[1])


def test_a_neck_drops_out():
    _, places, _, loops = glued(NECK)
    assert sorted(sorted(map(tuple, places[loop].tolist())) for loop in loops) == [
        [(0, 0), (0, 2), (2, 0), (2, 1), (2, 2)],
        [(4, 0), (4, 1), (4, 2), (6, 0), (6, 2)],
    ]


def test_strands_side_by_side_are_in_order():
    arrangement = pf.arrange(NECK)
    strips = strips_of(arrangement)
    noding, order = strips.strands.noding, strips.order
    part, backward = np.divmod(strips.strands.half_edge[order], 2)
    border = strips.moved_border[order]
    left = np.where(backward, arrangement.right_cell[border], arrangement.left_cell[border])
    right = np.where(backward, arrangement.left_cell[border], arrangement.right_cell[border])
    beside = np.flatnonzero(part[1:] == part[:-1])
    assert len(beside) == 1
    assert (left[beside] == right[beside + 1]).all()
    assert noding.times[part[beside]] == 0


# Most touch nowhere, and another seed may bring many of these first.
@settings(max_examples=50, deadline=None, suppress_health_check=[HealthCheck.filter_too_much])
@given(grown_outlines(), st.sampled_from([0, 40]))
def test_what_is_left_is_bounded_by_the_outline_but_for_necks(points, triangles):
    arrangement = pf.arrange(points)
    assume(is_moved(arrangement) and pf.find_immersion(arrangement))
    immersion, places, faces, loops = glued(arrangement, triangles)
    used = immersion.arrangement.given.points
    left = [loop_left(immersion.arrangement, places, faces, loop)[0] for loop in loops]
    everywhere = {tuple(point) for point in used.tolist()}
    assert runs([list(map(tuple, used.tolist()))], everywhere) == runs(
        [list(map(tuple, loop.tolist())) for loop in left], everywhere
    )
    assert sum(map(doubled_area, left)) == doubled_area(used)
    assert all(doubled_area(triangle) > 0 for triangle in places[faces])


def test_points_moved_too_far_are_named():
    far = pf.arrange([(0, 0), (9, 0), (9, 9), (5, 9), (5, 4), (4, 4), (4, 9), (0, 9)])
    near = pf.Curve([(0, 0), (9, 0), (9, 9), (5, 9), (5, -1), (4, -1), (4, 9), (0, 9)])
    with pytest.raises(PrecisionError, match="moved apart"):
        strips_of(replace(far, given=near))


def test_strands_run_along_the_outline():
    outline = pf.Outline([KEYHOLE, [(9, 0), (9, 9), (0, 9)]])
    strands = strands_of(outline)
    ends = strands.noding.points[strands.noding.ends.ravel()]
    assert np.array_equal(ends[strands.half_edge[strands.first[:-1]]], outline.points)
    last = strands.half_edge[strands.first[1:] - 1]
    assert np.array_equal(ends[last ^ 1], outline.points[outline.next_point])
