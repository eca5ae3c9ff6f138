"""All surfaces in space over an outline, none of which cut themselves: levels of borders, by trying all numbers.

With the sheets over each cell numbered 1..w from below, a gluing that keeps the order is determined by the level that
it misses: one number in 1..w(left cell) per border, the level of its own sheet. Over a bridge it changes nothing.
"""

from collections.abc import Callable, Iterator, Sequence
from itertools import permutations

from reference.gluings import Row
from reference.outline_gluings import Phi, dual_tree, edge_order, families, family, sheets_by_cell
from reference.outlines import OutlineCode, OutlineMap, outline_map

Levels = tuple[int, ...]


def agrees(found: OutlineMap, vertex: int, level: dict[int, int]) -> bool:
    """The rule at a crossing, a cusp or the foot of a bridge.

    The strands of a crossing have different levels in its top cell; the higher one has one less past the other. At a
    cusp the surface climbs or falls by one level for each full turn. At a foot nothing happens.
    """
    visits = found.at[vertex]
    if len(visits) == 1:
        (visit,) = visits
        return abs(level[found.before[visit]] - level[found.after[visit]]) == found.index[visit]
    first, second = visits
    a, a_past = level[found.before[first]], level[found.after[first]]
    b, b_past = level[found.after[second]], level[found.before[second]]
    return a != b and a_past == a - (b < a) and b_past == b - (a < b)


def level_solutions(code: OutlineCode) -> list[Levels]:
    """The levels of all borders, in all ways that obey the rules."""
    found = outline_map(code)
    if min(found.winding) < 0:
        return []
    order = [edge for edge in edge_order(found) if edge < found.n_borders]
    borders_at = [{b for v in visits for b in (found.before[v], found.after[v])} for visits in found.at]
    complete: list[list[int]] = [[] for _ in order]
    for vertex, borders in enumerate(borders_at):
        complete[max(map(order.index, borders))].append(vertex)

    def extend(level: dict[int, int], depth: int) -> Iterator[Levels]:
        if depth == len(order):
            yield tuple(level[border] for border in range(found.n_borders))
            return
        for choice in range(1, found.winding[found.left(order[depth])] + 1):
            level[order[depth]] = choice
            if all(agrees(found, vertex, level) for vertex in complete[depth]):
                yield from extend(level, depth + 1)

    return list(extend({}, 0))


def increasing_gluings(found: OutlineMap) -> list[list[Phi]]:
    """For every edge the gluings that keep the order of sheets."""
    choices = []
    for edge in range(found.n_edges):
        sheets = tuple(range(found.winding[found.left(edge)]))
        increasing = [(*(i for i in sheets if i != own), own) for own in sheets]
        choices.append(increasing if edge < found.n_borders else [sheets])
    return choices


def levels_by_gluings(code: OutlineCode) -> list[Levels]:
    """The same by definition: all families of gluings that keep the order and are surfaces."""
    found = outline_map(code)
    if min(found.winding) < 0:
        return []
    return [
        tuple(phi[border][-1] + 1 for border in range(found.n_borders))
        for phi in families(code, increasing_gluings(found))
    ]


def layerings(code: OutlineCode, own_sheet: Sequence[int], rows: Sequence[Row]) -> list[Levels]:
    """The levels of the own sheets in all orders of the sheets over each cell that all gluings of a surface keep."""
    found, phi = outline_map(code), family(code, own_sheet, rows)
    sheets = sheets_by_cell(code, own_sheet, rows)
    cells = [0, *(link.child for link in dual_tree(found))]
    edges_when = [
        [e for e in range(found.n_edges) if {found.left(e), found.right(e)} <= set(cells[: depth + 1])]
        for depth in range(len(cells))
    ]
    keeps = order_keeper(found, phi)

    def extend(order: dict[int, Levels], depth: int) -> Iterator[Levels]:
        if depth == len(cells):
            yield tuple(order[found.left(b)][sheets[found.left(b)].index(own_sheet[b])] for b in range(len(own_sheet)))
            return
        for levels in permutations(range(1, found.winding[cells[depth]] + 1)):
            more = order | {cells[depth]: levels}
            if all(keeps(edge, more) for edge in edges_when[depth]):
                yield from extend(more, depth + 1)

    return list(extend({}, 0))


def order_keeper(found: OutlineMap, phi: dict[int, Phi]) -> Callable[[int, dict[int, Levels]], bool]:
    """Whether the gluing of an edge keeps the order, given the levels of the sheets over its cells."""

    def keeps(edge: int, order: dict[int, Levels]) -> bool:
        right, left = order[found.right(edge)], order[found.left(edge)]
        upward = sorted(range(len(right)), key=lambda sheet: right[sheet])
        images = [left[phi[edge][sheet]] for sheet in upward]
        return images == sorted(images)

    return keeps
