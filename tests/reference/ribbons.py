"""Ribbons by their definition, slowly and in fractions.

A ribbon is a disk or ring of triangles, laid flat without folds, that its line runs through: from the start cap to the
end cap, or once round, never leaving it, also where it lies over itself. And all of its corners see the line, in the
surface, from no farther than the ribbon reaches.
"""

from fractions import Fraction
from itertools import pairwise
from math import hypot

# By how much the ends of a line may be beside their caps, in widths: those are rounded.
ROUNDING = 1e-9
# What is seen of a segment of the line ends so close before its ends: in a flat cap these are on the boundary.
ASIDE = Fraction(1, 10**9)


def cross(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def exact(points):
    return [(Fraction(float(x)), Fraction(float(y))) for x, y in points]


def between(start, end, share):
    return tuple(a + share * (b - a) for a, b in zip(start, end, strict=True))


class Surface:
    """Triangles that are glued where they have an edge in common; ``points`` and ``faces`` as of a mesh."""

    def __init__(self, points, faces):
        self.points = exact(points)
        self.faces = [tuple(map(int, face)) for face in faces]
        self.left_of = {}
        for number, (a, b, c) in enumerate(self.faces):
            for edge in ((a, b), (b, c), (c, a)):
                assert edge not in self.left_of, "three triangles at an edge"
                self.left_of[edge] = number

    def edges(self, face):
        a, b, c = self.faces[face]
        return (a, b), (b, c), (c, a)

    def is_laid_flat(self, loops):
        """Whether the boundary is the loops of points, and all is positive, of one piece, and nowhere a full turn."""
        following = {a: b for loop in loops for a, b in zip(loop, [*loop[1:], loop[0]], strict=True)}
        boundary = {(a, b) for a, b in self.left_of if (b, a) not in self.left_of}
        inner = (len(self.left_of) - len(boundary)) // 2
        characteristic = len(self.points) - len(boundary) - inner + len(self.faces)
        return (
            boundary == set(following.items())
            and all(cross(*(self.points[k] for k in face)) > 0 for face in self.faces)
            and len(self._reached()) == len(self.faces)
            and characteristic == 2 - len(loops)
            and all(self._is_less_than_a_full_turn(a, b) for a, b in following.items())
        )

    def _reached(self):
        reached, ahead = {0}, [0]
        while ahead:
            for a, b in self.edges(ahead.pop()):
                other = self.left_of.get((b, a))
                if other is not None and other not in reached:
                    reached.add(other)
                    ahead.append(other)
        return reached

    def _is_less_than_a_full_turn(self, corner, end):
        """Whether the triangles at a corner, from the edge that starts there on, do not come back to that edge."""
        first = ray = end
        halfway = False
        while (corner, ray) in self.left_of:
            ray = next(k for k in self.faces[self.left_of[corner, ray]] if k not in (corner, ray))
            side = cross(self.points[corner], self.points[first], self.points[ray])
            if halfway and side >= 0:
                return False
            halfway |= side <= 0
        return True

    def over(self, place):
        """The triangles over a place, those with it on an edge too."""
        return [
            number
            for number in range(len(self.faces))
            if all(cross(self.points[a], self.points[b], place) >= 0 for a, b in self.edges(number))
        ]

    def walk(self, face, start, end):
        """Where a straight walk from a place in a triangle ends: last triangle, place, and whether it stayed."""
        came_from = None
        while True:
            passed = [
                (self._share(edge, start, end), edge)
                for edge in self.edges(face)
                if edge != came_from and cross(self.points[edge[0]], self.points[edge[1]], end) < 0
            ]
            if not passed:
                return face, end, True
            share, (a, b) = min(passed)
            place = between(start, end, share)
            if (b, a) not in self.left_of or place in (self.points[a], self.points[b]):
                return face, place, False
            face, came_from = self.left_of[b, a], (b, a)

    def _share(self, edge, start, end):
        a, b = (self.points[k] for k in edge)
        from_start, from_end = cross(a, b, start), cross(a, b, end)
        return from_start / (from_start - from_end)

    def is_on_boundary(self, face, place):
        """Whether a place in a triangle is on one of its edges that has no other triangle, or is a corner."""
        ends = [self.points[k] for edge in self.edges(face) if edge[::-1] not in self.left_of for k in edge]
        on_edge = any(cross(a, b, place) == 0 for a, b in zip(ends[::2], ends[1::2], strict=True))
        return on_edge or place in [self.points[k] for k in self.faces[face]]

    def is_same(self, face, other, place):
        """Whether a place in two triangles is the same one of the surface."""
        common = set(self.edges(face)) & {edge[::-1] for edge in self.edges(other)}
        return face == other or any(cross(self.points[a], self.points[b], place) == 0 for a, b in common)


def as_walked(line, closed):
    """The line, which begins in the middle of its last segment if it is closed."""
    points = exact(line)
    return [middle := between(points[-1], points[0], Fraction(1, 2)), *points, middle] if closed else points


def lift(surface, line, closed, beyond):
    """The triangles at the points of a line that is walked through a surface, or None if there is no such walk.

    Points are those of :func:`as_walked`, but for the ends of an open line: its walk begins and ends in the middles of
    the first and the last segment, and from there, straight on, the surface must end as far beyond the line as is told
    of both ends.
    """
    points = as_walked(line, closed)
    for face in surface.over(points[0] if closed else between(*points[:2], Fraction(1, 2))):
        faces = _once_round(surface, points, face) if closed else _through(surface, points, face, beyond)
        if faces:
            return faces
    return None


def _once_round(surface, points, face):
    faces = _walked(surface, points, face)
    return faces if faces and surface.is_same(faces[-1], face, points[0]) else None


def _through(surface, points, face, beyond):
    middles = [between(*pair, Fraction(1, 2)) for pair in (points[:2], points[-2:])]
    faces = _walked(surface, [middles[0], *points[1:-1], middles[1]], face)
    if not faces:
        return None
    ends = [(faces[0], middles[0], points[0], beyond[0]), (faces[-1], middles[1], points[-1], beyond[1])]
    return faces if all(_surface_ends(surface, *end) for end in ends) else None


def _walked(surface, points, face):
    faces = [face]
    for start, end in pairwise(points):
        face, place, stayed = surface.walk(faces[-1], start, end)
        if not stayed or surface.is_on_boundary(face, place):
            return None
        faces.append(face)
    return faces


def _surface_ends(surface, face, start, end, beyond):
    """Whether a surface ends, walked straight on, as far beyond a place as is said."""
    goal = between(start, end, 1 + Fraction(beyond / length(start, end)))
    _, place, stayed = surface.walk(face, start, between(start, goal, 2))
    return not stayed and length(goal, place) <= ROUNDING * length(start, goal)


def farthest_corner(surface, line, faces, closed, half):
    """How far from the line the corner is that is farthest, in halves of the width there; straight in the surface.

    ``faces`` as from :func:`lift`, and ``half`` the halves of the widths at the points of :func:`as_walked`.
    """
    points = as_walked(line, closed)
    starts = points[:-1] if closed else [between(*points[:2], Fraction(1, 2)), *points[1:-1]]

    def distance(corner):
        """To the nearest place of the line that is seen, of the nearest ones of all segments."""
        feet = [_foot(surface.points[corner], *segment) for segment in pairwise(points)]
        away = [length(surface.points[corner], foot) / max(*half[k : k + 2]) for k, foot in enumerate(feet)]
        for k in sorted(range(len(feet)), key=away.__getitem__):
            of_line = surface.walk(faces[k], starts[k], feet[k])[0]
            if _is_seen(surface, corner, of_line, feet[k]):
                return away[k]
        return float("inf")

    return max(map(distance, range(len(surface.points))))


def length(start, end):
    return hypot(*(float(b - a) for a, b in zip(start, end, strict=True)))


def _is_seen(surface, corner, face, place):
    around = [number for number, corners in enumerate(surface.faces) if corner in corners]
    reached = [surface.walk(other, surface.points[corner], place) for other in around]
    return any(stayed and surface.is_same(other, face, place) for other, _, stayed in reached)


def _foot(place, start, end):
    """The place of a segment, but for its ends, that is nearest to another one."""
    along, across = ([b - a for a, b in zip(start, other, strict=True)] for other in (end, place))
    share = (along[0] * across[0] + along[1] * across[1]) / (along[0] ** 2 + along[1] ** 2)
    return between(start, end, min(max(share, ASIDE), 1 - ASIDE))
