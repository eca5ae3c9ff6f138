"""Outlines as codes: several loops with crossings, cusps and bridges; their cells and winding numbers.

A *visit* is where a loop meets a crossing, or a *mark*: a cusp, or the foot of a bridge. Visits are numbered along the
first loop, then the second and so on; they cut the loops into borders, numbered in the same order, where a loop without
a visit is one border. Bridge j counts as edge number borders + j. Dart 2e is edge e walked forward, 2e + 1 backward.
"""

from collections import deque
from collections.abc import Mapping, Sequence
from functools import lru_cache
from itertools import accumulate
from typing import NamedTuple

from reference.planar_maps import GaussCode


class OutlineCode(NamedTuple):
    """Loops in the plane, with the surface on their left.

    Loop l has visits[l] visits. Visit v meets visit partner[v], itself at a mark; ccw[v] says that there the other
    strand crosses from right to left. index[v] is how many full turns too many the surface makes at a cusp, else 0.
    Bridge j runs across a cell between the visits at which its two darts start; the cell lies on the left of both.
    `outside` has a dart of each boundary cycle of the unbounded cell: that cell lies on its left.
    """

    visits: tuple[int, ...]
    partner: tuple[int, ...]
    ccw: tuple[bool, ...]
    index: tuple[int, ...]
    bridges: tuple[tuple[int, int], ...]
    outside: tuple[int, ...]


class OutlineMap(NamedTuple):
    """The planar map of an outline. Its vertices are crossings and marks.

    before[v], after[v]: the borders that end and start at visit v. around[i]: the darts that leave vertex i, counter-
    clockwise. at[i]: the visits at vertex i. index[v]: that of a cusp at visit v. cell_of_dart: the cell on the left of
    each dart; cell 0 is the unbounded one. winding: the winding number of each cell.
    """

    n_borders: int
    loop_of_border: tuple[int, ...]
    before: tuple[int, ...]
    after: tuple[int, ...]
    around: tuple[tuple[int, ...], ...]
    at: tuple[tuple[int, ...], ...]
    index: tuple[int, ...]
    cell_of_dart: tuple[int, ...]
    winding: tuple[int, ...]

    @property
    def n_edges(self) -> int:
        """Borders and bridges."""
        return len(self.cell_of_dart) // 2

    def left(self, edge: int) -> int:
        """The cell on the left of an edge."""
        return self.cell_of_dart[2 * edge]

    def right(self, edge: int) -> int:
        """The cell on the right of an edge."""
        return self.cell_of_dart[2 * edge + 1]


def of_gauss(code: GaussCode) -> OutlineCode:
    """The outline of one curve."""
    n = len(code.partner)
    return OutlineCode((n,), code.partner, code.ccw, (0,) * n, (), (code.outer,))


def to_gauss(code: OutlineCode) -> GaussCode:
    """The one curve of an outline without marks."""
    assert len(code.visits) == 1
    assert all(partner != visit for visit, partner in enumerate(code.partner))
    return GaussCode(code.partner, code.ccw, code.outside[0])


@lru_cache(maxsize=256)
def outline_map(code: OutlineCode) -> OutlineMap:
    """The planar map; AssertionError if there is none, or if bridges are missing."""
    before, after, loop_of_border = borders_at_visits(code)
    at = [(v,) if v == w else (v, w) for v, w in enumerate(code.partner) if v == w or code.ccw[v]]
    around = [darts_around(code, before, after, visits) for visits in at]
    n_edges = len(loop_of_border) + len(code.bridges)
    orbits = orbits_of(around, n_edges)
    assert_planar(orbits, around, n_edges)
    cell_of_dart = cells_of_darts(orbits, code.outside)
    winding = windings(cell_of_dart, len(loop_of_border))
    return OutlineMap(
        len(loop_of_border), loop_of_border, before, after, tuple(around), tuple(at), code.index, cell_of_dart, winding
    )


def borders_at_visits(code: OutlineCode) -> tuple[tuple[int, ...], tuple[int, ...], tuple[int, ...]]:
    """The borders before and after each visit, and the loop of each border."""
    before, after, loop_of_border = [], [], []
    for loop, count in enumerate(code.visits):
        first = len(loop_of_border)
        after += range(first, first + count)
        before += [first + (i - 1) % count for i in range(count)]
        loop_of_border += [loop] * max(1, count)
    return tuple(before), tuple(after), tuple(loop_of_border)


def darts_around(
    code: OutlineCode, before: Sequence[int], after: Sequence[int], visits: tuple[int, ...]
) -> tuple[int, ...]:
    """The darts that leave a crossing or mark, counter-clockwise; each bridge beside the dart that names its corner."""
    if len(visits) == 2:  # strand a runs east, b north
        a, b = visits
        darts = [2 * after[a], 2 * after[b], 2 * before[a] + 1, 2 * before[b] + 1]
    else:
        darts = [2 * after[visits[0]], 2 * before[visits[0]] + 1]
    n_borders = sum(max(1, count) for count in code.visits)
    for j, (first, second) in enumerate(code.bridges):
        for start, bridge in ((first, 2 * (n_borders + j)), (second, 2 * (n_borders + j) + 1)):
            if start in darts:
                darts.insert(darts.index(start) + 1, bridge)
    return tuple(darts)


