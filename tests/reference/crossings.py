"""Crossings of a closed polygon in exact fractions, every pair of edges tried; winding of points; turning number.

Edge i runs from vertex i to vertex i + 1. Floats are taken at their exact value.
"""

from collections.abc import Iterable, Sequence
from fractions import Fraction
from itertools import combinations, pairwise
from typing import NamedTuple

from reference.planar_maps import GaussCode

Point = tuple[Fraction, Fraction]


class DegenerateError(ValueError):
    """The polygon is not in general position; `.places` lists (kind, point)."""

    def __init__(self, places: list[tuple[str, Point]]):
        super().__init__(", ".join(f"{kind} at ({float(x)}, {float(y)})" for kind, (x, y) in places))
        self.places = places


class Meeting(NamedTuple):
    """Edges `first` < `second` cross at `point`, at the fractions `on_first` and `on_second` of their lengths.

    `ccw`: the second edge crosses the first from right to left.
    """

    first: int
    second: int
    on_first: Fraction
    on_second: Fraction
    point: Point
    ccw: bool


class PolygonCrossings(NamedTuple):
    """The Gauss code of a polygon; where each visit is, and the edge that it lies on."""

    code: GaussCode
    points: tuple[Point, ...]
    edges: tuple[int, ...]


def exact(points: Iterable[Sequence[float]]) -> list[Point]:
    """The vertices as fractions, without rounding."""
    return [(Fraction(x), Fraction(y)) for x, y in ((float(x), float(y)) for x, y in points)]


def minus(p: Point, q: Point) -> Point:
    """Vector from q to p."""
    return p[0] - q[0], p[1] - q[1]


def cross(u: Point, v: Point) -> Fraction:
    """Positive if v points to the left of u."""
    return u[0] * v[1] - u[1] * v[0]


def dot(u: Point, v: Point) -> Fraction:
    """Scalar product."""
    return u[0] * v[0] + u[1] * v[1]


def side(p: Point, q: Point, r: Point) -> int:
    """+1 if r lies to the left of the line from p to q, -1 to the right, 0 on it."""
    value = cross(minus(q, p), minus(r, p))
    return (value > 0) - (value < 0)


def on_segment(p: Point, q: Point, r: Point) -> bool:
    """Whether r lies on the closed segment from p to q."""
    return side(p, q, r) == 0 and dot(minus(p, r), minus(q, r)) <= 0


def edges(vertices: Sequence[Point]) -> list[tuple[Point, Point]]:
    """The edges of the closed polygon."""
    return list(pairwise([*vertices, vertices[0]]))


def touching(vertices: Sequence[Point]) -> list[tuple[str, Point]]:
    """Vertices that lie where they must not: on the next vertex, or on an edge that is not one of their own two."""
    count = len(vertices)
    places = [("repeated vertex", p) for p, q in edges(vertices) if p == q]
    for i, r in enumerate(vertices):
        for j, (p, q) in enumerate(edges(vertices)):
            if i not in (j, (j + 1) % count) and on_segment(p, q, r):
                places.append(("vertex on edge", r))
    return places


def meetings(vertices: Sequence[Point]) -> list[Meeting]:
    """All proper crossings: the ends of each edge lie strictly on different sides of the other."""
    found = []
    for (i, (p, q)), (j, (r, s)) in combinations(enumerate(edges(vertices)), 2):
        if side(p, q, r) * side(p, q, s) < 0 and side(r, s, p) * side(r, s, q) < 0:
            along, across = minus(q, p), minus(s, r)
            denominator = cross(along, across)
            on_first = cross(minus(r, p), across) / denominator
            on_second = cross(minus(r, p), along) / denominator
            point = (p[0] + on_first * along[0], p[1] + on_first * along[1])
            found.append(Meeting(i, j, on_first, on_second, point, denominator > 0))
    return found


def coinciding(found: Sequence[Meeting]) -> list[tuple[str, Point]]:
    """Points where more than two edges cross."""
    points = [meeting.point for meeting in found]
    return [("more than two edges", point) for point in sorted(set(points)) if points.count(point) > 1]


