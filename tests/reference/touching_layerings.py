"""Layerings of drawings that touch themselves, as they are: at each node one order of all that is there.

The *germs* at a node are the connected parts of a surface over a small disk round it: whole disks, and corners of the
boundary. All of them have the node, so they must lie over it in some order; turns of a cusp's stair, which is one germ,
follow each other upward or downward. Along a part of an edge all sheets beside it have the part, which lie there in one
order, the same at both its ends; and so do the sheets over a face, the same at all its corners. Nothing else is asked.
"""

from collections.abc import Iterator, Sequence
from itertools import permutations, product

from reference.crossings import Point
from reference.touching_drawings import (
    Sides,
    TouchingDrawing,
    across,
    corner_of_boundary,
    surfaces,
    touching_drawing,
)

Corner = tuple[int, int]
"""Sector i, on the left of the i-th dart round a node, and a sheet over it."""
Height = tuple[int, int]
Shared = tuple[str, int]
"""A face or a part, over which corners at several nodes lie."""
Order = tuple[tuple[int, int], ...]


def germs_at(found: TouchingDrawing, sides: dict[int, Sides], node: int) -> list[list[Corner]]:
    """The germs at a node: the corners of each, in the order in which one comes through them."""
    darts = found.around[node]
    leaving = [strand for strand, dart in enumerate(found.strands) if dart in darts]
    germs = [corner_of_boundary(found, sides, node, strand)[0] for strand in leaving]
    known = {corner for germ in germs for corner in germ}
    for sheet in range(found.winding[found.cell_of_dart[darts[0]]]):
        if (0, sheet) not in known:
            germs.append(whole_disk(sides, darts, sheet))
    return germs


def whole_disk(sides: dict[int, Sides], darts: tuple[int, ...], sheet: int) -> list[Corner]:
    """The corners round a node of a sheet that has it inside, from the first sector on."""
    corners = [(0, sheet)]
    for sector in range(1, len(darts)):
        sheet = across(sides, darts[sector], sheet)
        corners.append((sector, sheet))
    return corners


def orders_at(found: TouchingDrawing, sides: dict[int, Sides], node: int) -> Iterator[dict[Shared, Order]]:
    """For each order of the germs at a node, the orders from below over the faces and along the parts there."""
    germs, darts = germs_at(found, sides, node), found.around[node]
    stairs = [len(germ) > len(darts) for germ in germs]
    for ranks in permutations(range(len(germs))):
        for upward in product(*((1, -1) if stair else (1,) for stair in stairs)):
            height = {
                corner: (rank, sign * step)
                for germ, rank, sign in zip(germs, ranks, upward, strict=True)
                for step, corner in enumerate(germ)
            }
            here = [*over_faces(found, darts, height), *along_parts(sides, darts, height)]
            if len(set(here)) == len(dict(here)):
                yield dict(here)


def over_faces(
    found: TouchingDrawing, darts: Sequence[int], height: dict[Corner, Height]
) -> Iterator[tuple[Shared, Order]]:
    """The order of the sheets over the face in each sector."""
    for sector, dart in enumerate(darts):
        face = found.cell_of_dart[dart]
        sheets = [(0, sheet) for sheet in range(found.winding[face])]
        yield ("face", face), tuple(sorted(sheets, key=lambda named, at=sector: height[at, named[1]]))


def along_parts(
    sides: dict[int, Sides], darts: Sequence[int], height: dict[Corner, Height]
) -> Iterator[tuple[Shared, Order]]:
    """The order of the sheets that have each part: those on its left (0, sheet), and those on its right that end."""
    for sector, dart in enumerate(darts):
        on_left, on_right = sides[dart // 2]
        here = [(0, sheet) for sheet in range(len(on_left))]
        here += [(1, sheet) for sheet, beyond in enumerate(on_right) if beyond < 0]
        beside = (sector, (sector - 1) % len(darts))
        places = beside if dart % 2 == 0 else beside[::-1]
        yield ("part", dart // 2), tuple(sorted(here, key=lambda named, at=places: height[at[named[0]], named[1]]))


def count_layerings(found: TouchingDrawing, sides: dict[int, Sides]) -> int:
    """The number of ways to order the germs at all nodes that agree along all parts and over all faces."""
    choices = [list(orders_at(found, sides, node)) for node in range(len(found.nodes))]

    def extend(known: dict[Shared, Order], depth: int) -> int:
        if depth == len(choices):
            return 1
        agreeing = (order for order in choices[depth] if all(known.get(at, row) == row for at, row in order.items()))
        return sum(extend(known | order, depth + 1) for order in agreeing)

    return extend({}, 0)


def count_layered_surfaces(loops: Sequence[Sequence[Point]], cusps: Sequence[Sequence[int]] = ()) -> int:
    """The number of layerings of all surfaces that an outline bounds as it is."""
    found = touching_drawing(loops, cusps)
    return sum(count_layerings(found, sides) for sides in surfaces(found))
