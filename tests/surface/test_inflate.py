"""Round bodies, judged by the checker, by other libraries and by the shapes that are known."""

import json

import numpy as np
import pytest
import trimesh

import plyfold as pf
from coarse import CURVES
from nightly.solids import judge_body, judge_solids
from plyfold.cli.commands import main
from plyfold.errors import InputError
from plyfold.gallery import OUTLINES

LIFTABLE = {name: named for name, named in {**CURVES, **OUTLINES}.items() if named.embeddable}
SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4)]
STRIP = [(0, -1), (20, -1), (20, 1), (0, 1)]


def circle(n=100):
    angle = np.arange(n) * 2 * np.pi / n
    return np.column_stack([np.cos(angle), np.sin(angle)])


@pytest.mark.parametrize("named", LIFTABLE.values(), ids=LIFTABLE.keys())
def test_gallery(named):
    surface = pf.lift(named.outline, triangles=100)
    judge_body(surface.inflate(), None)


@pytest.mark.parametrize("seed", range(10))
def test_random_outlines(seed):
    """Ribbons, thin cells, loops, fronts with cusps and handles, outlines that touch themselves."""
    assert judge_solids(seed)


# ---- how thick -------------------------------------------------------------------------------------------------------


def middle_of_strip(body):
    """Places across the middle of the strip, far from its ends, and the thickness there."""
    x, y, _ = body.surface.vertices.T
    inner = (x > 6) & (x < 14)
    return y[inner], body.thickness[inner]


def off(thickness, wanted):
    """How far off the thickness is, as a root of the mean square, in parts of the largest."""
    return np.sqrt(np.mean((thickness - wanted) ** 2)) / wanted.max()


def test_the_cross_section_of_a_strip_is_an_ellipse():
    y, thickness = middle_of_strip(pf.lift(STRIP, triangles=3000).inflate(1.5))
    assert off(thickness, 1.5 * np.sqrt(1 - y**2)) < 0.01


def test_by_default_half_of_a_tube():
    assert pf.lift(STRIP, triangles=3000).inflate().height == pytest.approx(1.0, rel=0.02)


def test_a_disk_becomes_an_ellipsoid():
    body = pf.lift(circle(), triangles=3000).inflate(0.8)
    radius = np.hypot(*body.surface.vertices[:, :2].T)
    assert off(body.thickness, 0.8 * np.sqrt((1 - radius**2).clip(0))) < 0.01
    assert body.volume == pytest.approx(4 / 3 * np.pi * 0.4, rel=0.02)


def test_a_flat_body_has_a_plateau_and_half_a_circle_for_a_rim():
    y, thickness = middle_of_strip(pf.lift(STRIP, triangles=3000).inflate(0.6, "flat"))
    inward = np.minimum((1 - np.abs(y)) / 0.3, 1)
    assert off(thickness, 0.6 * np.sqrt(1 - (1 - inward) ** 2)) < 0.02


def test_a_function_gives_shares_of_the_height():
    surface = pf.lift(STRIP, triangles=3000)
    y, thickness = middle_of_strip(surface.inflate(1.5, np.square))
    assert off(thickness, 1.5 * (1 - y**2)) < 0.01


def test_overlaps_do_not_make_it_thinner():
    """The thickness belongs to the cloth: a ribbon over itself is as thick as a straight one."""
    body = pf.lift(CURVES["exit-ramp"].curve, triangles=400).inflate(3.0)
    assert body.height == pytest.approx(3.0)
    judge_body(body, 3.0)


@pytest.mark.parametrize("scale", [2.0**-27, 2.0**27])
def test_scaled(scale):
    points = np.array(CURVES["exit-ramp"].draw())
    bodies = [pf.lift(factor * points, triangles=100).inflate() for factor in (1.0, scale)]
    assert bodies[1].thickness == pytest.approx(scale * bodies[0].thickness, rel=1e-6)
    bodies[1].check()


def test_options_of_the_lift_are_kept():
    pinned = pf.lift(SQUARE, triangles=100, pins={(2.0, 2.0): 5.0}).inflate(0.5).surface
    assert np.median(pinned.vertices[:, 2]) == pytest.approx(5.0)
    assert pinned.making.triangles == 100


def test_a_single_triangle():
    body = pf.lift([(0, 0), (4, 0), (0, 3)], max_area=10.0).inflate(1.0)
    judge_body(body, 1.0)


@pytest.mark.parametrize("height", [0.0, -1.0, np.nan, np.inf, "thick", True])
def test_wrong_heights(height):
    with pytest.raises(InputError, match="height"):
        pf.lift(SQUARE, triangles=20).inflate(height)


@pytest.mark.parametrize(
    ("profile", "said"),
    [
        ("pointed", "profile"),
        (3, "profile"),
        (np.zeros_like, "more than 0"),
        (lambda bulge: 2 * bulge, "at most 1"),
        (lambda bulge: np.full_like(bulge, np.nan), "more than 0"),
        (lambda bulge: bulge[1:], "numbers"),
    ],
)
def test_wrong_profiles(profile, said):
    with pytest.raises(InputError, match=said):
        pf.lift(SQUARE, triangles=20).inflate(1.0, profile)


def test_surfaces_that_pass_through_themselves_are_refused():
    layering = pf.least_intersecting_layering(pf.find_immersion(CURVES["smallest-unliftable"].curve))
    surface = pf.lift(layering, triangles=50)
    with pytest.raises(InputError, match="passes through itself"):
        surface.inflate()


# ---- files -----------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def body():
    return pf.lift(CURVES["stacked-spiral"].curve, triangles=200).inflate()


@pytest.mark.parametrize("suffix", [".obj", ".ply", ".stl", ".3mf", ".glb"])
def test_files_are_read_back_watertight(body, suffix, tmp_path):
    body.export(tmp_path / f"out{suffix}")
    read = trimesh.load(tmp_path / f"out{suffix}", force="mesh")
    read.merge_vertices(merge_tex=True, merge_norm=True)
    assert read.is_watertight
    assert len(read.faces) == len(body.faces)
    assert read.volume == pytest.approx(body.volume, rel=1e-4)


def test_page(body, tmp_path):
    body.export(tmp_path / "body.html")
    assert "<title>body</title>" in (tmp_path / "body.html").read_text(encoding="utf-8")


def test_command(tmp_path, capsys):
    out = tmp_path / "out.stl"
    words = ["lift", "gallery:ring", "--triangles", "1500", "--inflate", "0.3", "--profile", "flat"]
    assert main([*words, "--json", "-o", str(out)]) == 0
    told = json.loads(capsys.readouterr().out)["solid"]
    assert told["height"] == pytest.approx(0.3)
    assert trimesh.load(out).volume == pytest.approx(told["volume"], rel=1e-4)
    assert main([*words, "-o", str(tmp_path / "out.glb")]) == 0
    assert "thinnest wall" in capsys.readouterr().out


@pytest.mark.parametrize(
    "words", [["--inflate", "--thicken", "0.1"], ["--profile", "flat"], ["--min-wall", "0.1"], ["--inflate", "-1"]]
)
def test_what_does_not_go_together_is_refused(words, tmp_path):
    assert main(["lift", "gallery:ring", "--triangles", "50", *words, "-o", str(tmp_path / "out.stl")]) == 2
