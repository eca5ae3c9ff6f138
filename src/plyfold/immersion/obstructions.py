"""Why a curve bounds no immersed disk: the obstruction, and where it is (§2.4 of the paper)."""

from __future__ import annotations

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.immersion.dual_tree import DualTree, grow_dual_tree
from plyfold.immersion.grouping import find_groupings
from plyfold.immersion.propagation import Conflict
from plyfold.immersion.shorter_loops import place_of_turning
from plyfold.immersion.word import write_word
from plyfold.obstruction import Obstruction

__all__ = ["is_visibly_no_disk", "no_grouping", "visible_obstruction"]

# Above this many ascending links, the conflict that an obstruction names is not made minimal.
_MINIMISE_UP_TO = 300


def is_visibly_no_disk(arranged: Arrangement) -> bool:
    """Tell whether there is a visible obstruction, without looking for its place."""
    return arranged.turning_number != 1 or bool(arranged.winding.min() < 0)


def visible_obstruction(arranged: Arrangement) -> Obstruction | None:
    """Return the obstruction that numbers alone show, if there is one: the turning number or a winding number."""
    turning = arranged.turning_number
    if turning != 1:
        sentence = f"The curve turns {turning} times, and the outline of a disk turns once."
        return Obstruction("turning number", sentence, place_of_turning(arranged), turning, arranged)
    lowest = int(np.argmin(arranged.winding))
    winding = int(arranged.winding[lowest])
    if winding < 0:
        sentence = (
            f"The curve winds {winding} times around a cell, and cloth cannot cover it a negative number of times."
        )
        return Obstruction("negative winding", sentence, _places(arranged, [lowest]), winding, arranged)
    return None


def no_grouping(arranged: Arrangement) -> Obstruction:
    """Return the obstruction of a curve whose word has no grouping: cells whose ways out are in conflict."""
    tree = grow_dual_tree(arranged)
    cells = _conflict(tree)
    if len(cells) == 1:
        sentence = "No grouping: the way out of a cell can be joined to no border that would cut off a disk."
    else:
        sentence = f"No grouping: the ways out of {len(cells)} cells cannot be joined to borders without crossing."
    links = tuple(tree.link[cells].tolist())
    return Obstruction("no grouping", sentence, _places(arranged, cells), links, arranged)


def _places(arranged: Arrangement, cells: list[int]) -> tuple[tuple[float, float], ...]:
    return () if arranged.curve is None else tuple(arranged.cell_point(cell) for cell in cells)


def _conflict(tree: DualTree) -> list[int]:
    """Return cells whose ascending links cannot all be joined; as few as leaving out some at a time can reach.

    Begins with those that led to the contradiction. Whole stretches are left out first, each half as long as those
    before, and single cells at last.
    """
    cells = _contradiction(tree, tree.ascending_cells())
    stretch = len(cells) if len(cells) <= _MINIMISE_UP_TO else 0
    while stretch > 1:
        stretch = -(-stretch // 2)
        for start in range(0, len(cells), stretch)[::-1]:
            cells = _contradiction(tree, cells[:start] + cells[start + stretch :]) or cells
    return cells


def _contradiction(tree: DualTree, cells: list[int]) -> list[int]:
    """Return those of some cells that contradict each other; none if their links can be joined."""
    word = write_word(tree, cells)
    found = find_groupings(word)
    return [word.cells[label] for label in found.labels] if isinstance(found, Conflict) else []
