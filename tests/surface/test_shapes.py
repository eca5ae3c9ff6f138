"""What the heights look like: symmetric, smooth, monotone; and what pins, stiffness and flat parts do to them."""

from dataclasses import replace

import numpy as np
import pytest

import plyfold.surface.contact
from cloths import energy_matrix
from coarse import CURVES
from plyfold import find_layering, immersions, lift
from plyfold.errors import InputError
from plyfold.mesh.cells import triangulate_cells
from plyfold.surface.glue import LiftedMesh, stack_sheets
from plyfold.surface.heights import smooth_heights
from reference.contact import least_heights

RAMP = CURVES["exit-ramp"].curve


def glued(name, triangles=400):
    layering = next(filter(None, map(find_layering, immersions(CURVES[name].curve))))
    planar = triangulate_cells(layering.immersion.arrangement, triangles=triangles)
    return planar.points, stack_sheets(layering, planar)


def kept_apart(z, mesh, gap):
    lower, upper = mesh.stacked.T
    return (z[lower] + gap <= z[upper]).all()


def renumbered(points, mesh, rng):
    """The same mesh with points, vertices, triangles and stacked rows in another order."""
    v, p, f = (rng.permutation(n) for n in (len(mesh.level), len(points), len(mesh.faces)))
    # Copies of a triangle must stay together.
    below = mesh.planar_vertex[mesh.faces]
    group = np.cumsum(np.concatenate([[True], (below[1:] != below[:-1]).any(axis=1)]))
    f = np.lexsort((np.arange(len(group)), rng.permutation(group.max() + 1)[group]))
    new_points, planar, level = np.empty_like(points), np.empty_like(mesh.planar_vertex), np.empty_like(mesh.level)
    new_points[p] = points
    planar[v], level[v] = p[mesh.planar_vertex], mesh.level
    stacked = v[mesh.stacked][rng.permutation(len(mesh.stacked))]
    other = replace(
        mesh,
        planar_vertex=planar,
        faces=v[mesh.faces][f],
        sheet=mesh.sheet[f],
        boundary=v[mesh.boundary],
        level=level,
        stacked=stacked,
    )
    return new_points, other, v


@pytest.mark.parametrize("name", ["exit-ramp", "stacked-spiral", "bennequin"])
def test_the_order_of_vertices_does_not_matter(name):
    points, mesh = glued(name)
    z = smooth_heights(points, mesh, 1.0)
    for seed in range(3):
        other_points, other, number = renumbered(points, mesh, np.random.default_rng(seed))
        moved = smooth_heights(other_points, other, 1.0)
        assert kept_apart(moved, other, 1.0)
        assert moved[number] == pytest.approx(z, abs=2e-3)


@pytest.mark.parametrize("name", ["exit-ramp", "milnor"])
def test_turned_upside_down(name):
    """A mirrored stack has the mirrored heights: neither top nor bottom is preferred."""
    points, mesh = glued(name)
    top = np.zeros(len(points), dtype=int)
    np.maximum.at(top, mesh.planar_vertex, mesh.level)
    over = replace(mesh, level=top[mesh.planar_vertex] - mesh.level, stacked=mesh.stacked[:, ::-1])
    z, turned = smooth_heights(points, mesh, 1.0), smooth_heights(points, over, 1.0)
    assert turned == pytest.approx(z.max() - z, abs=1e-3)


def test_symmetric_for_symmetric_input():
    """A half turn takes the Milnor-like curve to itself, point i to point i + 6, and its stack upside down."""
    corners = CURVES["milnor"].curve.points
    surface = lift(corners, triangles=4000)
    z = np.array([surface.vertices[(surface.vertices[:, :2] == corner).all(axis=1)][0, 2] for corner in corners])
    assert np.array_equal(np.roll(corners, 6, axis=0), -corners)
    # The triangles are not symmetric.
    assert np.ptp(z + np.roll(z, 6)) < 1e-2 * np.ptp(z)


def test_ramps_only_rise():
    """Once round the horseshoe, from where one end lies over the other."""
    surface = lift(CURVES["horseshoe"].curve, triangles=6000)
    outline = surface.vertices[surface.boundary]
    angle = np.unwrap(np.arctan2(*(outline[:, :2] - outline[:, :2].mean(axis=0)).T[::-1]))
    low, high = np.argmin(angle), np.argmax(angle)
    side = outline[min(low, high) : max(low, high) + 1, 2]
    step = np.diff(side) * np.sign(side[-1] - side[0])
    # Where the ends lie over each other they are next to level.
    assert step.min() > -2e-3 * np.ptp(side)
    assert (step > 0).mean() > 0.85


