"""Lifted surfaces of outlines: holes, pieces, handles, and spiral stairs round cusps."""

from itertools import pairwise

import numpy as np
import pytest

import plyfold as pf
from plyfold.certify import check_surface_mesh
from plyfold.draw.viewer import mesh_data
from plyfold.errors import InputError
from plyfold.mesh.cells import triangulate_cells
from plyfold.surface.stairs import with_cusps_apart, with_steps
from reference.random_curves import HANDLE
from reference.triangles import meeting_pairs

SQUARE = [(0, 0), (9, 0), (9, 9), (0, 9)]
HOLE = [(3, 3), (3, 6), (6, 6), (6, 3)]
TRIANGLE = [(5, -2), (12, 5), (4, 12)]


def circle(radius, centre=(0.0, 0.0), way=1, n=40):
    angle = way * 2 * np.pi * np.arange(n) / n
    return np.column_stack([np.cos(angle), np.sin(angle)]) * radius + centre


def ring(centre):
    return [circle(4, centre), circle(2.7, centre, -1)]


def limacon(turns=1, n=80):
    """A curve that turns turns + 1 times, with a cusp in the middle of its inner loop."""
    angle = np.linspace(0, 2 * np.pi, n + 1)[:-1]
    radius = 0.45 + np.cos(angle)
    return pf.Curve(np.column_stack([radius * np.cos(angle), radius * np.sin(angle)]), cusps={n // 2: turns})


OUTLINES = {
    "ring": ([SQUARE, HOLE], [(2, 0)]),
    "ring and triangle": ([SQUARE, HOLE, TRIANGLE], [(2, 0), (1, 1)]),
    "one inside the other": ([circle(4), circle(2)], [(1, 1), (1, 1)]),
    "two rings": ([*ring((0, 0)), *ring((4.1, 0.3))], [(2, 0), (2, 0)]),
    "apart": ([circle(1), circle(1, (0, 5)), circle(1, (0.7, 0.2))], [(1, 1), (1, 1), (1, 1)]),
    "handle": (HANDLE, [(1, -1)]),
    "limaçon": (limacon(), [(1, 1)]),
}


@pytest.fixture(params=OUTLINES, scope="module")
def lifted(request):
    outline, kinds = OUTLINES[request.param]
    return pf.lift(outline, triangles=600), kinds


def test_is_what_the_outline_bounds(lifted):
    surface, kinds = lifted
    surface.check()
    check_surface_mesh(surface.faces, len(surface.vertices), kinds)
    assert sorted((len(p.loops), p.euler_characteristic) for p in surface.layering.immersion.pieces) == sorted(kinds)


def test_nothing_meets(lifted):
    surface, _ = lifted
    assert meeting_pairs(surface.vertices, surface.faces) == []


def test_boundary_runs_loop_after_loop(lifted):
    surface, _ = lifted
    outline, first = surface.outline, surface.first_boundary
    assert len(first) == outline.n_loops + 1
    assert surface.boundary.tolist() == list(range(first[-1]))
    for loop, start in zip(outline.loops, first, strict=False):
        assert surface.vertices[start, :2].tolist() == loop[0].tolist()


def test_solid(lifted):
    surface, _ = lifted
    solid = surface.thicken(surface.gap / 2)
    solid.check()
    assert meeting_pairs(solid.vertices, solid.faces) == []


@pytest.mark.parametrize("ending", [".glb", ".obj", ".ply", ".stl", ".3mf", ".html"])
def test_files(lifted, ending, tmp_path):
    surface, _ = lifted
    surface.export(tmp_path / f"surface{ending}")
    if ending != ".html":
        surface.thicken(surface.gap / 2).export(tmp_path / f"solid{ending}")
    assert (tmp_path / f"surface{ending}").stat().st_size > 1000


def test_pieces_that_lie_apart_lie_on_the_table():
    surface = pf.lift(OUTLINES["apart"][0], triangles=300)
    first = surface.first_boundary
    height = [surface.vertices[start:end, 2].min() for start, end in pairwise(first)]
    assert sorted(height)[:2] == [0.0, 0.0]


def test_pieces_over_each_other_lie_close():
    surface = pf.lift(OUTLINES["one inside the other"][0], triangles=300)
    assert np.ptp(surface.vertices[:, 2]) == pytest.approx(surface.gap, rel=0.01)


def test_linked_rings_pass_through_one_another():
    """Of all embeddings of two rings, those in which each is above the other somewhere are linked."""
    linked = [
        layering
        for layering in pf.embeddings(OUTLINES["two rings"][0])
        if len({bool(over) for over in layering.casing[:4]}) == 2
    ]
    surface = pf.lift(linked[0], triangles=600)
    surface.check()
    assert meeting_pairs(surface.vertices, surface.faces) == []


def test_pins_and_flat_parts_of_a_ring():
    surface = pf.lift([SQUARE, HOLE, TRIANGLE], triangles=300, pins={(1.0, 1.0): 5.0}, flat=True)
    surface.check()
    assert surface.vertices[0, 2] == pytest.approx(5.0, abs=0.5)


def test_what_is_no_disk_cannot_be_unwrapped():
    surface = pf.lift([SQUARE, HOLE], triangles=100)
    with pytest.raises(InputError, match="disk"):
        surface.unwrap()
    with pytest.raises(InputError, match="this"):
        _ = surface.curve
    with pytest.raises(InputError, match="disk"):
        surface.export("ring.glb", unwrapped=True)


def test_a_disk_with_a_cusp_is_unwrapped():
    unwound = pf.lift(limacon(), triangles=300).unwrap()
    assert np.allclose(np.hypot(*unwound.disk[unwound.boundary].T), 1)


# Stairs


@pytest.mark.parametrize("turned", range(4))
def test_stair_climbs_steadily(turned):
    """Round the cusp heights rise with the angle, the whole way by more than a gap, and the cusp is in the middle."""
    curve = limacon()
    quarter = np.linalg.matrix_power(np.array([[0, 1], [-1, 0]]), turned)
    surface = pf.lift(pf.Curve(curve.points @ quarter, cusps=curve.cusps[0]), triangles=1000)
    (cusp,) = surface.cusps
    step, at = cusp + 1, [cusp + 1]
    corners = {face[1]: face[2] for face in fan(surface.faces, cusp)}
    while step in corners:
        step = corners[step]
        at.append(step)
    assert at[-1] == cusp - 1
    height = surface.vertices[at, 2]
    climb = np.diff(height) * np.sign(height[-1] - height[0])
    assert (climb > 0).all()
    assert surface.gap < np.ptp(height) < 2 * surface.gap
    assert abs(surface.vertices[cusp, 2] - height[[0, -1]].mean()) < 0.2 * surface.gap
    assert np.hypot(*(surface.vertices[at, :2] - surface.vertices[cusp, :2]).T).max() < 0.01 * np.ptp(curve.points)


def fan(faces, vertex):
    """The triangles at a vertex, each from there."""
    row, corner = np.nonzero(faces == vertex)
    return [np.roll(faces[r], -c).tolist() for r, c in zip(row, corner, strict=True)]


def test_surface_climbs_little_more_than_it_must():
    surface = pf.lift(limacon(), triangles=1000)
    assert np.ptp(surface.vertices[:, 2]) < 1.6 * surface.gap


def test_steps_change_triangles_at_cusps_alone():
    mesh = triangulate_cells(pf.arrange(limacon()), triangles=300)
    steps = with_steps(mesh, np.array([40]))
    fine, n = steps.cells, len(mesh.points)
    assert fine.points[:n].tobytes() == mesh.points.tobytes()
    beside = np.unique(mesh.triangles[(mesh.triangles == 40).any(axis=1)])
    far = {tuple(t) for t in mesh.triangles.tolist() if not np.isin(t, beside).sum() >= 2}
    assert far <= {tuple(t) for t in fine.triangles.tolist()}
    assert (np.flatnonzero(steps.outer >= 0) >= n).all()
    start = fine.triangles.ravel()
    assert (start[fine.left] == fine.chain).all()
    assert (fine.cell[fine.left // 3] == pf.arrange(limacon()).left_cell[fine.chain_border]).all()


def test_without_room_for_steps():
    """A cusp whose neighbours are a few roundings away stays as it is."""
    curve = limacon()
    points = curve.points.copy()
    points[41] = points[40] + [0.0, 1e-9]
    mesh = triangulate_cells(pf.arrange(points), triangles=0)
    assert with_steps(mesh, np.array([40])).cells is mesh


@pytest.mark.parametrize("turns", [2, 3])
def test_stair_of_several_turns(turns):
    """A spiral that ends in a cusp with as many turns as it has too many."""
    angle = np.linspace(0, 2 * np.pi * (turns + 1), 30 * (turns + 1))
    spiral = np.column_stack([np.cos(angle), np.sin(angle)]) * (2 - angle / angle[-1])[:, None]
    curve = pf.Curve([*spiral.tolist(), (0.1, 0.05)], cusps={len(spiral): turns})
    surface = pf.lift(curve, triangles=1000)
    surface.check()
    assert np.ptp(surface.vertices[:, 2]) > (turns - 0.5) * surface.gap


def test_page_of_what_is_no_disk_has_no_way_from_the_disk():
    data = mesh_data(pf.lift([SQUARE, HOLE], triangles=100))
    assert data["frames"] == []
    assert len(mesh_data(pf.lift(limacon(), triangles=100))["frames"]) > 1


def test_edges_between_cusps_are_split():
    square = triangulate_cells(pf.arrange([(0, 0), (2, 0), (2, 2), (0, 2)]), triangles=0)
    apart = with_cusps_apart(square, np.array([0, 1, 2]))
    ends = np.stack([apart.triangles, np.roll(apart.triangles, -1, axis=1)], axis=2).reshape(-1, 2)
    assert not (ends < 3).all(axis=1).any()
    assert with_cusps_apart(square, np.array([0])) is square
