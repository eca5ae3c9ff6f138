"""Solids, judged by checkers and readers that know nothing of how they were made."""

import dataclasses

import numpy as np
import pytest
import trimesh

from coarse import CURVES
from plyfold import immersions, layerings
from plyfold.errors import InputError, PrecisionError
from plyfold.surface.lift import lift
from reference import random_curves
from reference.triangles import meeting_pairs

LIFTABLE = {name: named for name, named in CURVES.items() if named.embeddable}


def area(points):
    x, y = (np.asarray(points, dtype=np.float64) - points[0]).T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def assert_printable(solid, rounding=1e-9):
    """Proven by the checker; and another library finds it watertight, of the volume of the drawing times thickness."""
    solid.check()
    body = trimesh.Trimesh(solid.vertices - solid.vertices[0], solid.faces, process=False)
    assert body.is_watertight
    assert body.is_winding_consistent
    drawn = solid.surface.layering.immersion.arrangement.curve.points
    assert body.volume == pytest.approx(area(drawn) * solid.height, rel=rounding)


@pytest.mark.parametrize("named", LIFTABLE.values(), ids=LIFTABLE.keys())
def test_gallery(named):
    surface = lift(named.curve, triangles=200)
    assert_printable(surface.thicken(0.7 * surface.gap))


@pytest.mark.parametrize("name", ["exit-ramp", "stacked-spiral", "milnor"])
@pytest.mark.parametrize("share", [0.01, 0.99])
def test_no_triangles_meet(name, share):
    """By a generic test of all pairs of triangles, in fractions."""
    surface = lift(CURVES[name].curve, triangles=60)
    solid = surface.thicken(share * surface.gap)
    assert meeting_pairs(solid.vertices, solid.faces) == []


@pytest.mark.parametrize("name", ["exit-ramp", "milnor"])
def test_no_triangles_meet_in_an_stl(name, tmp_path):
    """Rounded to 32 bits, as printers read it."""
    surface = lift(CURVES[name].curve, triangles=60)
    surface.thicken(0.9 * surface.gap).export(tmp_path / "out.stl")
    body = trimesh.load(tmp_path / "out.stl")
    assert body.is_watertight
    assert meeting_pairs(body.vertices, body.faces) == []


@pytest.mark.parametrize("seed", range(4))
def test_random_ribbons(seed):
    outline = random_curves.ribbon_outline(np.random.default_rng(seed), 30)
    surface = lift(outline, triangles=200)
    assert_printable(surface.thicken(0.9 * surface.gap))


@pytest.mark.parametrize("seed", range(8))
def test_random_glued_disks(seed):
    """Sharp corners, thin cells, strands that all but touch."""
    outline = random_curves.glued_disk(np.random.default_rng(seed), 10)
    surface = lift(outline, triangles=100)
    solid = surface.thicken(0.5 * surface.gap)
    assert_printable(solid)
    if seed < 3:
        assert meeting_pairs(solid.vertices, solid.faces) == []


def test_every_layering():
    for immersion in immersions(CURVES["milnor"].curve):
        for layering in layerings(immersion):
            surface = lift(layering, triangles=60)
            assert_printable(surface.thicken(0.5 * surface.gap))


def test_far_from_the_origin():
    surface = lift(CURVES["exit-ramp"].draw() + np.array([1e6, -1e6]), triangles=200)
    assert_printable(surface.thicken(0.5 * surface.gap), rounding=1e-6)


@pytest.mark.parametrize("scale", [1e-100, 1e-8, 1e8, 1e90])
def test_scaled(scale):
    surface = lift(scale * CURVES["exit-ramp"].draw(), triangles=200)
    surface.thicken(0.5 * surface.gap).check()


def test_middle_and_sides():
    """The solid lies half above and half below the surface, and straight below and above it."""
    surface = lift(CURVES["horseshoe"].curve, triangles=100)
    solid = surface.thicken(0.25 * surface.gap)
    upper, lower = np.split(solid.vertices, 2)
    assert np.array_equal(upper[:, :2], surface.vertices[:, :2])
    assert np.array_equal(lower[:, :2], surface.vertices[:, :2])
    assert np.allclose((upper + lower) / 2, surface.vertices, rtol=1e-14)
    assert np.allclose(upper[:, 2] - lower[:, 2], solid.height)


def test_sheets_of_walls():
    """A wall belongs to the sheet of the triangle that it ends: they have two vertices in common."""
    surface = lift(CURVES["stacked-spiral"].curve, triangles=100)
    solid = surface.thicken(0.5 * surface.gap)
    m, n = len(surface.faces), len(surface.vertices)
    below = solid.faces % n
    for wall, sheet in zip(below[2 * m :].tolist(), solid.sheet[2 * m :].tolist(), strict=True):
        beside = [i for i, face in enumerate(surface.faces.tolist()) if len(set(wall) & set(face)) == 2]
        assert sheet in surface.sheet[beside].tolist()
        edge_of = [i for i in beside if _is_edge(sorted(set(wall)), surface.faces[i].tolist(), len(surface.boundary))]
        assert surface.sheet[edge_of].tolist() == [sheet]


