"""All surfaces with a given outline, enumerated from the definition, whatever its loops, handles and cusps.

A surface puts w(c) *sheets* over each cell c, cut open along bridges so that all cells are disks. Over a border with
left cell H and right cell L (w(H) = w(L) + 1) it glues the sheets of L one-to-one to sheets of H; the one left over is
the border's *own sheet*. Over a bridge it glues all sheets on one side to those on the other.

One rule says which families of such gluings are surfaces. Cut a small disk round a crossing or mark into sectors by the
edges that meet there; over it lie the corners of the sheets, glued to each other along these edges. Each must belong
either to a whole disk, which closes after one turn round the vertex; or to a corner of the boundary, one for each visit
at the vertex, which starts in the own sheet of the border that leaves, turns counter-clockwise to the own sheet of the
border that arrives, and makes as many full turns on its way as the visit's index says.

Surfaces are the same if renaming the sheets of each cell turns one into the other. As every piece has a boundary, which
stays fixed point by point, only renaming nothing leaves a surface as it is.
"""

from collections.abc import Iterator, Sequence
from itertools import permutations
from math import factorial, prod

from reference.gluings import Gluing, Link, Row
from reference.outlines import OutlineCode, OutlineMap, outline_map

Phi = tuple[int, ...]
"""Entry i is the sheet on the left that sheet i on the right is glued to; for a border, the last one is its own."""


# ---- the rule at a vertex --------------------------------------------------------------------------------------------


def across(found: OutlineMap, phi: Phi, dart: int, sheet: int) -> int | None:
    """The sheet on the left of a dart that a sheet on its right is glued to; None if the surface ends there."""
    if dart % 2 == 0:
        return phi[sheet]
    glued = phi[:-1] if dart // 2 < found.n_borders else phi
    return glued.index(sheet) if sheet in glued else None


