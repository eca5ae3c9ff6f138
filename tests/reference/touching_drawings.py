"""Drawings that touch themselves, as they are: nodes, parts of edges between them, faces; all surfaces over the faces.

Nothing is moved. All edges are cut where they meet; a *part* between two nodes is run by any number of *strands*, in
either direction. Loops are tied together by segments that no strand runs along, so that all bounded faces are disks.

A surface puts w(f) *sheets* over each face f. Over a part every sheet on either side is glued to one on the other side,
or ends at one of the strands that have that side on their left; at each strand one sheet ends, its *own*. Cut a small
disk round a node into sectors: there lie corners of sheets, glued across the parts. Each must belong to a whole disk,
which closes after one turn; or to a corner of the boundary, which starts at the strand that leaves the node, turns
counter-clockwise to the strand that comes in before it, less than once, and m times more at a cusp of index m. Such
families are the immersed surfaces with this boundary and the angles that one sees.
"""

from collections import defaultdict
from collections.abc import Iterator, Sequence
from functools import cmp_to_key
from itertools import pairwise, permutations
from typing import NamedTuple

from reference.crossings import Point, cross, dot, edges, minus, side
from reference.outline_gluings import dual_tree, edge_order


class TouchingDrawing(NamedTuple):
    """A drawing cut at its nodes. Dart 2e runs along part e, dart 2e + 1 back.

    around[i]: the darts that leave node i, counter-clockwise. cell_of_dart: the face on the left of each; 0 is the
    unbounded one. winding: of each face. strands: the dart that each strand runs along. following: the next strand of
    its loop. index: of the cusp where each strand ends, mostly 0.
    """

    nodes: tuple[Point, ...]
    around: tuple[tuple[int, ...], ...]
    cell_of_dart: tuple[int, ...]
    winding: tuple[int, ...]
    strands: tuple[int, ...]
    following: tuple[int, ...]
    index: tuple[int, ...]

    @property
    def n_edges(self) -> int:
        """The number of parts."""
        return len(self.cell_of_dart) // 2

    def left(self, part: int) -> int:
        """The face on the left of a part."""
        return self.cell_of_dart[2 * part]

    def right(self, part: int) -> int:
        """The face on the right of a part."""
        return self.cell_of_dart[2 * part + 1]


# ---- nodes and faces -------------------------------------------------------------------------------------------------


def touching_drawing(loops: Sequence[Sequence[Point]], cusps: Sequence[Sequence[int]] = ()) -> TouchingDrawing:
    """The drawing of some loops, none of which has the same vertex twice in a row."""
    every = [edge for loop in loops for edge in edges(loop)]
    ties = [(loops[0][0], loop[0]) for loop in loops[1:] if loop[0] != loops[0][0]]
    chains = [chain(edge, every + ties) for edge in every + ties]
    nodes = sorted({node for nodes in chains for node in nodes})
    ends = sorted({tuple(sorted(part)) for nodes in chains for part in pairwise(nodes)})
    dart = {part: 2 * i for i, part in enumerate(ends)} | {part[::-1]: 2 * i + 1 for i, part in enumerate(ends)}
    around = [sorted_round(node, {q: dart[p, q] for p, q in dart if p == node}) for node in nodes]
    strands, following, index = strands_of(loops, cusps, chains, dart)
    cell_of_dart = faces(around, {d: part for part, d in dart.items()})
    winding = windings(cell_of_dart, strands)
    return TouchingDrawing(tuple(nodes), tuple(around), cell_of_dart, winding, strands, following, index)


def chain(edge: tuple[Point, Point], others: Sequence[tuple[Point, Point]]) -> list[Point]:
    """All nodes on an edge, from its start to its end."""
    p, q = edge
    found = {p, q}
    for r, s in others:
        at_r, at_s = side(p, q, r), side(p, q, s)
        found |= {end for end, at in ((r, at_r), (s, at_s)) if at == 0 and dot(minus(p, end), minus(q, end)) <= 0}
        if at_r * at_s < 0 and side(r, s, p) * side(r, s, q) < 0:
            along, across = minus(q, p), minus(s, r)
            share = cross(minus(r, p), across) / cross(along, across)
            found.add((p[0] + share * along[0], p[1] + share * along[1]))
    return sorted(found, key=lambda node: dot(minus(node, p), minus(q, p)))