def orbits_of(around: Sequence[Sequence[int]], n_edges: int) -> list[tuple[int, ...]]:
    """The boundary cycles of cells: arriving at a vertex, go on with the dart clockwise from the way back.

    A loop without a visit closes at once.
    """
    following = list(range(2 * n_edges))
    for darts in around:
        for i, dart in enumerate(darts):
            following[dart ^ 1] = darts[i - 1]
    unseen, orbits = set(following), []
    while unseen:
        orbit = [min(unseen)]
        while (dart := following[orbit[-1]]) != orbit[0]:
            orbit.append(dart)
        unseen -= set(orbit)
        orbits.append(tuple(orbit))
    return orbits


def assert_planar(orbits: Sequence[Sequence[int]], around: Sequence[Sequence[int]], n_edges: int) -> None:
    """Euler's formula: V - E + F = 2 for every connected part (a loop without a visit counts as having a vertex)."""
    part = list(range(n_edges))
    for darts in around:
        joined = {part[dart // 2] for dart in darts}
        part = [min(joined) if p in joined else p for p in part]
    met = {dart // 2 for darts in around for dart in darts}
    vertices = len(around) + n_edges - len(met)
    assert vertices - n_edges + len(orbits) == 2 * len(set(part)), "the code lies in no plane"


def cells_of_darts(orbits: Sequence[Sequence[int]], outside: Sequence[int]) -> tuple[int, ...]:
    """The cell on the left of each dart: 0 on the outside, the others by their lowest darts."""
    inner = [orbit for orbit in orbits if not set(orbit) & set(outside)]
    cell = [0] * sum(map(len, orbits))
    for number, orbit in enumerate(inner, start=1):
        for dart in orbit:
            cell[dart] = number
    return tuple(cell)


def windings(cell_of_dart: Sequence[int], n_borders: int) -> tuple[int, ...]:
    """Winding number of each cell, by flood fill from the unbounded cell; bridges change nothing."""
    winding, queue = {0: 0}, deque([0])
    while queue:
        here = queue.popleft()
        for dart, cell in enumerate(cell_of_dart):
            beyond = cell_of_dart[dart ^ 1]
            if cell == here and beyond not in winding:
                winding[beyond] = winding[here] + step_across(dart, n_borders)
                queue.append(beyond)
    assert set(winding) == set(cell_of_dart), "no bridge leads to some loops"
    for dart, cell in enumerate(cell_of_dart):
        assert winding[cell_of_dart[dart ^ 1]] == winding[cell] + step_across(dart, n_borders)
    return tuple(winding[cell] for cell in range(len(winding)))


def step_across(dart: int, n_borders: int) -> int:
    """By how much the winding number changes across an edge, from the left of a dart of it to its right."""
    return 0 if dart // 2 >= n_borders else 1 if dart % 2 else -1


# ---- cusps set on borders, and drawn out as curls --------------------------------------------------------------------

Block = Sequence[tuple[int, bool, int]]
"""Visits to put in: the place of the partner in the block, ccw, index."""


def with_cusps(code: OutlineCode, sites: Sequence[tuple[int, int]]) -> OutlineCode:
    """The outline with cusps: (border, index) each, several on one border in the order in which they are given."""
    return with_blocks(code, [(border, [(0, False, index)]) for border, index in sites])


def with_curls(code: OutlineCode, sites: Sequence[tuple[int, int]]) -> OutlineCode:
    """The same with each cusp drawn out, a small disk round it cut off.

    There the outline goes round the cusp clockwise as often as its index says, ever nearer, and then straight away: it
    crosses itself in x1, x2, ..., x2, x1, where the way out crosses the way in from right to left.
    """
    return with_blocks(code, [(border, [(2 * m - 1 - i, i < m, 0) for i in range(2 * m)]) for border, m in sites if m])


def with_blocks(code: OutlineCode, sites: Sequence[tuple[int, Block]]) -> OutlineCode:
    """The outline with more visits on some borders."""
    _, after, loop_of_border = borders_at_visits(code)
    on: Mapping[int, list[Block]] = {border: [] for border in range(len(loop_of_border))}
    for border, block in sites:
        on[border].append(block)
    visit_of = {border: visit for visit, border in enumerate(after)}
    more = {border: sum(map(len, blocks)) for border, blocks in on.items()}
    place = place_of_old_visits(visit_of, more)
    partner, ccw, index = [], [], []
    for border, blocks in on.items():
        if border in visit_of:
            visit = visit_of[border]
            partner.append(place[code.partner[visit]])
            ccw.append(code.ccw[visit])
            index.append(code.index[visit])
        for block in blocks:
            partner += [len(partner) + other for other, _, _ in block]
            ccw += [sign for _, sign, _ in block]
            index += [turns for _, _, turns in block]
    pieces = [more[border] + (1 if border in visit_of else 0) for border in on]
    ends = list(accumulate(max(1, count) for count in pieces))

    def moved(dart: int) -> int:
        border, backward = divmod(dart, 2)
        return 2 * (ends[border] - 1) + 1 if backward else 2 * (ends[border] - max(1, pieces[border]))

    of_loop = [[border for border in on if loop_of_border[border] == loop] for loop in range(len(code.visits))]
    return OutlineCode(
        tuple(sum(pieces[border] for border in borders) for borders in of_loop),
        tuple(partner),
        tuple(ccw),
        tuple(index),
        tuple((moved(first), moved(second)) for first, second in code.bridges),
        tuple(map(moved, code.outside)),
    )


def place_of_old_visits(visit_of: Mapping[int, int], more: Mapping[int, int]) -> dict[int, int]:
    """The new number of each visit: as many higher as there are new ones on the borders before."""
    place, count = {}, 0
    for border, extra in more.items():
        if border in visit_of:
            place[visit_of[border]] = count
            count += 1
        count += extra
    return place
