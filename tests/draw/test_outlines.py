"""Pictures of outlines with several loops, holes and cusps."""

import re
from collections import Counter
from xml.etree import ElementTree

import numpy as np
import pytest
import shapely
from matplotlib.colors import to_hex

import plyfold as pf
from painted import painted
from plyfold import draw
from plyfold.colours import CUSP, winding_colour
from plyfold.draw.placement import arrows, label_circle

SVG = "{http://www.w3.org/2000/svg}"


def circle(x, y, radius, sense=1, points=60):
    angle = sense * 2 * np.pi * np.arange(points) / points + 0.013
    return np.stack([x + radius * np.cos(angle), y + radius * np.sin(angle)], axis=1)


def limacon(index=1):
    """Pascal's limaçon with a cusp at the tip of its inner loop."""
    angle = 2 * np.pi * np.arange(80) / 80
    return pf.Curve(((0.6 + np.cos(angle)) * [np.cos(angle), np.sin(angle)]).T, cusps={40: index})


RING = pf.Outline([circle(0, 0, 2), circle(0.3, 0, 1, sense=-1)])
TWO_RINGS = pf.Outline([*RING.loops, circle(2.6, 0.2, 2), circle(2.6, 0.2, 1.2, sense=-1)])
OUTLINES = {"ring": RING, "two rings": TWO_RINGS, "limaçon": limacon(), "nested": pf.Outline(RING.loops * 2)}
OUTLINES["nested"] = pf.Outline([*RING.loops, circle(0.3, 0, 0.7), circle(0.3, 0, 0.4, sense=-1)])
EVERY = pytest.mark.parametrize("outline", OUTLINES.values(), ids=OUTLINES.keys())


def rings_in_path(path):
    """The closed polygons of an SVG path."""
    pieces = (re.findall(r"(-?[\d.e-]+),(-?[\d.e-]+)", piece) for piece in path.get("d").split("Z") if piece)
    return [shapely.Polygon(np.array(piece, dtype=float)) for piece in pieces]


def covers(rings, x, y):
    """Whether a point lies in what rings enclose by the even-odd rule."""
    return sum(ring.contains(shapely.Point(x, y)) for ring in rings) % 2 == 1


def in_pixels(outline, svg):
    """The map from an outline to the pixels of its picture."""
    low, high = outline.points.min(axis=0), outline.points.max(axis=0)
    size = np.array([float(svg.get("width")), float(svg.get("height"))])
    scale = (400 - 32) / (high - low).max()
    return lambda places: (np.asarray(places) - (low + high) / 2) * scale * (1, -1) + size / 2


def shoelace(points):
    x, y = points.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


@EVERY
def test_every_cell_is_filled_but_for_what_lies_in_it(outline):
    arrangement = pf.arrange(outline)
    svg = ElementTree.fromstring(arrangement._repr_svg_())
    fills = {
        int(re.search(r"cell (\d+)", path[0].text)[1]): rings_in_path(path) for path in svg.iter(f"{SVG}path") if path
    }
    assert sorted(fills) == list(range(1, arrangement.n_cells))
    place = in_pixels(outline, svg)
    for cell in fills:
        x, y = place(arrangement.cell_point(cell))
        assert [other for other, rings in fills.items() if covers(rings, x, y)] == [cell]


@EVERY
def test_cells_have_the_areas_of_their_winding_numbers(outline):
    """What is filled, counted by winding numbers, is the signed area of all loops; and every cell is filled whole."""
    arrangement, shown = pf.arrange(outline), Counter()
    for patch in draw.plot_arrangement(outline).patches:
        shown[to_hex(patch.get_facecolor())] += painted(patch).area * np.ptp(outline.points, axis=0).max() ** 2
    signed = sum(shoelace(loop) for loop in outline.loops)
    windings = set(arrangement.winding.tolist())
    assert sum(winding * shown[winding_colour(winding)] for winding in windings) == pytest.approx(signed)


@EVERY
def test_labels_keep_out_of_holes(outline):
    arrangement = pf.arrange(outline)
    for cell in range(1, arrangement.n_cells):
        x, y, radius = label_circle(arrangement, cell)
        room = shapely.Point(x, y).buffer(0.99 * radius)
        for ring in arrangement.cell_outlines(cell):
            assert not shapely.LinearRing(ring).intersects(room)


@EVERY
def test_every_loop_has_an_arrow_in_its_direction(outline):
    places = arrows(pf.arrange(outline))
    for loop in outline.loops:
        line = shapely.LineString([*loop, loop[0]])
        here = [(place, ahead) for place, ahead in places if line.distance(shapely.Point(place)) < 1e-9]
        steps = [line.project(shapely.Point(p + 1e-3 * ahead)) - line.project(shapely.Point(p)) for p, ahead in here]
        assert steps
        assert steps == pytest.approx([1e-3] * len(steps))


@pytest.mark.parametrize("index", [1, 2])
def test_a_cusp_is_marked_with_its_index_alike_in_all_pictures(index):
    curve = limacon(index)
    arrangement = pf.arrange(curve)
    for picture in (curve._repr_svg_(), arrangement._repr_svg_()):
        svg = ElementTree.fromstring(picture)
        (sign,) = [group for group in svg.iter(f"{SVG}g") if group[0].text == f"cusp of index {index}"]
        disk, number = sign[1:]
        assert (disk.get("fill"), number.text) == (CUSP, str(index))
        place = in_pixels(curve, svg)(curve.points[40])
        assert (float(disk.get("cx")), float(disk.get("cy"))) == pytest.approx(place, abs=0.51)
    ax = draw.plot_arrangement(arrangement)
    (disks,) = [dots for dots in ax.collections if to_hex(dots.get_facecolor()) == CUSP]
    assert len(disks.get_offsets()) == 1
    assert ax.texts[0].get_text() == str(index)


def test_a_code_with_cusps_is_a_chord_diagram_with_the_same_signs():
    code = pf.Arrangement.from_gauss([1, 0], [True, False], outer=1, cusps={0: 2})
    svg = ElementTree.fromstring(code._repr_svg_())
    assert [group[0].text for group in svg.iter(f"{SVG}g")] == ["cusp of index 2"]
    assert [text.text for text in svg.findall(f"{SVG}text")] == ["0+", "1", "2−"]


def test_an_outline_without_crossings_of_its_loops_is_drawn_loop_by_loop():
    svg = ElementTree.fromstring(TWO_RINGS._repr_svg_())
    lines = [path for path in svg.iter(f"{SVG}path") if path.get("fill") == "none"]
    assert len(lines) == 4
