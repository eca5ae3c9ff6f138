"""Outlines: closed polylines that bound a surface together, and the one closed curve (the loop of the paper, §2.1)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate
from typing import TypeAlias, TypeVar

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Floats, Ints
from plyfold.errors import CurveError
from plyfold.outline.from_mesh import boundary_of_mesh
from plyfold.outline.points import Repair, as_planar_points
from plyfold.outline.strokes import join_strokes
from plyfold.outline.vertices import Vertices, cleaned, cleaned_of_several, marked, naming_the_curve, whole_turns
from plyfold.ragged import count_each

__all__ = ["Curve", "Cusps", "Outline", "Repair", "backward_numbers", "outline_of_points"]

Number = TypeVar("Number", np.float64, np.int64)

Cusps: TypeAlias = "Sequence[npt.ArrayLike] | Mapping[tuple[int, int], int]"
"""The index of the cusp at each point: an array for each loop, or those of a few as ``{(loop, point): index}``."""


@dataclass(frozen=True, eq=False, init=False)
class Outline:
    """Closed polylines that bound a surface together, which lies on the left of each: so holes run clockwise.

    Points, edges and rows are numbered loop after loop. Edge i starts at point i and ends at the next one of its loop.

    Parameters
    ----------
    loops : iterable of Curve or array-like of shape (n, 2) or (n, 3)
        Each as for :class:`Curve`, which is the outline with one loop. Of several, those whose points all lie on one
        line are left out, and ``repairs`` says so.
    cusps : sequence of array-likes of int, or mapping from (loop, point) to int, optional
        By how many full turns the surface's angle at each point is larger than the one that is seen, from 0 to 360°, on
        the left: its *index* as a cusp, 0 at almost all points. By default, those of the curves.
    repairs : iterable of Repair, optional
        What was changed before the points came here.

    Attributes
    ----------
    loops : tuple of ndarray, shape (n, 2), float64, read-only
    cusps : tuple of ndarray, shape (n,), int64, read-only
    points : ndarray, shape (all points, 2), float64, read-only
        The points of all loops, one after the other.
    repairs : tuple of Repair
        Everything that was changed in the input.
    rows : ndarray, shape (all points,), int64, read-only
        The row that each point has in the arrays it was made from, rows counted loop after loop.

    Raises
    ------
    CurveError
        If there is no loop, if one is none (see :class:`Curve`), if none has an area, or if a cusp's index is no whole
        number from 0 up.

    Notes
    -----
    O(n log n). Outlines are compared by identity.

    Examples
    --------
    >>> ring = Outline([[(0, 0), (9, 0), (0, 9)], [(1, 1), (1, 3), (3, 1)]])
    >>> ring.n_loops, len(ring), ring.first_point.tolist()
    (2, 6, [0, 3, 6])
    >>> Outline([[(0, 0), (9, 0), (0, 9)]], {(0, 2): 1}).cusps
    (array([0, 0, 1]),)
    """

    loops: tuple[Floats, ...]
    cusps: tuple[Ints, ...]
    points: Floats
    repairs: tuple[Repair, ...]
    rows: Ints

    def __init__(
        self, loops: Iterable[Curve | npt.ArrayLike], cusps: Cusps | None = None, repairs: Iterable[Repair] = ()
    ) -> None:
        vertices = _vertices_of_loops(_as_list(loops))
        if isinstance(loops, Outline) and loops.n_loops > 1:
            repairs = (*repairs, *loops.repairs)
        given = [len(loop.given) for loop in vertices]
        index = [loop.cusps for loop in vertices] if cusps is None else _index_of_rows(cusps, given)
        starts = np.cumsum([0, *given])
        marks = [marked(loop, turns) for loop, turns in zip(vertices, index, strict=True)]
        _settle(
            self,
            loops=tuple(loop.points for loop in vertices if len(loop.points)),
            cusps=tuple(turns for turns in marks if len(turns)),
            points=_one_after_the_other([loop.points for loop in vertices]),
            repairs=(*repairs, *(repair for loop in vertices for repair in loop.repairs)),
            rows=_one_after_the_other([start + loop.rows for start, loop in zip(starts, vertices, strict=False)]),
        )

    def __len__(self) -> int:
        return len(self.points)

    def __repr__(self) -> str:
        loops = f"{self.n_loops} loop" + "s" * (self.n_loops > 1)
        return f"<Outline of {loops}, {len(self)} points{_cusps_in_words(self)}>"

    def _repr_svg_(self) -> str:
        from plyfold.draw.svg import outline_svg

        return outline_svg(self)

    @property
    def n_loops(self) -> int:
        """Number of closed curves."""
        return len(self.loops)

    @cached_property
    def has_cusps(self) -> bool:
        """Whether some point is a cusp."""
        return any(index.any() for index in self.cusps)

    @cached_property
    def first_point(self) -> Ints:
        """The number of each loop's first point, and last the number of all points, shape (loops + 1,)."""
        return np.array([0, *accumulate(map(len, self.loops))])

    @cached_property
    def next_point(self) -> Ints:
        """The point that follows each along its loop, shape (points,): where the edge of that number ends."""
        following = np.arange(1, len(self) + 1)
        following[self.first_point[1:] - 1] = self.first_point[:-1]
        return following

    @cached_property
    def previous_point(self) -> Ints:
        """The point before each along its loop, shape (points,)."""
        previous = np.empty_like(self.next_point)
        previous[self.next_point] = np.arange(len(self))
        return previous

    @cached_property
    def loop_of_point(self) -> Ints:
        """The loop that each point belongs to, shape (points,)."""
        return np.repeat(np.arange(self.n_loops), np.diff(self.first_point))

    @staticmethod
    def from_mesh(vertices: npt.ArrayLike, faces: npt.ArrayLike) -> Outline:
        """Return the boundary of a flat triangle mesh, such as a UV chart or a patch of a body seen from one side.

        Parameters
        ----------
        vertices : array-like, shape (v, 2) or (v, 3)
            Positions; a third column is left out, and ``repairs`` says so. The mesh may lie over itself.
        faces : array-like of int, shape (t, 3)
            The vertices of each triangle, counter-clockwise.

        Returns
        -------
        Outline
            A :class:`Curve` if the boundary is one loop. Each loop starts at its lowest vertex; ``rows`` are the
            numbers of the vertices. Where the triangles at a vertex turn full turns too often, it is a cusp. The mesh
            is cut at vertices where parts of it touch in a point alone; ``repairs`` names them.

        Raises
        ------
        CurveError
            If a triangle is flat or runs clockwise, three share an edge or two lie on the same side of one, the mesh is
            closed, or the triangles around an inner vertex turn round it more than once. It names the place.

        Notes
        -----
        Exact: turns are counted by signs. O(t log t); 10⁵ triangles take about 0.2 s.

        Examples
        --------
        A spiral stair of eight steps of 50° around a point:

        >>> import numpy as np
        >>> angle = np.radians(50 * np.arange(9))
        >>> steps = [(0, i, i + 1) for i in range(1, 9)]
        >>> Outline.from_mesh([(0, 0), *zip(np.cos(angle), np.sin(angle))], steps).cusps
        (array([1, 0, 0, 0, 0, 0, 0, 0, 0, 0]),)
        """
        points, repairs = as_planar_points(vertices)
        boundary = boundary_of_mesh(points, faces)
        loops = [points[loop] for loop in boundary.loops]
        repairs = (*repairs, *boundary.repairs)
        several = len(loops) > 1
        outline = Outline(loops, boundary.cusps, repairs) if several else Curve(loops[0], repairs, boundary.cusps[0])
        # No points were dropped: neighbours on the boundary of a flat mesh differ.
        _settle(outline, rows=_one_after_the_other(boundary.loops))
        return outline

    @property
    def curves(self) -> tuple[Curve, ...]:
        """Each loop as an outline of its own, with its cusps; a single one with the repairs, too."""
        repairs = self.repairs if self.n_loops == 1 else ()
        return tuple(Curve(points, repairs, index) for points, index in zip(self.loops, self.cusps, strict=True))

    def reversed(self) -> Outline:
        """Return the same outline with each loop run the other way from the same first point, cusps included.

        Examples
        --------
        >>> Outline([[(0, 0), (1, 0), (0, 1)]], [[0, 1, 0]]).reversed().cusps
        (array([0, 0, 1]),)
        """
        backward = [np.roll(points[::-1], 1, axis=0) for points in self.loops]
        return Outline(backward, [np.roll(index[::-1], 1) for index in self.cusps], self.repairs)

    def simplified(self, tolerance: float, keep_code: bool = False) -> Outline:
        """Return the outline with fewer points: each loop as by :meth:`Curve.simplified`.

        Parameters
        ----------
        tolerance : float
        keep_code : bool, optional
            Only of one loop: the code of several says nothing of which of them lie in which.

        Returns
        -------
        Outline

        Raises
        ------
        InputError
            If the tolerance is no distance, or with ``keep_code`` and several loops.

        Examples
        --------
        >>> Outline([[(0, 0), (5, 0.1), (9, 0), (0, 9)], [(1, 1), (1, 3), (3, 1)]]).simplified(0.2)
        <Outline of 2 loops, 6 points>
        """
        from plyfold.arrangement.tidying import each_tidied, simplified

        return each_tidied(self, keep_code, lambda curve: simplified(curve, tolerance, keep_code))

    def smoothed(self, rounds: int = 3, keep_code: bool = False) -> Outline:
        """Return the outline with its points moved towards their neighbours: each loop as by :meth:`Curve.smoothed`.

        Parameters
        ----------
        rounds : int, optional
        keep_code : bool, optional
            Only of one loop: the code of several says nothing of which of them lie in which.

        Returns
        -------
        Outline

        Raises
        ------
        InputError
            If ``rounds`` is no count, or with ``keep_code`` and several loops.
        CurveError
            If all points of a loop come to lie on one line.

        Examples
        --------
        >>> ring = Outline([[(0, 0), (8, 0), (8, 8), (0, 8)], [(3, 3), (3, 5), (5, 3)]])
        >>> ring.smoothed(1).loops[0].tolist()
        [[2.0, 2.0], [6.0, 2.0], [6.0, 6.0], [2.0, 6.0]]
        """
        from plyfold.arrangement.tidying import each_tidied, smoothed

        return each_tidied(self, keep_code, lambda curve: smoothed(curve, rounds, keep_code))


