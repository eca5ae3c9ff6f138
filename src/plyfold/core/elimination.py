"""Single columns of the triangular factor's inverse, along paths of the elimination tree. See `surface.answers`.

Where A = C D Cᵀ with a sparse unit triangle C, the column of C⁻¹ that belongs to row j has entries only at j, at the
parent of j, and so on to the root: the parent of a row is the first one below it in its column of C (Liu 1990).
"""

from __future__ import annotations

from plyfold.core.buffers import RealBuffer, WholeBuffer, real_room

__all__ = ["Paths", "Triangle", "elimination_tree", "lengths_of_paths", "multiply_paths", "walk_paths"]


class Triangle:
    """The lower triangle C: column j has the rows ``row[first[j]:first[j + 1]]`` with their values, the 1 among them.

    ``scale`` is 1/√d for each entry d of the diagonal D, ``parent`` the elimination tree, and ``column`` room.
    """

    def __init__(
        self, first: WholeBuffer, row: WholeBuffer, value: RealBuffer, scale: RealBuffer, parent: WholeBuffer
    ) -> None:
        self.first, self.row, self.value, self.scale, self.parent = first, row, value, scale, parent
        self.column = real_room(len(scale))
        for place in range(len(scale)):
            self.column[place] = 0.0


class Paths:
    """Columns of D^(−½) C⁻¹: column i has the rows ``node[start[i]:start[i + 1]]``, from a leaf to the root."""

    def __init__(self, start: WholeBuffer, node: WholeBuffer, value: RealBuffer) -> None:
        self.start, self.node, self.value = start, node, value


def elimination_tree(
    first: WholeBuffer, row: WholeBuffer, place: WholeBuffer, at: WholeBuffer, parent: WholeBuffer, above: WholeBuffer
) -> None:
    """Find the elimination tree of a symmetric matrix whose rows are eliminated in a given order.

    Parameters
    ----------
    first, row : buffer of int
        Column j of the matrix has entries in ``row[first[j]:first[j + 1]]``.
    place, at : buffer of int
        When each row is eliminated, and which row is eliminated at each time.
    parent : buffer of int
        Room for the time of each time's parent, −1 for a root.
    above : buffer of int
        Room for a time further up in the tree, with −1 for all of them.

    Examples
    --------
    >>> from array import array
    >>> parent = array("i", [0] * 3)
    >>> same, star = array("i", [0, 1, 2]), (array("i", [0, 2, 4, 7]), array("i", [0, 2, 1, 2, 0, 1, 2]))
    >>> elimination_tree(*star, same, same, parent, array("i", [-1] * 3)) or parent.tolist()
    [2, 2, -1]
    """
    for time in range(len(at)):
        parent[time] = -1
        for entry in range(first[at[time]], first[at[time] + 1]):
            # From each earlier row that this one follows, climb to the root, which gets this one for its parent.
            node = place[row[entry]]
            while -1 < node < time:
                higher = above[node]
                above[node] = time
                if higher < 0:
                    parent[node] = time
                node = higher


def lengths_of_paths(parent: WholeBuffer, leaves: WholeBuffer, length: WholeBuffer) -> None:
    """Count the nodes on the path from each leaf to the root, both included; 0 of the leaf −1."""
    for number in range(len(leaves)):
        node, count = leaves[number], 0
        while node >= 0:
            node, count = parent[node], count + 1
        length[number] = count


def walk_paths(triangle: Triangle, leaves: WholeBuffer, node: WholeBuffer, value: RealBuffer) -> None:
    """Find the columns of D^(−½) C⁻¹ that belong to some rows, by substitution along their paths, one after the other.

    Parameters
    ----------
    triangle : Triangle
    leaves : buffer of int
        The rows; −1 for none.
    node, value : buffer
        Room for the places of their entries and for these, as long as all paths together.
    """
    size = 0
    for number in range(len(leaves)):
        place = leaves[number]
        if place >= 0:
            triangle.column[place] = 1.0
        while place >= 0:
            entry_here = triangle.column[place]
            for entry in range(triangle.first[place], triangle.first[place + 1]):
                triangle.column[triangle.row[entry]] -= triangle.value[entry] * entry_here
            triangle.column[place] = 0.0
            node[size], value[size] = place, entry_here * triangle.scale[place]
            place, size = triangle.parent[place], size + 1


def multiply_paths(paths: Paths, columns: WholeBuffer, others: WholeBuffer, product: RealBuffer) -> None:
    """Multiply some columns with others, each with each: the product has a row for each of the first ones.

    Two paths to the root have their ends in common, and nothing else.
    """
    count = len(others)
    for number in range(len(columns)):
        one, size = columns[number], number * count
        for place in range(count):
            common = _common_end(paths, one, others[place])
            product[size + place] = _end_product(paths, paths.start[one + 1], paths.start[others[place] + 1], common)


def _common_end(paths: Paths, one: int, other: int) -> int:
    """Return on how many last nodes two paths agree, by bisection: at least ``low``, and less than ``high``."""
    one_end, other_end = paths.start[one + 1], paths.start[other + 1]
    low, high = 0, min(one_end - paths.start[one], other_end - paths.start[other]) + 1
    while high - low > 1:
        middle = (low + high) // 2
        if paths.node[one_end - middle] == paths.node[other_end - middle]:
            low = middle
        else:
            high = middle
    return low


def _end_product(paths: Paths, one_end: int, other_end: int, count: int) -> float:
    """Return the sum of the products of the last entries of two columns, four sums at a time."""
    first = second = third = fourth = 0.0
    one, other = one_end - count, other_end - count
    for place in range(0, count - 3, 4):
        first += paths.value[one + place] * paths.value[other + place]
        second += paths.value[one + place + 1] * paths.value[other + place + 1]
        third += paths.value[one + place + 2] * paths.value[other + place + 2]
        fourth += paths.value[one + place + 3] * paths.value[other + place + 3]
    for place in range(count - count % 4, count):
        first += paths.value[one + place] * paths.value[other + place]
    return (first + second) + (third + fourth)
