"""The round disk: one-to-one by exact signs written here, and what is carried over to it and back."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

import plyfold as pf
from coarse import CURVES
from plyfold.disk import round_map
from plyfold.disk.places import locate
from plyfold.disk.places import weights as weights_of
from plyfold.errors import CertificateError, InputError, NotImmersibleError, PlyfoldError, PrecisionError
from reference import random_curves

DISKS = {name: named.curve for name, named in CURVES.items() if named.immersions}


def positive(a, b, c):
    """Exactly: the triangle is counter-clockwise."""
    (ax, ay), (bx, by), (cx, cy) = ([Fraction(float(x)) for x in point] for point in (a, b, c))
    return (bx - ax) * (cy - ay) > (by - ay) * (cx - ax)


def area(outline):
    x, y = np.asarray(outline).T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def triangle_areas(points, faces):
    a, b, c = points[faces].swapaxes(0, 1)
    return ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2


def assert_one_to_one(unwound):
    """Positive triangles, a simple boundary on the circle, and areas that add up leave no room for a second sheet."""
    assert all(positive(*unwound.disk[face]) for face in unwound.faces)
    assert all(positive(*unwound.plane[face]) for face in unwound.faces)
    circle = unwound.disk[unwound.boundary]
    assert np.abs(np.hypot(*circle.T) - 1).max() < 4e-16
    assert triangle_areas(unwound.disk, unwound.faces).sum() == pytest.approx(area(circle), rel=1e-12)
    assert area(circle) <= np.pi
    unwound.check()


@pytest.mark.parametrize("curve", DISKS.values(), ids=DISKS.keys())
def test_gallery(curve):
    assert_one_to_one(pf.unwrap(curve, triangles=300))


@pytest.mark.parametrize("seed", range(8))
def test_random_disks(seed):
    """Sharp corners, thin cells, strands that all but touch; and long ribbons."""
    assert_one_to_one(pf.unwrap(random_curves.glued_disk(np.random.default_rng(seed), 12), triangles=200))
    assert_one_to_one(pf.unwrap(random_curves.ribbon_outline(np.random.default_rng(seed), 40), triangles=200))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(200))
def test_many_random_disks(seed):
    rng = np.random.default_rng(1000 + seed)
    pf.unwrap(random_curves.glued_disk(rng, 5 + seed % 40), triangles=(1, 500)[seed % 2]).check()
    pf.unwrap(random_curves.ribbon_outline(rng, 10 + seed), triangles=(1, 500)[seed % 2]).check()


@pytest.mark.parametrize("name", ["milnor", "bennequin", "seven-flaps"])
def test_every_immersion_liftable_or_not(name):
    for immersion in pf.immersions(CURVES[name].curve):
        assert_one_to_one(pf.unwrap(immersion, triangles=200))


def test_boundary_goes_by_arc_length():
    """Half of the outline of a 3 by 1 rectangle is half the circle; its corners are at 3/8, 4/8 and 7/8."""
    unwound = pf.unwrap([(0, 0), (3, 0), (3, 1), (0, 1)], triangles=100)
    corners = [np.flatnonzero((unwound.plane == corner).all(axis=1))[0] for corner in [(0, 0), (3, 0), (3, 1), (0, 1)]]
    angle = 2 * np.pi * np.array([0, 3 / 8, 4 / 8, 7 / 8])
    assert unwound.disk[corners] == pytest.approx(np.stack([np.cos(angle), np.sin(angle)], axis=1), abs=1e-12)


def test_a_regular_polygon_stays_as_it_is():
    """The map of a regular polygon to itself is the identity, and that is harmonic."""
    angle = 2 * np.pi * np.arange(60) / 60
    outline = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    unwound = pf.unwrap(outline, triangles=500)
    flat = ~np.isin(np.arange(len(unwound.disk)), unwound.boundary)
    assert flat.sum() > 50
    assert unwound.disk[flat] == pytest.approx(unwound.plane[flat], abs=2e-3)


@pytest.mark.parametrize("scale", [1e-8, 1e8, 1e-120, 1e120])
def test_scale_changes_nothing(scale):
    plain = pf.unwrap(DISKS["exit-ramp"], triangles=200)
    scaled = pf.unwrap(scale * DISKS["exit-ramp"].points, triangles=200)
    scaled.check()
    there = plain.to_plane(scaled.disk[scaled.boundary])
    assert there * scale == pytest.approx(scaled.plane[scaled.boundary], abs=1e-6 * scale * np.ptp(plain.plane))


def test_moved_and_turned():
    """A turn by a right angle and a shift leave the vertices' places in the disk alone."""
    points = np.asarray(random_curves.glued_disk(np.random.default_rng(3), 10), dtype=float)
    plain = pf.unwrap(points, triangles=1)
    moved = pf.unwrap(points @ np.array([[0, 1], [-1, 0]]) + [7000, -300], triangles=1)
    assert moved.disk[moved.boundary] == pytest.approx(plain.disk[plain.boundary], abs=1e-9)


