"""Pictures of outlines with several loops, holes and cusps."""

import base64
import re
from collections import Counter
from xml.etree import ElementTree

import numpy as np
import pytest
import shapely
from matplotlib.colors import to_hex

import plyfold as pf
from coarse import OUTLINES as GALLERY
from painted import painted
from plyfold import draw
from plyfold.colours import CUSP, winding_colour
from plyfold.draw.figures import overview
from plyfold.draw.over_under import over_under
from plyfold.draw.over_under_files import over_under_svg, over_under_tikz
from plyfold.draw.placement import Frame, arrows, border_line, label_circle
from plyfold.draw.viewer import mesh_data, page
from plyfold.errors import InputError

SVG = "{http://www.w3.org/2000/svg}"


def circle(x, y, radius, sense=1, points=60):
    angle = sense * 2 * np.pi * np.arange(points) / points + 0.013
    return np.stack([x + radius * np.cos(angle), y + radius * np.sin(angle)], axis=1)


def limacon(index=1):
    """Pascal's limaçon with a cusp at the tip of its inner loop."""
    angle = 2 * np.pi * np.arange(80) / 80
    return pf.Curve(((0.6 + np.cos(angle)) * [np.cos(angle), np.sin(angle)]).T, cusps={40: index})


RING = pf.Outline([circle(0, 0, 2), circle(0.3, 0, 1, sense=-1)])
TWO_RINGS = pf.Outline([circle(x, y, r, s) for x, y in ((0, 0), (2.6, 0.2)) for r, s in ((2, 1), (1.4, -1))])
NESTED = pf.Outline([*RING.loops, circle(0.3, 0, 0.7), circle(0.3, 0, 0.4, sense=-1)])
# Of the torus's front, the foot of a bridge is at a cusp.
OUTLINES = {"ring": RING, "two rings": TWO_RINGS, "nested": NESTED, "limaçon": limacon()}
OUTLINES["front of a torus"] = GALLERY["torus-front"].outline
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
    titled = [path for path in svg.iter(f"{SVG}path") if len(path)]
    fills = {int(re.search(r"cell (\d+)", path[0].text)[1]): rings_in_path(path) for path in titled}
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


# ---- layered -------------------------------------------------------------------------------------------------------


def parity_of(rings, place):
    """How many rings go round a place."""
    return sum(shapely.Polygon(ring).buffer(0).contains(shapely.Point(place)) for ring in rings) % 2


@EVERY
@pytest.mark.parametrize("colours", ["cloth", "sheets"])
def test_pieces_cover_every_cell_once_on_each_level_and_no_hole(outline, colours):
    found = list(pf.embeddings(outline))
    assert found
    for layering in found:
        arrangement = layering.immersion.arrangement
        drawn = over_under(layering, colours=colours)
        frame = Frame(outline.points)
        for cell in range(1, arrangement.n_cells):
            (place,) = frame(arrangement.cell_point(cell))
            levels = [piece.level for piece in drawn.pieces if parity_of(piece.rings, place)]
            assert levels == list(range(1, arrangement.winding[cell] + 1))


@EVERY
def test_seen_strands_are_those_with_nothing_above_them(outline):
    """Of every point along the strands, cloth above it says whether it is hidden; all loops are drawn whole."""
    found = list(pf.embeddings(outline))
    assert found
    for layering in found:
        drawn = over_under(layering, hidden="dashed")
        length = sum(shapely.LinearRing(loop).length for loop in map(Frame(outline.points), outline.loops))
        shown = sum(
            (shapely.LinearRing if strand.closed else shapely.LineString)(strand.points).length
            for strand in drawn.strands
        )
        assert length - 8 * len(drawn.strands) * drawn.stroke <= shown <= length + 1e-9
        for strand in drawn.strands:
            assert strand.hidden == is_covered(layering, drawn, strand)


def is_covered(layering, drawn, strand):
    """Whether there is cloth over the middle of a strand, beside the cloth that ends there."""
    border = strand.points if not strand.closed else np.concatenate([strand.points, strand.points[:1]])
    number = len(border) // 2 - 1
    step = border[number + 1] - border[number]
    middle = border[number] + step / 2
    inside = middle + 1e-4 * np.array([-step[1], step[0]]) / np.hypot(*step)
    levels = {piece.level for piece in drawn.pieces if parity_of(piece.rings, inside)}
    borders = layering.immersion.arrangement
    near = [
        shapely.LineString(Frame(borders.outline.points)(border_line(borders, b))).distance(shapely.Point(middle))
        for b in range(borders.n_borders)
    ]
    own = int(layering.border_level[int(np.argmin(near))])
    return own < max(levels)


