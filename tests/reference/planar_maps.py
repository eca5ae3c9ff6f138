"""Generic closed plane curves as signed Gauss codes: cells, windings, turning number, and the census of all curves.

A curve with k crossings passes its crossings in 2k *visits*, numbered along the curve. Border i runs from visit i to
visit i + 1 (mod 2k); dart 2i is border i walked forward, dart 2i + 1 backward. With k = 0 there is one border, 0.
"""

from collections import deque
from collections.abc import Iterator
from functools import lru_cache
from itertools import permutations, product
from typing import NamedTuple


class GaussCode(NamedTuple):
    """A closed curve in the plane.

    Visit p meets visit partner[p]; ccw[p] says that there the other strand crosses from right to left;
    `outer` is a dart with the unbounded cell on its left.
    """

    partner: tuple[int, ...]
    ccw: tuple[bool, ...]
    outer: int


CIRCLE = GaussCode((), (), 1)


def gauss_code(partner, ccw, outer) -> GaussCode:
    """The code with plain Python entries, from any sequences (arrays, lists, 0/1 signs)."""
    return GaussCode(tuple(int(p) for p in partner), tuple(bool(c) for c in ccw), int(outer))


def border_count(code: GaussCode) -> int:
    """A closed curve with k > 0 crossings has 2k borders, one without crossings has one."""
    return max(1, len(code.partner))


def next_dart(partner: tuple[int, ...], ccw: tuple[bool, ...], dart: int) -> int:
    """The dart that follows when walking with the cell on the left: at the crossing turn left.

    To the left lies the other strand's way out if it crosses us from right to left, else its way in, walked backward.
    Walking our own strand backward swaps right and left.
    """
    if not partner:
        return dart
    border, backward = divmod(dart, 2)
    visit = border if backward else (border + 1) % len(partner)
    other = partner[visit]
    other_goes_left = ccw[visit] != bool(backward)
    return 2 * other if other_goes_left else 2 * ((other - 1) % len(partner)) + 1


def cells(partner: tuple[int, ...], ccw: tuple[bool, ...]) -> list[tuple[int, ...]]:
    """All cells of the surface that the code describes, each as the darts that have it on their left."""
    unseen = set(range(max(2, 2 * len(partner))))
    found = []
    while unseen:
        start = min(unseen)
        walk = [start]
        while (dart := next_dart(partner, ccw, walk[-1])) != start:
            walk.append(dart)
        unseen.difference_update(walk)
        found.append(tuple(walk))
    return found


def cell_of_dart(code: GaussCode) -> list[int]:
    """For every dart the number of the cell on its left (numbers as in `cells`)."""
    cell = [0] * (2 * border_count(code))
    for number, darts in enumerate(cells(code.partner, code.ccw)):
        for dart in darts:
            cell[dart] = number
    return cell


def outer_cell(code: GaussCode) -> int:
    """The number of the unbounded cell."""
    return cell_of_dart(code)[code.outer]


def left_and_right(code: GaussCode) -> list[tuple[int, int]]:
    """For every border the cell on its left and the cell on its right."""
    cell = cell_of_dart(code)
    return [(cell[2 * border], cell[2 * border + 1]) for border in range(border_count(code))]


def windings(code: GaussCode) -> list[int]:
    """Winding number of every cell, by flood fill: 0 in the unbounded cell, one more on the left of each border."""
    sides = left_and_right(code)
    winding = {outer_cell(code): 0}
    queue = deque(winding)
    while queue:
        here = queue.popleft()
        for left, right in sides:
            for neighbour, step in ((left, +1),) * (here == right) + ((right, -1),) * (here == left):
                if neighbour not in winding:
                    winding[neighbour] = winding[here] + step
                    queue.append(neighbour)
    assert all(winding[left] == winding[right] + 1 for left, right in sides)
    return [winding[cell] for cell in range(len(winding))]


def turning_number(code: GaussCode) -> int:
    """Whitney's formula.

    Start on a border with the unbounded cell on its right. Every crossing counts -1 if the strand met first is crossed
    from right to left, else +1; add 1. If the unbounded cell lies on the left instead, look at the mirror image.
    """
    start, backward = divmod(code.outer, 2)
    mirror = 1 if backward else -1
    visits = [(start + 1 + step) % border_count(code) for step in range(len(code.partner))]
    firsts = [p for position, p in enumerate(visits) if code.partner[p] in visits[position + 1 :]]
    return mirror + sum(-1 if code.ccw[p] else +1 for p in firsts)


def turning_number_from_windings(code: GaussCode) -> int:
    """Integral of the winding number against the Euler characteristic, independent of Whitney's formula.

    Cells count with their winding, borders and crossings with the mean of the cells around them, borders negatively.
    """
    winding = windings(code)
    total = sum(2 * w for w in winding)
    if code.partner:
        total -= sum(winding[left] + winding[right] for left, right in left_and_right(code))
        total += sum(2 * (winding[corner.top] - 1) for corner in corners(code))
    return total // 2


class Corner(NamedTuple):
    """A crossing of strands a and b, where b crosses a from right to left.

    Around it lie, counter-clockwise from the cell left of both strands: `top` (winding w + 2), `left_of_b` (w + 1),
    `bottom` (w), `left_of_a` (w + 1). Each strand is split into the border beside the top and one beside the bottom.
    """

    top: int
    left_of_a: int
    left_of_b: int
    bottom: int
    a_top: int
    a_bottom: int
    b_top: int
    b_bottom: int