def outer_dart(vertices: Sequence[Point], visit_edges: Sequence[int]) -> int:
    """A dart with the unbounded cell on its left.

    The smallest vertex (by x, then y) is a corner of the convex hull. If the curve turns left there, the outside is on
    its right. Its border is the one after all visits on earlier edges.
    """
    lowest = vertices.index(min(vertices))
    before, after = vertices[lowest - 1], vertices[(lowest + 1) % len(vertices)]
    earlier = sum(edge < lowest for edge in visit_edges)
    border = (earlier - 1) % len(visit_edges) if visit_edges else 0
    return 2 * border + (side(before, vertices[lowest], after) > 0)


def crossings(points: Iterable[Sequence[float]]) -> PolygonCrossings:
    """The Gauss code of a closed polygon, visits numbered along it from its first vertex.

    Raises DegenerateError if it is not in general position: vertices on other vertices or edges (edges that
    overlap among them), more than two edges through a point.
    """
    return crossings_between(exact(points))


def crossings_between(vertices: Sequence[Point]) -> PolygonCrossings:
    """The Gauss code of a closed polygon with these vertices, which need be no doubles."""
    found = meetings(vertices)
    if places := touching(vertices) + coinciding(found):
        raise DegenerateError(places)
    ends = [(m.first, m.on_first, index, m.ccw) for index, m in enumerate(found)]
    ends += [(m.second, m.on_second, index, not m.ccw) for index, m in enumerate(found)]
    ends.sort()
    names = [index for _, _, index, _ in ends]
    visits = [[p for p, name in enumerate(names) if name == index] for index in range(len(found))]
    partner = tuple(sum(visits[name]) - p for p, name in enumerate(names))
    visit_edges = tuple(edge for edge, _, _, _ in ends)
    code = GaussCode(partner, tuple(ccw for *_, ccw in ends), outer_dart(vertices, visit_edges))
    return PolygonCrossings(code, tuple(found[name].point for name in names), visit_edges)


def base_visit(points: Iterable[Sequence[float]]) -> int:
    """The visit at the leftmost crossing, the lowest of several, of the strand that the other crosses from the right.

    0 for a curve without crossings.
    """
    found = crossings(points)
    if not found.points:
        return 0
    visit = found.points.index(min(found.points))
    return visit if found.code.ccw[visit] else found.code.partner[visit]


def winding_number(points: Iterable[Sequence[float]], place: Sequence[float]) -> int:
    """How often the polygon winds round a point, exactly: edges that cross the ray to the right, upward minus downward.

    Raises ValueError if the point lies on the polygon.
    """
    (here,) = exact([place])
    total = 0
    for p, q in edges(exact(points)):
        if on_segment(p, q, here):
            raise ValueError("the point lies on the polygon")
        if p[1] <= here[1] < q[1] and side(p, q, here) > 0:
            total += 1
        if q[1] <= here[1] < p[1] and side(p, q, here) < 0:
            total -= 1
    return total


def passes_east(u: Point, v: Point) -> int:
    """Turning from direction u to v the short way: +1 if it passes east counter-clockwise, -1 if clockwise, else 0.

    Arriving at east counter-clockwise counts as passing it, and leaving it clockwise as passing back.
    """
    above_u, above_v = ((y > 0 or (y == 0 and x > 0)) for x, y in (u, v))
    turn = cross(u, v)
    return int(not above_u and above_v and turn > 0) - int(above_u and not above_v and turn < 0)


def turning_number(points: Iterable[Sequence[float]]) -> int:
    """Sum of the exterior angles over 2 pi, exactly, as the number of times that the direction passes east.

    Raises DegenerateError where the polygon turns straight back.
    """
    vertices = exact(points)
    directions = [minus(q, p) for p, q in edges(vertices)]
    turns = edges(directions)
    back = [i for i, (u, v) in enumerate(turns) if cross(u, v) == 0 and dot(u, v) <= 0]
    if back:
        raise DegenerateError([("turns straight back", vertices[(i + 1) % len(vertices)]) for i in back])
    return sum(passes_east(u, v) for u, v in turns)


def reversed_polygon(points: Sequence[Sequence[float]]) -> list[Sequence[float]]:
    """The same polygon run backward from the same first vertex."""
    return [points[0], *reversed(list(points)[1:])]