@pytest.mark.parametrize("name", ["exit-ramp", "bennequin", "stacked-spiral"])
def test_smooth_across_borders(name):
    """Triangles on both sides of a border meet at no larger angles than others do, for their size."""
    surface = lift(CURVES[name].curve, triangles=8000)
    a, b, c = surface.vertices[surface.faces].swapaxes(0, 1)
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    edges = np.sort(surface.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    order = np.lexsort(edges.T)
    twice = np.flatnonzero((np.diff(edges[order], axis=0) == 0).all(axis=1))
    first, second = order[twice] // 3, order[twice + 1] // 3
    bend = np.linalg.norm(normal[first] - normal[second], axis=1)
    border = surface.sheet[first] != surface.sheet[second]
    assert border.sum() > 30
    assert np.quantile(bend[border], 0.95) < 3 * np.quantile(bend[~border], 0.95)
    assert bend[border].max() < 1.5 * bend[~border].max()


@pytest.mark.parametrize("name", ["exit-ramp", "milnor"])
def test_against_an_active_set_method(name):
    """Another solver, one contact after the other, on the whole matrix."""
    points, mesh = glued(name, triangles=100)
    energy = energy_matrix(points, mesh)
    reference = least_heights(energy, mesh.stacked, np.ones(len(mesh.stacked)))
    assert smooth_heights(points, mesh, 1.0) == pytest.approx(reference, abs=1e-3)


@pytest.mark.parametrize("name", ["bennequin", "stacked-spiral"])
def test_springs_find_the_same(name, monkeypatch):
    points, mesh = glued(name)
    forced = smooth_heights(points, mesh, 1.0)
    monkeypatch.setattr(plyfold.surface.contact, "_MOST_PLACES", 0)
    sprung = smooth_heights(points, mesh, 1.0)
    assert kept_apart(sprung, mesh, 1.0)
    assert sprung == pytest.approx(forced, abs=2e-3)
    energy = energy_matrix(points, mesh)
    assert sprung @ energy @ sprung == pytest.approx(forced @ energy @ forced, rel=1e-5)


class TestPins:
    def test_sheets_have_exactly_their_heights(self):
        for height in (0.1, -7.3, 0.0):
            surface = lift(RAMP, pins={1: height}, triangles=500)
            surface.check()
            assert (surface.vertices[surface.faces[surface.sheet == 1], 2] == height).all()

    def test_points(self):
        """The height of the surface at the point, in the middle of a triangle."""
        plain = lift(RAMP, triangles=500)
        place = plain.vertices[plain.faces[plain.sheet == 3][4]].mean(axis=0)
        surface = lift(RAMP, pins={(place[0], place[1]): 4.5}, triangles=500)
        assert surface.vertices[plain.faces[plain.sheet == 3][4], 2].mean() == pytest.approx(4.5, abs=1e-9)
        # One pin moves the surface as a whole.
        assert np.ptp(surface.vertices[:, 2] - plain.vertices[:, 2]) < 1e-3 * plain.gap

    def test_several_points_and_a_sheet(self):
        plain = lift(RAMP, triangles=500)
        faces = [plain.faces[plain.sheet == sheet][2] for sheet in (2, 4)]
        keys = [tuple(plain.vertices[face].mean(axis=0)[:2]) for face in faces]
        surface = lift(RAMP, pins={(*keys[0], 2): 3.0, (*keys[1], 4): -2.0, 0: 1.0}, triangles=500)
        surface.check()
        assert surface.vertices[faces[0], 2].mean() == pytest.approx(3.0, abs=1e-9)
        assert surface.vertices[faces[1], 2].mean() == pytest.approx(-2.0, abs=1e-9)
        assert (surface.vertices[surface.faces[surface.sheet == 0], 2] == 1).all()

    def test_exactly_one_gap(self):
        surface = lift(RAMP, pins={0: 0.1, 1: 0.1 + 0.2}, gap=0.2, triangles=500)
        surface.check()
        z = [surface.vertices[surface.faces[surface.sheet == sheet], 2] for sheet in (0, 1)]
        assert set(z[0].ravel()) == {0.1}
        assert set(z[1].ravel()) == {0.1 + 0.2}

    def test_the_surface_over_one_sheet(self):
        """A square with nothing over it can be pinned too."""
        surface = lift([(0, 0), (4, 0), (4, 3), (0, 3)], pins={0: 2.5})
        assert (surface.vertices[:, 2] == 2.5).all()
        tilted = lift([(0, 0), (4, 0), (4, 3), (0, 3)], pins={(0.5, 1.5): 0.0, (3.5, 1.5): 1.0})
        assert 0.5 < np.ptp(tilted.vertices[:, 2]) < 2.0

    @pytest.mark.parametrize(
        ("pins", "message"),
        [
            ({0: 0.0, 1: 0.1}, "closer than the gap"),
            ({0: 0.0, 2: 0.5}, "and a sheet that it meets at 0"),
            ({99: 0.0}, "no sheet 99"),
            ({-1: 0.0}, "no sheet -1"),
            ({0: float("nan")}, "height of the pin"),
            ({0: 1e9}, "height of the pin"),
            ({0: "high"}, "height of the pin"),
            ({(1e6, 0.0): 0.0}, "no sheet lies over"),
            ({(0.0,): 0.0}, "a pin is a sheet"),
            ({(float("nan"), 0.0): 0.0}, "a pin is a sheet"),
        ],
        ids=str,
    )
    def test_impossible(self, pins, message):
        with pytest.raises(InputError, match=message):
            lift(RAMP, pins=pins, triangles=200)

    def test_the_place_without_room_is_named(self):
        with pytest.raises(InputError) as error:
            lift(RAMP, pins={0: 0.0, 1: 0.1}, triangles=200)
        overlap = lift(RAMP, triangles=200)
        corners = overlap.vertices[overlap.faces[overlap.sheet == 0], :2].reshape(-1, 2)
        assert np.hypot(*(corners - error.value.where[0]).T).min() == 0

    def test_a_point_without_room(self):
        plain = lift(RAMP, triangles=200)
        x, y, _ = plain.vertices[plain.faces[plain.sheet == 1][3]].mean(axis=0)
        with pytest.raises(InputError, match="closer than the gap"):
            lift(RAMP, pins={0: 0.0, (x, y, 1): 0.9 * plain.gap}, triangles=200)
        with pytest.raises(InputError, match="sheets 0, 1 lie over"):
            lift(RAMP, pins={(x, y): 0.0}, triangles=200)
        with pytest.raises(InputError):
            lift(RAMP, pins={(x, y, 0): 0.0, (x, y, 1): 0.9 * plain.gap}, triangles=200)
        with pytest.raises(InputError, match="given by other pins"):
            lift(RAMP, pins={1: 0.0, (x, y, 1): 1.0}, triangles=200)


class TestFlat:
    def test_level_where_nothing_overlaps(self):
        """The free ends of the two-loop ribbon and the ways between loops change their heights less."""
        slopes = []
        for flat in (False, 10, True):
            surface = lift(CURVES["bennequin"].curve, flat=flat, triangles=1500)
            surface.check()
            winding = surface.layering.immersion.arrangement.winding[_cell_of_sheet(surface)]
            alone = winding[surface.sheet] == 1
            a, b, c = surface.vertices[surface.faces[alone]].swapaxes(0, 1)
            normal = np.cross(b - a, c - a)
            slopes.append((np.hypot(normal[:, 0], normal[:, 1])).sum() / normal[:, 2].sum())
        assert slopes[0] > 1.3 * slopes[1] > 1.3 * 1.3 * slopes[2]

    @pytest.mark.parametrize("option", [{"flat": 0}, {"flat": 0.5}, {"flat": float("nan")}, {"flat": 1e9}])
    def test_refused(self, option):
        with pytest.raises(InputError, match="how flat"):
            lift(RAMP, **option)


def _cell_of_sheet(surface):
    immersion = surface.layering.immersion
    return np.repeat(np.arange(len(immersion.sheets)), [len(sheets) for sheets in immersion.sheets])


@pytest.mark.parametrize("stiffness", [0, -1, float("nan"), 1e6])
def test_stiffness_out_of_reason(stiffness):
    with pytest.raises(InputError, match="stiffness"):
        lift(RAMP, stiffness=stiffness)


def test_stiffer_cloth_bends_less():
    """The mean square of the angle between neighbouring triangles falls."""
    bends = []
    for stiffness in (0.02, 0.5, 10.0):
        surface = lift(CURVES["milnor"].curve, stiffness=stiffness, triangles=1500)
        surface.check()
        z = surface.vertices[:, 2]
        bends.append(z @ energy_matrix(surface.vertices[:, :2], _as_mesh(surface), 1e3) @ z)
    assert bends == sorted(bends, reverse=True)


def _as_mesh(surface):
    n = np.arange(len(surface.vertices))
    none = np.empty((0, 2), dtype=int)
    ends = surface.boundary, surface.first_boundary, surface.cusps
    return LiftedMesh(n, surface.faces, surface.sheet, *ends, 0 * n, none, none)


def test_sheets_that_meet_themselves_cannot_be_level():
    """The loop of the ribbon is a single sheet, and both sides of a crossing belong to it. No other is."""
    plain = lift(RAMP, triangles=200)
    arranged = plain.layering.immersion.arrangement
    sheets = set(range(plain.layering.immersion.n_sheets))
    loop = max(sheets, key=lambda sheet: np.ptp(plain.vertices[plain.faces[plain.sheet == sheet], 2]))
    for sheet in sheets - {loop}:
        lift(RAMP, pins={sheet: 0.0}, triangles=200).check()
    with pytest.raises(InputError, match="over itself at a crossing") as error:
        lift(RAMP, pins={loop: 0.0}, triangles=200)
    assert np.hypot(*(arranged.crossings - error.value.where[0]).T).min() < 1e-12
