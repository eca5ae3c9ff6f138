"""All immersions of the disk bounded by a curve, enumerated from the definition.

An immersion puts w(c) *sheets* over each cell c. Over a border with left cell H and right cell L (w(H) = w(L) + 1) it
glues the sheets of L one-to-one to sheets of H; the one sheet of H left over has the border on the boundary of the
disk: its *own sheet*. At every crossing the four gluings around it must agree. Every family of such injections that
does so is a surface whose Euler characteristic is the turning number of the curve, so a disk if that is 1.

Two families are the same immersion if renaming the sheets of each cell turns one into the other.
"""

from collections.abc import Iterator, Sequence
from itertools import permutations
from typing import NamedTuple

from reference.planar_maps import (
    Corner,
    GaussCode,
    border_count,
    corners,
    gauss_code,
    left_and_right,
    may_bound_disk,
    outer_cell,
    turning_number,
    windings,
)

Row = tuple[int, int, int]
"""(border, sheet on the right, sheet on the left)"""


class Gluing(NamedTuple):
    """One immersion: own_sheet[border], and rows (border, right sheet, left sheet); sheets numbered cell by cell."""

    own_sheet: tuple[int, ...]
    rows: tuple[Row, ...]


class Link(NamedTuple):
    """A border of the dual spanning tree: it leads from cell `parent` (nearer to the unbounded one) to cell `child`."""

    border: int
    parent: int
    child: int


def dual_tree(code: GaussCode) -> list[Link]:
    """A spanning tree of the dual graph, grown from the unbounded cell; every link comes after the link to its parent.

    Any tree is correct. This one goes to higher cells (left of a border) while it can: fewer choices later.
    """
    sides = left_and_right(code)
    reached = {outer_cell(code)}
    links: list[Link] = []
    while len(links) < len(windings(code)) - 1:
        up = [Link(e, right, left) for e, (left, right) in enumerate(sides) if right in reached]
        down = [Link(e, left, right) for e, (left, right) in enumerate(sides) if left in reached]
        links.append(next(link for link in up + down if link.child not in reached))
        reached.add(links[-1].child)
    return links


def borders_at(corner: Corner) -> set[int]:
    """The borders that end at a crossing (three if one of them is a loop there)."""
    return {corner.a_top, corner.a_bottom, corner.b_top, corner.b_bottom}


def border_order(code: GaussCode) -> list[int]:
    """All borders, such that crossings have all their borders as early as possible; tree links in order of the tree.

    When all links are placed, the remaining borders form a spanning tree of the crossings, so one crossing always
    lacks a single border until none is left.
    """
    links = [link.border for link in dual_tree(code)]
    order: list[int] = []
    while len(order) < border_count(code):
        lacking = [borders_at(corner).difference(order) for corner in corners(code)]
        last_ones = [min(borders) for borders in lacking if len(borders) == 1]
        order.append(last_ones[0] if last_ones else next(e for e in links if e not in order))
    return order


def injections(code: GaussCode) -> list[list[tuple[int, ...]]]:
    """For every border the injections to try.

    An injection of w sheets into w + 1 is written as a permutation of range(w + 1): entry i is the image of sheet i,
    the last entry is the sheet missed.

    Relabelling. Walk the dual tree outward from the unbounded cell, which has no sheet to rename. Over a link to a
    higher child, its sheets can be renamed in exactly one way that makes the injection the identity. Over a link to a
    lower child, they can be renamed in exactly one way that makes the injection increasing. So every class of families
    under renaming has exactly one member that is the identity on all links up and increasing on all links down.
    Borders outside the tree get every injection.
    """
    winding = windings(code)
    size = [winding[left] for left, _ in left_and_right(code)]
    choices = [list(permutations(range(w))) for w in size]
    for border, _, child in dual_tree(code):
        identity = tuple(range(size[border]))
        if child == left_and_right(code)[border][0]:
            choices[border] = [identity]
        else:
            choices[border] = [(*(i for i in identity if i != missed), missed) for missed in identity]
    return choices


