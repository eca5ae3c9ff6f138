"""The least self-intersections of an immersed disk, by trying all orders of the sheets over every cell.

Where two sheets glued along a border lie in one order on its right and in the other one on its left, they pass through
each other there, which costs the border's weight.
"""

from collections.abc import Sequence
from itertools import combinations, permutations

from reference.gluings import Row, dual_tree, right_to_left, sheets_by_cell
from reference.planar_maps import GaussCode, gauss_code, left_and_right


def crossed_pairs(glued: dict[int, int], level: dict[int, int]) -> list[tuple[int, int]]:
    """The pairs of sheets on the right of a border that lie the other way round on its left; the lower one first."""
    upward = sorted(glued, key=lambda sheet: level[sheet])
    return [(a, b) for a, b in combinations(upward, 2) if level[glued[a]] > level[glued[b]]]


def intersections(
    own_sheet: Sequence[int], rows: Sequence[Row], level: dict[int, int]
) -> list[tuple[int, tuple[int, int]]]:
    """All (border, pair of sheets on its right) that pass through each other with the given levels."""
    glued = right_to_left(own_sheet, rows)
    return [(border, pair) for border, sheets in enumerate(glued) for pair in crossed_pairs(sheets, level)]


def least_cost(code: GaussCode, own_sheet: Sequence[int], rows: Sequence[Row], weight: Sequence[float]) -> float:
    """The least total weight of borders with a pair of sheets that passes through each other.

    The cells are taken in an order in which most borders are decided early. For each, all orders of its sheets are
    tried that do not cost as much already as the best answer so far.
    """
    code = gauss_code(*code)
    sheets, glued, sides = sheets_by_cell(code, own_sheet, rows), right_to_left(own_sheet, rows), left_and_right(code)
    order = sorted((link.child for link in dual_tree(code)), key=lambda cell: -len(sheets[cell]))
    decided = [
        [border for border, pair in enumerate(sides) if cell in pair and set(pair) <= set(order[: depth + 1])]
        for depth, cell in enumerate(order)
    ]
    best = float("inf")

    def extend(level: dict[int, int], depth: int, cost: float) -> None:
        nonlocal best
        if cost >= best:
            return
        if depth == len(order):
            best = cost
            return
        for upward in permutations(sorted(sheets[order[depth]])):
            more = level | {sheet: position for position, sheet in enumerate(upward, start=1)}
            added = sum(weight[border] * len(crossed_pairs(glued[border], more)) for border in decided[depth])
            extend(more, depth + 1, cost + added)

    extend({}, 0, 0.0)
    return best
