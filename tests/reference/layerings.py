"""All layerings by brute force: of a given immersion, and independently from the curve alone.

A layering numbers the sheets over each cell 1..w from below such that all gluings preserve the order.
"""

from collections.abc import Iterator, Sequence
from itertools import permutations

from reference.gluings import (
    Gluing,
    Row,
    border_order,
    borders_at,
    dual_tree,
    first_sheets,
    key_of,
    right_to_left,
    sheets_by_cell,
)
from reference.planar_maps import Corner, GaussCode, corners, gauss_code, left_and_right, may_bound_disk, windings


def preserves_order(glued: dict[int, int], level: dict[int, int]) -> bool:
    """Whether the sheets on the left lie in the same order as the sheets on the right that they are glued to."""
    upward = sorted(glued, key=lambda sheet: level[sheet])
    images = [level[glued[sheet]] for sheet in upward]
    return images == sorted(images)


def layerings(
    partner: Sequence[int], ccw: Sequence[bool], outer: int, own_sheet: Sequence[int], rows: Sequence[Row]
) -> list[dict[int, int]]:
    """All layerings of an immersion, each as {sheet: level}: every order over every cell, checked at every border."""
    code = gauss_code(partner, ccw, outer)
    sheets, up, sides = sheets_by_cell(code, own_sheet, rows), right_to_left(own_sheet, rows), left_and_right(code)
    order = [link.child for link in dual_tree(code)]
    checks = [
        [e for e, pair in enumerate(sides) if cell in pair and set(pair) <= set(order[: depth + 1])]
        for depth, cell in enumerate(order)
    ]

    def extend(level: dict[int, int], depth: int) -> Iterator[dict[int, int]]:
        if depth == len(order):
            yield level
            return
        for upward in permutations(sorted(sheets[order[depth]])):
            more = level | {sheet: position for position, sheet in enumerate(upward, start=1)}
            if all(preserves_order(up[border], more) for border in checks[depth]):
                yield from extend(more, depth + 1)

    return list(extend({}, 0))


def is_layering(code: GaussCode, own_sheet: Sequence[int], rows: Sequence[Row], level: dict[int, int]) -> bool:
    """Whether levels are 1..w over every cell and every gluing preserves the order."""
    sheets = sheets_by_cell(code, own_sheet, rows).values()
    numbered = all(sorted(level[sheet] for sheet in group) == list(range(1, len(group) + 1)) for group in sheets)
    return numbered and all(preserves_order(glued, level) for glued in right_to_left(own_sheet, rows))


def border_levels(own_sheet: Sequence[int], level: dict[int, int]) -> tuple[int, ...]:
    """The level of the own sheet of every border; it determines the layering (see `level_solutions`)."""
    return tuple(level[sheet] for sheet in own_sheet)


def levels_agree(corner: Corner, level: dict[int, int]) -> bool:
    """The rule at a crossing: the strands lie at different levels a and b of the top cell, and the lower one of them is
    missing in the cell that it does not bound, so that the higher one is one level lower there."""
    a, b = level[corner.a_top], level[corner.b_top]
    return a != b and level[corner.a_bottom] == a - (b < a) and level[corner.b_bottom] == b - (a < b)


def level_solutions(code: GaussCode) -> list[tuple[int, ...]]:
    """All layered disks of the curve, without an immersion: the level of the own sheet of every border.

    With the sheets of each cell numbered from below, every gluing preserves the order, so it is determined by the level
    it misses: one number in 1..w(left cell) per border. All values are tried, the rule checked at every crossing.
    """
    if not may_bound_disk(code):
        return []
    winding, sides, order = windings(code), left_and_right(code), border_order(code)
    complete: list[list[Corner]] = [[] for _ in order]
    for corner in corners(code):
        complete[max(order.index(border) for border in borders_at(corner))].append(corner)

    def extend(level: dict[int, int], depth: int) -> Iterator[tuple[int, ...]]:
        if depth == len(order):
            yield tuple(level[border] for border in range(len(order)))
            return
        border = order[depth]
        for choice in range(1, winding[sides[border][0]] + 1):
            level[border] = choice
            if all(levels_agree(corner, level) for corner in complete[depth]):
                yield from extend(level, depth + 1)

    return list(extend({}, 0))


def gluing_of_levels(code: GaussCode, levels: Sequence[int]) -> Gluing:
    """The immersion below a layered disk: over each border the increasing injection that misses the given level."""
    first = first_sheets(code)
    own, rows = [], []
    for border, (left, right) in enumerate(left_and_right(code)):
        own.append(first[left] + levels[border] - 1)
        images = [i for i in range(windings(code)[left]) if i != levels[border] - 1]
        rows += [(border, first[right] + i, first[left] + image) for i, image in enumerate(images)]
    return Gluing(tuple(own), tuple(rows))


def level_solutions_by_immersion(code: GaussCode) -> dict[tuple, set[tuple[int, ...]]]:
    """The layered disks of the curve, grouped by the key of the immersion below them."""
    groups: dict[tuple, set[tuple[int, ...]]] = {}
    for levels in level_solutions(code):
        groups.setdefault(key_of(*code, *gluing_of_levels(code, levels)), set()).add(levels)
    return groups


def layerings_by_immersion(code: GaussCode, immersions: Sequence[Gluing]) -> dict[tuple, set[tuple[int, ...]]]:
    """The layerings of the given immersions, by key, each as the levels of the own sheets; keys without any too."""
    return {
        key_of(*code, own, rows): {border_levels(own, level) for level in layerings(*code, own, rows)}
        for own, rows in immersions
    }