def corners(code: GaussCode) -> list[Corner]:
    """Every crossing, seen with strand a running east and strand b running north.

    So a comes in between top (north-west) and left_of_b (south-west), and goes out between left_of_a (north-east) and
    bottom (south-east); b comes in between left_of_b and bottom and goes out between top and left_of_a.
    """
    sides = left_and_right(code)
    borders = len(code.partner)
    found = []
    for a in range(borders):
        if code.ccw[a]:
            b = code.partner[a]
            a_in, a_out, b_in, b_out = (a - 1) % borders, a, (b - 1) % borders, b
            (top, left_of_b), (left_of_a, bottom) = sides[a_in], sides[a_out]
            assert sides[b_in] == (left_of_b, bottom)
            assert sides[b_out] == (top, left_of_a)
            found.append(Corner(top, left_of_a, left_of_b, bottom, a_in, a_out, b_out, b_in))
    return found


def with_smallest_outer_dart(code: GaussCode) -> GaussCode:
    """The same curve, the unbounded cell given by the smallest of its darts."""
    dart, smallest = next_dart(code.partner, code.ccw, code.outer), code.outer
    while dart != code.outer:
        smallest = min(smallest, dart)
        dart = next_dart(code.partner, code.ccw, dart)
    return code._replace(outer=smallest)


def rotated(code: GaussCode) -> GaussCode:
    """The same curve, started one visit later: visit p becomes p - 1."""
    borders = len(code.partner)
    if not borders:
        return code
    partner = tuple((code.partner[(p + 1) % borders] - 1) % borders for p in range(borders))
    return with_smallest_outer_dart(GaussCode(partner, code.ccw[1:] + code.ccw[:1], (code.outer - 2) % (2 * borders)))


def reflected(code: GaussCode) -> GaussCode:
    """The mirror image: all signs change, and what was on the left of a border is on its right."""
    return with_smallest_outer_dart(GaussCode(code.partner, tuple(not c for c in code.ccw), code.outer ^ 1))


def reversed_code(code: GaussCode) -> GaussCode:
    """The curve run backward from the same first point: visit p becomes 2k - 1 - p, border i becomes 2k - 2 - i."""
    borders = border_count(code)
    partner = tuple(borders - 1 - p for p in reversed(code.partner))
    border, backward = divmod(code.outer, 2)
    dart = 2 * ((borders - 2 - border) % borders) + (1 - backward)
    return with_smallest_outer_dart(GaussCode(partner, tuple(reversed(code.ccw)), dart))


def oriented(code: GaussCode) -> GaussCode:
    """The curve with the orientation in which its turning number is not negative."""
    return reversed_code(code) if turning_number(code) < 0 else code


def spherical_codes(crossings: int) -> Iterator[tuple[tuple[int, ...], tuple[bool, ...]]]:
    """Every (partner, ccw) that lies on the sphere: Euler's formula asks for k + 2 cells.

    A closed curve on the sphere meets itself an even number of times between the two visits of a crossing, so an even
    visit always meets an odd one. All such pairings and all signs are tried.
    """
    for odds in permutations(range(1, 2 * crossings, 2)):
        partner = [0] * (2 * crossings)
        for even, odd in zip(range(0, 2 * crossings, 2), odds, strict=True):
            partner[even], partner[odd] = odd, even
        for signs in product((False, True), repeat=crossings):
            ccw = tuple(signs[p // 2] if p % 2 == 0 else not signs[partner[p] // 2] for p in range(2 * crossings))
            if len(cells(tuple(partner), ccw)) == crossings + 2:
                yield tuple(partner), ccw


def plane_codes(crossings: int) -> Iterator[GaussCode]:
    """Every code of a plane curve, with every start: each spherical code with each of its cells as unbounded one."""
    for partner, ccw in spherical_codes(crossings):
        for darts in cells(partner, ccw):
            yield GaussCode(partner, ccw, min(darts))


def rotations(code: GaussCode) -> list[GaussCode]:
    """The same oriented curve from every start."""
    found = [code]
    for _ in range(border_count(code) - 1):
        found.append(rotated(found[-1]))
    return found


def symmetric_copies(code: GaussCode) -> set[GaussCode]:
    """The curve, its mirror image, both reversed, each from every start."""
    variants = (code, reflected(code), reversed_code(code), reversed_code(reflected(code)))
    return {copy for variant in variants for copy in rotations(variant)}


@lru_cache
def census(crossings: int) -> tuple[GaussCode, ...]:
    """One code for every generic closed plane curve with that many crossings, up to reflection and reversal.

    The representatives are oriented: turning number >= 0.
    """
    seen: set[GaussCode] = set()
    representatives = []
    for code in plane_codes(crossings):
        if code not in seen:
            seen |= symmetric_copies(code)
            representatives.append(oriented(code))
    return tuple(representatives)


@lru_cache
def nonnegative_curves(crossings: int) -> tuple[GaussCode, ...]:
    """All plane curves up to reflection, in both directions, that have no negative winding number."""
    both = {copy for code in census(crossings) for copy in (code, reversed_code(code))}
    return tuple(code for code in sorted(both) if min(windings(code)) >= 0)


@lru_cache
def oriented_census(crossings: int, turning: int = 1) -> tuple[GaussCode, ...]:
    """One code for every oriented curve with that turning number; mirror images and reversed curves count apart."""
    seen: set[GaussCode] = set()
    representatives = []
    for code in plane_codes(crossings):
        if code not in seen and turning_number(code) == turning:
            seen.update(rotations(code))
            representatives.append(code)
    return tuple(representatives)


def may_bound_disk(code: GaussCode) -> bool:
    """Necessary conditions on an oriented curve: turning number 1 and no negative winding number."""
    return turning_number(code) == 1 and min(windings(code)) >= 0