@dataclass(frozen=True, eq=False, init=False, repr=False)
class Curve(Outline):
    """A closed polyline: the points in order, the last one joined to the first. It is an outline with one loop.

    Parameters
    ----------
    points : array-like, shape (n, 2) or (n, 3)
        Vertices in order, x to the right and y up, in any unit. If the last point repeats the first, it is left out;
        other points that repeat the one before them, and a third column, are left out and recorded in ``repairs``.
    repairs : iterable of Repair, optional
        What was changed before the points came here.
    cusps : array-like of int, shape (n,), or mapping from point to int, optional
        The index of each point as a cusp, see :class:`Outline`; 0 by default.

    Attributes
    ----------
    points : ndarray, shape (n, 2), float64, read-only
        At least three vertices, no two consecutive ones equal, not all on one line.
    repairs : tuple of Repair
        Everything that was changed in the input.
    rows : ndarray, shape (n,), int64, read-only
        The row that each vertex has in the array it was made from: 0 to n − 1, unless points were left out.

    Raises
    ------
    CurveError
        If the shape is wrong, a coordinate is not finite, fewer than three points differ, or all lie on one line
        (decided exactly; a figure eight with signed area 0 is a fine curve).

    Notes
    -----
    O(n log n). Curves are compared by identity.

    Examples
    --------
    >>> square = Curve([(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)])
    >>> len(square)
    4
    >>> [str(repair) for repair in Curve([(0, 0), (1, 0), (1, 0), (0, 1)]).repairs]
    ['repeated point dropped at (1, 0)']
    """

    def __init__(
        self,
        points: npt.ArrayLike,
        repairs: Iterable[Repair] = (),
        cusps: npt.ArrayLike | Mapping[int, int] | None = None,
    ) -> None:
        vertices = cleaned(points)
        if isinstance(cusps, Mapping):
            cusps = _index_of_rows({(0, vertex): index for vertex, index in cusps.items()}, [len(vertices.given)])[0]
        _settle(
            self,
            loops=(vertices.points,),
            cusps=(vertices.cusps if cusps is None else marked(vertices, cusps),),
            points=vertices.points,
            repairs=(*repairs, *vertices.repairs),
            rows=vertices.rows,
        )

    def __repr__(self) -> str:
        return f"<Curve of {len(self)} points{_cusps_in_words(self)}>"

    @classmethod
    def from_strokes(cls, strokes: Iterable[npt.ArrayLike], max_gap: float | None = None) -> Curve:
        """Join strokes, given in any order and direction, into one closed curve.

        Parameters
        ----------
        strokes : iterable of array-likes, each of shape (m, 2)
            Pen strokes that together cover the loop (§4 of [MGR11]_).
        max_gap : float, optional
            Longest gap that may be bridged; by default a tenth of the diagonal of the bounding box.

        Returns
        -------
        Curve
            It starts with the first stroke in its given direction; every bridged gap is in ``repairs``.

        Raises
        ------
        StrokeError
            If there is no stroke, or a gap is longer than ``max_gap``; it names both ends.
        CurveError
            If the joined points are not a usable curve.

        Notes
        -----
        See :func:`plyfold.outline.strokes.join_strokes`, which does the work, for the cost.

        References
        ----------
        .. [MGR11] U. Mukherjee, M. Gopi, J. Rossignac, "Immersion and Embedding of Self-Crossing Loops",
           Sketch-Based Interfaces and Modeling, 2011.

        Examples
        --------
        >>> curve = Curve.from_strokes([[(0, 0), (4, 0)], [(0, 3), (0, 0)], [(4, 0), (0, 3)]])
        >>> curve.points.tolist()
        [[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]]
        """
        points, repairs = join_strokes(strokes, max_gap)
        return cls(points, repairs)

    def reversed(self) -> Curve:
        """Return the same curve run the other way from the same first point.

        Returns
        -------
        Curve

        Notes
        -----
        O(n log n).

        Examples
        --------
        >>> Curve([(0, 0), (1, 0), (0, 1)]).reversed().points.tolist()
        [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]]
        """
        return Curve(np.roll(self.points[::-1], 1, axis=0), self.repairs, np.roll(self.cusps[0][::-1], 1))

    def simplified(self, tolerance: float, keep_code: bool = False) -> Curve:
        """Return the curve with fewer of its points.

        Parameters
        ----------
        tolerance : float
            How far the others may be from the edges between those that stay.
        keep_code : bool, optional
            Keep more points where that is needed, so that the curve crosses itself as before: its signed Gauss code,
            counted from its first point, is the same. That is proved by comparing the codes in the end.

        Returns
        -------
        Curve
            The first point and all cusps stay.

        Raises
        ------
        InputError
            If the tolerance is no distance.

        Notes
        -----
        By Douglas and Peucker, O(n log n) mostly; with ``keep_code`` a few arrangements more. Where the curve touches
        itself, its code is that of ``arrange(curve)``.

        Examples
        --------
        >>> len(Curve([(0, 0), (4, 0), (8, 0.1), (9, 9), (0, 9)]).simplified(0.2))
        4
        """
        from plyfold.arrangement.tidying import simplified

        return simplified(self, tolerance, keep_code)

    def smoothed(self, rounds: int = 3, keep_code: bool = False) -> Curve:
        """Return the curve with its points moved towards their neighbours.

        Parameters
        ----------
        rounds : int, optional
            How often each point moves halfway to the middle of its neighbours, at most 10,000 times.
        keep_code : bool, optional
            Move points less where that is needed, so that the curve crosses itself as before: its signed Gauss code,
            counted from its first point, is the same. That is proved by comparing the codes in the end.

        Returns
        -------
        Curve
            With as many points; cusps stay where they are.

        Raises
        ------
        InputError
            If ``rounds`` is no count.
        CurveError
            Without ``keep_code``, if all points come to lie on one line.

        Notes
        -----
        O(n) for each round, up to the first one that moves nothing; with ``keep_code`` a few arrangements more, whose
        number does not grow with n.

        Examples
        --------
        >>> Curve([(0, 0), (4, 0), (4, 4), (0, 4)]).smoothed(1).points.tolist()
        [[1.0, 1.0], [3.0, 1.0], [3.0, 3.0], [1.0, 3.0]]
        """
        from plyfold.arrangement.tidying import smoothed

        return smoothed(self, rounds, keep_code)


