"""Named curves and outlines with known answers, for the tests, the pictures, and anyone who wants one to begin with.

>>> from plyfold import gallery
>>> ramp = gallery.CURVES["exit-ramp"]
>>> len(ramp.curve), ramp.crossings, ramp.immersions
(482, 4, 1)
>>> gallery.OUTLINES["linked-rings"].outline
<Outline of 4 loops, 800 points>
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Self

import numpy as np
import numpy.typing as npt

from plyfold.errors import InputError
from plyfold.outline.curve import Curve, Outline
from plyfold.outline.given import as_curve, as_outline
from plyfold.wording import counted

__all__ = ["CURVES", "OUTLINES", "NamedCurve", "NamedOutline", "band", "chain", "named_curve", "ribbon", "rounded"]

Points = npt.NDArray[np.float64]

POINTS_A_TURN = 200


@dataclass(frozen=True, eq=False)
class NamedOutline:
    """An outline with its known answers.

    Parameters
    ----------
    name, title : str
        A short name for the command line, and what the outline shows.
    sample : callable
        Returns the outline, or the points of a curve, for a number of points on a full turn; polygons have their
        corners.
    crossings : int
        Number of crossings, k.
    turning_number : int
        Of all loops together, after orienting a curve so that it is not negative.
    immersions : int
        In how many ways it bounds an immersed surface; of a curve that turns once, an immersed disk.
    embeddable : int
        How many of these can be layered.

    Examples
    --------
    >>> OUTLINES["ring"]
    <NamedOutline ring: 0 crossings, 1 immersion>
    >>> OUTLINES["ring"].outline.n_loops
    2
    """

    name: str
    title: str
    sample: Callable[[int], Outline | Points]
    crossings: int
    turning_number: int
    immersions: int
    embeddable: int

    def __repr__(self) -> str:
        crossings, immersions = counted(self.crossings, "crossing"), counted(self.immersions, "immersion")
        return f"<{type(self).__name__} {self.name}: {crossings}, {immersions}>"

    def _repr_svg_(self) -> str:
        from plyfold.arrangement.arrangement import arrange

        return arrange(self.outline)._repr_svg_()

    @cached_property
    def outline(self) -> Outline:
        """The outline itself, so fine that it looks smooth."""
        return as_outline(self.sample(POINTS_A_TURN))

    def coarse(self, a_turn: int = 40) -> Self:
        """Return the same with fewer points, for what takes long with many.

        Examples
        --------
        >>> len(CURVES["circle"].curve), len(CURVES["circle"].coarse().curve)
        (200, 40)
        """
        return replace(self, sample=lambda _: self.sample(a_turn))


@dataclass(frozen=True, eq=False, repr=False)
class NamedCurve(NamedOutline):
    """A curve with its known answers: an outline with one loop and without cusps.

    Parameters
    ----------
    name, title, sample, crossings, turning_number, immersions, embeddable
        As for :class:`NamedOutline`.

    Examples
    --------
    >>> CURVES["milnor"]
    <NamedCurve milnor: 6 crossings, 2 immersions>
    """

    @property
    def curve(self) -> Curve:
        """The curve itself, so fine that it looks smooth."""
        return as_curve(self.outline)

    def draw(self, a_turn: int = POINTS_A_TURN) -> Points:
        """Return the points, with so many on a full turn; polygons have their corners."""
        return as_curve(self.sample(a_turn)).points


def ribbon(centre: npt.ArrayLike, width: float) -> Points:
    """Return the outline of a ribbon: along its right side, and back along its left side.

    Parameters
    ----------
    centre : array_like, shape (m, 2)
        Centre line; it must bend more gently than half the width.
    width : float

    Returns
    -------
    ndarray, shape (2 m, 2)
        However often the centre line crosses itself, the outline bounds an immersed disk: the ribbon.

    Examples
    --------
    >>> ribbon([(0, 0), (4, 0)], width=2).tolist()
    [[0.0, -1.0], [4.0, -1.0], [4.0, 1.0], [0.0, 1.0]]
    """
    line = np.asarray(centre, dtype=np.float64)
    side = width / 2 * _left_of(np.gradient(line, axis=0))
    return np.concatenate([line - side, (line + side)[::-1]])


def band(centre: npt.ArrayLike, width: float) -> tuple[Points, Points]:
    """Return the outline of a closed ribbon: its right side, and its left side backward.

    Parameters
    ----------
    centre : array_like, shape (m, 2)
        Closed centre line; it must bend more gently than half the width.
    width : float

    Returns
    -------
    pair of ndarray, shape (m, 2)
        However often the centre line crosses itself, they bound an immersed ring.

    Examples
    --------
    >>> right, left = band([(2, 0), (0, 2), (-2, 0), (0, -2)], width=2)
    >>> right.tolist(), left.tolist()
    ([[3.0, 0.0], [0.0, 3.0], [-3.0, 0.0], [0.0, -3.0]], [[0.0, -1.0], [-1.0, 0.0], [0.0, 1.0], [1.0, 0.0]])
    """
    line = np.asarray(centre, dtype=np.float64)
    side = width / 2 * _left_of(np.roll(line, -1, axis=0) - np.roll(line, 1, axis=0))
    return line - side, (line + side)[::-1]


def _left_of(along: Points) -> Points:
    """Return unit vectors to the left of some directions."""
    return np.asarray(np.stack([-along[:, 1], along[:, 0]], axis=1) / np.hypot(*along.T)[:, None])


def rounded(corners: npt.ArrayLike, rounds: int = 3) -> Points:
    """Round a closed polygon by cutting its corners, each round at a quarter of both edges (Chaikin).

    Parameters
    ----------
    corners : array_like, shape (n, 2)
    rounds : int, optional

    Returns
    -------
    ndarray, shape (n 2^rounds, 2)

    Examples
    --------
    >>> len(rounded([(0, 0), (4, 0), (4, 4), (0, 4)], rounds=2))
    16
    """
    points = np.asarray(corners, dtype=np.float64)
    for _ in range(rounds):
        following = np.roll(points, -1, axis=0)
        points = np.stack([0.75 * points + 0.25 * following, 0.25 * points + 0.75 * following], axis=1).reshape(-1, 2)
    return points


def chain(link: object, links: int) -> Points:
    """Return copies of a curve side by side, each joined to the next by a band.

    Parameters
    ----------
    link : Curve, NamedCurve or array_like of shape (n, 2)
        A counter-clockwise curve with one leftmost and one rightmost point, at corners.
    links : int
        Number of copies, m.

    Returns
    -------
    ndarray, shape (m (n + 2), 2)
        The bands join the disks, so the number of immersions is that of the link to the power of m. Each copy has the
        two corners cut off.

    Examples
    --------
    >>> chain([(0, 0), (2, -1), (4, 0), (2, 1)], 2).shape
    (12, 2)
    """
    points = as_curve(link).points
    points = np.roll(points, -int(points[:, 0].argmin()), axis=0)
    right = int(points[:, 0].argmax())
    left_end, left_start = _cut_corner(points[-1], points[0], points[1])
    right_end, right_start = _cut_corner(points[right - 1], points[right], points[(right + 1) % len(points)])
    lower = np.concatenate([[left_start], points[1:right], [right_end]])
    upper = np.concatenate([[right_start], points[right + 1 :], [left_end]])
    steps = np.array([(1.25 * np.ptp(points[:, 0]) * number, 0.0) for number in range(links)])
    return np.concatenate([*(lower + step for step in steps), *(upper + step for step in steps[::-1])])


def _cut_corner(before: Points, corner: Points, after: Points) -> tuple[Points, Points]:
    """Return the points a twentieth of the way from a corner back and ahead."""
    return 0.95 * corner + 0.05 * before, 0.95 * corner + 0.05 * after


def _polar(radius: npt.ArrayLike, angle: npt.NDArray[np.float64]) -> Points:
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)


def _turns(number: float, a_turn: int, start: float = 0.1) -> npt.NDArray[np.float64]:
    """Return angles over a number of full turns, the end left out; the start keeps samples off the crossings."""
    points = round(number * a_turn)
    return start + 2 * np.pi * number * np.arange(points) / points


def _circle(a_turn: int) -> Points:
    return _polar(1.0, _turns(1, a_turn))


def _figure_eight(a_turn: int) -> Points:
    t = _turns(1, 2 * a_turn)
    return np.stack([np.sin(t), 0.8 * np.sin(t) * np.cos(t)], axis=1)


def _limacon(a_turn: int) -> Points:
    t = _turns(1, 2 * a_turn)
    return _polar(0.6 + np.cos(t), t)


def _doubled_circle(a_turn: int) -> Points:
    t = _turns(2, a_turn)
    return _polar(1 + 0.12 * np.sin(t / 2), t)


def _finely_rounded(corners: npt.ArrayLike, a_turn: int) -> Points:
    """Round a polygon in three rounds for 40 points on a turn, and in one more for each doubling."""
    return rounded(corners, 3 + max(0, round(math.log2(a_turn / 40))))


def _kinked_circle(a_turn: int) -> Points:
    corners = [(3, 0), (5, 2.5), (6.5, 1), (3.5, 1.2), (3, 4), (-2, 4.5), (-2, 1), (1, 1), (1, 3), (-4, 3), (-4, -2)]
    return _finely_rounded(corners, 2 * a_turn)


def _along(start: float, end: float, turns: float, a_turn: int) -> npt.NDArray[np.float64]:
    """Return parameters of a line that turns so many times from start to end."""
    return np.linspace(start, end, round(turns * a_turn))


def _exit_ramp(a_turn: int) -> Points:
    t = np.linspace(-2.15, 2.15, round(1.2 * a_turn) + 1)
    return ribbon(np.stack([t**3 - 3 * t, 2.2 * t**2], axis=1), 1.6)


def _spiral(turns: float, pitch: float, start_radius: float, width: float, a_turn: int) -> Points:
    t = np.linspace(0, 2 * np.pi * turns, int(a_turn * turns) + 1)
    return ribbon(_polar(start_radius + pitch * t / (2 * np.pi), t), width)


def _horseshoe(a_turn: int) -> Points:
    return _spiral(1.08, 0.4, 2.0, 1.0, a_turn)


def _two_turn_spiral(a_turn: int) -> Points:
    return _spiral(2.0, 0.75, 2.0, 1.0, a_turn)


def _stacked_spiral(a_turn: int) -> Points:
    return _spiral(3.2, 0.45, 2.0, 1.2, a_turn)


def _knotted_ribbon(a_turn: int) -> Points:
    t = _along(0.15, 2 * np.pi - 0.15, 2.5, a_turn)
    return ribbon(np.stack([np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t)], axis=1), 0.6)


def _two_loops(a_turn: int) -> Points:
    t = _along(-np.pi, 3 * np.pi, 2, a_turn)
    return ribbon(np.stack([1.4 * t - 3 * np.sin(t), -3 * np.cos(t)], axis=1), 0.8)


def _pretzel(a_turn: int) -> Points:
    t = _along(0.05, 2 * np.pi - 0.35, 3.25, a_turn)
    return ribbon(np.stack([4 * np.cos(2 * t + 0.6), 3 * np.sin(3 * t)], axis=1), 0.5)


def _pentagram(a_turn: int) -> Points:
    t = _along(0.1, 2 * np.pi - 0.1, 3.25, a_turn)
    return ribbon(_polar(3 + 1.1 * np.cos(5 * t), 2 * t), 0.5)


def _milnor(_: int) -> Points:
    half = [(88, 39), (62, 102), (-17, -15), (-17, -13), (44, -7), (-75, 180)]
    return _with_half_turn(half)


def _ten_gon(_: int) -> Points:
    return _with_half_turn([(-12, 53), (3, 21), (-134, -108), (149, -92), (-78, 180)])


def _with_half_turn(half: Sequence[tuple[float, float]]) -> Points:
    return np.concatenate([np.array(half, dtype=np.float64), -np.array(half, dtype=np.float64)])


def _bennequin(_: int) -> Points:
    right = [(-18, -81), (62, -52), (19, 31), (34, 30), (-175, 9), (59, -176), (79, 25), (14, 80), (-36, 1)]
    left = [(-43, 14), (80, -156), (124, 139), (-61, 56), (-76, -28), (17, -32), (9, -44), (95, 147), (-182, 37)]
    return np.array(right + left, dtype=np.float64)


def _smallest_unliftable(a_turn: int) -> Points:
    corners = [
        (-24, 32), (-68, 30), (-87, 5), (-59, -43), (-14, -66), (42, -47), (85, 4), (91, 41), (45, 67),
        (-28, 72), (-81, 48), (-100, 2), (-82, -46), (-29, -72), (33, -62), (91, -21), (98, 7), (53, 51),
        (-7, 66), (-66, 49), (-77, 23), (-52, -11), (-12, -35), (-12, -50), (-23, -50), (-22, -34), (10, -25),
        (49, -28), (65, 9), (47, 46), (0, 56), (-36, 29), (-50, -25), (-23, -56), (18, -50), (36, -12),
        (42, 24), (54, 24), (52, 10), (24, 4), (8, 30), (16, 49), (27, 45), (21, 31),
    ]  # fmt: skip
    return _finely_rounded(corners, a_turn)


def _never_lifts(a_turn: int) -> Points:
    """Return the curve a-a+b-b+c-d-e+c+f-f+g-h-h+e-i-j-j+i+d+g+ of the census, drawn from its code."""
    corners = [
        (12, 42), (2, 63), (-10, 70), (-38, 56), (-80, 2), (-71, -26), (-36, -61), (-1, -76), (29, -75),
        (55, -58), (75, -29), (88, 36), (83, 54), (33, 78), (-26, 84), (-70, 69), (-96, 39), (-98, 3),
        (-78, -33), (-37, -70), (2, -84), (37, -79), (66, -57), (93, -15), (99, 18), (52, 58), (12, 75),
        (-31, 75), (-66, 55), (-72, 30), (-49, -30), (-22, -58), (12, -71), (33, -62), (44, -27), (47, 22),
        (56, 30), (64, 24), (58, 12), (34, 10), (-12, 22), (-24, 32), (-26, 42), (-16, 47), (-13, 40),
        (-21, 20), (-39, -11), (-38, -32), (-16, -52), (22, -57), (53, -49), (69, -21), (71, 18), (54, 47),
        (13, 63), (-16, 56), (-38, 40), (-45, 23), (-43, 2), (1, -37), (3, -47), (-6, -50), (-12, -36),
        (0, -18), (26, -12), (32, -20), (30, -25), (22, -26), (13, -8),
    ]  # fmt: skip
    return _finely_rounded(corners, a_turn)


def _seven_flaps(_: int) -> Points:
    from plyfold.hard.flaps import PALEY, flap_disk

    curve = flap_disk(7, PALEY).immersion.arrangement.curve
    return curve.points if curve is not None else np.empty((0, 2))


# ---- outlines ------------------------------------------------------------------------------------------------------


def _ring(a_turn: int) -> Outline:
    return Outline(band(1.6 * _circle(a_turn), 0.9))


def _linked_rings(a_turn: int) -> Outline:
    right, left = band(1.6 * _circle(a_turn), 0.6)
    aside = np.array([2.1, 0.15])
    return Outline([right, left, right + aside, left + aside])


def _pen(corners: Sequence[tuple[float, float]], a_turn: int) -> Points:
    """Return a line of cubic Béziers, each from one of the corners to the third one after it, with its last point."""
    share = np.arange(a_turn // 4)[:, None] / (a_turn // 4)
    weights = [(1 - share) ** 3, 3 * share * (1 - share) ** 2, 3 * share**2 * (1 - share), share**3]
    places = np.array(corners, dtype=np.float64)
    pieces = [np.hstack(weights) @ places[start : start + 4] for start in range(0, len(places) - 1, 3)]
    return np.concatenate([*pieces, places[-1:]])


def _letter_b(a_turn: int) -> Outline:
    corners = [
        (0, 1.2), (0, 3), (0, 7), (0, 8.8), (0, 9.8), (0.3, 10), (1.2, 10), (5.2, 10), (5.2, 6), (1.4, 6), (0.6, 6),
        (-0.4, 6), (-0.9, 6), (-2.4, 6), (-2.4, 4), (-0.9, 4), (-0.4, 4), (0.6, 4), (1.4, 4), (6.2, 4), (6.2, 0),
        (1.4, 0), (0.3, 0), (0, 0.2), (0, 1.2),
    ]  # fmt: skip
    return Outline(band(_pen(corners, a_turn)[:-1], 1.1))


def _letter_g(a_turn: int) -> Outline:
    stroke = [
        (2.1, 10.1), (2.1, 7), (2.1, 4), (2.1, 2.6), (2.1, -1.8), (-2.2, -1.2), (-2.2, 1.2), (-2.2, 2.8), (0.4, 2.8),
        (4.2, 4.2),
    ]  # fmt: skip
    bowl = (0, 7) + _circle(a_turn) * (2.2, 2.4)
    return Outline([*band(bowl, 1.1), ribbon(_pen(stroke, a_turn), 1.1)])


def _ampersand(a_turn: int) -> Outline:
    stroke = [
        (6.2, 0.1), (4.6, 1.9), (0.9, 5.6), (0.9, 7.9), (0.9, 9.9), (3.9, 9.9), (3.9, 7.9), (3.9, 5.6), (-0.2, 5.2),
        (-0.2, 2.4), (-0.2, -0.9), (4.9, -0.9), (5.6, 4.2),
    ]  # fmt: skip
    return Curve(ribbon(_pen(stroke, a_turn), 1.1))


def _disk_with_handle(a_turn: int) -> Outline:
    """Return a disk with two arches on it, one over the other: their four feet take turns."""
    body = [(-4.0, -1.2), (-3.4, -2.6), (-1.6, -3.2), (1.6, -3.2), (3.4, -2.6), (4.0, -1.2)]
    outer, inner = 2.6 * _polar(1.0, np.linspace(0, np.pi, 7)), 1.6 * _polar(1.0, np.linspace(np.pi, 0, 7))
    right, left = np.array([1.1, 0.5]), np.array([-1.1, 0.5])
    gaps = np.array([[(-2.0, 0.1)], [(0.0, 0.1)], [(2.0, 0.1)]])
    arches = [outer + right, gaps[0], inner + left, gaps[1], inner + right, gaps[2], outer + left]
    return Curve(_finely_rounded(np.concatenate([body, *arches]), a_turn))


def _limacon_with_cusp(a_turn: int) -> Outline:
    t = _turns(1, 2 * a_turn, 0.0)
    return Curve(_polar(0.6 + np.cos(t), t), cusps={a_turn: 1})


def _torus_front(a_turn: int) -> Outline:
    """Return the outline of what faces the viewer of a torus, from 30° above its plane.

    The circle in the middle of the tube is seen as an ellipse, and the outline runs beside it, on both sides, as far
    away as the tube is thick. Where the ellipse is bent as the tube is, the inner loop has a spike: at four places. At
    those two of them that are behind the hole, the front goes round the spike once and further, so these are cusps.
    """
    wide, high, tube = 3.0, 1.5, 1.3
    spike = math.asin(math.sqrt(((wide * high * tube) ** (2 / 3) - high**2) / (wide**2 - high**2)))
    spikes = [spike, np.pi - spike, np.pi + spike, 2 * np.pi - spike, 2 * np.pi + spike]
    part = a_turn // 2
    inner = np.concatenate([np.linspace(start, end, part, endpoint=False) for start, end in pairwise(spikes)])
    loops = [
        _polar(1.0, turn) * (wide, high) - side * tube * _left_of(_polar(1.0, turn + np.pi / 2) * (wide, high))
        for turn, side in ((_turns(1, 2 * a_turn), 1), (inner[::-1], -1))
    ]
    return Outline(loops, {(1, 2 * part - 1): 1, (1, part - 1): 1})


# After each figure of the paper (Mukherjee, Gopi, Rossignac 2011): a loop of its kind, not a copy of it.
CURVES: Mapping[str, NamedCurve] = {
    named.name: named
    for named in (
        NamedCurve("circle", "a circle", _circle, 0, 1, 1, 1),
        NamedCurve("figure-eight", "a figure eight: it turns 0 times", _figure_eight, 1, 0, 0, 0),
        NamedCurve("limacon", "Pascal's limaçon: it turns twice", _limacon, 1, 2, 0, 0),
        NamedCurve("doubled-circle", "a circle run through twice: it turns twice", _doubled_circle, 1, 2, 0, 0),
        NamedCurve("kinked-circle", "a kink and a curl: it turns once, and is no disk", _kinked_circle, 2, 1, 0, 0),
        NamedCurve("horseshoe", "a horseshoe whose ends overlap (figure 5)", _horseshoe, 2, 1, 1, 1),
        NamedCurve("exit-ramp", "a ribbon that crosses itself once (figure 6)", _exit_ramp, 4, 1, 1, 1),
        NamedCurve("two-loops", "a ribbon with two loops (figure 4)", _two_loops, 8, 1, 1, 1),
        NamedCurve("pretzel", "a woven ribbon (figure 7)", _pretzel, 24, 1, 1, 1),
        NamedCurve("knotted-ribbon", "an open trefoil of ribbon (figure 1)", _knotted_ribbon, 12, 1, 1, 1),
        NamedCurve("pentagram", "an open star of ribbon (figure 13)", _pentagram, 20, 1, 1, 1),
        NamedCurve("two-turn-spiral", "a spiral ramp of two turns (figure 12, left)", _two_turn_spiral, 2, 1, 1, 1),
        NamedCurve("stacked-spiral", "a spiral ramp three deep (figure 12, middle)", _stacked_spiral, 4, 1, 1, 1),
        NamedCurve("milnor", "Milnor's doodle: two immersions (figure 3)", _milnor, 6, 1, 2, 2),
        NamedCurve("ten-gon", "a polygon of ten points with two immersions", _ten_gon, 10, 1, 2, 2),
        NamedCurve("smallest-unliftable", "one of two immersions cannot be lifted", _smallest_unliftable, 8, 1, 2, 1),
        NamedCurve("never-lifts", "two immersions, and neither can be lifted", _never_lifts, 10, 1, 2, 0),
        NamedCurve(
            "bennequin", "five immersions, of which two cannot be lifted (figure 12, right)", _bennequin, 12, 1, 5, 3
        ),
        NamedCurve("seven-flaps", "one immersion, and no order of its sheets fits", _seven_flaps, 158, 1, 1, 0),
    )
}


OUTLINES: Mapping[str, NamedOutline] = {
    named.name: named
    for named in (
        NamedOutline("ring", "a ring, which has a hole", _ring, 0, 0, 1, 1),
        NamedOutline("linked-rings", "two rings, which can be linked", _linked_rings, 8, 0, 1, 1),
        NamedOutline("letter-b", "the letter B, a closed stroke of a pen", _letter_b, 8, 0, 1, 1),
        NamedOutline("letter-g", "the letter g, a closed stroke and an open one", _letter_g, 10, 1, 1, 1),
        NamedOutline("ampersand", "an ampersand, one open stroke of a pen", _ampersand, 8, 1, 1, 1),
        NamedOutline("disk-with-handle", "a disk with a handle: two arches cross", _disk_with_handle, 4, -1, 1, 1),
        NamedOutline(
            "limacon-with-cusp", "Pascal's limaçon, a disk with a cusp at the tip", _limacon_with_cusp, 1, 2, 1, 1
        ),
        NamedOutline("torus-front", "the front of a torus: a ring with two cusps", _torus_front, 2, 2, 1, 1),
    )
}


def named_curve(name: str) -> NamedOutline:
    """Return a curve or an outline of the gallery.

    Parameters
    ----------
    name : str
        As ``plyfold gallery`` lists it.

    Returns
    -------
    NamedOutline
        Of those in ``CURVES``, a :class:`NamedCurve`.

    Raises
    ------
    InputError
        If there is none of this name; it lists those there are.

    Examples
    --------
    >>> named_curve("milnor").immersions
    2
    """
    known = {**CURVES, **OUTLINES}
    if name not in known:
        raise InputError(f"the gallery has no curve {name!r}", hint=f"it has {', '.join(known)}")
    return known[name]