def agree(corner: Corner, phi: dict[int, tuple[int, ...]]) -> bool:
    """Whether the four gluings around a crossing are compatible.

    Both ways from a bottom sheet to the top lead to the same sheet, and where a strand passes the crossing, the sheet
    it bounds below the other strand is glued to the sheet it bounds above.
    """
    a_top, a_bottom, b_top, b_bottom = (
        phi[border] for border in (corner.a_top, corner.a_bottom, corner.b_top, corner.b_bottom)
    )
    bottom_sheets = range(len(a_bottom) - 1)
    return (
        all(b_top[a_bottom[i]] == a_top[b_bottom[i]] for i in bottom_sheets)
        and b_top[a_bottom[-1]] == a_top[-1]
        and a_top[b_bottom[-1]] == b_top[-1]
    )


def families(code: GaussCode) -> Iterator[dict[int, tuple[int, ...]]]:
    """All compatible families of injections, one per class under renaming (see `injections`), by backtracking."""
    order, choices = border_order(code), injections(code)
    complete: list[list[Corner]] = [[] for _ in order]
    for corner in corners(code):
        complete[max(order.index(border) for border in borders_at(corner))].append(corner)

    def extend(phi: dict[int, tuple[int, ...]], depth: int) -> Iterator[dict[int, tuple[int, ...]]]:
        if depth == len(order):
            yield dict(phi)
            return
        for choice in choices[order[depth]]:
            phi[order[depth]] = choice
            if all(agree(corner, phi) for corner in complete[depth]):
                yield from extend(phi, depth + 1)
        phi.pop(order[depth], None)

    yield from extend({}, 0)


def first_sheets(code: GaussCode) -> list[int]:
    """Sheets of cell c are numbered first_sheets(code)[c], ... consecutively, w(c) of them (winding numbers >= 0)."""
    winding = windings(code)
    return [sum(winding[:cell]) for cell in range(len(winding))]


def gluing(code: GaussCode, phi: dict[int, tuple[int, ...]]) -> Gluing:
    """A family of injections with the sheets of all cells numbered through."""
    first = first_sheets(code)
    own, rows = [], []
    for border, (left, right) in enumerate(left_and_right(code)):
        *images, missed = phi[border]
        own.append(first[left] + missed)
        rows += [(border, first[right] + i, first[left] + image) for i, image in enumerate(images)]
    return Gluing(tuple(own), tuple(rows))


def immersions(partner: Sequence[int], ccw: Sequence[bool], outer: int) -> list[Gluing]:
    """All immersions of the disk that the curve bounds, up to equivalence; none unless it turns once and w >= 0.

    The curve must be oriented with positive turning number (ValueError if it turns negatively).
    """
    code = gauss_code(partner, ccw, outer)
    if turning_number(code) < 0:
        raise ValueError("orient the curve first: its turning number is negative")
    if not may_bound_disk(code):
        return []
    return [gluing(code, phi) for phi in families(code)]


def sheets_by_cell(code: GaussCode, own_sheet: Sequence[int], rows: Sequence[Row]) -> dict[int, set[int]]:
    """The sheets over each cell, collected from the borders around it (every sheet of a cell meets all of them)."""
    sheets: dict[int, set[int]] = {cell: set() for cell in range(len(windings(code)))}
    sides = left_and_right(code)
    for border, sheet in enumerate(own_sheet):
        sheets[sides[border][0]].add(sheet)
    for border, right, left in rows:
        sheets[sides[border][1]].add(right)
        sheets[sides[border][0]].add(left)
    return sheets


def right_to_left(own_sheet: Sequence[int], rows: Sequence[Row]) -> list[dict[int, int]]:
    """For every border the gluing as a map from sheets on the right to sheets on the left."""
    up: list[dict[int, int]] = [{} for _ in own_sheet]
    for border, right, left in rows:
        up[border][right] = left
    return up


def cell_problems(code: GaussCode, own_sheet: Sequence[int], rows: Sequence[Row]) -> list[str]:
    """What is wrong with the number of sheets over the cells."""
    sheets = sheets_by_cell(code, own_sheet, rows)
    problems = [
        f"cell {cell} has {len(sheets[cell])} sheets, not {winding}"
        for cell, winding in enumerate(windings(code))
        if len(sheets[cell]) != winding
    ]
    if len(set().union(*sheets.values())) != sum(len(group) for group in sheets.values()):
        problems.append("a sheet lies over two cells")
    return problems


