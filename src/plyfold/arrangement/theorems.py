"""What every arrangement must obey: Euler's formula, orbits, winding numbers and turning numbers."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from plyfold.arrangement.polylines import polygon_turning_numbers

if TYPE_CHECKING:
    from plyfold.arrangement.arrangement import Arrangement

__all__ = ["theorems_of"]


def theorems_of(arranged: Arrangement) -> Iterator[tuple[str, bool]]:
    """Yield each theorem in words, and whether an arrangement obeys it."""
    left, right = arranged.winding[arranged.left_cell], arranged.winding[arranged.right_cell]
    groups = 1 if arranged.n_loops == 1 else int(arranged.group_of_loop.max()) + 1
    cells, darts, partner = arranged.n_crossings + groups + 1, np.arange(2 * arranged.n_borders), arranged.partner
    yield "Euler: as many cells as crossings and groups of loops, and one more", arranged.n_cells == cells
    yield "every dart belongs to one cell", _same(np.sort(arranged.cell_darts), darts)
    cell_of_dart = arranged.cell_of_dart
    yield "a dart and the next one have the same cell", _same(cell_of_dart, cell_of_dart[arranged.next_dart])
    yield "the unbounded cell winds 0 times", arranged.winding[cell_of_dart[arranged.outer]] == 0
    yield "left of a border winds once more than right of it", _same(left, right + 1)
    yield "the partner's partner is the visit itself", _same(partner[partner], np.arange(len(partner)))
    by_windings = arranged.turning_by_windings()
    yield "turning number by crossings and by winding numbers agree", arranged.turning_number == by_windings
    outline, numbers = arranged.outline, arranged.turning_numbers
    exterior = polygon_turning_numbers(arranged.exact_points, outline.first_point) if outline else numbers
    yield "turning numbers by crossings and by angles agree", exterior == numbers
    feet = cell_of_dart[arranged.bridges]
    yield "both feet of a bridge stand in one cell", _same(feet[:, 0], feet[:, 1])


def _same(first: npt.NDArray[np.int64], second: npt.NDArray[np.int64]) -> bool:
    return bool((first == second).all())