def sorted_round(node: Point, darts: dict[Point, int]) -> tuple[int, ...]:
    """The darts that leave a node for others, counter-clockwise from east."""

    def is_below(v: Point) -> bool:
        return v[1] < 0 or (v[1] == 0 and v[0] < 0)

    def compare(a: Point, b: Point) -> int:
        u, v = minus(a, node), minus(b, node)
        if is_below(u) != is_below(v):
            return 1 if is_below(u) else -1
        turn = cross(u, v)
        return (turn < 0) - (turn > 0)

    return tuple(darts[end] for end in sorted(darts, key=cmp_to_key(compare)))


def strands_of(
    loops: Sequence[Sequence[Point]],
    cusps: Sequence[Sequence[int]],
    chains: Sequence[Sequence[Point]],
    dart: dict[tuple[Point, Point], int],
) -> tuple[tuple[int, ...], tuple[int, ...], tuple[int, ...]]:
    """The dart of each strand, the next strand of its loop, and the index of the cusp where it ends."""
    strands, following, index, edge = [], [], [], 0
    for number, loop in enumerate(loops):
        first = len(strands)
        for vertex in range(len(loop)):
            parts = list(pairwise(chains[edge]))
            strands += [dart[part] for part in parts]
            at_end = cusps[number][(vertex + 1) % len(loop)] if cusps else 0
            index += [0] * (len(parts) - 1) + [at_end]
            edge += 1
        following += [*range(first + 1, len(strands)), first]
    return tuple(strands), tuple(following), tuple(index)


def faces(around: Sequence[Sequence[int]], ends: dict[int, tuple[Point, Point]]) -> tuple[int, ...]:
    """The face on the left of each dart. All hangs together; so the outer face alone has a boundary run clockwise."""
    following = {dart ^ 1: darts[i - 1] for darts in around for i, dart in enumerate(darts)}
    cell, count = [-1] * len(ends), 0
    for start in range(len(ends)):
        if cell[start] < 0:
            orbit = [start]
            while (dart := following[orbit[-1]]) != start:
                orbit.append(dart)
            is_outer = sum(cross(*ends[dart]) for dart in orbit) <= 0
            count += not is_outer
            for dart in orbit:
                cell[dart] = 0 if is_outer else count
    assert len(around) - len(ends) // 2 + count + 1 == 2
    return tuple(cell)


def windings(cell_of_dart: Sequence[int], strands: Sequence[int]) -> tuple[int, ...]:
    """The winding number of each face, by flood fill from the outer one."""
    winding, queue = {0: 0}, [0]
    while queue:
        here = queue.pop()
        for dart, cell in enumerate(cell_of_dart):
            beyond = cell_of_dart[dart ^ 1]
            step = strands.count(dart ^ 1) - strands.count(dart)
            if cell == here and beyond not in winding:
                winding[beyond] = winding[here] + step
                queue.append(beyond)
            assert cell != here or winding[beyond] == winding[here] + step
    return tuple(winding[cell] for cell in range(len(winding)))


# ---- surfaces over the faces -----------------------------------------------------------------------------------------

Sides = tuple[tuple[int, ...], tuple[int, ...]]
"""For each sheet on the left of a part, and for each on its right: the one beyond, or -1 - s if it ends at strand s."""


def all_sides(found: TouchingDrawing, part: int) -> list[Sides]:
    """All ways in which the sheets beside a part are glued or end."""
    left, right = (found.winding[face] for face in (found.left(part), found.right(part)))
    forward, backward = (strands_along(found, dart) for dart in (2 * part, 2 * part + 1))
    if left < len(forward) or right < len(backward):
        return []
    return [
        glued(owns, others, images)
        for owns in own_sheets(left, forward)
        for others in own_sheets(right, backward)
        for images in permutations(range(right - len(backward)))
    ]


def strands_along(found: TouchingDrawing, dart: int) -> list[int]:
    """The strands that run along a dart."""
    return [strand for strand, run in enumerate(found.strands) if run == dart]


def own_sheets(count: int, strands: Sequence[int]) -> list[tuple[int | None, ...]]:
    """All ways in which some of the sheets on a side end at its strands: -1 - strand, or None where they go on."""
    ends = [-1 - strand for strand in strands]
    return [
        tuple(ends[chosen.index(sheet)] if sheet in chosen else None for sheet in range(count))
        for chosen in permutations(range(count), len(ends))
    ]


