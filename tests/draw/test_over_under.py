"""Layered drawings, compared with lifted surfaces seen from above, and rendered by other programs."""

import re
import shutil
import subprocess
from itertools import islice
from xml.etree import ElementTree

import numpy as np
import pytest
import shapely
from PIL import Image

from coarse import CURVES
from plyfold import find_immersion, find_layering, immersions, layerings
from plyfold.draw.over_under import over_under
from plyfold.draw.over_under_files import over_under_svg, over_under_tex, over_under_tikz, save_over_under
from plyfold.draw.placement import label_circle
from plyfold.errors import InputError, PlyfoldError
from plyfold.layering.orders.intersections import least_intersecting_layering
from plyfold.surface.lift import lift
from reference import random_curves

SVG = "{http://www.w3.org/2000/svg}"
INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"
# The middle line of a band tied like an overhand knot: it crosses itself three times.
KNOT = [(-6, 0), (6, 0), (5, 5), (-3, -4), (2, -5), (-4, 6)]
LIFTABLE = {name: named.curve for name, named in CURVES.items() if named.embeddable}
RANDOM = {f"{kind} {seed}": (kind, seed) for kind in ("ribbon", "glued") for seed in range(6)}


def layered(name):
    return next(layering for immersion in immersions(CURVES[name].curve) if (layering := find_layering(immersion)))


def knotted_band(half_width=0.12):
    step = np.diff(np.array(KNOT, dtype=float), axis=0)
    normal = np.stack([-step[:, 1], step[:, 0]], axis=1) / np.hypot(*step.T)[:, None]
    before, after = np.concatenate([normal[:1], normal]), np.concatenate([normal, normal[-1:]])
    aside = half_width * (before + after) / (1 + (before * after).sum(axis=1))[:, None]
    return np.concatenate([KNOT - aside, (KNOT + aside)[::-1]])


def some_layerings(name):
    """Layerings of a gallery curve, the knotted band, or a random ribbon or glued disk."""
    if name in LIFTABLE:
        curve = LIFTABLE[name]
    elif name == "knotted band":
        curve = knotted_band()
    else:
        kind, seed = RANDOM[name]
        rng = np.random.default_rng(seed)
        curve = random_curves.ribbon_outline(rng, 30) if kind == "ribbon" else random_curves.glued_disk(rng, 8)
    for immersion in islice(immersions(curve), 2):
        yield from islice(layerings(immersion), 8 if name == "knotted band" else 3)


EVERY = pytest.mark.parametrize("name", [*LIFTABLE, "knotted band", *RANDOM])


def scale_of(layering):
    """Where the drawing's points are in over_under."""
    points = layering.immersion.arrangement.curve.points
    low, high = points.min(axis=0), points.max(axis=0)
    return lambda places: (places - (low + high) / 2) / (high - low).max()


def parity_of(rings, place):
    """How many rings go round a place, by another library."""
    return sum(shapely.Polygon(ring).buffer(0).contains(shapely.Point(place)) for ring in rings) % 2


@EVERY
@pytest.mark.parametrize("colours", ["cloth", "sheets"])
def test_pieces_cover_every_cell_once_on_each_level(name, colours):
    """At a point of each cell, the pieces there are those of its sheets, from the lowest to the highest."""
    for layering in some_layerings(name):
        immersion = layering.immersion
        drawn = over_under(layering, colours=colours)
        assert sorted(sheet for piece in drawn.pieces for sheet in piece.sheets) == list(range(immersion.n_sheets))
        to_picture = scale_of(layering)
        for cell in range(1, immersion.arrangement.n_cells):
            place = to_picture(np.array(immersion.arrangement.cell_point(cell)))
            here = [piece for piece in drawn.pieces if parity_of(piece.rings, place)]
            assert [piece.level for piece in here] == list(range(1, immersion.arrangement.winding[cell] + 1))
            sheets = sorted(immersion.sheets[cell], key=lambda sheet: layering.level[sheet])
            assert all(sheet in piece.sheets for sheet, piece in zip(sheets, here, strict=True))


@EVERY
def test_hidden_strands_are_those_below_the_lifted_surface(name):
    """A point of the boundary is hidden if and only if the lifted surface has a vertex above it."""
    for layering in some_layerings(name):
        surface = lift(layering, triangles=150)
        drawn = over_under(layering, hidden="dashed")
        lines = {hidden: _lines(drawn, hidden) for hidden in (False, True)}
        ends = [strand.points[[0, -1]] for strand in drawn.strands if not strand.hidden and not strand.closed]
        gaps = shapely.MultiPoint(np.concatenate(ends)) if ends else shapely.Point()
        at = shapely.points(scale_of(layering)(surface.vertices[:, :2]))
        compared = 0
        for vertex, hidden in _hidden_vertices(surface):
            if hidden or not gaps.distance(at[vertex]) < 0.05:  # they end a little before crossings
                compared += 1
                assert lines[hidden].distance(at[vertex]) < 1e-9
                assert not lines[not hidden].distance(at[vertex]) < 1e-12
        assert compared > 3