def test_another_first_point_turns_the_disk():
    points = DISKS["exit-ramp"].points
    plain = pf.unwrap(points, triangles=1)
    shifted = pf.unwrap(np.roll(points, -5, axis=0), triangles=1)
    turn = complex(*plain.disk[np.flatnonzero((plain.plane == points[5]).all(axis=1))[0]])
    turned = (shifted.disk[:, 0] + 1j * shifted.disk[:, 1])[shifted.boundary] * turn
    other = plain.disk[plain.boundary]
    place = {tuple(xy): uv for xy, uv in zip(plain.plane[plain.boundary].tolist(), other, strict=True)}
    for xy, uv in zip(shifted.plane[shifted.boundary].tolist(), turned, strict=True):
        if xy in points.tolist():
            assert complex(*place[tuple(xy)]) == pytest.approx(uv, abs=1e-9)


def test_surface_and_its_disk_share_vertices():
    surface = pf.lift(DISKS["exit-ramp"], triangles=300)
    unwound = surface.unwrap()
    assert unwound is surface.unwrap()
    assert unwound is pf.unwrap(surface)
    assert unwound.faces is surface.faces
    assert (unwound.to_space(unwound.disk) == surface.vertices).all()
    assert (unwound.uv == (unwound.disk + 1) / 2).all()
    assert_one_to_one(unwound)


def test_back_and_forth():
    """From the disk to a sheet of the drawing and back."""
    unwound = pf.unwrap(DISKS["milnor"], triangles=400)
    rng = np.random.default_rng(0)
    wanted = np.sqrt(rng.random((500, 1))) * 0.999 * np.stack([np.cos(t := 7 * rng.random(500)), np.sin(t)], axis=1)
    sheets, plane = unwound.to_sheet(wanted), unwound.to_plane(wanted)
    assert len(np.unique(sheets)) > 3
    for sheet in np.unique(sheets):
        inside = sheets == sheet
        back = unwound.from_plane(plane[inside], int(sheet))
        assert back == pytest.approx(wanted[inside], abs=1e-7)


def test_vertices_go_where_they_came_from():
    unwound = pf.unwrap(DISKS["bennequin"], triangles=300)
    assert (unwound.to_plane(unwound.disk) == unwound.plane).all()


def test_located_triangles_hold_their_points():
    unwound = pf.unwrap(random_curves.glued_disk(np.random.default_rng(5), 12), triangles=300)
    points = np.random.default_rng(1).uniform(-0.7, 0.7, (300, 2))
    for point, face in zip(points, locate(points, unwound.disk, unwound.faces).face, strict=True):
        a, b, c = unwound.disk[unwound.faces[face]]
        assert not any(positive(q, p, point) for p, q in ((a, b), (b, c), (c, a)))


