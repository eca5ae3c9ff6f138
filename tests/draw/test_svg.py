import re
from xml.etree import ElementTree

import numpy as np
import pytest
import shapely

from plyfold import Arrangement, arrange
from plyfold.colours import ACCENT
from plyfold.draw.svg import arrangement_svg

RAMP = np.array([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)], float)
EIGHT = np.array([(0, 0), (2, 2), (2, 0), (0, 2)], float)
SVG = "{http://www.w3.org/2000/svg}"


def parse(picture):
    return ElementTree.fromstring(picture)


def polygon(path):
    return shapely.Polygon([tuple(map(float, pair.split(","))) for pair in re.split("[MLZ]", path.get("d")) if pair])


def cells(picture):
    """Winding number and polygon of every filled cell, by its tooltip."""
    found = []
    for path in parse(picture).iter(f"{SVG}path"):
        title = path.find(f"{SVG}title")
        if title is not None:
            found.append((int(title.text.split()[-1]), polygon(path)))
    return found


def test_cells_have_the_areas_that_polygonize_finds():
    pieces = shapely.polygonize([shapely.unary_union(shapely.LinearRing(RAMP))]).geoms
    expected = sorted(piece.area for piece in pieces)
    scale = (400 - 2 * 16) / 9  # pixels per unit: the longer side is 9
    drawn = sorted(cell.area / scale**2 for _, cell in cells(arrangement_svg(arrange(RAMP))))
    assert drawn == pytest.approx(expected, rel=1e-3)


def test_picture_is_upright():
    ((_, triangle),) = cells(arrangement_svg(arrange([(0, 0), (4, 0), (2, 8)])))
    highest = min(triangle.exterior.coords, key=lambda point: point[1])
    assert highest[0] == pytest.approx(triangle.centroid.x, abs=0.1)  # the tip, at (2, 8)


@pytest.mark.parametrize("scale", [2.0**-27, 2.0**27])
@pytest.mark.parametrize("shift", [0.0, 1024.0])
def test_size_and_place_of_the_drawing_do_not_matter(scale, shift):
    assert arrangement_svg(arrange((RAMP + shift) * scale)) == arrangement_svg(arrange(RAMP))


def test_everything_lies_on_the_sheet():
    root = parse(arrangement_svg(arrange(RAMP)))
    width, height = float(root.get("width")), float(root.get("height"))
    for path in root.iter(f"{SVG}path"):
        x0, y0, x1, y1 = polygon(path).bounds
        assert min(x0, y0) > 0
        assert x1 < width
        assert y1 < height


def test_crossings_and_numbers():
    root = parse(arrangement_svg(arrange(RAMP)))
    assert len(list(root.iter(f"{SVG}circle"))) == 4
    assert sorted(text.text for text in root.iter(f"{SVG}text")) == ["0", "1", "1", "1", "2"]


def test_minus_sign_is_typeset():
    assert "−1" in arrangement_svg(arrange(EIGHT))


def test_gauss_code_becomes_a_chord_diagram():
    drawn = arrange(RAMP)
    root = parse(arrangement_svg(Arrangement.from_gauss(*drawn.gauss_code())))
    labels = [text.text for text in root.iter(f"{SVG}text")]
    assert [path.get("stroke") for path in root.iter(f"{SVG}path")].count(ACCENT) == 4
    assert labels == [f"{visit}{'+' if ccw else '−'}" for visit, ccw in enumerate(drawn.ccw)]


def test_gauss_code_of_a_circle_is_a_bare_ring():
    root = parse(arrangement_svg(Arrangement.from_gauss([], [], 1)))
    assert [element.tag for element in root] == [f"{SVG}circle", f"{SVG}path"]


def test_notebooks_show_it():
    assert arrange(RAMP)._repr_svg_() == arrangement_svg(arrange(RAMP))