def outline_of_points(points: Floats, loop: Ints, cusps: Ints, rows: Ints, repairs: Iterable[Repair]) -> Outline:
    """Return the outline of points that are listed loop after loop, no two neighbours equal; one loop is a curve.

    Parameters
    ----------
    points : (n, 2) float
    loop : (n,) int
        The loop of each, in order; numbers without points are left out.
    cusps, rows : (n,) int
        The index of each as a cusp, and its row in the arrays that were given.
    repairs : iterable of Repair
        Everything that was changed.

    Examples
    --------
    >>> points, zero = np.array([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]), np.zeros(3, dtype=int)
    >>> outline_of_points(points, zero + 2, zero, np.array([0, 5, 7]), []).rows.tolist()
    [0, 5, 7]
    """
    ends = np.flatnonzero(np.diff(loop)) + 1
    loops, index = np.split(points, ends), np.split(cusps, ends)
    outline = Outline(loops, index, repairs) if len(loops) > 1 else Curve(points, repairs, cusps)
    _settle(outline, rows=_one_after_the_other([rows]))
    return outline


def backward_numbers(first_point: Ints) -> Ints:
    """Return the number that each point of a reversed outline has in the outline itself.

    Examples
    --------
    >>> backward_numbers(np.array([0, 3, 7])).tolist()
    [0, 2, 1, 3, 6, 5, 4]
    """
    length = np.diff(first_point)
    return np.asarray(np.repeat(first_point[:-1], length) + -count_each(length) % np.repeat(length, length))