def _hidden_vertices(surface):
    """The vertices of the boundary that are no crossings, and whether there is a vertex above them."""
    places = [place.tobytes() for place in surface.vertices[:, :2] + 0.0]
    height = surface.vertices[:, 2].tolist()
    top = {}
    for place, z in zip(places, height, strict=True):
        top[place] = max(z, top.get(place, -np.inf))
    crossings = {crossing.tobytes() for crossing in surface.layering.immersion.arrangement.crossings + 0.0}
    for vertex in surface.boundary.tolist():
        if places[vertex] not in crossings:
            yield vertex, top[places[vertex]] > height[vertex]


def _lines(drawn, hidden):
    return shapely.MultiLineString(
        [[*strand.points, *strand.points[: int(strand.closed)]] for strand in drawn.strands if strand.hidden == hidden]
    )


def test_gaps_are_on_the_lower_strand_only():
    """At a crossing that is seen, the upper strand runs through, and the lower one ends two lines' widths before."""
    layering = layered("horseshoe")
    drawn = over_under(layering)
    lines = _lines(drawn, False)
    ends = shapely.MultiPoint(np.concatenate([strand.points[[0, -1]] for strand in drawn.strands]))
    for crossing in scale_of(layering)(layering.immersion.arrangement.crossings):
        assert lines.distance(shapely.Point(crossing)) < 1e-12
        assert 1.99 * drawn.stroke < ends.distance(shapely.Point(crossing)) < 8.01 * drawn.stroke


def test_a_disk_without_crossings_is_one_closed_strand():
    drawn = over_under(layered("circle"), hidden="dashed")
    assert len(drawn.pieces) == 1
    (strand,) = drawn.strands
    assert strand.closed
    assert not strand.hidden


def test_strips_that_lie_over_one_another_in_a_circle():
    """The knotted band can be over and under by turns, and then no order of its strips would do."""
    found = list(some_layerings("knotted band"))
    assert len(found) == 8
    by_turns = [layering for layering in found if layering.changes == 10]  # five along each side of the band
    assert len(by_turns) == 2
    for layering in by_turns:
        assert len(over_under(layering).strands) == 6  # both sides of the band are interrupted three times


def test_glued_sheets_of_a_level_are_one_piece():
    layering = layered("stacked-spiral")
    merged, single = (over_under(layering, colours=colours) for colours in ("cloth", "sheets"))
    assert len(merged.pieces) < len(single.pieces) == layering.immersion.n_sheets
    assert [len(layer) for layer in single.layers] == np.bincount(layering.level)[1:].tolist()


@pytest.mark.parametrize("options", [{"colours": "rainbow"}, {"hidden": "dotted"}])
def test_unknown_options(options):
    with pytest.raises(InputError, match="no option"):
        over_under(layered("horseshoe"), **options)


def test_only_layerings_of_drawings():
    layering = layered("horseshoe")
    with pytest.raises(InputError, match="over and under"):
        over_under(least_intersecting_layering(layering.immersion))
    arranged = layering.immersion.arrangement
    code = type(arranged).from_gauss(*arranged.gauss_code())
    with pytest.raises(PlyfoldError, match="Gauss code"):
        over_under(find_layering(find_immersion(code)))


# ---- SVG -----------------------------------------------------------------------------------------------------------


def test_svg_has_a_layer_for_each_level_and_a_group_for_each_piece():
    layering = layered("stacked-spiral")
    root = ElementTree.fromstring(over_under_svg(layering, colours="sheets", hidden="dashed"))
    layers = root.findall(f"{SVG}g")
    assert [layer.get(f"{INKSCAPE}groupmode") for layer in layers] == ["layer"] * 5
    labels = [layer.get(f"{INKSCAPE}label") for layer in layers]
    assert labels == ["layer 1", "layer 2", "layer 3", "hidden strands", "visible strands"]
    for level, layer in enumerate(layers[:3], start=1):
        sheets = [int(group.get(f"{INKSCAPE}label").removeprefix("sheet ")) for group in layer]
        assert sheets == np.flatnonzero(layering.level == level).tolist()
    ids = [group.get("id") for group in root.iter(f"{SVG}g")]
    assert len(set(ids)) == len(ids)
    assert all("stroke-dasharray" in layer.attrib for layer in layers[3:4])


