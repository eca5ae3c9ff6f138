"""What people give in place of a curve is refused in one sentence, and the hint names the call that takes it."""

from pathlib import Path

import numpy as np
import pytest
import shapely
from matplotlib.path import Path as Outline

import plyfold as pf
from plyfold.errors import CurveError, GaussCodeError, InputError, PlyfoldError
from plyfold.outline.given import as_curve

SQUARE = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
TREFOIL_PD = [[1, 4, 2, 5], [3, 6, 4, 1], [5, 2, 6, 3]]
TREFOIL = "1+ 2- 3+ 1- 2+ 3- / outer 1"


class GeoSeries:
    """What geopandas has: one word for each geometry."""

    geom_type = np.array(["Polygon", "Polygon"], dtype=object)
    is_empty = np.array([False, False])

    def __len__(self):
        return 2


SIGNED = "pf.GaussCode.parse"
PD = "pf.GaussCode.from_pd"
NONE_YET = "no call takes"
MISTAKES = {
    "a file name": ("examples/ramp.svg", "pf.read('examples/ramp.svg')"),
    "a path": (Path("examples/ramp.svg"), "pf.read"),
    "a name of the gallery": ("gallery:milnor", "pf.gallery.named_curve('milnor')"),
    "SVG": ('<svg><polygon points="0,0 4,0 0,3"/></svg>', "pf.read"),
    "well-known text": ("POLYGON ((0 0, 1 0, 1 1, 0 0))", "shapely.from_wkt"),
    "text of a Gauss code": (TREFOIL, SIGNED),
    "bytes": (b"0,0\n1,0\n1,1\n", "pf.read"),
    "a PD code": (TREFOIL_PD, PD),
    "a PD code as an array": (np.array(TREFOIL_PD), PD),
    "text of a PD code": ("PD[X[1, 4, 2, 5], X[3, 6, 4, 1], X[5, 2, 6, 3]]", PD),
    "text of a PD code, as SnapPy has it": ("[(1, 4, 2, 5), (3, 6, 4, 1), (5, 2, 6, 3)]", PD),
    "an unsigned Gauss code": ([1, 2, 3, 1, 2, 3], NONE_YET),
    "a knot's Gauss code": ([1, -2, 3, -1, 2, -3], NONE_YET),
    "text of an unsigned Gauss code": ("1 2 3 1 2 3", NONE_YET),
    "letters of an unsigned Gauss code": ("a, b, c, a, b, c", NONE_YET),
    "text of a knot's Gauss code": ("1,-2,3,-1,2,-3", NONE_YET),
    "over and under": ("O1U2O3U1O2U3", NONE_YET),
    "a GeoSeries": (GeoSeries(), ".iloc[0]"),
    "a generator": ((point for point in SQUARE), "list("),
    "a map": (map(tuple, SQUARE), "list("),
    "a zip": (zip([0, 1, 1, 0], [0, 0, 1, 1], strict=True), "list("),
    "a set": (set(SQUARE), "list"),
    "a dictionary": ({"x": [0, 1, 1], "y": [0, 0, 1]}, "numpy.column_stack"),
    "xs and ys": ([[0, 1, 1, 0], [0, 0, 1, 1]], "numpy.transpose"),
    "nothing": (None, "one x and one y"),
    "a number": (42, "one x and one y"),
}


SEVERAL = {
    "strokes": ([[(0, 0), (4, 0)], [(0, 3), (0, 0)], [(4, 0), (0, 3)]], "pf.Curve.from_strokes"),
    "curves": ([pf.Curve(SQUARE), pf.Curve(SQUARE)], "pf.find_embedding"),
    "geometries": ([shapely.box(0, 0, 1, 1), shapely.box(2, 0, 3, 1)], "pf.find_embedding"),
}


def well_said(error):
    """One sentence and one hint, joined as sentences are."""
    text = str(error)
    assert text.count("hint:") == text.count("\n  hint: ") == bool(error.hint)
    sentence = text.partition("\n  hint: ")[0]
    assert "\n" not in sentence
    for slip in (".,", "..", ",,", " ,", ". at", ".:", "numpy.ndarray", "dtype"):
        assert slip not in text
    return True


@pytest.mark.parametrize(("value", "call"), MISTAKES.values(), ids=MISTAKES)
def test_the_right_call_is_named(value, call):
    for use in (pf.arrange, pf.lift, pf.Curve):
        with pytest.raises(CurveError) as caught:
            use(value)
        assert call in str(caught.value)
        assert well_said(caught.value)
        assert len(str(caught.value)) < 300


@pytest.mark.parametrize(("value", "call"), SEVERAL.values(), ids=SEVERAL)
def test_several_are_no_single_curve(value, call):
    with pytest.raises(CurveError) as caught:
        pf.Curve(value)
    assert call in str(caught.value)
    assert well_said(caught.value)


def test_several_are_an_outline():
    """But strokes are none. Curves that overlap bound pieces that lie over each other."""
    with pytest.raises(PlyfoldError):
        pf.lift(SEVERAL["strokes"][0])
    assert len(pf.find_immersion(SEVERAL["curves"][0]).pieces) == 2
    assert len(pf.lift(SEVERAL["geometries"][0], triangles=50).outline.loops) == 2


@pytest.mark.parametrize("curves", [["examples/ramp.svg"], [SQUARE, "examples/ramp.svg"]])
def test_a_list_of_curves_may_hold_mistakes_too(curves):
    with pytest.raises(CurveError):
        pf.find_embedding(curves)


@pytest.mark.parametrize("strokes", ["examples/ramp.svg", Path("examples/ramp.svg"), Outline(SQUARE)])
def test_strokes_that_are_none(strokes):
    with pytest.raises(InputError) as caught:
        pf.Curve.from_strokes(strokes)
    assert "pf.read" in str(caught.value) or "pf.arrange" in str(caught.value)
    assert well_said(caught.value)


