"""Whether a flat mesh is an immersed disk with the curve as its boundary, in rational numbers alone."""

from fractions import Fraction

Point = tuple[Fraction, Fraction]


def rational(point: tuple[float, float]) -> Point:
    x, y = point
    return Fraction(float(x)), Fraction(float(y))


def cross(a: Point, b: Point, c: Point, d: Point) -> Fraction:
    return (b[0] - a[0]) * (d[1] - c[1]) - (b[1] - a[1]) * (d[0] - c[0])


def share_along(point: Point, start: Point, end: Point) -> Fraction:
    """Where the point of a line is that is nearest to a given one: 0 at the start, 1 at the end."""
    ux, uy = end[0] - start[0], end[1] - start[1]
    return (ux * (point[0] - start[0]) + uy * (point[1] - start[1])) / (ux * ux + uy * uy)


def on_edges(curve: list[Point], walk: list[Point]) -> list[Point] | None:
    """The walk with what is between points of the curve put on its edges; None if it does not advance along them."""
    placed: list[Point] = []
    edge, share = -1, Fraction(0)
    for point in walk:
        if edge + 1 < len(curve) and point == curve[edge + 1]:
            edge, share = edge + 1, Fraction(0)
            placed.append(point)
            continue
        start, end = curve[edge], curve[(edge + 1) % len(curve)]
        before, share = share, share_along(point, start, end)
        if not before < share < 1:
            return None
        placed.append((start[0] + share * (end[0] - start[0]), start[1] + share * (end[1] - start[1])))
    return placed if edge + 1 == len(curve) else None


def is_up(a: Point, b: Point) -> bool:
    """Whether the direction has an angle in [0, π)."""
    return b[1] > a[1] or (b[1] == a[1] and b[0] > a[0])


def turns_once(places: list[Point], faces: list[list[int]], boundary: list[int]) -> bool:
    """Whether the corners at each inner vertex make one full turn, and those at a boundary vertex less than one."""
    passages = [0] * len(places)
    for a, b, c in (corner for i, j, k in faces for corner in ((i, j, k), (j, k, i), (k, i, j))):
        passages[a] += not is_up(places[a], places[b]) and is_up(places[a], places[c])
    expected = [1] * len(places)
    for before, here, after in zip(boundary[-1:] + boundary, boundary, boundary[1:] + boundary[:1], strict=False):
        out, back = is_up(places[here], places[after]), is_up(places[here], places[before])
        turn = cross(places[here], places[after], places[here], places[before])
        if out == back and turn == 0:
            return False
        expected[here] = int(turn < 0 if out == back else back)
    return passages == expected


def is_immersed_disk(
    curve: list[tuple[float, float]],
    vertices: list[tuple[float, float]],
    faces: list[list[int]],
    boundary: list[int],
) -> bool:
    """Whether a mesh that is a disk is an immersed one over the curve, with its boundary vertices on the edges."""
    given = [rational(point) for point in vertices]
    placed = on_edges([rational(point) for point in curve], [given[i] for i in boundary])
    if placed is None:
        return False
    exact = list(given)
    for vertex, place in zip(boundary, placed, strict=True):
        exact[vertex] = place
    positive = all(cross(p[a], p[b], p[a], p[c]) > 0 for p in (given, exact) for a, b, c in faces)
    return positive and turns_once(exact, faces, boundary)