def test_svg_is_the_same_wherever_the_drawing_is():
    points = CURVES["exit-ramp"].draw().round(6)
    pictures = {over_under_svg(find_layering(find_immersion(points * 2.0**n))) for n in (-30, 0, 30)}
    assert len(pictures) == 1


def top_colours(layering, colours):
    """Places in cells with room, in the picture with middle 0 and size 1, and the colours that are seen there."""
    drawn = over_under(layering, colours=colours)
    arranged = layering.immersion.arrangement
    for cell in range(1, arranged.n_cells):
        x, y, radius = label_circle(arranged, cell)
        if arranged.winding[cell] and radius > 0.02 * np.ptp(arranged.curve.points, axis=0).max():
            top = max(layering.immersion.sheets[cell], key=lambda sheet: layering.level[sheet])
            (colour,) = (piece.colour for piece in drawn.pieces if top in piece.sheets)
            yield scale_of(layering)(np.array([x, y])), colour


@pytest.mark.skipif(shutil.which("inkscape") is None, reason="Inkscape is not installed")
@pytest.mark.parametrize("name", ["stacked-spiral", "bennequin", "exit-ramp"])
@pytest.mark.parametrize("colours", ["layers", "sheets"])
def test_inkscape_fills_every_cell_with_its_top_sheet(name, colours, tmp_path):
    layering = layered(name)
    save_over_under(layering, tmp_path / "out.svg", colours=colours)
    command = ["inkscape", "--export-type=png", f"--export-filename={tmp_path / 'out.png'}", str(tmp_path / "out.svg")]
    subprocess.run(command, check=True, capture_output=True, timeout=120)
    picture = np.asarray(Image.open(tmp_path / "out.png").convert("RGB"))
    places = list(top_colours(layering, colours))
    assert len(places) >= 3
    for (x, y), colour in places:
        height, width, _ = picture.shape
        seen = picture[round(height / 2 - 800 * y), round(width / 2 + 800 * x)].tolist()
        assert seen == [int(colour[i : i + 2], 16) for i in (1, 3, 5)]


# ---- TikZ ----------------------------------------------------------------------------------------------------------


def test_tikz_has_the_same_paths_as_the_drawing():
    layering = layered("bennequin")
    drawn = over_under(layering, hidden="dashed")
    text = over_under_tikz(layering, hidden="dashed", size=10.0)
    commands = re.findall(r"\\(filldraw|draw)\[[^]]*\][^\n]*\n(.*?);", text, re.DOTALL)
    assert [kind for kind, _ in commands] == ["filldraw"] * len(drawn.pieces) + ["draw"] * len(drawn.strands)
    rings = [np.concatenate(piece.rings) for piece in drawn.pieces] + [strand.points for strand in drawn.strands]
    for (_, path), points in zip(commands, rings, strict=True):
        written = [tuple(map(float, pair)) for pair in re.findall(r"\(([-\d.]+),([-\d.]+)\)", path)]
        assert np.allclose(written, 10 * points, atol=1e-4)
    assert text.count("dash pattern") == sum(strand.hidden for strand in drawn.strands)


@pytest.mark.parametrize("size", [0.0, -1.0, np.nan, 1e4])
def test_tikz_refuses_sizes(size):
    with pytest.raises(InputError, match="size"):
        over_under_tikz(layered("horseshoe"), size=size)


def has_tex():
    if shutil.which("pdflatex") is None or shutil.which("kpsewhich") is None:
        return False
    found = subprocess.run(["kpsewhich", "standalone.cls", "tikz.sty"], check=False, capture_output=True, text=True)
    return len(found.stdout.splitlines()) == 2


@pytest.mark.skipif(not has_tex(), reason="pdflatex, TikZ or standalone is not installed")
@pytest.mark.parametrize("name", ["horseshoe", "bennequin"])
def test_tex_compiles(name, tmp_path):
    save_over_under(layered(name), tmp_path / "out.tex", hidden="dashed")
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "out.tex"]
    subprocess.run(command, check=True, capture_output=True, cwd=tmp_path, timeout=120)
    assert (tmp_path / "out.pdf").read_bytes().startswith(b"%PDF")


# ---- files ---------------------------------------------------------------------------------------------------------


def test_files(tmp_path):
    layering = layered("horseshoe")
    save_over_under(layering, tmp_path / "out.svg")
    save_over_under(layering, tmp_path / "out.tikz")
    assert (tmp_path / "out.svg").read_text() == over_under_svg(layering)
    assert (tmp_path / "out.tikz").read_text() in over_under_tex(layering)
    with pytest.raises(FileExistsError):
        save_over_under(layering, tmp_path / "out.svg")
    with pytest.raises(InputError, match="ending"):
        save_over_under(layering, tmp_path / "out.png")