def corner_of_boundary(
    found: OutlineMap, phi: dict[int, Phi], darts: Sequence[int], visit: int
) -> list[tuple[int, int]]:
    """The corners (sector, sheet) of sheets between the borders of a visit, from the one that leaves until it ends.

    Sector i lies on the left of dart i.
    """
    place, sheet = darts.index(2 * found.after[visit]), phi[found.after[visit]][-1]
    walk = [(place, sheet)]
    while True:
        place = (place + 1) % len(darts)
        sheet = across(found, phi[darts[place] // 2], darts[place], sheet)
        if sheet is None:
            return walk
        walk.append((place, sheet))


def fits(found: OutlineMap, phi: dict[int, Phi], vertex: int) -> bool:
    """Whether the gluings of the edges at a vertex obey the rule."""
    darts = found.around[vertex]
    on_boundary: set[tuple[int, int]] = set()
    for visit in found.at[vertex]:
        walk = corner_of_boundary(found, phi, darts, visit)
        start, end = darts.index(2 * found.after[visit]), darts.index(2 * found.before[visit] + 1)
        turn = (end - start) % len(darts) + found.index[visit] * len(darts)
        if len(walk) != turn:  # so it ends at the right border too
            return False
        on_boundary.update(walk)
    corners = [(i, s) for i, dart in enumerate(darts) for s in range(found.winding[found.cell_of_dart[dart]])]
    return all(is_whole_disk(found, phi, darts, corner) for corner in corners if corner not in on_boundary)


def is_whole_disk(found: OutlineMap, phi: dict[int, Phi], darts: Sequence[int], corner: tuple[int, int]) -> bool:
    """Whether the corners of sheets close after one turn."""
    place, start = corner
    sheet: int | None = start
    for i in range(len(darts)):
        dart = darts[(place + 1 + i) % len(darts)]
        if (sheet := across(found, phi[dart // 2], dart, sheet)) is None:
            return False
    return sheet == start


# ---- all families ----------------------------------------------------------------------------------------------------


def dual_tree(found: OutlineMap) -> list[Link]:
    """A spanning tree of the cells, joined by edges, grown from the unbounded one; to higher cells while it can."""
    reached, links = {0}, []
    while len(links) < len(found.winding) - 1:
        edges = range(found.n_edges)
        up = [Link(e, found.right(e), found.left(e)) for e in edges if found.right(e) in reached]
        down = [Link(e, found.left(e), found.right(e)) for e in edges if found.left(e) in reached]
        links.append(next(link for link in up + down if link.child not in reached))
        reached.add(links[-1].child)
    return links


def edge_order(found: OutlineMap) -> list[int]:
    """All edges, such that vertices have all their edges as early as possible; tree links in order of the tree."""
    links = [link.border for link in dual_tree(found)]
    order: list[int] = []
    while len(order) < found.n_edges:
        lacking = [{dart // 2 for dart in darts}.difference(order) for darts in found.around]
        last_ones = [min(edges) for edges in lacking if len(edges) == 1]
        order.append(last_ones[0] if last_ones else next(e for e in links if e not in order))
    return order


def all_gluings(found: OutlineMap) -> list[list[Phi]]:
    """For every edge all ways to glue the sheets beside it."""
    return [list(permutations(range(found.winding[found.left(edge)]))) for edge in range(found.n_edges)]


def one_of_each_class(found: OutlineMap) -> list[list[Phi]]:
    """The same, but for the links of a tree only so many that each surface comes up in one numbering of its sheets.

    Walk the tree outward. Over a link to a higher child, or over a bridge, the child's sheets can be renamed in exactly
    one way that makes the gluing the identity; over a link to a lower child in one way that makes it increasing.
    """
    choices = all_gluings(found)
    for edge, _, child in dual_tree(found):
        identity = tuple(range(found.winding[found.left(edge)]))
        if edge >= found.n_borders or child == found.left(edge):
            choices[edge] = [identity]
        else:
            choices[edge] = [(*(i for i in identity if i != own), own) for own in identity]
    return choices


def families(code: OutlineCode, choices: Sequence[Sequence[Phi]]) -> Iterator[dict[int, Phi]]:
    """All families of gluings that are surfaces, by backtracking."""
    found = outline_map(code)
    order = edge_order(found)
    complete: list[list[int]] = [[] for _ in order]
    for vertex, darts in enumerate(found.around):
        complete[max(order.index(dart // 2) for dart in darts)].append(vertex)

    def extend(phi: dict[int, Phi], depth: int) -> Iterator[dict[int, Phi]]:
        if depth == len(order):
            yield dict(phi)
            return
        for choice in choices[order[depth]]:
            phi[order[depth]] = choice
            if all(fits(found, phi, vertex) for vertex in complete[depth]):
                yield from extend(phi, depth + 1)
        phi.pop(order[depth], None)

    yield from extend({}, 0)


def gluing(found: OutlineMap, phi: dict[int, Phi]) -> Gluing:
    """A family of gluings with the sheets of all cells numbered through; bridges have rows after the borders."""
    first = [sum(found.winding[:cell]) for cell in range(len(found.winding))]
    own, rows = [], []
    for edge in range(found.n_edges):
        left, right = first[found.left(edge)], first[found.right(edge)]
        rows += [(edge, right + i, left + phi[edge][i]) for i in range(found.winding[found.right(edge)])]
        if edge < found.n_borders:
            own.append(left + phi[edge][-1])
    return Gluing(tuple(own), tuple(rows))


def surfaces(code: OutlineCode) -> list[Gluing]:
    """All surfaces with the outline, each once; none where a winding number is negative."""
    found = outline_map(code)
    if min(found.winding) < 0:
        return []
    return [gluing(found, phi) for phi in families(code, one_of_each_class(found))]


def count_by_labels(code: OutlineCode) -> int:
    """Their number in another way: all families, divided by the ways to number the sheets."""
    found = outline_map(code)
    if min(found.winding) < 0:
        return 0
    labelled = sum(1 for _ in families(code, all_gluings(found)))
    count, rest = divmod(labelled, prod(map(factorial, found.winding)))
    assert not rest
    return count


# ---- claimed surfaces ------------------------------------------------------------------------------------------------


def sheets_by_cell(code: OutlineCode, own_sheet: Sequence[int], rows: Sequence[Row]) -> list[list[int]]:
    """The sheets over each cell in the order of their numbers, collected from the edges around it."""
    found = outline_map(code)
    sheets: list[set[int]] = [set() for _ in found.winding]
    for border, sheet in enumerate(own_sheet):
        sheets[found.left(border)].add(sheet)
    for edge, right, left in rows:
        sheets[found.right(edge)].add(right)
        sheets[found.left(edge)].add(left)
    return list(map(sorted, sheets))


def family(code: OutlineCode, own_sheet: Sequence[int], rows: Sequence[Row]) -> dict[int, Phi]:
    """The gluings of a claimed surface, with the sheets of each cell counted from 0; ValueError if they are none."""
    found, sheets = outline_map(code), sheets_by_cell(code, own_sheet, rows)
    counts = [len(group) for group in sheets]
    if counts != list(found.winding) or sum(counts) != len(set().union(*sheets)) or len(own_sheet) != found.n_borders:
        raise ValueError("not a surface: numbers of sheets")
    phi = {}
    for edge in range(found.n_edges):
        on_right, on_left = sheets[found.right(edge)], sheets[found.left(edge)]
        images = {right: left for e, right, left in rows if e == edge}
        glued = [images.get(sheet, -1) for sheet in on_right] + list(own_sheet[edge : edge + 1])
        if sorted(glued) != on_left or sum(row[0] == edge for row in rows) != len(on_right):
            raise ValueError(f"not a surface: the gluing of edge {edge}")
        phi[edge] = tuple(on_left.index(sheet) for sheet in glued)
    return phi


def key_of(code: OutlineCode, own_sheet: Sequence[int], rows: Sequence[Row]) -> tuple[Phi, ...]:
    """A complete invariant of a surface: its gluings in the numbering of `one_of_each_class`; ValueError if it is none.

    Sheets get their new numbers along the tree: over each link there is one way that makes the gluing the identity, or
    increasing.
    """
    own_sheet = [int(sheet) for sheet in own_sheet]
    rows = [(int(edge), int(right), int(left)) for edge, right, left in rows]
    found, phi = outline_map(code), family(code, own_sheet, rows)
    if not all(fits(found, phi, vertex) for vertex in range(len(found.around))):
        raise ValueError("not a surface: around a vertex")
    name: dict[int, Phi] = {0: ()}  # the new number of each sheet
    for edge, parent, child in dual_tree(found):
        if child == found.left(edge):
            named = (*name[parent], len(name[parent]))
            name[child] = tuple(named[phi[edge].index(sheet)] for sheet in range(found.winding[child]))
        else:
            images = [name[parent][left] for left in phi[edge][: found.winding[child]]]
            name[child] = tuple(sorted(images).index(image) for image in images)
    return tuple(renamed(phi[e], name[found.right(e)], name[found.left(e)]) for e in range(found.n_edges))


def renamed(phi: Phi, right: Phi, left: Phi) -> Phi:
    """A gluing with new numbers of the sheets on both sides."""
    images = {right[i]: left[phi[i]] for i in range(len(right))}
    return (*(images[i] for i in range(len(right))), *(left[own] for own in phi[len(right) :]))


def pieces(code: OutlineCode, own_sheet: Sequence[int], rows: Sequence[Row]) -> list[tuple[tuple[int, ...], int]]:
    """The loops and the Euler characteristic of each connected piece, by the order of their first loops.

    Sheets are disks; they are glued along the copies of edges, which end in the corners of the boundary and in whole
    disks over vertices. A border without vertices is a circle and counts nothing.
    """
    found, phi = outline_map(code), family(code, own_sheet, rows)
    sheets = sheets_by_cell(code, own_sheet, rows)
    piece = {sheet: sheet for group in sheets for sheet in group}
    for _, right, left in rows:
        piece = {sheet: piece[right] if p == piece[left] else p for sheet, p in piece.items()}
    euler = {p: sum(q == p for q in piece.values()) for p in piece.values()}
    met = {dart // 2 for darts in found.around for dart in darts}
    for sheet in [own for border, own in enumerate(own_sheet) if border in met]:
        euler[piece[sheet]] -= 1
    for _, _, left in (row for row in rows if row[0] in met):
        euler[piece[left]] -= 1
    for darts, visits in zip(found.around, found.at, strict=True):
        walks = [corner_of_boundary(found, phi, darts, visit) for visit in visits]
        for walk in walks:
            place, sheet = walk[0]
            euler[piece[sheets[found.cell_of_dart[darts[place]]][sheet]]] += 1
        for i, sheet in enumerate(sheets[found.cell_of_dart[darts[0]]]):
            euler[piece[sheet]] += all((0, i) not in walk for walk in walks)
    loops: dict[int, list[int]] = {}
    for border, own in enumerate(own_sheet):
        of_piece = loops.setdefault(piece[own], [])
        of_piece += [] if found.loop_of_border[border] in of_piece else [found.loop_of_border[border]]
    return [(tuple(of_piece), euler[p]) for p, of_piece in loops.items()]
