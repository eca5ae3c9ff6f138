"""In a notebook: pictures that are values show themselves, and values say in a line what they are."""

import pytest

import plyfold as pf
from coarse import CURVES, OUTLINES
from plyfold import draw

RAMP = CURVES["exit-ramp"].curve
EIGHT = [(0, 0), (2, 2), (2, 0), (0, 2)]

PICTURES = {
    "arrangement": lambda: draw.plot_arrangement(RAMP),
    "layout": lambda: draw.plot_layout(pf.find_immersion(RAMP)),
    "immersion": lambda: draw.plot_immersion(pf.find_immersion(RAMP)),
    "layers": lambda: draw.plot_layers(pf.find_embedding(RAMP)),
    "casing": lambda: draw.plot_casing(pf.find_embedding(RAMP)),
    "obstruction": lambda: draw.plot_obstruction(EIGHT),
    "surface": lambda: draw.plot_surface(pf.lift(RAMP, triangles=100), pixels=60),
    "overview": lambda: draw.overview(pf.find_immersion(RAMP)),
}

VALUES = {
    "curve": lambda: RAMP,
    "gallery": lambda: CURVES["bennequin"],
    "turning": lambda: pf.find_immersion(EIGHT),
    "negative": lambda: pf.find_immersion(CURVES["kinked-circle"].curve),
    "layering": lambda: next(filter(None, (_no_layering(i) for i in pf.immersions(CURVES["bennequin"].curve)))),
    "casing": lambda: pf.embed_cased(RAMP, [True, False, True, False]),
    "ring": lambda: pf.find_embedding(OUTLINES["ring"].outline).immersion,
    "loops": lambda: OUTLINES["letter-g"].outline,
    "layered loops": lambda: pf.find_embedding(OUTLINES["linked-rings"].outline),
    "outline of the gallery": lambda: OUTLINES["torus-front"],
    "disk": lambda: pf.unwrap(RAMP, triangles=200),
    "solid": lambda: pf.lift(RAMP, triangles=200).thicken(0.1),
    "word": lambda: pf.blank_word(CURVES["milnor"].curve),
}


def _no_layering(immersion):
    found = pf.find_layering(immersion)
    return None if found else [found]


def first(value):
    return value[0] if isinstance(value, list) else value


def shown(value):
    """What Jupyter takes: the first of these that is there and not None."""
    for kind in ("_repr_html_", "_repr_svg_", "_repr_png_"):
        picture = getattr(value, kind, lambda: None)()
        if picture is not None:
            return picture
    return None


@pytest.mark.parametrize("name", PICTURES)
def test_a_picture_shows_itself_as_the_last_line_of_a_cell(name):
    assert shown(PICTURES[name]()).startswith(b"\x89PNG")


@pytest.mark.parametrize("name", VALUES)
def test_values_are_short_in_words_and_have_a_picture(name):
    value = first(VALUES[name]())
    assert repr(value).startswith("<")
    assert len(repr(value)) < 160
    assert "\n" not in repr(value)
    picture = shown(value)
    assert picture.startswith(b"\x89PNG" if isinstance(picture, bytes) else "<")


def test_axes_of_ones_own_are_returned_as_they_are():
    from matplotlib.figure import Figure

    ax = Figure().subplots()
    assert draw.plot_arrangement(RAMP, ax) is ax


def test_figures_are_not_registered_with_pyplot():
    from matplotlib import pyplot

    before = pyplot.get_fignums()
    draw.plot_arrangement(RAMP)._repr_png_()
    assert pyplot.get_fignums() == before
