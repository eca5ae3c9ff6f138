"""Whether pieces of triangles are a surface as an outline was given, in rational numbers: by chains of directed segments.

Triangles cover each place as often as closed curves wind round it if their sides, added up, are the curves: a function
that is zero far away and changes across segments by what the segments say is known everywhere.
"""

from collections import Counter
from collections.abc import Iterable, Sequence
from fractions import Fraction
from itertools import pairwise

Point = tuple[Fraction, Fraction]
Segment = tuple[Point, Point]


def rational(points: Iterable[Sequence[float]]) -> list[Point]:
    return [(Fraction(float(x)), Fraction(float(y))) for x, y in points]


def double_area(corners: Sequence[Point]) -> Fraction:
    """Twice the signed area of a polygon."""
    following = [*corners[1:], corners[0]]
    return sum((a * d - b * c for (a, b), (c, d) in zip(corners, following, strict=True)), Fraction(0))


def sides(corners: Sequence[Point]) -> list[Segment]:
    return list(zip(corners, [*corners[1:], corners[0]], strict=True))


def are_the_same(one: Iterable[Segment], other: Iterable[Segment]) -> bool:
    """Whether directed segments add up to the same as others, where opposite directions cancel each other."""
    count: Counter[Segment] = Counter()
    for segment, times in [*((s, 1) for s in one), *((s, -1) for s in other)]:
        # On a line, points are in the order of their coordinates.
        rises = segment[0] < segment[1]
        count[segment if rises else segment[::-1]] += times if rises else -times
    left = {segment: times for segment, times in count.items() if times}
    ends = {end for segment in left for end in segment}
    parts: Counter[Segment] = Counter()
    for segment, times in left.items():
        inside = sorted(end for end in ends if lies_on(end, segment))
        for part in pairwise(inside):
            parts[part] += times
    return not any(parts.values())


def lies_on(point: Point, segment: Segment) -> bool:
    (ax, ay), (bx, by) = segment
    x, y = point
    on_line = (bx - ax) * (y - ay) == (by - ay) * (x - ax)
    return on_line and min(segment) <= point <= max(segment)


def pieces_of(faces: Sequence[Sequence[int]]) -> list[list[Sequence[int]]]:
    """The triangles of each piece: they hang together along sides."""
    side = {(a, b): face for face in faces for a, b in zip(face, [*face[1:], face[0]], strict=True)}
    left, pieces = [tuple(face) for face in faces], []
    while left:
        piece, waiting = [], [left[0]]
        while waiting:
            face = waiting.pop()
            if face in left:
                left.remove(face)
                piece.append(face)
                around = zip(face, [*face[1:], face[0]], strict=True)
                waiting += [tuple(side[b, a]) for a, b in around if (b, a) in side]
        pieces.append(piece)
    return pieces


def boundary_of(faces: Sequence[Sequence[int]]) -> list[int]:
    """The corners along the boundary of a disk, from the lowest on."""
    steps = {(a, b) for face in faces for a, b in zip(face, [*face[1:], face[0]], strict=True)}
    following = {a: b for a, b in steps if (b, a) not in steps}
    assert len(following) == sum((b, a) not in steps for a, b in steps)
    walk = [min(following)]
    while (step := following[walk[-1]]) != walk[0]:
        walk.append(step)
    assert len(walk) == len(following)
    return walk
