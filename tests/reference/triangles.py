"""Which triangles of a mesh in space meet where they should not: exact, slow, and without any idea of layers.

Two triangles may have in common what their common vertices span: nothing, a vertex or an edge. Their intersection is
computed by clipping one with the other in rational numbers and compared with that. Pairs whose boxes are apart are
left out, and so are pairs that a plane separates so clearly that rounding cannot matter.
"""

from collections.abc import Iterator
from fractions import Fraction

import numpy as np

Vector = tuple[Fraction, Fraction, Fraction]


def meeting_pairs(vertices: np.ndarray, faces: np.ndarray) -> list[tuple[int, int]]:
    """All pairs of triangles that have more in common than the span of their common vertices."""
    vertices, faces = np.asarray(vertices, dtype=np.float64), np.asarray(faces)
    first, second = box_pairs(vertices[faces])
    doubtful = ~(clearly_apart(vertices, faces, first, second) | clearly_apart(vertices, faces, second, first))
    return list(wrong_pairs(vertices, faces, first[doubtful], second[doubtful]))


def box_pairs(corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    low, high = corners.min(axis=1), corners.max(axis=1)
    pairs = [np.empty((2, 0), dtype=np.int64)]
    for i in range(len(corners) - 1):
        meet = ((low[i] <= high[i + 1 :]) & (low[i + 1 :] <= high[i])).all(axis=1)
        others = i + 1 + np.flatnonzero(meet)
        pairs.append(np.stack([np.full(len(others), i), others]))
    first, second = np.concatenate(pairs, axis=1)
    return first, second


def clearly_apart(vertices: np.ndarray, faces: np.ndarray, first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Whether all corners that only the first triangle has lie well on one side of the second triangle's plane."""
    scaled = vertices / 2.0 ** np.frexp(np.abs(vertices).max())[1]
    a, b, c = scaled[faces[second]].swapaxes(0, 1)
    normal = np.cross(b - a, c - a)
    side = ((scaled[faces[first]] - a[:, None]) * normal[:, None]).sum(axis=2)
    common = (faces[first][:, :, None] == faces[second][:, None, :]).any(axis=2)
    # Coordinates are at most 1, so a computed determinant is within 1e-13 of the true one.
    return ((side > 1e-13) | common).all(axis=1) | ((side < -1e-13) | common).all(axis=1)


def wrong_pairs(
    vertices: np.ndarray, faces: np.ndarray, first: np.ndarray, second: np.ndarray
) -> Iterator[tuple[int, int]]:
    exact = {
        v: tuple(map(Fraction, vertices[v].tolist())) for v in np.unique(faces[np.union1d(first, second)]).tolist()
    }
    for i, j in zip(first.tolist(), second.tolist(), strict=True):
        common = set(faces[i].tolist()) & set(faces[j].tolist())
        met = intersection([exact[v] for v in faces[i].tolist()], [exact[v] for v in faces[j].tolist()])
        if not all(in_span(point, [exact[v] for v in sorted(common)]) for point in met):
            yield i, j


def intersection(a: list[Vector], b: list[Vector]) -> list[Vector]:
    """Points whose convex hull is the intersection of two closed triangles."""
    normal = cross(minus(b[1], b[0]), minus(b[2], b[0]))
    half_spaces = [(b[0], normal), (b[0], tuple(-x for x in normal))]
    half_spaces += [(b[i], cross(normal, minus(b[(i + 1) % 3], b[i]))) for i in range(3)]
    for origin, inward in half_spaces:
        a = clip(a, origin, inward)
    return a


def clip(polygon: list[Vector], origin: Vector, inward: Vector) -> list[Vector]:
    """The part of a convex polygon (or segment, or point) in a closed half-space."""
    depth = [dot(minus(p, origin), inward) for p in polygon]
    clipped = []
    for i, (p, d) in enumerate(zip(polygon, depth, strict=True)):
        if depth[i - 1] * d < 0:
            q, share = polygon[i - 1], depth[i - 1] / (depth[i - 1] - d)
            clipped.append(tuple(x + share * (y - x) for x, y in zip(q, p, strict=True)))
        if d >= 0:
            clipped.append(p)
    return clipped


def in_span(point: Vector, corners: list[Vector]) -> bool:
    """Whether a point lies on the vertex or segment with the given ends; nothing lies on no corners."""
    if len(corners) < 2:
        return [point] == corners
    along, step = minus(corners[1], corners[0]), minus(point, corners[0])
    return len(corners) == 2 and cross(along, step) == (0, 0, 0) and 0 <= dot(along, step) <= dot(along, along)


def minus(a: Vector, b: Vector) -> Vector:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a: Vector, b: Vector) -> Fraction:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
