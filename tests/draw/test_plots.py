from collections import Counter
from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from matplotlib.colors import rgb_to_hsv, to_hex, to_rgb

from coarse import CURVES
from painted import painted
from plyfold import Arrangement, arrange, find_immersion, find_layering, lift
from plyfold.colours import INK, OBSTRUCTION, mix, sheet_colour, winding_colour
from plyfold.draw import plot_arrangement, plot_layers, plot_layout, plot_surface
from plyfold.errors import InputError, PlyfoldError
from plyfold.obstruction import Obstruction

RAMP = np.array([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)], float)
EIGHT = np.array([(0, 0), (2, 2), (2, 0), (0, 2)], float)


class Stub(SimpleNamespace):
    __eq__, __hash__ = object.__eq__, object.__hash__


def flat_surface(heights=(0.0, 0.0, 0.0, 0.0)):
    corners = np.column_stack([[(0, 0), (4, 0), (4, 3), (0, 3)], heights])
    faces = np.array([(0, 1, 2), (0, 2, 3)])
    layering = SimpleNamespace(immersion=SimpleNamespace(arrangement=SimpleNamespace(n_crossings=0)))
    return Stub(
        vertices=corners,
        faces=faces,
        boundary=np.arange(4),
        first_boundary=np.array([0, 4]),
        cusps=np.empty(0, dtype=int),
        intersections=(),
        layering=layering,
    )


def areas_by_colour(ax):
    areas = Counter()
    for patch in ax.patches:
        areas[to_hex(patch.get_facecolor())] += painted(patch).area
    return areas