def test_the_calls_that_are_named_work():
    assert len(pf.Curve(list(iter(SQUARE)))) == 4
    assert len(pf.Curve(np.transpose([[0, 1, 1, 0], [0, 0, 1, 1]]))) == 4
    assert pf.arrange(pf.gallery.named_curve("milnor")).n_crossings == 6
    assert pf.arrange(pf.GaussCode.parse(TREFOIL)).n_crossings == 3
    assert len(as_curve(shapely.from_wkt("POLYGON ((0 0, 1 0, 1 1, 0 0))"))) == 3


@pytest.mark.parametrize(
    ("text", "call"),
    [
        ("1 2 3 1 2 3", NONE_YET),
        ("1,-2,3,-1,2,-3", NONE_YET),
        ("PD[X[1, 4, 2, 5], X[3, 6, 4, 1], X[5, 2, 6, 3]]", PD),
    ],
)
def test_codes_that_are_not_signed(text, call):
    with pytest.raises(GaussCodeError, match=call) as caught:
        pf.GaussCode.parse(text)
    assert well_said(caught.value)


@pytest.mark.parametrize(
    ("code", "call"), [([1, 2, 3, 1, 2, 3], NONE_YET), ([1, -2, 3, -1, 2, -3], NONE_YET), (TREFOIL_PD, PD)]
)
def test_lists_that_are_not_signed_codes(code, call):
    with pytest.raises(CurveError, match=call) as caught:
        pf.Curve(code)
    assert well_said(caught.value)


GPX = '<?xml version="1.0"?><gpx xmlns="http://www.topografix.com/GPX/1/1"><trk><trkseg/></trk></gpx>'
FILES = {
    "track.gpx": (GPX, "no track", "lat and lon"),
    "track.txt": (GPX, "no track", "lat and lon"),
    "track.svg": (GPX, "its root is <gpx>", "path"),
    "place.kml": ('<kml xmlns="http://www.opengis.net/kml/2.2"/>', "KML", "GeoJSON"),
    "pd.txt": ("PD[X[1,4,2,5],X[3,6,4,1],X[5,2,6,3]]", "PD code", PD),
    "pd.json": ("[[1,4,2,5],[3,6,4,1],[5,2,6,3]]", "PD code", PD),
    "gauss.txt": ("1 2 3 1 2 3", "Gauss code", NONE_YET),
    "knot.csv": ("1,-2,3,-1,2,-3\n", "Gauss code", NONE_YET),
    "gauss.json": ("[1, 2, 3, 1, 2, 3]", "Gauss code", NONE_YET),
    "code.txt": (TREFOIL, "Gauss code", SIGNED),
}


@pytest.mark.parametrize("name", FILES)
def test_files_of_other_kinds(name, tmp_path):
    content, kind, call = FILES[name]
    (tmp_path / name).write_text(content)
    with pytest.raises(InputError) as caught:
        pf.read(tmp_path / name)
    assert str(caught.value).startswith(f"{name}: ")
    assert kind in caught.value.message
    assert call in caught.value.hint
    assert well_said(caught.value)


@pytest.mark.parametrize(
    ("given", "call"),
    [
        (SQUARE, "pf.Curve"),
        (pf.Curve(SQUARE), "as it is"),
        (shapely.box(0, 0, 1, 1), "as it is"),
        ("gallery:milnor", "pf.gallery.named_curve('milnor')"),
    ],
)
def test_read_takes_a_path(given, call):
    with pytest.raises(InputError) as caught:
        pf.read(given)
    assert call in caught.value.hint
    assert well_said(caught.value)


def limits():
    """Calls that fail, one of each kind."""
    eight, limacon = [(0, 0), (2, 2), (2, 0), (0, 2)], pf.gallery.CURVES["limacon"].curve
    return {
        "turns 0 times": lambda: pf.lift(eight),
        "turns twice": lambda: pf.lift(limacon),
        "triangulate": lambda: pf.triangulate(eight),
        "unwrap": lambda: pf.unwrap(limacon),
        "no layering": lambda: pf.lift(pf.gallery.CURVES["seven-flaps"].curve),
        "touching": lambda: pf.arrange([(0, 0), (4, 0), (4, 4), (2, 0), (0, 4)], general_position="raise"),
        "not finite": lambda: pf.Curve([(0, 0), (1, np.nan), (1, 1)]),
        "huge": lambda: pf.Curve([(0, 0), (1, 1e200), (1, 1)]),
        "on a line": lambda: pf.Curve([(0, 0), (1, 1), (2, 2)]),
        "gap": lambda: pf.Curve.from_strokes([[(0, 0), (4, 0)], [(0, 3), (0, 2)]]),
        "no stroke": lambda: pf.Curve.from_strokes([]),
        "hole": lambda: pf.unwrap(shapely.box(0, 0, 9, 9).difference(shapely.box(1, 1, 2, 2))),
        "ending": lambda: pf.lift(SQUARE, triangles=50).export("out.xyz"),
        "time": lambda: pf.lift(pf.gallery.CURVES["milnor"].curve, time_limit=0),
        "pins": lambda: pf.lift(SQUARE, triangles=50, pins={(9, 9): 1.0}),
        "code": lambda: pf.GaussCode.parse("1+ 1+ / outer 1"),
        "name": lambda: pf.gallery.named_curve("milnr"),
        "file": lambda: pf.read("no-such-file.svg"),
        "list": lambda: pf.lift([eight, eight]),
    }


@pytest.mark.parametrize("name", limits())
def test_what_is_raised_is_well_said(name):
    with pytest.raises(PlyfoldError) as caught:
        limits()[name]()
    assert well_said(caught.value)