@pytest.mark.parametrize("points", [[(1.001, 0)], [(0, 0), (-0.8, -0.8)]])
def test_points_outside_the_disk(points):
    with pytest.raises(InputError, match="outside the unit disk") as caught:
        pf.unwrap(DISKS["circle"], triangles=50).to_plane(points)
    assert caught.value.where == (tuple(map(float, points[-1])),)


def test_points_between_circle_and_polygon_are_on_the_boundary():
    unwound = pf.unwrap([(0, 0), (4, 0), (0, 4)], triangles=1)
    angle = np.linspace(0, 2 * np.pi, 50)
    x, y = unwound.to_plane(np.stack([np.cos(angle), np.sin(angle)], axis=1)).T
    assert np.abs(np.min([x, y, 4 - x - y], axis=0)).max() < 1e-9


def test_points_not_below_the_sheet():
    unwound = pf.unwrap(DISKS["circle"], triangles=50)
    with pytest.raises(InputError, match="not below sheet 0"):
        unwound.from_plane([(100.0, 0.0)], 0)
    with pytest.raises(InputError, match="no sheet 1"):
        unwound.from_plane([(0.0, 0.0)], 1)


@pytest.mark.parametrize("name", ["exit-ramp", "milnor", "stacked-spiral"])
@pytest.mark.parametrize("shift", [0.0, 1e6])
def test_back_from_the_rim(name, shift):
    """Middles of the boundary's pieces, which rounding puts on either side of it, far from the origin too."""
    unwound = pf.unwrap(DISKS[name].points + shift)
    ends = unwound.disk[unwound.boundary]
    middles = (ends + np.roll(ends, -1, axis=0)) / 2
    plane, sheets = unwound.to_plane(middles), unwound.to_sheet(middles)
    assert len(middles) > 300
    for sheet in np.unique(sheets):
        back = unwound.from_plane(plane[sheets == sheet], int(sheet))
        assert back == pytest.approx(middles[sheets == sheet], abs=1e-14 + 1e-13 * shift)


@pytest.mark.parametrize("name", ["exit-ramp", "milnor", "bennequin"])
def test_back_from_anywhere(name):
    """None of 20,000 points is lost, and the drawing says where each of them was."""
    unwound = pf.unwrap(DISKS[name])
    rng = np.random.default_rng(0)
    wanted = np.sqrt(rng.random((20_000, 1))) * np.stack([np.cos(t := 7 * rng.random(20_000)), np.sin(t)], axis=1)
    plane, sheets = unwound.to_plane(wanted), unwound.to_sheet(wanted)
    for sheet in np.unique(sheets):
        back = unwound.from_plane(plane[sheets == sheet], int(sheet))
        assert unwound.to_plane(back) == pytest.approx(plane[sheets == sheet], abs=1e-12 * np.ptp(unwound.plane))


def test_points_that_are_missing():
    unwound = pf.unwrap([(0, 0), (2, 0), (2, 2), (0, 2)], triangles=50)
    points = np.array([(1.0, 1.0), (3.0, 1.0), (2.0, 1.0), (-1e-9, 1.0), (2 + 2.0**-50, 0.5)])
    with pytest.raises(InputError, match="2 of 5 points are not below sheet 0") as caught:
        unwound.from_plane(points, 0)
    assert caught.value.where == ((3.0, 1.0), (-1e-9, 1.0))
    found = unwound.from_plane(points, 0, missing="nan")
    assert np.isnan(found).all(axis=1).tolist() == [False, True, False, True, False]
    assert unwound.to_plane(found[[0, 2, 4]]) == pytest.approx(points[[0, 2, 4]])
    with pytest.raises(InputError, match="missing"):
        unwound.from_plane(points, 0, missing="none")


def test_weights_in_triangles_without_area():
    """Cross products of their sides are 0 in doubles; a point on the longest side lies between its ends."""
    corners = np.array([[(0, 0), (1, 0), (0.25, 1e-320)], [(3, 3), (0, 0), (1e-300, 2e-300)]])
    found = weights_of(np.array([(0.75, 0.0), (1.0, 1.0)]), corners)
    assert found == pytest.approx(np.array([(0.25, 0.75, 0), (1 / 3, 2 / 3, 0)]))


