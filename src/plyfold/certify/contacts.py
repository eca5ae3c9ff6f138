"""Check what is said about an outline that touches itself: that it is a limit of surfaces, and how it was cut."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise
from math import lcm
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from plyfold.certify.disk import Sides, corners_of_fans, surface_sides
from plyfold.certify.exact import Bools, Floats, Ints, Loops, as_loops, as_vertices, exact_points, finite
from plyfold.certify.immersed import require_immersed, turns_too_many, walked
from plyfold.certify.places import ExactPlaces, Point, doubles, on_edges, rationals, require_positive
from plyfold.errors import CertificateError

__all__ = ["check_boundary", "check_limit", "check_pieces"]

Whole: TypeAlias = tuple[int, int]
_Loops: TypeAlias = npt.ArrayLike | Sequence[npt.ArrayLike]


# ---- the moves -------------------------------------------------------------------------------------------------------


def check_limit(  # noqa: PLR0913, PLR0917 - an outline, where it has moved, and what it bounds there
    loops: _Loops,
    moved: _Loops,
    faces: npt.ArrayLike,
    cusps: _Loops | None = None,
    free: npt.ArrayLike = (),
    twins: npt.ArrayLike | None = None,
) -> None:
    """Check that an outline is the limit of outlines of immersed surfaces, which come to it from outside.

    Parameters
    ----------
    loops : array_like, shape (n, 2), or a sequence of such
        The points of one closed curve or of several, with the surface on the left of each, as they were given.
    moved : array_like, shape (n, 2), or a sequence of such
        The same points, some of which were moved a little; as numbers of any kind, also fractions, which moves may need
        that are infinitely small.
    faces : array_like of int, shape (m, 3)
        Triangles on the points, numbered loop after loop, that are a surface with the moved outline as its boundary.
    cusps : array_like of int, shape (n,), or a sequence of such, optional
        How many full turns the angle at each point has more than one sees; none by default.
    free : array_like of int, optional
        The numbers of points that may have moved in any direction.
    twins : array_like of int, shape (3 m,), optional
        How the triangles are glued, as in :func:`check_immersed_surface`.

    Raises
    ------
    CertificateError
        If the triangles on the moved points are no immersed surface with these as its boundary (see
        :func:`check_immersed_surface`), a point did not move strictly to the right of both its edges, or a triangle or
        a point turns over on the way back. It names the place.

    Notes
    -----
    All is exact. When all points go back together by the same share of their ways, the area of each triangle is a
    polynomial of degree 2 in this share. In Bernstein's form its coefficients are seen to be positive, but for the one
    at the end, which may be 0. So are those of the polynomials which tell that no point becomes the tip of a spike.
    Hence every outline on the way is that of an immersed surface, and the given one is their limit. O(m log m).

    Examples
    --------
    Two triangles that meet in a point, which was moved apart to the right of the outline on either side:

    >>> given = [(0, 0), (1, 1), (2, 0), (2, 2), (1, 1), (0, 2)]
    >>> moved = [(0, 0), (1, 0.9), (2, 0), (2, 2), (1, 1.1), (0, 2)]
    >>> check_limit(given, moved, [(0, 1, 5), (1, 4, 5), (1, 2, 4), (2, 3, 4)])
    >>> inward = [(0, 0), (1, 1.1), (2, 0), (2, 2), (1, 0.9), (0, 2)]
    >>> check_limit(given, inward, [(0, 1, 5), (1, 4, 5), (1, 2, 4), (2, 3, 4)])
    Traceback (most recent call last):
    plyfold.errors.CertificateError: triangle 1 is flat or turned over, at (1, 1.1), (1, 0.9), (0, 2)
    """
    way = _as_way(loops, moved, cusps)
    n = len(way.given)
    sides = surface_sides(faces, n, twins)
    there = rationals(way.moved)
    require_immersed(sides, walked(replace(way.outline, points=there.near), there.near, sides, np.arange(n)), there)
    movers = np.flatnonzero([here != gone for here, gone in zip(way.given, way.moved, strict=True)])
    _require_outward(way, np.setdiff1d(movers, as_vertices(free, n, "the row of free points")))
    _require_positive_on_the_way(way, np.asarray(faces), movers)
    _require_no_spike_on_the_way(way, movers)


@dataclass(frozen=True, eq=False)
class _Way:
    """Where the points of an outline were given, and where they were moved to."""

    outline: Loops
    given: list[Point]
    moved: list[Point]


def _as_way(loops: _Loops, moved: _Loops, cusps: _Loops | None) -> _Way:
    outline = as_loops(loops, cusps)
    if not np.array_equal(outline.first, as_loops(moved, cusps).first):
        raise CertificateError("the moved outline has other numbers of points than the given one")
    return _Way(outline, exact_points(loops), exact_points(moved))


def _require_outward(way: _Way, movers: Ints) -> None:
    """Check that points go to the right of both their edges; a cusp has no outside, and must not go."""
    before, after = _neighbours(way.outline)
    points = rationals([*way.given, *way.moved])
    moved = movers + len(way.given)
    inward = points.cross_sign(before[movers], movers, movers, moved) >= 0
    inward |= points.cross_sign(movers, after[movers], movers, moved) >= 0
    inward |= way.outline.cusps[movers] > 0
    if inward.any():
        raise CertificateError("a point was moved, but not outward", where=way.outline.points[movers[inward]])


def _neighbours(outline: Loops) -> tuple[Ints, Ints]:
    """Return the points before and after each one along its loop."""
    after = outline.following
    before = np.empty_like(after)
    before[after] = np.arange(len(after))
    return before, after


def _require_positive_on_the_way(way: _Way, faces: Ints, movers: Ints) -> None:
    """Check that triangles with corners that moved keep their orientation until these are back."""
    for triangle in np.flatnonzero(np.isin(faces, movers).any(axis=1)).tolist():
        now, then = _on_the_way(way, faces[triangle])
        first, middle, last = _crosses(_step(now, 0, 1), _step(now, 0, 2), _step(then, 0, 1), _step(then, 0, 2))
        if first < 0 or middle < 0 or last <= 0:
            where = way.outline.points[faces[triangle]]
            raise CertificateError(f"triangle {triangle} turns over on the way to the points as given", where=where)


def _require_no_spike_on_the_way(way: _Way, movers: Ints) -> None:
    """Check that no corner near points that moved doubles back before these are back, nor when they are."""
    before, after = _neighbours(way.outline)
    for point in np.unique(np.concatenate([movers, before[movers], after[movers]])).tolist():
        corner = np.array([before[point], point, after[point]])
        now, then = _on_the_way(way, corner)
        arriving, leaving = _step(now, 0, 1), _step(now, 1, 2)
        later = _step(then, 0, 1), _step(then, 1, 2)
        turns = _crosses(arriving, leaving, *later)
        ahead = _crosses(arriving, _turned(leaving), later[0], _turned(later[1]))
        if not (min(turns) > 0 or max(turns) < 0 or min(ahead) > 0):
            where = way.outline.points[[point]]
            raise CertificateError("the outline doubles back on the way to the points as given", where=where)


def _on_the_way(way: _Way, corners: Ints) -> tuple[list[Whole], list[Whole]]:
    """Return where three points were given and where they were moved to, in whole multiples of a common unit."""
    places = [*(way.given[corner] for corner in corners), *(way.moved[corner] for corner in corners)]
    unit = lcm(*(number.denominator for place in places for number in place))
    whole = [(int(x * unit), int(y * unit)) for x, y in places]
    return whole[:3], whole[3:]


def _step(places: list[Whole], start: int, end: int) -> Whole:
    return places[end][0] - places[start][0], places[end][1] - places[start][1]


def _turned(step: Whole) -> Whole:
    """Return a step turned by a right angle to the left: the cross product with it is the scalar product."""
    return -step[1], step[0]


def _crosses(u: Whole, v: Whole, later_u: Whole, later_v: Whole) -> tuple[int, int, int]:
    """Return the Bernstein coefficients of the cross product of two steps on their way, the middle one twice."""
    return _cross(u, v), _cross(u, later_v) + _cross(later_u, v), _cross(later_u, later_v)


def _cross(u: Whole, v: Whole) -> int:
    return u[0] * v[1] - u[1] * v[0]


# ---- the pieces ------------------------------------------------------------------------------------------------------


def check_pieces(  # noqa: PLR0913, PLR0917 - an outline, a mesh, and where it is on the outline
    loops: _Loops,
    vertices_xy: npt.ArrayLike,
    faces: npt.ArrayLike,
    cusps: _Loops | None = None,
    boundary: npt.ArrayLike | None = None,
    along: npt.ArrayLike | None = None,
    *,
    twins: npt.ArrayLike | None = None,
) -> None:
    """Check that a flat mesh is what an outline that touches itself bounds, cut where it has no width.

    Parameters
    ----------
    loops : array_like, shape (n, 2), or a sequence of such
        The points of one closed curve or of several, with the surface on the left of each, as they were given.
    vertices_xy : array_like, shape (v, 2)
        Positions; several vertices may lie at one place.
    faces : array_like of int, shape (m, 3)
        Vertices of each triangle, counter-clockwise. Triangles hang together by sides that they share, not where they
        have only a vertex in common.
    cusps : array_like of int, shape (n,), or a sequence of such, optional
        How many full turns the angle at each point has more than one sees; none by default.
    boundary, along : array_like of int, shape (b,), optional
        The vertices on the boundary, and the edge of the outline along which it leaves each of them. Then a vertex
        stands for the exact point of its edge that is nearest to it, as in :func:`check_immersed_surface`; without
        these, it must be on the outline as it is.
    twins : array_like of int, shape (3 m,), optional
        How the triangles are glued, as in :func:`check_immersed_surface`.

    Raises
    ------
    CertificateError
        If the mesh is no surface, a triangle is not strictly counter-clockwise, the triangles turn round a vertex more
        than once (but for cusps), or the boundary is not the outline: every stretch of the one must be run as often and
        in the same direction as of the other, but for *necks*, stretches that the outline runs as often in both
        directions and the mesh does not. It names the place.

    Notes
    -----
    Exact: stretches are compared in rational numbers on each line. With equal boundaries, the mesh covers each place as
    often as the outline winds round it. O(m log m).

    Examples
    --------
    >>> bow = [(0, 0), (1, 1), (2, 0), (2, 2), (1, 1), (0, 2)]
    >>> check_pieces(bow, bow, [(0, 1, 5), (2, 3, 4)])
    >>> check_pieces(bow, bow, [(0, 1, 5)])
    Traceback (most recent call last):
    plyfold.errors.CertificateError: the boundary of the pieces is not the outline, at (1.5, 0.5)

    A square and a triangle with a neck between them:

    >>> neck = [(0, 0), (2, 0), (3, -1), (4, -2), (5, -1), (3, -1), (2, 0), (2, 2), (0, 2)]
    >>> check_pieces(neck, neck, [(0, 1, 7), (0, 7, 8), (2, 3, 4)])
    """
    outline, near = as_loops(loops, cusps), finite(vertices_xy, 2)
    triangles, vertex = corners_of_fans(faces, len(near), twins)
    sides = surface_sides(triangles, len(vertex), twins)
    rim = np.flatnonzero(sides.twin < 0)
    start, end = sides.start[rim], sides.end[rim]
    if boundary is None:
        edge, places = _edges_between(outline, near[vertex[start]], near[vertex[end]]), doubles(near[vertex])
    else:
        edge = _edges_along(len(outline.points), len(near), vertex[start], boundary, along)
        places = _places_on_edges(
            outline, near[vertex], _at_vertices(start, edge, vertex), _at_vertices(end, edge, vertex)
        )
    require_positive(places, triangles)
    _require_turns(outline, sides, _Rim(outline, start, end, edge, places))
    _require_same_boundary(_Rim(outline, start, end, edge, places))


def check_boundary(loops: _Loops, boundary: _Loops) -> None:
    """Check that the boundary loops of pieces, put together, are an outline that touches itself, but for its necks.

    Parameters
    ----------
    loops : array_like, shape (n, 2), or a sequence of such
        The outline as it was given.
    boundary : array_like, shape (m, 2), or a sequence of such
        The points of the pieces' loops, exactly; :func:`check_surface` shows that a mesh has them.

    Raises
    ------
    CertificateError
        Otherwise, as in :func:`check_pieces`.

    Examples
    --------
    >>> bow = [(0, 0), (1, 1), (2, 0), (2, 2), (1, 1), (0, 2)]
    >>> check_boundary(bow, [[(0, 0), (1, 1), (0, 2)], [(1, 1), (2, 0), (2, 2)]])
    >>> check_boundary(bow, [[(0, 0), (1, 1), (0, 2)]])
    Traceback (most recent call last):
    plyfold.errors.CertificateError: the boundary of the pieces is not the outline, at (1.5, 0.5)
    """
    outline, left = as_loops(loops), as_loops(boundary)
    edge = _edges_between(outline, *left.edges.swapaxes(0, 1))
    _require_same_boundary(_Rim(outline, np.arange(len(left.points)), left.following, edge, doubles(left.points)))


@dataclass(frozen=True, eq=False)
class _Rim:
    """The boundary of a mesh by its sides: the vertices at which they start and end, and where these are.

    ``edge`` is the edge of the outline on which each side lies, −1 where that is not known.
    """

    outline: Loops
    start: Ints
    end: Ints
    edge: Ints
    places: ExactPlaces

    @property
    def turns(self) -> tuple[Bools, Bools]:
        """Which sides begin where the boundary comes from another edge, and which end where it goes on to another."""
        leaving, arriving = (_at_vertices(ends, self.edge, self.places.near) for ends in (self.start, self.end))
        turns = (leaving != arriving) | (leaving < 0)
        return turns[self.start], turns[self.end]


def _at_vertices(ends: Ints, numbers: Ints, vertices: Floats | Ints) -> Ints:
    """Return the numbers of sides at the vertices that are their ends, −1 at others."""
    at = np.full(len(vertices), -1)
    at[ends] = numbers
    return at


def _edges_between(outline: Loops, start: Floats, end: Floats) -> Ints:
    """Return the edges of the outline from some places to others, −1 for none."""
    number = {tuple(ends): edge for edge, ends in enumerate(outline.edges.reshape(-1, 4).tolist())}
    sides = np.concatenate([start, end], axis=1).tolist()
    return np.array([number.get(tuple(ends), -1) for ends in sides], dtype=np.int64)


def _edges_along(n: int, n_vertices: int, start: Ints, boundary: npt.ArrayLike, along: npt.ArrayLike | None) -> Ints:
    """Return the edges of the outline along which the sides from some vertices run, as they are given."""
    rows = as_vertices(boundary, n_vertices, "the boundary")
    edges = as_vertices(() if along is None else along, n, "the row of edges")
    if rows.shape != edges.shape or not np.array_equal(np.sort(rows), np.sort(start)):
        raise CertificateError("the given boundary is not a row of all boundary vertices of the mesh, with their edges")
    if len(np.unique(rows)) < len(rows):
        raise CertificateError("the given boundary names a vertex twice")
    edge_at = np.full(n_vertices, -1)
    edge_at[rows] = edges
    return np.asarray(edge_at[start])


def _places_on_edges(outline: Loops, near: Floats, leaving: Ints, arriving: Ints) -> ExactPlaces:
    """Return places of vertices: those that are no points of the outline lie on the edges beside them."""
    points = set(map(tuple, outline.points.tolist()))
    is_point = np.array([tuple(place) in points for place in near.tolist()])
    edges = np.stack([leaving, np.where(arriving == leaving, -1, arriving)], axis=1)
    return on_edges(near, edges, outline.edges, is_point)


def _require_turns(outline: Loops, sides: Sides, rim: _Rim) -> None:
    """Check that the triangles turn round each vertex once at most, and more often only at cusps."""
    turns, _ = turns_too_many(sides, rim.start, rim.end, rim.places)
    allowed: dict[tuple[float, ...], int] = defaultdict(int)
    for point in np.flatnonzero(outline.cusps).tolist():
        allowed[tuple(outline.points[point].tolist())] += int(outline.cusps[point])
    wrong = turns != 0
    for vertex in np.intersect1d(np.flatnonzero(turns > 0), rim.start).tolist():
        place = tuple(rim.places.near[vertex].tolist())
        allowed[place] -= int(turns[vertex])
        wrong[vertex] = allowed[place] < 0
    if wrong.any():
        how = "not often enough" if (turns < 0)[np.argmax(wrong)] else "too often"
        raise CertificateError(f"the triangles at a vertex turn round it {how}", where=rim.places.near[wrong])


# ---- stretches of the boundary and of the outline --------------------------------------------------------------------


class _Line(NamedTuple):
    """A line: of upright ones the slope is None, and the height is their x."""

    slope: Fraction | None
    height: Fraction


class _Change(NamedTuple):
    """From a point of a line on, one more stretch, or one less, is run forward (to higher x or y) or backward."""

    place: Point
    forward: int
    backward: int


def _require_same_boundary(rim: _Rim) -> None:
    """Check that each stretch is run by the outline as often as by the boundary, but for as often there as back.

    What the outline runs counts positively, what the boundary runs negatively. Only the ends of stretches are looked
    at: where the boundary goes on along an edge, it does so in its direction.
    """
    _require_along_edges(rim)
    changes: dict[_Line, list[_Change]] = defaultdict(list)
    whole = _whole_edges(rim)
    for edge in np.flatnonzero(~whole).tolist():
        start, end = ((Fraction(x), Fraction(y)) for x, y in rim.outline.edges[edge].tolist())
        _add(changes, (start, end), ((start, 1), (end, -1)))
    begins, ends = rim.turns
    for side in np.flatnonzero((begins | ends) & ~((rim.edge >= 0) & whole[rim.edge])).tolist():
        start, end = rim.places.exact(int(rim.start[side])), rim.places.exact(int(rim.end[side]))
        _add(changes, (start, end), ((start, -1),) * bool(begins[side]) + ((end, 1),) * bool(ends[side]))
    for line in changes.values():
        _require_balance(line)


def _require_along_edges(rim: _Rim) -> None:
    """Check that sides on edges of the outline run along them in their direction."""
    known = np.flatnonzero(rim.edge >= 0)
    start, end, edge = rim.start[known], rim.end[known], rim.edge[known]
    with np.errstate(over="ignore"):
        step = np.diff(rim.outline.edges, axis=1)[edge, 0]
    axis = np.argmax(np.abs(step), axis=1)
    back = rim.places.step_sign(start, end, axis) * np.sign(step[np.arange(len(step)), axis]) <= 0
    if back.any():
        raise CertificateError(
            "the boundary stops or runs backwards along the curve", where=rim.places.near[start[back]]
        )


def _whole_edges(rim: _Rim) -> Bools:
    """Return the edges of the outline along which the boundary runs once, from end to end."""
    whole = np.ones(len(rim.outline.points), dtype=bool)
    for at_end, (turns, vertices) in enumerate(zip(rim.turns, (rim.start, rim.end), strict=True)):
        which = np.flatnonzero(turns & (rim.edge >= 0))
        vertex, edge = vertices[which], rim.edge[which]
        there = (rim.places.near[vertex] == rim.outline.edges[edge, at_end]).all(axis=1) & (rim.places.off[vertex] == 0)
        whole &= np.bincount(edge, minlength=len(whole)) == 1
        whole &= np.bincount(edge[there], minlength=len(whole)) == 1
    return whole


def _add(changes: dict[_Line, list[_Change]], stretch: tuple[Point, Point], met: Iterable[tuple[Point, int]]) -> None:
    """Note on the line of a stretch where it begins and ends."""
    line = _line_through(*stretch)
    is_forward = stretch[0] < stretch[1]
    for place, count in met:
        changes[line].append(_Change(place, count * is_forward, count * (not is_forward)))


def _line_through(start: Point, end: Point) -> _Line:
    if start[0] == end[0]:
        return _Line(None, start[0])
    slope = (end[1] - start[1]) / (end[0] - start[0])
    return _Line(slope, start[1] - slope * start[0])


def _require_balance(line: list[_Change]) -> None:
    """Check that between any two changes as much is run forward as backward, and nothing less than no times."""
    for place, following, forward, backward in _stretches(line):
        if forward != backward or forward < 0:
            middle = [float((a + b) / 2) for a, b in zip(place, following, strict=True)]
            raise CertificateError("the boundary of the pieces is not the outline", where=[middle])


def _stretches(line: list[_Change]) -> Iterator[tuple[Point, Point, int, int]]:
    """Yield the stretches of a line between changes, and how often each is run forward and backward."""
    forward = backward = 0
    for change, following in pairwise(sorted(line)):
        # Backward stretches begin at their higher end.
        forward, backward = forward + change.forward, backward - change.backward
        if change.place != following.place:
            yield change.place, following.place, forward, backward
