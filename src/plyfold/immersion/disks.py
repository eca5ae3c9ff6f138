"""All disks that a curve bounds, after Blank: the groupings of a word (§2.3 of the paper)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrangement.places import place_in_cell, places_of_visits
from plyfold.clock import UNWATCHED, Watch
from plyfold.immersion.curls import draw_out_cusps
from plyfold.immersion.dual_tree import DualTree, grow_dual_tree
from plyfold.immersion.grouping import (
    Grouping,
    Groupings,
    count_groupings,
    find_groupings,
    list_groupings,
    nth_grouping,
)
from plyfold.immersion.immersion import Immersion, require_memory_for_gluing
from plyfold.immersion.propagation import Conflict
from plyfold.immersion.search_map import SearchMap, search_map_of
from plyfold.immersion.sewing import glue_sheets
from plyfold.immersion.word import write_word
from plyfold.obstruction import Obstruction

__all__ = ["Disks", "bounds_disks", "count_disks", "find_disks", "list_disks", "no_grouping", "nth_disk"]

# Above this many ascending links, the conflict that an obstruction names is not made minimal.
_MINIMISE_UP_TO = 300


@dataclass(frozen=True, eq=False)
class Disks:
    """All disks with one curve as their boundary; tree and word are those of the search map."""

    search_map: SearchMap
    tree: DualTree
    groupings: Groupings


def find_disks(arranged: Arrangement, watch: Watch = UNWATCHED) -> Disks | None:
    """Return all disks that a curve without a visible obstruction bounds; None if its word has no grouping."""
    search_map = search_map_of(arranged)
    tree = grow_dual_tree(search_map.map)
    groupings = find_groupings(write_word(tree), watch)
    return Disks(search_map, tree, groupings) if isinstance(groupings, Groupings) else None


def bounds_disks(arranged: Arrangement) -> bool:
    """Tell whether a curve without a visible obstruction bounds a disk: its word tells, wherever it begins."""
    word = write_word(grow_dual_tree(draw_out_cusps(arranged).arrangement))
    return isinstance(find_groupings(word), Groupings)


def list_disks(disks: Disks, watch: Watch = UNWATCHED) -> Iterator[Immersion]:
    """List them, each once, in a stable order."""
    return (_glued(disks, grouping) for grouping in list_groupings(disks.groupings, watch))


def count_disks(disks: Disks) -> int:
    """Count them, exactly."""
    return count_groupings(disks.groupings)


def nth_disk(disks: Disks, index: int) -> Immersion:
    """Return the one that is listed at a number."""
    return _glued(disks, nth_grouping(disks.groupings, index))


def _glued(disks: Disks, grouping: Grouping) -> Immersion:
    require_memory_for_gluing(disks.search_map.arrangement)
    word = disks.groupings.word
    partner = np.full(disks.search_map.map.n_borders, -1)
    partner[disks.tree.link[word.cells]] = word.border[grouping]
    return disks.search_map.carried_back(glue_sheets(disks.search_map.map, disks.tree, partner))


# ---- why there is none (§2.4 of the paper) --------------------------------------------------------------------------


def no_grouping(arranged: Arrangement) -> Obstruction:
    """Return the obstruction of a curve whose word has no grouping: cells whose ways out are in conflict."""
    drawn_out = draw_out_cusps(arranged)
    tree = grow_dual_tree(drawn_out.arrangement)
    cells = _conflict(tree)
    if len(cells) == 1:
        sentence = "No grouping: the way out of a cell can be joined to no border that would cut off a disk."
    else:
        sentence = f"No grouping: the ways out of {len(cells)} cells cannot be joined to borders without crossing."
    links = tuple(drawn_out.border_at(tree.link[cells]).tolist())
    return Obstruction("no grouping", sentence, _places(arranged, cells, links), links, arranged)


def _places(arranged: Arrangement, cells: list[int], links: tuple[int, ...]) -> tuple[tuple[float, float], ...]:
    """Return a point in each cell, and for those inside curls the cusp."""
    if arranged.outline is None:
        return ()
    cusps = places_of_visits(arranged, arranged.start_visit[list(links)].tolist())
    return tuple(
        place_in_cell(arranged, cell) if cell < arranged.n_cells else cusp
        for cell, cusp in zip(cells, cusps, strict=True)
    )


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
    return word.cells[list(found.labels)].tolist() if isinstance(found, Conflict) else []