def test_cells_are_filled_by_winding_number():
    areas = areas_by_colour(plot_arrangement(arrange(RAMP)))
    assert areas[winding_colour(2)] == pytest.approx(1 / 81)  # one unit square, drawn with 9 units as 1
    x, y = RAMP.T
    with_multiplicity = (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2
    assert areas[winding_colour(1)] == pytest.approx((with_multiplicity - 2) / 81)
    assert areas[winding_colour(0)] == 0


def test_winding_numbers_are_written_in_their_cells():
    ax = plot_arrangement(arrange(RAMP))
    drawn = arrange(RAMP)
    outlines = [shapely.Polygon((drawn.cell_outline(c) - (4.5, 1.5)) / 9) for c in range(drawn.n_cells)]
    assert len(ax.texts) == 5
    for text in ax.texts:
        (cell,) = [c for c in range(1, drawn.n_cells) if outlines[c].contains(shapely.Point(text.get_position()))]
        assert text.get_text() == str(drawn.winding[cell])


def test_crossings_are_dots():
    ax = plot_arrangement(arrange(EIGHT))
    assert ax.collections[0].get_offsets().tolist() == [[0.0, 0.0]]


def test_numbers_of_borders_keep_off_the_winding_numbers_of_small_loops():
    drawn = arrange(CURVES["smallest-unliftable"].curve)
    texts = plot_arrangement(drawn, borders=True).texts
    places = np.array([text.get_position() for text in texts])
    apart = np.hypot(*(places[:, None] - places).T) + 9.0 * np.eye(len(places))
    assert len(texts) == drawn.n_borders + int((drawn.winding[1:] != 0).sum())
    assert apart.min() > 0.03


def test_borders_are_numbered_on_request():
    ax = plot_arrangement(arrange(RAMP), borders=True)
    assert Counter(t.get_text() for t in ax.texts) >= Counter(str(i) for i in range(8))


def test_obstruction_is_a_red_cross_and_a_sentence():
    why = Obstruction("negative winding", "One cell is wound backwards.", where=((0.25, 1.0),))
    ax = plot_arrangement(arrange(EIGHT), obstruction=why)
    cross = ax.collections[-1]
    assert cross.get_offsets().tolist() == [[-0.375, 0.0]]
    assert to_hex(cross.get_edgecolor()[0]) == OBSTRUCTION
    assert "One cell is wound backwards." in [t.get_text() for t in ax.texts]


def test_obstruction_without_a_place_is_a_sentence():
    ax = plot_arrangement(arrange(EIGHT), obstruction=find_immersion(EIGHT))
    assert any("turn" in t.get_text() for t in ax.texts)


def test_code_without_a_drawing_is_refused():
    with pytest.raises(PlyfoldError, match="without a drawing"):
        plot_arrangement(Arrangement.from_gauss([1, 0], [True, False], outer=3))


def test_disk_layout_has_a_region_for_every_group_and_arcs_that_do_not_cross():
    immersion = find_immersion(RAMP)
    ax = plot_layout(immersion)
    assert len(ax.patches) == 1 + len(immersion.disk_layout())
    rim = [line for line in ax.lines if line.get_linewidth() == 5.0]
    arcs = [shapely.LineString(line.get_xydata()) for line in ax.lines if line.get_linewidth() != 5.0]
    assert len(rim) == immersion.arrangement.n_borders
    assert len(arcs) == sum(len(group.arcs) for group in immersion.disk_layout())
    assert not any(a.intersects(b) for i, a in enumerate(arcs) for b in arcs[:i])


def test_disk_layout_numbers_the_borders_counter_clockwise():
    places = [t.get_position() for t in plot_layout(find_immersion(RAMP)).texts]
    angles = np.unwrap([np.arctan2(y, x) for x, y in places])
    assert (np.diff(angles) > 0).all()
    assert angles[-1] - angles[0] < 2 * np.pi


def test_each_layer_shows_its_sheets():
    layering = find_layering(find_immersion(RAMP))
    ax = plot_layers(layering)
    shown = Counter(to_hex(patch.get_facecolor()) for patch in ax.patches)
    assert shown == Counter(mix(sheet_colour(s), "#ffffff", 0.25) for s in range(layering.immersion.n_sheets))
    assert [t.get_text() for t in ax.texts] == ["layer 1", "layer 2"]


def test_each_border_is_dark_in_exactly_one_layer():
    layering = find_layering(find_immersion(RAMP))
    dark = [line for line in plot_layers(layering).lines if line.get_color() == INK]
    assert len(dark) == layering.immersion.arrangement.n_borders


def test_surface_from_straight_above_is_the_drawing():
    ax = plot_surface(flat_surface(), view=(-90, 90), pixels=100)
    left, right, bottom, top = ax.images[0].get_extent()
    solid = (ax.images[0].get_array()[..., 3] == 1).mean() * (right - left) * (top - bottom)
    assert solid == pytest.approx(1 * 3 / 4, rel=0.03)
    outline = shapely.Polygon(np.concatenate([line.get_xydata() for line in ax.lines]))
    assert outline.bounds == pytest.approx((-0.5, -0.375, 0.5, 0.375))


def test_hidden_part_of_the_curve_is_faint():
    """A strip under a roof: two squares joined far outside are enough for the picture."""
    squares = [np.column_stack([[(0, 0), (4, 0), (4, 3), (0, 3)], np.full(4, z)]) for z in (0.0, 1.0)]
    surface = flat_surface()
    surface.vertices = np.concatenate([squares[0] * (0.5, 0.5, 1) + (1, 0.7, 0), squares[1]])
    surface.faces = np.concatenate([surface.faces, surface.faces + 4])
    (line,) = plot_surface(surface, view=(-90, 90), pixels=100).lines
    assert line.get_alpha() < 0.5
    surface.boundary = np.arange(4, 8)
    (line,) = plot_surface(surface, view=(-90, 90), pixels=100).lines
    assert line.get_alpha() is None


def test_intersections_are_red_lines():
    surface = flat_surface()
    surface.intersections = (surface.vertices[[0, 2]],)
    red = [line for line in plot_surface(surface, view=(-90, 90), pixels=100).lines if line.get_color() == OBSTRUCTION]
    ends = np.concatenate([line.get_xydata() for line in red])
    assert [ends.min(axis=0), ends.max(axis=0)] == [pytest.approx((-0.5, -0.375)), pytest.approx((0.5, 0.375))]


@pytest.mark.parametrize("scale", [1e-8, 1e8])
def test_size_of_the_drawing_does_not_matter(scale):
    small, plain = (plot_arrangement(arrange(RAMP * s)) for s in (scale, 1.0))
    for first, second in zip(small.patches, plain.patches, strict=True):
        assert first.get_path().vertices == pytest.approx(second.get_path().vertices)
    surface = flat_surface()
    surface.vertices = surface.vertices * scale
    images = [plot_surface(s, pixels=40).images[0].get_array() for s in (surface, flat_surface())]
    assert np.asarray(images[0]) == pytest.approx(np.asarray(images[1]), abs=1e-6)


def test_given_axes_are_used_and_pyplot_is_left_alone():
    from matplotlib import pyplot
    from matplotlib.figure import Figure

    ax = Figure().subplots()
    assert plot_arrangement(arrange(RAMP), ax) is ax
    assert plot_layout(find_immersion(RAMP), ax) is ax
    plot_arrangement(arrange(RAMP))
    assert pyplot.get_fignums() == []


def hues(image):
    """The hue of every opaque pixel, or -1 for greys."""
    colour, alpha = np.asarray(image)[..., :3], np.asarray(image)[..., 3]
    hue, saturation, _ = np.moveaxis(rgb_to_hsv(colour), -1, 0)
    return np.where((alpha == 1) & (saturation > 0.15), hue, -1)


def test_surface_from_above_has_the_colours_of_the_topmost_sheets():
    surface = lift(RAMP)
    ax = plot_surface(surface, view=(-90, 90), colours="sheets", pixels=300)
    image, (left, right, bottom, top) = ax.images[0].get_array(), ax.images[0].get_extent()
    seen = hues(image)
    layering, arrangement = surface.layering, surface.layering.immersion.arrangement
    for cell in range(1, arrangement.n_cells):
        if sheets := layering.immersion.sheets[cell]:
            topmost = max(sheets, key=lambda sheet: layering.level[sheet])
            x, y = (np.array(arrangement.cell_point(cell)) - (4.5, 1.5)) / 9
            row, column = (y - bottom) / (top - bottom) * len(image), (x - left) / (right - left) * len(image[0])
            expected = rgb_to_hsv(to_rgb(sheet_colour(topmost)))[0]
            assert seen[int(row), int(column)] == pytest.approx(expected, abs=0.02)


def test_layers_have_colours_too_and_others_are_refused():
    surface = lift(RAMP)
    image = plot_surface(surface, view=(-90, 90), colours="layers", pixels=60).images[0].get_array()
    assert (hues(image) >= 0).any()
    with pytest.raises(InputError, match="no colours 'rainbow'"):
        plot_surface(surface, colours="rainbow")
    with pytest.raises(InputError, match="no view 'below'"):
        plot_surface(surface, view="below")


@pytest.mark.parametrize(
    "option",
    [
        {"view": 5},
        {"view": (1,)},
        {"view": ("a", "b")},
        {"view": None},
        {"stretch": "x"},
        {"stretch": 0},
        {"pixels": None},
        {"pixels": 0},
    ],
)
def test_options_of_a_shaded_view_of_the_wrong_kind(option):
    with pytest.raises(InputError):
        plot_surface(lift(RAMP[:3]), **option)
