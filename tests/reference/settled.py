"""Whether triangles are a surface as an outline was given, in rational numbers: by chains of directed segments.

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


def parts(segments: Iterable[Segment], ends: Iterable[Point]) -> Counter[Segment]:
    """How often each part of directed segments is run, where they are cut at some points."""
    cuts, count = set(ends), Counter()
    for start, end in segments:
        # On a line, points are in the order of their coordinates.
        inside = sorted((p for p in cuts if lies_on(p, (start, end))), reverse=start > end)
        count.update(pairwise(inside))
    return count


def ends_of(*segments: Iterable[Segment]) -> set[Point]:
    return {end for some in segments for segment in some for end in segment}


def are_the_same(one: Sequence[Segment], other: Sequence[Segment]) -> bool:
    """Whether directed segments add up to the same as others, where opposite directions cancel each other."""
    ends = ends_of(one, other)
    count, expected = parts(one, ends), parts(other, ends)
    keys = {*count, *expected}
    return all(count[s] - count[s[::-1]] == expected[s] - expected[s[::-1]] for s in keys)


def are_among(some: Sequence[Segment], others: Sequence[Segment]) -> bool:
    """Whether directed segments are parts of others, none of which is used twice."""
    ends = ends_of(some, others)
    return parts(some, ends) <= parts(others, ends)


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
