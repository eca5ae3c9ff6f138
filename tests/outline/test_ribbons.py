"""Ribbons by their definition: an immersed disk or ring that covers the neighbourhood of its line."""

import math
from fractions import Fraction

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import plyfold as pf
from plyfold.outline.ribbons.line import as_line
from plyfold.outline.ribbons.ribbon import Style, ribbon_of_line
from reference.crossings import winding_number
from reference.shor_van_wyk import triangulation

JOINS, CAPS = ("round", "mitre", "bevel"), ("flat", "round", "square")


def wandering(rng, n):
    """Steps of one length whose direction changes by chance; it crosses itself now and then."""
    angle = np.cumsum(rng.normal(0, 0.6, n))
    return np.cumsum(np.stack([np.cos(angle), np.sin(angle)], axis=1), axis=0)


def uneven(rng, n):
    """Segments of all lengths, many of them much shorter than any width."""
    angle = np.cumsum(rng.normal(0, 0.5, n))
    length = rng.exponential(1, n)
    return np.cumsum(length[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1), axis=0)


def on_a_grid(rng, n):
    """Corners on a small grid, where edges of the ribbon often touch each other; the next one is always elsewhere."""
    points = rng.integers(0, 5, (n, 2)).astype(float) * 3
    return points[np.append(True, (np.diff(points, axis=0) != 0).any(axis=1))]


def trembling(rng, n):
    """A figure eight by an unsteady hand."""
    t = np.linspace(0, 2 * np.pi, 2 * n, endpoint=False)
    return np.stack([9 * np.cos(t), 6 * np.sin(2 * t)], axis=1) + rng.normal(0, 0.1, (2 * n, 2))


KINDS = (wandering, uneven, on_a_grid, trembling)


@st.composite
def wide_lines(draw):
    """A line and its width, one number or one for each point."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    line = draw(st.sampled_from(KINDS))(rng, draw(st.integers(4, 14)))
    assume(len(np.unique(line, axis=0)) > 2)
    width = draw(st.floats(0.1, 2.5))
    return line, width * rng.uniform(0.6, 1, len(line)) if draw(st.booleans()) else width


def integers(points):
    """The same points in integers, exactly."""
    unit = max(Fraction(float(x)).denominator for x in np.ravel(points))
    return [(int(Fraction(float(x)) * unit), int(Fraction(float(y)) * unit)) for x, y in points]


def made(line, width, closed, join, cap):
    """The ribbon with its triangles, or None if a bend is too tight; then its place is on the line."""
    wide, error = as_line(line, width, closed), None
    try:
        return ribbon_of_line(wide, Style(join, cap, quad_segs=3))
    except pf.errors.InputError as refused:
        error = refused
    assert "too tight" in str(error)
    (place,) = error.where
    assert shapely.distance(shapely.LineString([*line, *line[: int(closed)]]), shapely.Point(place)) < 1e-9
    return None


def cut_open(ribbon):
    """The outline of a ring cut along one edge between its two loops."""
    outline, faces = ribbon.outline, ribbon.faces
    first, n = outline.first_point[1], len(outline)
    right, left = next((a, b) for face in faces.tolist() for a in face for b in face if a < first <= b)
    around = [*range(right, first), *range(right + 1), *range(left, n), *range(first, left + 1)]
    return outline.points[around]


@settings(deadline=None, max_examples=150)
@given(wide_lines(), st.sampled_from(JOINS), st.sampled_from(CAPS))
def test_a_ribbon_is_a_disk_by_the_slow_reference(line, join, cap):
    ribbon = made(*line, False, join, cap)
    if ribbon is not None:
        assert isinstance(ribbon.outline, pf.Curve)
        assert triangulation(integers(ribbon.outline.points)) is not None


@settings(deadline=None, max_examples=80)
@given(wide_lines(), st.sampled_from(JOINS))
def test_a_closed_ribbon_is_a_ring_by_the_slow_reference(line, join):
    ribbon = made(*line, True, join, "flat")
    if ribbon is not None:
        assert ribbon.outline.n_loops == 2
        assert triangulation(integers(cut_open(ribbon))) is not None


def within(line, width, rng, across):
    """A place beside the line, by how much of the way to the ribbon's side; and not at the end of a segment."""
    half = np.broadcast_to(np.asarray(width) / 2, len(line))
    k, share = int(rng.integers(len(line) - 1)), rng.uniform(0.02, 0.98)
    step = line[k + 1] - line[k]
    reach = across * ((1 - share) * half[k] + share * half[k + 1])
    return line[k] + share * step + reach * np.array([-step[1], step[0]]) / np.hypot(*step)