@pytest.mark.parametrize("name", ["exit-ramp", "milnor", "circle", "seven-flaps"])
def test_borders_are_those_of_the_drawing(name):
    unwound = pf.unwrap(DISKS[name], triangles=300)
    drawn = unwound.immersion.arrangement
    pieces = 0
    for number in range(drawn.n_borders):
        border, points = unwound.border(number), drawn.border_points(number)
        assert (unwound.plane[border[0]] == points[0]).all()
        ends = points[0] if drawn.n_crossings == 0 else points[-1]
        assert (unwound.plane[border[-1]] == ends).all()
        length = np.hypot(*np.diff(unwound.plane[border], axis=0).T).sum()
        closed = points if drawn.n_crossings else np.concatenate([points, points[:1]])
        assert length == pytest.approx(np.hypot(*np.diff(closed, axis=0).T).sum())
        pieces += len(border) - 1
    assert pieces == len(unwound.boundary)


def test_seams_part_the_disk_into_its_sheets():
    """As many regions as sheets, and each seam is a piece of a border of the drawing."""
    unwound = pf.unwrap(DISKS["exit-ramp"], triangles=300)
    seams = {tuple(sorted(pair)) for pair in unwound.seams.tolist()}
    part = list(range(len(unwound.faces)))

    def find(face):
        while part[face] != face:
            face = part[face]
        return face

    side_of = {}
    for number, face in enumerate(unwound.faces.tolist()):
        for pair in zip(face, face[1:] + face[:1], strict=True):
            side_of.setdefault(tuple(sorted(pair)), []).append(number)
    for pair, sides in side_of.items():
        if len(sides) == 2 and pair not in seams:
            part[find(sides[0])] = find(sides[1])
    assert len({find(face) for face in range(len(part))}) == unwound.immersion.n_sheets
    on_curve = {tuple(sorted(map(tuple, p))) for p in np.stack([unwound.plane[unwound.boundary],
                np.roll(unwound.plane[unwound.boundary], -1, axis=0)], axis=1).tolist()}  # fmt: skip
    assert all(tuple(sorted(map(tuple, unwound.plane[list(pair)].tolist()))) in on_curve for pair in seams)


def test_map_disk():
    points = DISKS["milnor"].points
    for immersion in pf.immersions(points):
        vertices, faces, uv = pf.map_disk(points, immersion, triangles=300)
        assert all(positive(*vertices[face]) and positive(*uv[face]) for face in faces)
        assert triangle_areas(vertices, faces).sum() == pytest.approx(area(points))
        assert np.hypot(*(uv - 0.5).T).max() <= 0.5 + 4e-16
    with pytest.raises(InputError, match="another curve"):
        pf.map_disk(DISKS["circle"], immersion)


def flat_triangles():
    """A square with two inner vertices, joined so badly that one cotangent weight is far below zero."""
    points = np.array([(0, 0), (10, 0), (10, 1), (0, 1), (5.0, 0.05), (5.0, 0.95)])
    faces = np.array([(0, 1, 4), (2, 3, 5), (0, 4, 3), (1, 2, 4), (4, 2, 5), (4, 5, 3)])
    return points, faces, np.arange(4)


def test_all_weights_give_maps_that_are_one_to_one(monkeypatch):
    points, faces, boundary = flat_triangles()
    for weights in ("mean_values", "equal"):
        chosen = getattr(round_map, f"_{weights}")
        monkeypatch.setattr(round_map, "cotangents", chosen)
        disk = round_map.round_map(points, faces, boundary)
        assert all(positive(*disk[face]) for face in faces)


