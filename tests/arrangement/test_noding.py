"""Nodes, parts, faces and winding numbers of drawings that touch, against slabs and rays in fractions, and GEOS."""

from collections import Counter

import numpy as np
import pytest
import shapely
from hypothesis import given, settings

import plyfold as pf
from plyfold.arrangement.noding import Noding, node_outline
from reference.fills import winding_by_ray
from touching import touching_outlines


def noded(*loops) -> Noding:
    return node_outline(pf.Outline([np.array(loop, dtype=np.float64) for loop in loops]))


def euler_holds(found: Noding) -> bool:
    nodes = len(np.unique(found.ends))
    graph = shapely.node(shapely.multilinestrings([found.points[ends] for ends in found.ends]))
    merged = shapely.unary_union(shapely.buffer(graph, 0.001))
    return nodes - len(found.ends) + len(found.winding) == 1 + shapely.get_num_geometries(merged)


@settings(max_examples=150, deadline=None)
@given(touching_outlines())
def test_windings_differ_by_the_times_a_part_is_run(outline):
    found = node_outline(outline)
    left, right = found.winding[found.face.reshape(-1, 2)].T
    assert (left - right == found.times).all()
    assert found.winding[0] == 0
    assert (found.times != 0).all()
    assert sorted(found.following) == list(range(len(found.face)))
    assert (found.face[found.following] == found.face).all()
    assert len(found.ends) == 0 or euler_holds(found)


@settings(max_examples=100, deadline=None)
@given(touching_outlines())
def test_windings_are_those_of_rays(outline):
    """A little right of a node and far less above it lies the face left of the last part that runs level or down."""
    found = node_outline(outline)
    for node in np.unique(found.ends[:, 0]).tolist():
        if found.is_vertex[node]:
            parts = np.flatnonzero(found.ends[:, 0] == node)
            rising = found.points[found.ends[parts, 1], 1] - found.points[node, 1]
            level_or_down = parts[rising <= 0]
            if len(level_or_down):
                part = level_or_down[np.argmax(found.line[level_or_down])]
                expected = winding_by_ray(outline.loops, *found.points[node].tolist())
                assert found.winding[found.face[2 * part]] == expected


def test_nothing_is_left_of_a_loop_that_runs_back_all_the_way():
    found = noded([(0, 0), (2, 0), (2, 1), (2, 0)])
    assert len(found.ends) == 0
    assert found.winding.tolist() == [0]


def test_a_strand_run_thrice():
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    assert noded(square * 3).times.tolist() == [-3, 3, -3, 3]
    assert noded(square * 3).winding.tolist() == [0, 3]


def test_loops_lie_in_faces_of_loops():
    """Squares in each other, one that touches nothing beside, and one that hangs on a corner inside."""

    def square(x, y, size):
        return [(x, y), (x + size, y), (x + size, y + size), (x, y + size)]

    found = noded(
        square(0, 0, 10), square(1, 1, 8), square(2, 2, 1), square(4, 2, 1), square(9, 9, 1), square(20, 0, 1)
    )
    assert Counter(found.winding.tolist()) == Counter([0, 1, 2, 3, 3, 2, 1])
    euler = len(found.points) - len(found.ends) + len(found.winding)
    # The fifth square touches the first at a corner, and the second at another.
    assert euler == 1 + 4


@pytest.mark.parametrize("scale", [1, 0.25, 1000003, 0.1])
def test_crowds_have_one_graph_at_every_scale(scale):
    """Hundreds of edges through hundreds of places; scaled by a tenth, rounding breaks contacts."""
    points = np.random.default_rng(1).integers(0, 8, (120, 2))
    plain, scaled = noded(points), noded(points * scale)
    x, y = (points * scale).T
    area = (x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
    cells = pf.coverage(points * scale)
    if scale != 0.1:
        assert plain.ends.tolist() == scaled.ends.tolist()
        assert plain.face.tolist() == scaled.face.tolist()
    assert abs(sum(cell.winding * cell.polygon.area for cell in cells)) == pytest.approx(abs(area))


def test_rank_of_crossings_that_doubles_cannot_tell_apart():
    """Three edges that nearly meet: their crossings differ by less than rounding."""
    nearly = [(0, 0), (3, 1), (3, 0), (0, 1 + 2**-52), (1.5, 2), (1.5, -1)]
    assert len(noded(nearly).points) == 9
    assert len(noded([(0, 0), (3, 1), (3, 0), (0, 1), (1.5, 2), (1.5, -1)]).points) == 7
