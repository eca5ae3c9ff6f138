"""What surface triangles are, counted from the definition: corners are one vertex if sides between them are glued."""

from collections import Counter
from collections.abc import Iterable, Sequence

Kind = tuple[int, int]
"""Boundary loops and Euler characteristic of a connected piece."""


class Classes:
    """Things that are said to be the same, one pair after the other."""

    def __init__(self) -> None:
        self.same: dict[object, object] = {}

    def of(self, thing: object) -> object:
        while (other := self.same.get(thing, thing)) != thing:
            thing = other
        return thing

    def join(self, one: object, other: object) -> None:
        self.same[self.of(one)] = self.of(other)


def kinds_of_triangles(faces: Iterable[Sequence[int]]) -> list[Kind]:
    """The kinds of the pieces that triangles are, glued along sides that run from one point to another and back.

    Corners at the same point are the same vertex only if triangles between them are glued.
    """
    side = {(face[i], face[i - 2]): (number, i) for number, face in enumerate(faces) for i in range(3)}
    vertices, triangles, loops = Classes(), Classes(), Classes()
    for (start, end), (number, i) in side.items():
        if (end, start) in side:
            other, j = side[end, start]
            vertices.join((number, i), (other, (j + 1) % 3))
            vertices.join((number, (i + 1) % 3), (other, j))
            triangles.join(number, other)
    free = [corner for ends, corner in side.items() if ends[::-1] not in side]
    for number, i in free:
        loops.join(vertices.of((number, i)), vertices.of((number, (i + 1) % 3)))
    euler: Counter[object] = Counter()
    for corner in {vertices.of(corner): corner for corner in side.values()}.values():
        euler[triangles.of(corner[0])] += 1
    for ends, (number, _) in side.items():
        euler[triangles.of(number)] -= ends[::-1] not in side or ends < ends[::-1]
    for number in {number for number, _ in side.values()}:
        euler[triangles.of(number)] += 1
    bounds = Counter({loops.of(vertices.of(corner)): triangles.of(corner[0]) for corner in free}.values())
    return sorted((bounds[piece], euler[piece]) for piece in {triangles.of(number) for number, _ in side.values()})