def _settle(outline: Outline, **attributes: object) -> None:
    """Write the attributes of a new outline, which is frozen."""
    vars(outline).update(attributes)


def _as_list(loops: Iterable[Curve | npt.ArrayLike]) -> list[Curve | npt.ArrayLike]:
    if isinstance(loops, Outline):
        return list(loops.curves)
    try:
        return list(loops)
    except TypeError as error:
        hint = "give a list of closed curves; a shapely geometry is taken as it is wherever an outline is"
        raise CurveError(f"a {type(loops).__name__} is no list of loops", hint=hint) from error


def _vertices_of_loops(loops: Sequence[Curve | npt.ArrayLike]) -> list[Vertices]:
    """Return the vertices of each loop; an error says which one is none."""
    if not loops:
        raise CurveError("the outline has no loop", hint="give at least one closed curve")
    clean = cleaned if len(loops) == 1 else cleaned_of_several
    vertices = []
    for number, loop in enumerate(loops):
        with naming_the_curve(number, len(loops)):
            vertices.append(_vertices_of(loop) if isinstance(loop, Outline) else clean(loop))
    if not any(len(loop.points) for loop in vertices):
        places = [loop.given[0] for loop in vertices]
        raise CurveError(f"none of the {len(loops)} loops has an area", places, "draw one that goes round something")
    return vertices


