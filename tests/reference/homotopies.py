"""The least area of a contraction by definition: all ways to cut a curve at crossings into self-overlapping loops.

Two cuts must not interleave. Each loop must bound an immersed disk on its left or on its right, and then sweeps each
cell as often as it winds round it, without sign. Weights are those of cells, numbered as in `planar_maps.cells`.
"""

from collections.abc import Iterator, Sequence
from functools import cache
from itertools import combinations

from reference.gluings import immersions
from reference.planar_maps import (
    CIRCLE,
    GaussCode,
    border_count,
    left_and_right,
    outer_cell,
    reversed_code,
    turning_number,
    windings,
)

Cut = tuple[int, int]


def interleave(one: Cut, other: Cut) -> bool:
    """Whether exactly one end of a cut lies between the ends of the other."""
    return (one[0] < other[0] < one[1]) != (one[0] < other[1] < one[1])


def cuttings(code: GaussCode) -> Iterator[tuple[Cut, ...]]:
    """All sets of crossings at which the curve can be cut at once, as their visits."""
    crossings = [(visit, other) for visit, other in enumerate(code.partner) if visit < other]
    for size in range(len(crossings) + 1):
        for cuts in combinations(crossings, size):
            if not any(interleave(one, other) for one, other in combinations(cuts, 2)):
                yield cuts


def loops(code: GaussCode, cuts: Sequence[Cut]) -> list[list[int]]:
    """The borders of each loop in order: at a cut, a loop goes on with the other strand."""
    n = border_count(code)
    ahead = {border: (border + 1) % n for border in range(n)}
    for visit, other in cuts:
        ahead[(visit - 1) % n], ahead[(other - 1) % n] = other, visit
    found, unseen = [], set(range(n))
    while unseen:
        way = [min(unseen)]
        while (border := ahead[way[-1]]) != way[0]:
            way.append(border)
        unseen.difference_update(way)
        found.append(way)
    return found


def loop_windings(code: GaussCode, borders: Sequence[int]) -> list[int]:
    """How often a loop winds round each cell: one more on the left of its borders than on their right."""
    sides = left_and_right(code)
    winding = {outer_cell(code): 0}
    while len(winding) < len(windings(code)):
        for border, (left, right) in enumerate(sides):
            step = int(border in borders)
            if right in winding:
                winding.setdefault(left, winding[right] + step)
            elif left in winding:
                winding.setdefault(right, winding[left] - step)
    return [winding[cell] for cell in range(len(winding))]


def outside(code: GaussCode, borders: Sequence[int]) -> set[int]:
    """The cells that can be reached from the unbounded one without crossing a loop."""
    reached = {outer_cell(code)}
    while True:
        more = {
            cell
            for border, sides in enumerate(left_and_right(code))
            if border not in borders and reached & set(sides)
            for cell in sides
        }
        if more <= reached:
            return reached
        reached |= more


def code_of_loop(code: GaussCode, borders: Sequence[int]) -> GaussCode:
    """The code of a loop alone: of the visits at which it goes straight on, those whose partner it visits, too."""
    n, far = border_count(code), outside(code, borders)
    followed = list(zip(borders, [*borders[1:], borders[0]], strict=True))
    straight = {(here + 1) % n for here, ahead in followed if code.partner and ahead == (here + 1) % n}
    kept = [(here + 1) % n for here, _ in followed if (here + 1) % n in straight]
    kept = [visit for visit in kept if code.partner[visit] in straight]
    darts = []
    passed = 0
    for border in borders:
        own = (passed - 1) % max(len(kept), 1)
        left, right = left_and_right(code)[border]
        darts += [2 * own] * (left in far) + [2 * own + 1] * (right in far)
        passed += (border + 1) % n in kept if code.partner else 0
    if not kept:
        return CIRCLE._replace(outer=darts[0])
    partner = tuple(kept.index(code.partner[visit]) for visit in kept)
    return GaussCode(partner, tuple(code.ccw[visit] for visit in kept), darts[0])


@cache
def is_self_overlapping(code: GaussCode) -> bool:
    """Whether a curve bounds an immersed disk on its left or on its right."""
    way = code if turning_number(code) > 0 else reversed_code(code)
    return turning_number(way) == 1 and min(windings(way)) >= 0 and len(immersions(*way)) > 0


def least_area(code: GaussCode, weights: Sequence[float]) -> float:
    """The least that the loops of a cutting sweep, if all of them bound disks."""
    return min(
        sum(weight * abs(w) for loop in parts for weight, w in zip(weights, loop_windings(code, loop), strict=True))
        for parts in (loops(code, cuts) for cuts in cuttings(code))
        if all(is_self_overlapping(code_of_loop(code, loop)) for loop in parts)
    )