def _is_edge(ends, face, boundary):
    """Whether a triangle has the boundary edge between two vertices that follow each other along the boundary."""
    sides = [(face[i], face[(i + 1) % 3]) for i in range(3)]
    return any(sorted(side) == ends and side[1] == (side[0] + 1) % boundary for side in sides)


def test_a_flat_disk_may_be_thick():
    surface = lift(CURVES["circle"].curve, triangles=50)
    assert_printable(surface.thicken(100 * surface.gap))


@pytest.mark.parametrize("thickness", [0.0, -1.0, np.nan, np.inf])
def test_thickness_must_be_positive(thickness):
    with pytest.raises(InputError, match="positive"):
        lift(CURVES["circle"].curve, triangles=20).thicken(thickness)


@pytest.mark.parametrize("share", [1.0, 1.5])
def test_thickness_must_be_less_than_the_gap(share):
    surface = lift(CURVES["horseshoe"].curve, triangles=50)
    with pytest.raises(InputError, match="apart") as caught:
        surface.thicken(share * surface.gap)
    assert "gap" in caught.value.hint


def test_what_rounding_takes_away_is_refused():
    """Far up, doubles are too coarse for what is left of the gap, or for the thickness."""
    surface = lift(CURVES["stacked-spiral"].curve, triangles=50)
    far_up = dataclasses.replace(surface, vertices=surface.vertices + np.array([0.0, 0.0, 1e12 * surface.gap]))
    for thickness in (surface.gap * (1 - 1e-9), 1e-9 * surface.gap):
        surface.thicken(thickness).check()
        with pytest.raises(PrecisionError) as caught:
            far_up.thicken(thickness)
        assert caught.value.where


def test_surfaces_that_pass_through_themselves_are_refused():
    surface = next(
        found
        for immersion in immersions(CURVES["bennequin"].curve)
        if len((found := lift(immersion, triangles=50, allow_intersections=True)).passing)
    )
    with pytest.raises(InputError, match="passes through itself") as caught:
        surface.thicken(0.1 * surface.gap)
    assert caught.value.where


def test_solid_cannot_be_changed():
    solid = lift(CURVES["circle"].curve, triangles=20).thicken(0.1)
    with pytest.raises(ValueError, match="read-only"):
        solid.vertices[0, 0] = 1.0


# ---- files ---------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def solid():
    surface = lift(CURVES["stacked-spiral"].curve, triangles=200)
    return surface.thicken(0.6 * surface.gap)


@pytest.mark.parametrize("colours", ["layers", "sheets"])
@pytest.mark.parametrize("suffix", [".obj", ".ply", ".stl", ".3mf"])
def test_files_are_read_back_watertight(solid, suffix, colours, tmp_path):
    solid.export(tmp_path / f"out{suffix}", colours=colours)
    body = trimesh.load(tmp_path / f"out{suffix}", force="mesh")
    body.merge_vertices(merge_tex=True, merge_norm=True)
    assert body.is_watertight
    assert len(body.faces) == len(solid.faces)
    drawn = solid.surface.layering.immersion.arrangement.curve.points
    assert body.volume == pytest.approx(area(drawn) * solid.height, rel=1e-4)


def test_no_film_of_a_solid(solid, tmp_path):
    with pytest.raises(InputError, match="gif"):
        solid.export(tmp_path / "out.gif")


def test_existing_files_stay(solid, tmp_path):
    (tmp_path / "out.stl").write_text("precious")
    with pytest.raises(FileExistsError):
        solid.export(tmp_path / "out.stl")
    solid.export(tmp_path / "out.stl", force=True)
    assert (tmp_path / "out.stl").stat().st_size > 1000


def test_3mf_is_a_solid_for_the_library_of_the_format(solid, tmp_path):
    """In strict mode and without a warning; where that library is installed."""
    lib3mf = pytest.importorskip("lib3mf")
    solid.export(tmp_path / "out.3mf", colours="sheets")
    model = lib3mf.get_wrapper().CreateModel()
    reader = model.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromFile(str(tmp_path / "out.3mf"))
    assert reader.GetWarningCount() == 0
    objects = model.GetMeshObjects()
    assert objects.MoveNext()
    body = objects.GetCurrentMeshObject()
    assert body.IsManifoldAndOriented()
    assert (body.GetVertexCount(), body.GetTriangleCount()) == (len(solid.vertices), len(solid.faces))