def glued(left: Sequence[int | None], right: Sequence[int | None], images: Sequence[int]) -> Sides:
    """The sides of a part whose sheets that go on are glued: the i-th on the left to number images[i] on the right."""
    going = [[sheet for sheet, end in enumerate(side) if end is None] for side in (left, right)]
    beyond = {sheet: going[1][images[i]] for i, sheet in enumerate(going[0])}
    back = {other: sheet for sheet, other in beyond.items()}
    on_left = tuple(beyond[sheet] if end is None else end for sheet, end in enumerate(left))
    return on_left, tuple(back[sheet] if end is None else end for sheet, end in enumerate(right))


def across(sides: dict[int, Sides], dart: int, sheet: int) -> int:
    """What lies on the left of a dart beyond a sheet on its right: a sheet, or -1 - the strand that ends it."""
    return sides[dart // 2][(dart + 1) % 2][sheet]


def corner_of_boundary(
    found: TouchingDrawing, sides: dict[int, Sides], node: int, strand: int
) -> tuple[list[tuple[int, int]], int]:
    """The corners (sector, sheet) between strands, from the one that leaves; and the one at which they end.

    Sector i lies on the left of dart i.
    """
    darts, leaving = found.around[node], found.strands[strand]
    place, sheet = darts.index(leaving), sides[leaving // 2][leaving % 2].index(-1 - strand)
    walk = [(place, sheet)]
    while True:
        place = (place + 1) % len(darts)
        sheet = across(sides, darts[place], sheet)
        if sheet < 0:
            return walk, -1 - sheet
        walk.append((place, sheet))


def fits(found: TouchingDrawing, sides: dict[int, Sides], node: int) -> bool:
    """Whether the gluings of the parts at a node obey the rule."""
    darts = found.around[node]
    arriving = [strand for strand, dart in enumerate(found.strands) if dart ^ 1 in darts]
    on_boundary: set[tuple[int, int]] = set()
    for strand in arriving:
        leaving = found.following[strand]
        walk, end = corner_of_boundary(found, sides, node, leaving)
        seen = (darts.index(found.strands[strand] ^ 1) - darts.index(found.strands[leaving])) % len(darts)
        if end != strand or len(walk) != (seen or len(darts)) + found.index[strand] * len(darts):
            return False
        on_boundary.update(walk)
    corners = [(i, s) for i, dart in enumerate(darts) for s in range(found.winding[found.cell_of_dart[dart]])]
    return all(is_whole_disk(sides, darts, corner) for corner in corners if corner not in on_boundary)


def is_whole_disk(sides: dict[int, Sides], darts: Sequence[int], corner: tuple[int, int]) -> bool:
    """Whether the corners of sheets close after one turn."""
    place, sheet = corner
    for i in range(len(darts)):
        sheet = across(sides, darts[(place + 1 + i) % len(darts)], sheet)
        if sheet < 0:
            return False
    return sheet == corner[1]


def one_of_each_class(found: TouchingDrawing) -> list[list[Sides]]:
    """For every part the ways to try: each surface comes up in one numbering of its sheets.

    Walk a tree of the faces outward. Over each link the sheets of the child can be numbered in exactly one way such
    that those that are glued come first, in the order of the parent's, and then those that end, by strand.
    """
    choices = [all_sides(found, part) for part in range(found.n_edges)]
    for part, _, child in dual_tree(found):
        of_child = 0 if child == found.left(part) else 1
        choices[part] = [sides for sides in choices[part] if is_numbered(sides[of_child])]
    return choices


def is_numbered(sheets: Sequence[int]) -> bool:
    """Whether the sheets that go on come first, in order, and then those that end."""
    return list(sheets) == [s for s in sorted(sheets) if s >= 0] + [s for s in sorted(sheets, reverse=True) if s < 0]


def surfaces(found: TouchingDrawing) -> Iterator[dict[int, Sides]]:
    """All surfaces up to renaming of sheets, by backtracking; none where a winding number is negative."""
    if min(found.winding) < 0:
        return
    order, choices = edge_order(found), one_of_each_class(found)
    complete: dict[int, list[int]] = defaultdict(list)
    for node, darts in enumerate(found.around):
        complete[max(order.index(dart // 2) for dart in darts)].append(node)

    def extend(sides: dict[int, Sides], depth: int) -> Iterator[dict[int, Sides]]:
        if depth == len(order):
            yield dict(sides)
            return
        for choice in choices[order[depth]]:
            sides[order[depth]] = choice
            if all(fits(found, sides, node) for node in complete[depth]):
                yield from extend(sides, depth + 1)
        sides.pop(order[depth], None)

    yield from extend({}, 0)