def border_problems(code: GaussCode, own_sheet: Sequence[int], rows: Sequence[Row]) -> list[str]:
    """Borders over which the rows are not an injection that misses exactly the own sheet."""
    sheets, up, problems = sheets_by_cell(code, own_sheet, rows), right_to_left(own_sheet, rows), []
    for border, (left, right) in enumerate(left_and_right(code)):
        images = [row[2] for row in rows if row[0] == border]
        is_map = len(images) == len(up[border]) and set(up[border]) == sheets[right]
        if not is_map or sorted([*images, own_sheet[border]]) != sorted(sheets[left]):
            problems.append(f"border {border} does not glue all sheets on its right to all but one on its left")
    return problems


def corner_problems(code: GaussCode, own_sheet: Sequence[int], rows: Sequence[Row]) -> list[str]:
    """Crossings around which the gluings do not agree (borders are known to be all right)."""
    up, problems = right_to_left(own_sheet, rows), []
    for corner in corners(code):
        a_top, b_top = up[corner.a_top], up[corner.b_top]
        a_bottom, b_bottom = up[corner.a_bottom], up[corner.b_bottom]
        if any(b_top[a_bottom[sheet]] != a_top[b_bottom[sheet]] for sheet in a_bottom):
            problems.append(f"going round {corner} changes the sheet")
        if b_top[own_sheet[corner.a_bottom]] != own_sheet[corner.a_top]:
            problems.append(f"strand a changes the sheet at {corner}")
        if a_top[own_sheet[corner.b_bottom]] != own_sheet[corner.b_top]:
            problems.append(f"strand b changes the sheet at {corner}")
    return problems


def problems(code: GaussCode, own_sheet: Sequence[int], rows: Sequence[Row]) -> list[str]:
    """What is wrong with a claimed immersion (any numbering of the sheets); empty if it is one."""
    if not may_bound_disk(code):
        return ["turning number is not 1, or a winding number is negative"]
    return (
        cell_problems(code, own_sheet, rows)
        or border_problems(code, own_sheet, rows)
        or corner_problems(code, own_sheet, rows)
    )


def sheet_names(code: GaussCode, own_sheet: Sequence[int], rows: Sequence[Row]) -> dict[int, tuple[int, int]]:
    """For every sheet (cell, border): start in the sheet, follow the tree path of its cell to the unbounded cell; the
    border is the one through which this path leaves the disk.

    Walking over a link from child to parent: if the child is lower, the sheet goes on to the one it is glued to. If the
    child is higher, it goes back through the gluing, or it is the own sheet of that border, and the path leaves there.
    It must leave somewhere, as the unbounded cell has no sheets.
    """
    sheets, up = sheets_by_cell(code, own_sheet, rows), right_to_left(own_sheet, rows)
    sides = left_and_right(code)
    names: dict[int, tuple[int, int]] = {}
    for border, _, child in dual_tree(code):
        down = {left: right for right, left in up[border].items()}
        onward = down if child == sides[border][0] else up[border]
        for sheet in sheets[child]:
            leaves_here = child == sides[border][0] and sheet == own_sheet[border]
            names[sheet] = (child, border if leaves_here else names[onward[sheet]][1])
    return names


def key_of(
    partner: Sequence[int], ccw: Sequence[bool], outer: int, own_sheet: Sequence[int], gluing_rows: Sequence[Row]
) -> tuple:
    """A key of an immersion that does not depend on how its sheets are numbered; a complete invariant.

    Equal keys <=> same immersion. The names of `sheet_names` are defined by the gluing alone, so renaming sheets does
    not change them. Two sheets of a cell never share a name: a path that leaves through border e was in the own sheet
    of e before, and from there every step back is determined, the gluings being injective. So the names are themselves
    a numbering of the sheets, and own sheets and rows written in names, which is the key, determine the immersion;
    two immersions with the same key become equal when both name their sheets so.

    Raises ValueError if the data are not an immersion.
    """
    code = gauss_code(partner, ccw, outer)
    own_sheet = [int(sheet) for sheet in own_sheet]
    rows = [(int(border), int(right), int(left)) for border, right, left in gluing_rows]
    if found := problems(code, own_sheet, rows):
        raise ValueError("not an immersion: " + "; ".join(found))
    names = sheet_names(code, own_sheet, rows)
    return (
        tuple(names[sheet] for sheet in own_sheet),
        tuple(sorted((border, names[right], names[left]) for border, right, left in rows)),
    )


def keys(partner: Sequence[int], ccw: Sequence[bool], outer: int) -> set[tuple]:
    """The keys of all immersions of the curve."""
    return {key_of(partner, ccw, outer, *immersion) for immersion in immersions(partner, ccw, outer)}