def test_mean_values_reproduce_the_plane():
    """A vertex is the mean of its neighbours with these weights, as with cotangents: both are exact for linear maps."""
    points, faces, _ = flat_triangles()
    for weights in (round_map.cotangents, round_map._mean_values):
        total = np.zeros((len(points), 2))
        for face, row in zip(faces, weights(points[faces]), strict=True):
            for i in range(3):
                a, b = face[(i + 1) % 3], face[(i + 2) % 3]
                total[a] += row[i, 0] * (points[b] - points[a])
                total[b] += row[i, 1] * (points[a] - points[b])
        assert np.abs(total[4:]).max() < 1e-9


def test_other_weights_take_the_place_of_those_that_flip(monkeypatch):
    points, faces, boundary = flat_triangles()
    monkeypatch.setattr(round_map, "cotangents", lambda corners: -round_map._equal(corners) * np.arange(1, 4)[:, None])
    disk = round_map.round_map(points, faces, boundary)
    assert all(positive(*disk[face]) for face in faces)


def test_a_disk_that_cotangents_flip():
    """Found among random ones: two triangles are flipped by cotangents, none by mean values."""
    rng = np.random.default_rng(1028)
    assert_one_to_one(pf.unwrap(random_curves.glued_disk(rng, 33), triangles=1))


def test_what_doubles_cannot_hold_is_refused_with_the_place(monkeypatch):
    points, faces, boundary = flat_triangles()
    monkeypatch.setattr(round_map, "_weighted_means", lambda *_: np.zeros((2, 2)))
    with pytest.raises(PrecisionError) as caught:
        round_map.round_map(points, faces, boundary)
    assert caught.value.where


def test_pieces_of_any_length():
    """A vertex every 1e-9 at one corner: an ear of the disk is too flat for doubles at its true length."""
    corner = np.array([(0, 0), (1e-9, 0), (2e-9, 1e-10), (3e-9, 3e-10)])
    assert_one_to_one(pf.unwrap(np.concatenate([corner, [(1, 0.5), (1, 1), (0, 1)]]), triangles=100))


def helix(turns):
    """A ring that runs over itself and ends exactly above its beginning, up to rounding."""
    angle = np.linspace(0, 2 * np.pi * turns, 60 * turns)
    way = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return np.concatenate([(3 + 0.01 * angle)[:, None] * way, ((2 + 0.01 * angle)[:, None] * way)[::-1]])


def nearly_closed(gap):
    """A strip that comes back to itself at a distance of rounding errors."""
    return [(0, 0), (10, 0), (10, 10), (0, 10), (0, 5), (1, 5), (1, 9), (9, 9), (9, 1), (1.5, 1),
            (1.5, 5 + gap), (0.5, 5 + gap), (0.5, 2)]  # fmt: skip


@pytest.mark.parametrize("curve", [helix(2), helix(3), nearly_closed(1e-14)], ids=["2 turns", "3 turns", "strip"])
def test_strands_that_all_but_fall_together(curve):
    """Triangles as flat as rounding errors: in the disk they are counter-clockwise, as texture coordinates too."""
    unwound = pf.unwrap(curve)
    assert_one_to_one(unwound)
    assert all(positive(*unwound.uv[face]) for face in unwound.faces)


def test_a_helix_is_written_with_its_disk(tmp_path):
    surface = pf.lift(helix(2), triangles=500)
    surface.export(tmp_path / "helix.glb")
    assert b"TEXCOORD_0" in (tmp_path / "helix.glb").read_bytes()


@pytest.mark.parametrize("kind", ["cotangents", "_mean_values"])
def test_weights_of_flat_triangles_are_finite(kind):
    """Angles of half a turn but for a rounding error; mean values stay positive as well."""
    corners = np.array([[(0, 0), (1, 0), (0.5, 2.0**-1000)], [(0, 0), (1, 0), (1, 2.0**-60)]])
    found = getattr(round_map, kind)(corners)
    assert np.isfinite(found).all()
    assert kind == "cotangents" or (found > 0).all()