def test_rings_can_be_linked():
    """Two rings lie over one another in two places: where each is above in one, neither can be lifted off."""
    ends = [
        {
            number // 2
            for number, loop in enumerate(TWO_RINGS.loops)
            for strand in over_under(layering).strands
            if not strand.closed and shapely.LinearRing(loop).distance(shapely.Point(mid(layering, strand))) < 1e-9
        }
        for layering in pf.embeddings(TWO_RINGS)
    ]
    assert sorted(map(len, ends)) == [1, 1, 2, 2]


def mid(layering, strand):
    """The middle of the first edge of a strand, in the drawing."""
    points = layering.immersion.arrangement.outline.points
    low, high = points.min(axis=0), points.max(axis=0)
    return (strand.points[1] + strand.points[2]) / 2 * (high - low).max() + (low + high) / 2


@pytest.mark.parametrize("index", [1, 2])
def test_the_strands_at_a_cusp_are_on_levels_as_far_apart_as_its_index(index):
    found = list(pf.embeddings(wound_limacon(index)))
    assert len(found) == 2
    for layering in found:
        arrangement = layering.immersion.arrangement
        (cusp,) = np.flatnonzero(arrangement.cusp_index)
        ends = layering.border_level[[arrangement.border_before[cusp], arrangement.border_after[cusp]]]
        marked = [text.get_position()[1] for text in draw.plot_layers(layering).texts if text.get_text() == str(index)]
        assert len(marked) == 2 == len(set(marked))
        assert abs(ends[0] - ends[1]) == index
        svg = ElementTree.fromstring(over_under_svg(layering))
        (group,) = [group for group in svg.iter(f"{SVG}g") if group.get("id") == "cusps"]
        assert [sign[0].text for sign in group] == [f"cusp of index {index}"]
        assert rf"\textbf{{{index}}}" in over_under_tikz(layering)


def wound_limacon(index):
    """A spiral that winds once more than its cusp is large, closed by a crossing."""
    angle = 2 * np.pi * np.arange(40 * (index + 1)) / 40
    radius = 0.4 + angle / 10
    points = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    return pf.Curve(points, cusps={0: index})


@EVERY
def test_a_surface_has_its_loops_and_cusps_in_the_picture_and_on_the_page(outline):
    surface = pf.lift(outline, triangles=300)
    ax = draw.plot_surface(surface, view=(-90, 90), pixels=120)
    hits = [line.get_xydata() for line in ax.lines]
    frame = Frame(outline.points)
    for loop in map(frame, outline.loops):
        near = shapely.MultiLineString([hit for hit in hits if len(hit) > 1]).buffer(0.02)
        assert near.covers(shapely.MultiPoint(loop))
    signs = [text.get_text() for text in ax.texts]
    assert signs == [str(index) for index in np.concatenate(outline.cusps).tolist() if index]
    data = mesh_data(surface)
    cusps = np.frombuffer(base64.b64decode(data["cusps"]), "<u4")
    assert surface.boundary[cusps].tolist() == cusps.tolist()
    assert surface.vertices[cusps, :2].tolist() == outline.points[np.concatenate(outline.cusps) > 0].tolist()
    assert len(data["frames"]) == (10 if surface.layering.immersion.is_disk else 0)
    html = page(surface)
    assert all(f"<dt>{name}</dt>" in html for name in ("triangles", "layers"))


def test_an_obstruction_is_shown_on_all_loops():
    inside_out = pf.Outline([circle(0, 0, 2), circle(5, 0, 1, sense=-1)])
    why = pf.find_embedding(inside_out)
    assert not why
    assert why._repr_png_().startswith(b"\x89PNG")
    ax = draw.plot_obstruction(inside_out, why)
    assert sum(len(line.get_xydata()) == 61 for line in ax.lines) == 2


@EVERY
def test_every_border_is_numbered(outline):
    arrangement = pf.arrange(outline)
    shown = Counter(text.get_text() for text in draw.plot_arrangement(arrangement, borders=True).texts)
    assert all(shown[str(border)] for border in range(arrangement.n_borders))


def test_what_is_no_disk_has_no_disk_layout():
    ring = pf.find_embedding(RING).immersion
    with pytest.raises(InputError, match="disk"):
        draw.plot_layout(ring)
    titles = [ax.get_title() for ax in overview(ring).axes]
    assert titles == ["The outline, its winding numbers and borders", "The surface laid flat"]