def _vertices_of(curve: Outline) -> Vertices:
    """Return the vertices of a curve that has been cleaned before."""
    if curve.n_loops > 1:
        raise CurveError(
            f"this outline has {curve.n_loops} loops", where=curve.loops[1][:1], hint="give them one by one"
        )
    return Vertices(curve.points, np.arange(len(curve)), curve.points, curve.repairs, curve.cusps[0])


def _index_of_rows(cusps: Cusps, given: Sequence[int]) -> list[npt.ArrayLike]:
    """Return the index of each row of each loop; ``given`` is the number of rows of each."""
    if not isinstance(cusps, Mapping):
        if len(cusps) != len(given):
            raise CurveError(f"there are cusps for {len(cusps)} loops, and {len(given)} loops")
        return list(cusps)
    index = [np.zeros(count, dtype=np.int64) for count in given]
    for key, turns in cusps.items():
        loop, vertex = _loop_and_point(key)
        if not (0 <= loop < len(given) and 0 <= vertex < given[loop]):
            raise CurveError(f"there is no point {vertex} of loop {loop} to be a cusp", hint="both count from 0")
        index[loop][vertex] = whole_turns(turns)
    return list(index)


def _loop_and_point(key: object) -> tuple[int, int]:
    """Return the loop and the point that a cusp is named by; refuse other names."""
    if isinstance(key, tuple) and len(key) == 2 and all(isinstance(number, int | np.integer) for number in key):
        return int(key[0]), int(key[1])
    raise CurveError(f"a cusp is named by its loop and its point, and not by {key!r}", hint="such as {(0, 12): 1}")


def _one_after_the_other(arrays: Sequence[npt.NDArray[Number]]) -> npt.NDArray[Number]:
    whole = np.concatenate(arrays)
    whole.setflags(write=False)
    return whole


def _cusps_in_words(outline: Outline) -> str:
    count = sum(int(np.count_nonzero(index)) for index in outline.cusps)
    return f", {count} cusp" + "s" * (count > 1) if count else ""