def test_a_disk_that_is_lost_is_refused_and_its_surface_written_without(monkeypatch, tmp_path):
    """Factors of a matrix with a pivot of 0 are an error of the library below, not of ours."""

    def singular(*_, **__):
        raise RuntimeError("Factor is exactly singular")

    surface = pf.lift(DISKS["exit-ramp"], triangles=200)
    monkeypatch.setattr("scipy.sparse.linalg.splu", singular)
    with pytest.raises(PrecisionError, match="round disk") as caught:
        surface.unwrap()
    assert len(caught.value.where) > 100
    surface.export(tmp_path / "ramp.glb")
    assert b"TEXCOORD_0" not in (tmp_path / "ramp.glb").read_bytes()


def test_checks_notice_a_spoiled_disk():
    unwound = pf.unwrap(DISKS["exit-ramp"], triangles=100)
    for spoil in (lambda disk: disk * [1, -1], lambda disk: disk * 0.5, lambda disk: -disk):
        object.__setattr__(unwound, "disk", spoil(unwound.disk))
        with pytest.raises(CertificateError):
            unwound.check()


def test_the_circle_is_met_to_the_last_place():
    """By fractions here: no vertex is further off than rounding can bring it, and no further is allowed."""
    unwound = pf.unwrap(DISKS["milnor"], triangles=300)
    squares = [sum(Fraction(x) ** 2 for x in point) for point in unwound.disk[unwound.boundary].tolist()]
    assert max(abs(square - 1) for square in squares) <= 3 * Fraction(2) ** -52
    for factor in (1 - 2.0**-50, 1 + 2.0**-50, 1e12):
        spoiled = replace(unwound, disk=unwound.disk * factor)
        with pytest.raises(CertificateError, match="once along the unit circle"):
            spoiled.check()


def test_once_round_is_in_order_and_once():
    angle = 2 * np.pi * np.arange(7) / 7
    points = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    heptagon = round_map.round_map(points, np.empty((0, 3), dtype=int), np.arange(7))
    assert round_map.runs_once_round(heptagon)
    for order in ("0213456", "0246135", "1234560", "0654321", "011"):
        assert not round_map.runs_once_round(heptagon[list(map(int, order))])


def test_all_vertices_are_in_the_disk():
    unwound = pf.unwrap(DISKS["milnor"], triangles=300)
    assert np.allclose(unwound.to_plane(unwound.disk), unwound.plane)


@pytest.mark.parametrize("options", [{"triangles": 0}, {"triangles": np.nan}, {"max_area": -1.0}, {"max_area": np.nan}])
def test_sizes_that_make_no_mesh(options):
    with pytest.raises(InputError):
        pf.unwrap(DISKS["circle"], **options)


def test_no_disk():
    with pytest.raises(NotImmersibleError):
        pf.unwrap(CURVES["limacon"].curve)
    arranged = pf.arrange(DISKS["circle"])
    code = type(arranged).from_gauss(arranged.partner, arranged.ccw, arranged.outer)
    with pytest.raises(PlyfoldError, match="Gauss code"):
        pf.unwrap(code)
    with pytest.raises(InputError, match="not been lifted"):
        pf.unwrap(DISKS["circle"], triangles=50).to_space([(0, 0)])


@pytest.mark.parametrize("name", ["exit-ramp", "milnor", "circle", "seven-flaps", "bennequin"])
def test_arcs_stay_in_their_sheets_and_end_on_their_borders(name):
    unwound = pf.unwrap(DISKS[name], triangles=300)
    groups = unwound.immersion.disk_layout()
    assert [arc.borders for arc in unwound.arcs] == [pair for group in groups for pair in group.arcs]
    for arc in unwound.arcs:
        assert (unwound.to_sheet(arc.points[1:-1]) == arc.sheet).all()
        for end, border in zip(arc.points[[0, -1]], arc.borders, strict=True):
            ends = unwound.disk[unwound.border(border)[[0, -1]]]
            start, stop, there = np.arctan2(*np.array([ends[0], ends[1], end]).T[::-1])
            whole = (stop - start) % (2 * np.pi) or 2 * np.pi
            assert 0 < (there - start) % (2 * np.pi) < whole
            assert np.hypot(*end) > 0.9