@pytest.mark.parametrize("kind", [wandering, trembling])
def test_a_ribbon_covers_its_line(kind):
    """Along lines without hairpins, also where inner corners do not fit between their neighbours."""
    judged = 0
    for seed in range(60):
        rng = np.random.default_rng(seed)
        line = kind(rng, 14)
        ribbon = made(line, 1.2, False, JOINS[seed % 3], CAPS[seed // 3 % 3]) if turns(line).max() < 2 else None
        judged += ribbon is not None
        for _ in range(8 if ribbon else 0):
            assert winding_number(ribbon.outline.points, within(line, 1.2, rng, 0)) >= 1
    assert judged > 20


def test_a_side_that_its_line_would_cross_is_refused():
    line = [(3, 12), (0, 12), (3, 6), (12, 0), (3, 3), (0, 6), (3, 6), (6, 0), (6, 6), (0, 0)]
    with pytest.raises(pf.errors.InputError, match=r"too tight .* at \(12, 0\)"):
        pf.ribbon(line, 2.375)
    with pytest.raises(pf.errors.InputError, match=r"too tight .* at \(5, 0\)"):
        pf.ribbon([(4, 4), (1, 4), (0, 6), (5, 0), (2, 4), (0, 0)], 2, "mitre")


@settings(deadline=None, max_examples=100)
@given(st.integers(0, 2**32 - 1), st.sampled_from(KINDS), st.sampled_from(JOINS), st.sampled_from(CAPS))
def test_a_ribbon_covers_the_neighbourhood_of_its_line_where_inner_corners_fit(seed, kind, join, cap):
    """And where no bend is sharper than a right angle: beyond the next segment nothing is left of a sharper one.

    Near its ends the caps may cut off what belongs to the segments after the first one.
    """
    rng = np.random.default_rng(seed)
    line = kind(rng, int(rng.integers(4, 15)))
    assume(len(line) > 1 and turns(line).max(initial=0) < math.pi / 2)
    width = min(0.99 * widest(line), 2.5)
    points = pf.ribbon(line, width, join, cap, closed=False).points
    for _ in range(8):
        place = within(line, width, rng, rng.uniform(-0.95, 0.95))
        at_an_end = np.hypot(*(line[[0, -1]] - place).T).min() < width / 2
        assert at_an_end or winding_number(points, place) >= 1


@settings(deadline=None, max_examples=60)
@given(wide_lines(), st.booleans(), st.sampled_from(JOINS), st.sampled_from(CAPS))
def test_turned_round_in_the_mirror_and_at_any_scale_it_is_the_same(line, closed, join, cap):
    points, width = line
    ribbon = made(points, width, closed, join, cap)
    mirrored = made(points * (1, -1), width, closed, join, cap)
    larger = made(points * 2.0**40, np.asarray(width) * 2.0**40, closed, join, cap)
    if ribbon is None:
        assert mirrored is None
        assert larger is None
    else:
        assert np.array_equal(larger.outline.points, ribbon.outline.points * 2.0**40)
        assert sorted((mirrored.outline.points * (1, -1)).tolist()) == sorted(ribbon.outline.points.tolist())


def turns(points):
    """By which angle a line turns at each point but the ends."""
    step = np.diff(points, axis=0)
    angle = np.diff(np.arctan2(step[:, 1], step[:, 0]))
    return np.abs((angle + np.pi) % (2 * np.pi) - np.pi)


def widest(line):
    """The width at which the first inner corner reaches its neighbours."""
    inset = np.concatenate([[0], np.tan(turns(line) / 2), [0]])
    return (2 * np.hypot(*np.diff(line, axis=0).T) / (inset[:-1] + inset[1:] + 1e-9)).min()


@settings(deadline=None, max_examples=100)
@given(st.integers(0, 2**32 - 1), st.sampled_from(KINDS), st.sampled_from(JOINS), st.sampled_from(CAPS))
def test_nothing_is_refused_where_inner_corners_fit_between_their_neighbours(seed, kind, join, cap):
    rng = np.random.default_rng(seed)
    line = kind(rng, int(rng.integers(3, 30)))
    assume(len(line) > 1 and turns(line).max(initial=0) < 3.1)
    pf.ribbon(line, 0.99 * widest(line), join, cap, closed=False)


@pytest.mark.parametrize("kind", [wandering, uneven, trembling])
def test_lines_with_short_segments_are_hardly_ever_refused(kind):
    """Bends below a right angle, but many of them within one width of the ribbon."""
    lines = [kind(np.random.default_rng(seed), 20) for seed in range(150)]
    gentle = [line for line in lines if turns(line).max() < np.pi / 2]
    refused = [line for line in gentle if made(line, 1.2, False, "round", "round") is None]
    assert len(gentle) > 20
    assert len(refused) <= 0.02 * len(gentle)


def signed_area(loops):
    return sum(float(loop[:, 0] @ np.roll(loop[:, 1], -1) - loop[:, 1] @ np.roll(loop[:, 0], -1)) / 2 for loop in loops)


def spiral(n=60):
    """It turns round three times and comes out again across its own turns."""
    t = np.linspace(0, 6 * np.pi, n)
    inward = np.stack([(4 + t) * np.cos(t), (4 + t) * np.sin(t)], axis=1)[::-1]
    return np.concatenate([inward, [(30.0, 1.0)]])


@pytest.mark.parametrize("closed", [False, True])
def test_the_area_is_length_times_width_where_bends_are_mitred(closed):
    line = np.array([(0.0, 0), (20, 0), (20, 12), (8, 12), (6, -9), (-5, -9)])
    ribbon = pf.ribbon(line, 1.5, "mitre", closed=closed, mitre_limit=9)
    ends = np.concatenate([line, line[:1]]) if closed else line
    length = np.hypot(*np.diff(ends, axis=0).T).sum()
    assert signed_area(ribbon.loops) == pytest.approx(1.5 * length)


def test_it_lies_over_itself_as_often_as_the_line_passes():
    ribbon = pf.ribbon(spiral(), 1)
    assert pf.arrange(ribbon).winding.max() == 2
    assert pf.count_immersions(ribbon) == 1
    assert pf.winding_at(pf.ribbon([(0, 0), (9, 0), (9, 9), (4, 9), (4, -9)], 2), [(4, 0)]).tolist() == [2]


def test_caps_and_joins_look_as_they_are_called():
    line = [(0, 0), (10, 0)]
    assert pf.ribbon(line, 2).points.tolist() == [[0, -1], [10, -1], [10, 1], [0, 1]]
    assert pf.ribbon(line, 2, cap_style="square").points.tolist() == [[-1, -1], [11, -1], [11, 1], [-1, 1]]
    round_ends = pf.ribbon(line, 2, cap_style="round", quad_segs=2)
    assert len(round_ends) == 10
    assert [-1.0, 0.0] in round_ends.points.tolist()
    corner = [(0, 0), (10, 0), (10, 10)]
    assert pf.ribbon(corner, 2, "mitre").points[1].tolist() == [11, -1]
    assert pf.ribbon(corner, 2, "bevel").points[1:3].tolist() == [[10, -1], [11, 0]]
    assert len(pf.ribbon(corner, 2, "round", quad_segs=5)) == 6 + 5
    assert len(pf.ribbon(corner, 2, "mitre", mitre_limit=1.4)) == len(pf.ribbon(corner, 2, "bevel"))


def test_the_width_changes_evenly_and_may_end_in_a_tip():
    wedge = pf.ribbon([(0, 0), (10, 0)], [0, 4])
    assert sorted(wedge.points.tolist()) == [[0, 0], [10, -2], [10, 2]]
    drop = pf.ribbon([(0, 0), (5, 0), (10, 0)], [0, 4, 0], cap_style="round")
    assert sorted(drop.points.tolist()) == [[0, 0], [5, -2], [5, 2], [10, 0]]
    with pytest.raises(pf.errors.InputError, match="0 wide, at"):
        pf.ribbon([(0, 0), (5, 0), (10, 0)], [1, 0, 1])


def test_corners_of_densely_drawn_lines_are_cut_off():
    corner = np.concatenate([np.linspace((0, 0), (10, 0), 101)[:-1], np.linspace((10, 0), (10, 10), 101)])
    ribbon = pf.ribbon(corner, 2, "mitre")
    inner = ribbon.points[np.hypot(*(ribbon.points - (9, 1)).T) < 1e-9]
    assert len(inner) == 1
    # No loop: it is simple, and has the area of two rectangles that share a corner.
    assert pf.arrange(ribbon).n_crossings == 0
    assert signed_area(ribbon.loops) == pytest.approx(2 * 20)


def test_closed_lines_may_be_given_in_three_ways():
    square = [(0, 0), (9, 0), (9, 9), (0, 9)]
    by_flag = pf.ribbon(square, 1, "mitre", closed=True)
    repeated = pf.ribbon([*square, square[0]], 1, "mitre")
    of_a_curve = pf.ribbon(pf.Curve(square), 1, "mitre")
    ring = pf.ribbon(shapely.LinearRing(square), 1, "mitre")
    loops = [loop.tolist() for loop in by_flag.loops]
    assert [[loop.tolist() for loop in outline.loops] for outline in (repeated, of_a_curve, ring)] == [loops] * 3
    assert sorted(loops[0]) == [[-0.5, -0.5], [-0.5, 9.5], [9.5, -0.5], [9.5, 9.5]]
    opened = pf.ribbon([*square, square[0]], 1, "mitre", closed=False)
    assert isinstance(opened, pf.Curve)
    assert pf.bounds_disk(opened)
    [piece] = pf.find_immersion(by_flag).pieces
    assert (piece.loops, piece.euler_characteristic) == ((0, 1), 0)


def test_bends_that_are_too_tight_are_named():
    for line, place in [
        ([(0, 0), (9, 0), (0, 0)], (9, 0)),
        ([(0, 0), (20, 0), (20, 1), (0, 1)], (20, 1)),
        ([(0, 0), (20, 0), (30, 5), (20, 0.5), (0, 1)], (30, 5)),
    ]:
        with pytest.raises(pf.errors.InputError, match="too tight for a ribbon 3 wide") as caught:
            pf.ribbon(line, 3)
        assert math.dist(*caught.value.where, place) < 1.1
    with pytest.raises(pf.errors.InputError, match="too tight"):
        pf.ribbon([(0, 0), (4, 0), (2, 3)], 6, closed=True)


def test_what_is_no_line_no_width_and_no_style_is_refused():
    line = [(0, 0), (9, 0), (9, 9)]
    for call, words in [
        (lambda: pf.ribbon([(0, 0)], 1), "only 1 different point"),
        (lambda: pf.ribbon([], 1), "no points"),
        (lambda: pf.ribbon([(0, 0), (0, 0)], 1), "needs at least 2"),
        (lambda: pf.ribbon([(0, 0), (1, 0)], 1, closed=True), "needs at least 3"),
        (lambda: pf.ribbon(line, -1), "-1 wide"),
        (lambda: pf.ribbon(line, math.nan), "nan wide"),
        (lambda: pf.ribbon(line, 1e300), r"1e\+300 wide is too wide"),
        (lambda: pf.ribbon(line, 1e-15), r"1e-15 wide is lost in rounding .* at \(9, 0\)"),
        (lambda: pf.ribbon(line, 1e-300), r"1e-300 wide is lost in rounding"),
        (lambda: pf.ribbon(line[:2], 0), "0 wide"),
        (lambda: pf.ribbon(line, [0, 0, 1]), "0 wide"),
        (lambda: pf.ribbon(line, [1, 2]), r"widths of shape \(2,\) for 3 points"),
        (lambda: pf.ribbon(line, "wide"), "a width is a number"),
        (lambda: pf.ribbon(line, 1, "miter"), "join_style is round, mitre or bevel"),
        (lambda: pf.ribbon(line, 1, cap_style="butt"), "cap_style is flat, round or square"),
        (lambda: pf.ribbon(line, 1, quad_segs=0), "quad_segs must be"),
        (lambda: pf.ribbon(line, 1, mitre_limit=0.5), "a mitre is at least as long"),
        (lambda: pf.ribbon(shapely.box(0, 0, 1, 1), 1), "a Polygon is not one line"),
        (lambda: pf.ribbon(pf.Outline([line, np.add(line, 20)]), 1), "2 loops"),
        (lambda: pf.ribbon([(0, 0, 0), (1, 1, math.nan)], 1), "height of point 1 is not finite"),
    ]:
        with pytest.raises(pf.errors.InputError, match=words):
            call()


def test_repeated_points_are_dropped_and_reported():
    ribbon = pf.ribbon([(0, 0), (0, 0), (9, 0), (9, 0), (9, 5)], [2, 7, 2, 7, 2], "mitre")
    assert [str(repair) for repair in ribbon.repairs] == [
        "repeated point dropped at (0, 0)",
        "repeated point dropped at (9, 0)",
    ]
    assert ribbon.points.tolist() == pf.ribbon([(0, 0), (9, 0), (9, 5)], 2, "mitre").points.tolist()
