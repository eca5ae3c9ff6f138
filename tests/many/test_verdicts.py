"""Verdicts on many outlines are those of single calls."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import heaps
import plyfold as pf
from plyfold.arrangement.as_given import crossings_as_given, given_windings
from plyfold.errors import CurveError, InputError, PlyfoldError
from plyfold.many.verdicts import DEFAULT_COLUMNS, VERDICT_COLUMNS
from plyfold.report import touches_of


def single(outline):
    """The row of an outline, by calls that are there for one alone."""
    row = dict.fromkeys(
        name for column in VERDICT_COLUMNS for name in (("place_x", "place_y") if column == "place" else (column,))
    )
    try:
        if outline is None:
            raise CurveError("there is no outline in this row")
        if isinstance(outline, bytes | bytearray):
            outline = shapely.from_wkb(bytes(outline), on_invalid="ignore")
            if outline is None:
                raise CurveError("broken WKB")
        found = pf.find_immersion(outline)
        arranged = pf.arrange(outline)
    except PlyfoldError as error:
        place = dict(zip(("place_x", "place_y"), error.where[0], strict=False)) if error.where else {}
        return row | {"error": str(error).partition("\n")[0]} | place
    row |= {"crossings": crossings_as_given(arranged), "loops": arranged.n_loops, "turning": arranged.turning_number}
    row["immersions"] = pf.count_immersions(outline)
    embedding = pf.find_embedding(outline)
    row |= {"embeddable": bool(embedding), "levels": int(given_windings(arranged).max()) if embedding else None}
    mended = pf.repair(outline)
    row["repair"] = mended.region_change if mended else None
    if found:
        row["verdict"] = "disk" if pf.bounds_disk(outline) else "surface"
        row["verdict"] += " that touches itself" if touches_of(found) else ""
        strictly = pf.bounds_disk(outline, touching=False)
        assert strictly == (row["verdict"] == "disk")
    else:
        row |= {"verdict": "none", "reason": found.reason}
        if found.where:
            row["place_x"], row["place_y"] = found.where[0]
    return row


def agree(outlines):
    expected = list(map(single, outlines))
    assert [*pf.verdicts(outlines, VERDICT_COLUMNS).rows()] == expected
    assert [*pf.verdicts(outlines).rows()] == [{name: row[name] for name in DEFAULT_COLUMNS} for row in expected]


@pytest.mark.parametrize("what", [heaps.glyphs, heaps.strokes, heaps.buildings])
def test_drawn_outlines(what):
    agree([*what(12, 1)])


def test_others():
    agree(heaps.others(2))


def test_bad_outlines():
    outlines = heaps.bad(3)
    agree(outlines)
    assert all(pf.verdicts(outlines)["error"])


@settings(max_examples=25, deadline=None)
@given(st.lists(st.lists(st.tuples(*[st.integers(0, 6)] * 2), max_size=8), max_size=4))
def test_outlines_on_a_grid(outlines):
    """They touch in all ways, are too short, or run to and fro."""
    agree(outlines)


@settings(max_examples=15, deadline=None)
@given(st.integers(0, 2**32), st.integers(3, 14))
def test_random_curves(seed, n):
    agree([*np.random.default_rng(seed).random((3, n, 2))])


def test_every_way_to_give_them():
    pandas, pyarrow = pytest.importorskip("pandas"), pytest.importorskip("pyarrow")
    curves = np.random.default_rng(5).random((40, 9, 2))
    expected = [*pf.verdicts(curves).rows()]
    polygons = shapely.polygons(curves)
    column = pandas.Series(shapely.to_wkb(polygons))
    frame = type("Frame", (), {"geometry": pandas.Series(polygons)})()
    for given_so in (
        [*curves],
        curves.tolist(),
        iter(curves),
        (curves.reshape(-1, 2), np.arange(0, 361, 9)),
        polygons,
        frame,
        shapely.linearrings(curves),
        column,
        pyarrow.array(column),
        pyarrow.chunked_array([pyarrow.array(column)]),
    ):
        assert [*pf.verdicts(given_so).rows()] == expected


@pytest.mark.parametrize(
    ("wrong", "match"),
    [
        (42, "does not hold"),
        (b"abc", "does not hold"),
        ((np.zeros((4, 2)), np.array([0, 3])), "offsets are"),
        ((np.zeros((4, 2)), np.array([0, 4, 3, 4])), "do not fall"),
        ((np.zeros((4, 3)), np.array([0, 4])), "coordinates of shape"),
    ],
)
def test_what_is_not_many(wrong, match):
    with pytest.raises(InputError, match=match):
        pf.verdicts(wrong)


def test_columns():
    with pytest.raises(InputError, match="no column"):
        pf.verdicts([], ["crossing"])
    table = pf.verdicts([], ["turning", "place"])
    assert (len(table), list(table.columns)) == (0, ["turning", "place_x", "place_y"])
    assert list(pf.verdicts([[(0, 0), (1, 0), (0, 1)]], "turning").rows()) == [{"turning": 1}]


def test_missing_values_are_missing_everywhere():
    pandas, pyarrow = pytest.importorskip("pandas"), pytest.importorskip("pyarrow")
    table = pf.verdicts([[(0, 0), (1, 0), (0, 1)], []], VERDICT_COLUMNS)
    frame = table.to_pandas()
    assert frame["crossings"].isna().tolist() == [False, True]
    assert (str(frame["turning"].dtype), str(frame["embeddable"].dtype)) == ("Int64", "boolean")
    assert isinstance(frame, pandas.DataFrame)
    arrow = table.to_arrow()
    assert arrow.schema.field("crossings").type == pyarrow.int64()
    assert arrow.column("immersions").to_pylist() == ["1", None]
    assert arrow.to_pylist() == [row | {"immersions": row["immersions"] and "1"} for row in table.rows()]


def test_a_time_limit_leaves_it_unknown():
    """The outline of a surface that no numbers refuse."""
    ring = shapely.Polygon([(0, 0), (9, 0), (9, 9), (0, 9)], [[(1, 1), (1, 3), (3, 1)]])
    (row,) = pf.verdicts([ring], ["verdict", "immersions", "error"], time_limit=0.0).rows()
    assert row == {"verdict": "unknown", "immersions": None, "error": None}


def test_a_cluster_says_the_same():
    distributed = pytest.importorskip("distributed")
    curves = np.random.default_rng(7).random((5_100, 5, 2))
    options = {"n_workers": 2, "threads_per_worker": 1, "processes": False, "dashboard_address": None}
    with distributed.LocalCluster(**options) as cluster, distributed.Client(cluster) as client:
        found = pf.verdicts(curves, client=client)
        triangles = pf.triangulate_many(curves[:, :3], client=client)
    here, expected = pf.verdicts(curves), pf.triangulate_many(curves[:, :3])
    assert all(np.array_equal(found[name], here[name]) for name in here.columns)
    assert np.array_equal(triangles.values, expected.values)
    assert np.array_equal(triangles.first, expected.first)
