from xml.etree import ElementTree

import numpy as np
import pytest
import shapely
from matplotlib.colors import to_hex

import plyfold as pf
from coarse import CURVES
from painted import painted
from plyfold import draw
from plyfold.colours import INK, PAPER, mix, sheet_colour
from plyfold.draw.svg import layout_svg
from plyfold.errors import NotImmersibleError

SVG = "{http://www.w3.org/2000/svg}"
RAMP = np.array([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)], float)


def pale(sheet):
    return mix(sheet_colour(sheet), PAPER, 0.5)


def unit(points):
    """The drawing moved to the origin and scaled to size 1."""
    return (np.asarray(points) - (4.5, 1.5)) / 9


def test_sheets_over_a_cell_share_it_evenly_in_stripes():
    immersion = pf.find_immersion(RAMP)
    ax = draw.plot_immersion(immersion)
    (stripes,) = ax.collections
    (cell,) = np.flatnonzero(immersion.arrangement.winding == 2)
    outline = shapely.Polygon(unit(immersion.arrangement.cell_outline(cell)))
    drawn = shapely.union_all([shapely.Polygon(path.vertices) for path in stripes.get_paths()])
    assert drawn.intersection(outline).area == pytest.approx(outline.area / 2, rel=0.2)
    assert to_hex(stripes.get_facecolor()[0]) == pale(immersion.sheets[cell][1])
    clip = shapely.Polygon(stripes.get_clip_path().get_fully_transformed_path().vertices)
    shown = shapely.Polygon(ax.transData.transform(np.array(outline.exterior.coords)))
    assert clip.symmetric_difference(shown).area < 1e-6 * shown.area


def test_cells_with_one_sheet_have_its_colour():
    immersion = pf.find_immersion(RAMP)
    fills = {to_hex(patch.get_facecolor()): painted(patch) for patch in draw.plot_immersion(immersion).patches}
    for cell in np.flatnonzero(immersion.arrangement.winding == 1):
        outline = shapely.Polygon(unit(immersion.arrangement.cell_outline(cell)))
        assert fills[pale(immersion.sheets[cell][0])].symmetric_difference(outline).area < 1e-12


def test_bands_show_the_own_sheet_of_each_border_inside_its_cell():
    immersion = pf.find_immersion(RAMP)
    bands = [line for line in draw.plot_immersion(immersion).lines if line.get_color() != INK]
    assert [band.get_color() for band in bands] == [sheet_colour(sheet) for sheet in immersion.own_sheet]
    for border, band in enumerate(bands):
        assert band.get_xydata() == pytest.approx(unit(immersion.arrangement.border_points(border)))
        assert band.get_clip_path() is not None


def test_immersions_stand_side_by_side_with_their_layouts():
    ax = draw.plot_immersions(CURVES["bennequin"].curve, most=3)
    assert len(ax.child_axes) == 6
    assert [text.get_text() for text in ax.texts] == ["3 of 5 immersions"]
    assert len(draw.plot_immersions(CURVES["milnor"].curve).texts) == 0


def test_no_immersion_no_picture():
    with pytest.raises(NotImmersibleError, match="turns 0 times"):
        draw.plot_immersions(CURVES["figure-eight"].curve)
    with pytest.raises(NotImmersibleError):
        draw.plot_immersion(pf.find_immersion(CURVES["figure-eight"].curve))


def test_some_groups_of_a_layout_leave_the_other_borders_grey():
    immersion = pf.find_immersion(RAMP)
    (group,) = [group for group in immersion.disk_layout() if group.borders == (1, 5)]
    ax = draw.plot_layout(immersion, groups=[group])
    rim = [line.get_color() for line in ax.lines if line.get_linewidth() == 5.0]
    assert {border for border, colour in enumerate(rim) if colour == sheet_colour(group.sheet)} == {1, 5}
    assert len(set(rim)) == 2


def test_too_many_borders_are_said_to_have_no_numbers():
    immersion = pf.find_immersion(CURVES["seven-flaps"].curve)
    for ax in (draw.plot_layout(immersion), draw.plot_arrangement(immersion.arrangement, borders=True)):
        texts = [" ".join(text.get_text().split()) for text in ax.texts]
        assert any(text.startswith("316 borders") for text in texts)
        assert not {"100", "315"} & set(texts)


def test_deepest_graphs_come_first():
    immersion = next(pf.immersions(CURVES["bennequin"].curve))
    ax = draw.plot_collapsed_graphs(immersion, most=1)
    nodes = [text.get_text() for text in ax.child_axes[1].texts if text.get_fontsize() == 9.5]
    assert sorted(map(int, nodes)) == list(immersion.sheets[int(immersion.arrangement.winding.argmax())])
    assert [text.get_text() for text in ax.texts] == ["the 1 deepest of 10 cells"]


def test_notebooks_show_the_layout_in_the_colours_of_the_sheets():
    immersion = pf.find_immersion(RAMP)
    root = ElementTree.fromstring(immersion._repr_svg_())
    assert immersion._repr_svg_() == layout_svg(immersion)
    sheets = {group.find(f"{SVG}title").text: group for group in root.iter(f"{SVG}g")}
    assert len(sheets) == len(immersion.disk_layout())
    for group in immersion.disk_layout():
        paths = sheets[f"sheet {group.sheet} over cell {group.cell}"].findall(f"{SVG}path")
        rim = [path for path in paths if path.get("stroke") == sheet_colour(group.sheet)]
        assert len(rim) == len(group.borders)
    assert sorted(int(text.text) for text in root.iter(f"{SVG}text")) == list(range(8))


def test_layout_needs_no_drawing_and_layers_do():
    code = pf.arrange(RAMP).gauss_code()
    immersion = pf.find_immersion(pf.Arrangement.from_gauss(*code))
    assert immersion._repr_svg_().startswith("<svg")
    layering = pf.find_layering(immersion)
    assert layering._repr_svg_() is None
    assert "<svg" in pf.find_layering(pf.find_immersion(RAMP))._repr_svg_()


def test_all_names_are_there():
    assert all(callable(getattr(draw, name)) for name in draw.__all__)
    assert set(draw.__all__) <= set(dir(draw))
    with pytest.raises(AttributeError, match="plot_nothing"):
        getattr(draw, "plot_nothing")  # noqa: B009 - to ask for a name that is not there
