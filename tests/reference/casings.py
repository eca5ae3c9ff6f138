"""All layered disks of a curve by trying over and under at every crossing: 2^k casings, each settled by one walk.

Along the curve the level of the own sheet changes only at crossings, and only where it passes over: by one sheet less
below it where it leaves the region on the left of the other strand, by one more where it enters. A border of the
unbounded cell has level 1.
"""

from collections.abc import Iterator, Sequence
from itertools import product

from reference.planar_maps import Corner, GaussCode, corners, left_and_right, may_bound_disk, outer_cell, windings


def walk(code: GaussCode, found: Sequence[Corner], a_is_over: Sequence[bool]) -> dict[int, int]:
    """The level of every border, going once round the curve; the visit to a crossing begins the border after it."""
    change = {}
    for corner, a_over in zip(found, a_is_over, strict=True):
        change[corner.a_bottom], change[corner.b_top] = -int(a_over), int(not a_over)
    borders = len(code.partner)
    start = next(border for border, (_, right) in enumerate(left_and_right(code)) if right == outer_cell(code))
    level = {start: 1}
    for step in range(1, borders):
        border = (start + step) % borders
        level[border] = level[(border - 1) % borders] + change[border]
    return level


def fits(code: GaussCode, found: Sequence[Corner], a_is_over: Sequence[bool], level: dict[int, int]) -> bool:
    """Whether the levels exist over their cells, are as above and below as the casing says, and change as it says."""
    winding = windings(code)
    exist = all(1 <= level[border] <= winding[left] for border, (left, _) in enumerate(left_and_right(code)))
    return exist and all(
        (level[corner.a_top] > level[corner.b_top]) == a_over
        and level[corner.a_top] != level[corner.b_top]
        and level[corner.a_bottom] == level[corner.a_top] - a_over
        and level[corner.b_bottom] == level[corner.b_top] - (not a_over)
        for corner, a_over in zip(found, a_is_over, strict=True)
    )


def casing_solutions(code: GaussCode) -> Iterator[tuple[int, ...]]:
    """All layered disks of a curve with crossings, each as the level of the own sheet of every border."""
    found = corners(code)
    if not found or not may_bound_disk(code):
        return
    for a_is_over in product((False, True), repeat=len(found)):
        level = walk(code, found, a_is_over)
        if fits(code, found, a_is_over, level):
            yield tuple(level[border] for border in range(len(level)))
