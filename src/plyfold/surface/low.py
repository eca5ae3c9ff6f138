"""Layerings whose surfaces stay low, found with cloth that touches itself at crossings alone.

Cloth that passes over itself at one crossing after another may climb each time, and becomes a tower, or climb and come
down again. Which it does is open where classes of pairs of sheets are ordered independently of each other. So one class
after the other is turned round, wherever that makes the surface lower.

For hundreds of tries, heights have to be cheap. So distances are kept where strands cross and nowhere else: there cloth
touches cloth, as a rule. How heights there answer to forces there is one small full matrix for all layerings, and the
heights of a layering follow from a dense problem with as many unknowns as there are pairs of vertices over crossings.
With fewer distances to keep cloth is lower, so these ranges of heights are bounds from below, nearly: for most drawings
they miss 3%.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import cycle, islice
from typing import Any, NamedTuple

import numpy as np

from plyfold.arrays import Bools, Floats, Ints
from plyfold.clock import UNWATCHED, Watch
from plyfold.immersion.immersion import Immersion
from plyfold.layering.layering import Layering
from plyfold.layering.orders.search import OrderProblem
from plyfold.matrices import one_thread, summed
from plyfold.surface.contact import least_forces
from plyfold.surface.glue import LiftedMesh
from plyfold.surface.heights import SpreadCloth

__all__ = ["CrossingCloth", "Estimate", "crossing_cloth", "estimated", "lowered"]

# With more vertices over crossings than this, the full matrix takes longer than the surface itself. Then one crossing
# stands for all those at which the same class of pairs is met: the corners of a place where strips cross, as a rule.
_MOST_ENDS, _MOST_CHOSEN = 400, 800
# With more classes than this, they are not turned round together with all that come after.
_MOST_IN_ROWS = 40
# Of the gap: what may be missing. So many pairs of vertices join in a round, and as many again as there are.
_MISSING, _FIRST_PAIRS = 1e-4, 16
# A layering is lower if its range is by this share; of ranges that are equal to within it, one of less energy is taken.
_LOWER = 1e-3
# All classes are tried so many times, and so many tries are begun with.
_ROUNDS, _MOST_TRIES = 3, 150


@dataclass(frozen=True, eq=False)
class CrossingCloth:
    """Vertices over the crossings of a surface, and how their heights answer to forces there.

    Parameters
    ----------
    sheet : (e,) int
        A sheet that each vertex is on; those of vertices over the same crossing lie over the same cell.
    point : (e,) int
        The point of the planar triangulation below each vertex.
    flexibility : (e, e) float
        Heights of vertices by forces, up to a constant; the sum of the forces is 0.
    """

    sheet: Ints
    point: Ints
    flexibility: Floats


class Estimate(NamedTuple):
    """The range of heights of a layering and its energy, in gaps, and which vertices press on which, (e, e)."""

    height: float
    energy: float
    pressing: Bools


def crossing_cloth(problem: OrderProblem, mesh: LiftedMesh, spread: SpreadCloth) -> CrossingCloth | None:
    """Return the vertices over crossings.

    Parameters
    ----------
    problem : OrderProblem
    mesh : LiftedMesh
        Of a layering of its immersion.
    spread : SpreadCloth
        Of this mesh.

    Returns
    -------
    CrossingCloth or None
        None where there are too many of them.
    """
    outline = mesh.planar_vertex[: len(mesh.boundary)]
    is_crossing = np.bincount(outline, minlength=int(mesh.planar_vertex.max()) + 1) > 1
    ends, sheet = _on_fullest_cell(problem.immersion, mesh, is_crossing)
    if len(ends) > _MOST_ENDS:
        kept = _one_for_each_class(problem, mesh, ends, sheet)
        ends, sheet = ends[kept], sheet[kept]
    if not 0 < len(ends) <= _MOST_CHOSEN:
        return None
    weights = _against_the_first(ends, len(spread.fine.places))
    return CrossingCloth(sheet, mesh.planar_vertex[ends], spread.answers.between(weights, weights))


def _on_fullest_cell(immersion: Immersion, mesh: LiftedMesh, is_crossing: Bools) -> tuple[Ints, Ints]:
    """Return the vertices over crossings, each with its sheet over the cell there that most sheets lie over.

    Crossings beside which no cell has all vertices are left out: there are some where an outline touches itself.
    """
    corner = np.flatnonzero(is_crossing[mesh.planar_vertex[mesh.faces.ravel()]])
    vertex, sheet = mesh.faces.ravel()[corner], mesh.sheet[corner // 3]
    cell = immersion.sheet_cell[sheet]
    order = np.lexsort((sheet, cell, immersion.arrangement.winding[cell], vertex))
    last = order[np.flatnonzero(np.append(np.diff(vertex[order]) > 0, True))]
    vertex, sheet, cell = vertex[last], sheet[last], cell[last]
    point = mesh.planar_vertex[vertex]
    count = np.bincount(point, minlength=len(is_crossing))
    lowest, highest = np.full(len(is_crossing), immersion.arrangement.n_cells), np.full(len(is_crossing), -1)
    np.minimum.at(lowest, point, cell)
    np.maximum.at(highest, point, cell)
    whole = (lowest == highest)[point] & (immersion.arrangement.winding[cell] == count[point])
    return vertex[whole], sheet[whole]


def _one_for_each_class(problem: OrderProblem, mesh: LiftedMesh, ends: Ints, sheet: Ints) -> Bools:
    """Tell which vertices lie over the first crossing of those at which the same class of pairs is met."""
    point = mesh.planar_vertex[ends]
    rim = np.flatnonzero(ends < len(mesh.boundary))
    rim = rim[np.argsort(point[rim], kind="stable")]
    pair = np.flatnonzero(np.diff(point[rim]) == 0)
    variable = np.abs(problem.above(sheet[rim[pair]], sheet[rim[pair + 1]]))
    _, first = np.unique(variable, return_index=True)
    return np.isin(point, point[rim[pair[first]]])


def _against_the_first(ends: Ints, size: int) -> Any:
    """Return the rows that take heights of all vertices to those of some, less that of the first of these."""
    signs, rows = np.repeat([-1.0, 1.0], len(ends)), np.tile(np.arange(len(ends)), 2)
    return summed(signs, rows, np.append(np.full(len(ends), ends[0]), ends), (len(ends), size))


def estimated(cloth: CrossingCloth, level: Ints, near: Estimate | None = None) -> Estimate:
    """Return the heights over crossings for an order of the sheets, with distances kept there alone.

    Parameters
    ----------
    cloth : CrossingCloth
    level : (sheets,) int
    near : Estimate, optional
        Of a similar order: much the same vertices will press.

    Returns
    -------
    Estimate
        Infinite where rounding errors leave it open.
    """
    lower, upper = _stacked(cloth, level)
    active = np.arange(len(lower)) < (_FIRST_PAIRS if near is None else 1)
    if near is not None:
        active |= near.pressing[lower, upper]
    while True:
        rows = np.flatnonzero(active)
        answer = cloth.flexibility[upper[rows]] - cloth.flexibility[lower[rows]]
        opening = answer[:, upper[rows]] - answer[:, lower[rows]]
        force = least_forces((opening + opening.T) / 2, np.ones(len(rows)), 0, np.ones(len(rows), dtype=bool))
        if force is None:
            return Estimate(np.inf, np.inf, np.zeros(cloth.flexibility.shape, dtype=bool))
        z = force @ answer
        missing = np.where(active, 0.0, 1 - (z[upper] - z[lower]))
        worst = np.argsort(-missing, kind="stable")[: _FIRST_PAIRS + len(rows)]
        added = worst[missing[worst] > _MISSING]
        if not len(added):
            return Estimate(float(np.ptp(z)), float(force.sum()) / 2, _pairs(lower, upper, rows[force > 0], len(z)))
        active[added] = True


def _stacked(cloth: CrossingCloth, level: Ints) -> tuple[Ints, Ints]:
    """Return the vertices next to each other over the same crossing, the lower and the upper ones."""
    order = np.lexsort((level[cloth.sheet], cloth.point))
    above = np.flatnonzero(np.diff(cloth.point[order]) == 0)
    return order[above], order[above + 1]


def _pairs(lower: Ints, upper: Ints, rows: Ints, size: int) -> Bools:
    """Return a symmetric matrix that is true at some of the pairs."""
    chosen = np.zeros((size, size), dtype=bool)
    chosen[lower[rows], upper[rows]] = chosen[upper[rows], lower[rows]] = True
    return chosen


@one_thread()
def lowered(
    problem: OrderProblem, start: Layering, cloth: CrossingCloth, watch: Watch = UNWATCHED
) -> tuple[Layering, Estimate]:
    """Return a layering that stays lower than another one, or that one: classes are turned round as long as it helps.

    Parameters
    ----------
    problem : OrderProblem
        Of the layering's immersion.
    start : Layering
    cloth : CrossingCloth
    watch : Watch, optional

    Returns
    -------
    Layering
    Estimate
    """
    signs, best = _signs(problem, start), estimated(cloth, start.level)
    turns = list(_turns(problem))
    idle = 0
    for turned in islice(cycle(turns), min(_ROUNDS * len(turns), _MOST_TRIES)):
        watch.step()
        tried = np.where(turned, -signs, signs)
        idle += 1
        if _solves(problem, tried):
            estimate = estimated(cloth, problem.levels(_literals(tried)), best)
            if _is_lower(estimate, best):
                signs, best, idle = tried, estimate, 0
        if idle == len(turns):
            break
    return problem.layering(_literals(signs)), best


def _turns(problem: OrderProblem) -> Iterator[Bools]:
    """Yield sets of classes to turn round together: each alone, those tied to each other, and few from one on."""
    number = np.arange(1, problem.n_variables + 1)
    yield from (number == one for one in number)
    yield from (np.isin(number, tied) for tied in problem.components() if 1 < len(tied) < len(number))
    if len(number) <= _MOST_IN_ROWS:
        yield from (number >= one for one in number[1:])


def _is_lower(one: Estimate, other: Estimate) -> bool:
    """Tell whether one is lower, or as low and more at ease; neither by a hair's breadth, which depends on the mesh."""
    if abs(one.height - other.height) > _LOWER * other.height:
        return one.height < other.height
    return one.energy < other.energy * (1 - _LOWER)


def _signs(problem: OrderProblem, layering: Layering) -> Ints:
    """Return 1 for each variable that is true in a layering, and −1 for the others."""
    pairs = np.flatnonzero(problem.literal > 0)
    _, first = np.unique(problem.literal[pairs], return_index=True)
    lower, upper = problem.graph.lower[pairs[first]], problem.graph.upper[pairs[first]]
    return np.where(layering.level[upper] > layering.level[lower], 1, -1)


def _literals(signs: Ints) -> list[int]:
    return [int(literal) for literal in signs * np.arange(1, len(signs) + 1)]


def _solves(problem: OrderProblem, signs: Ints) -> bool:
    """Tell whether of no three orders that make a circle all are true or all are false."""
    true = signs[np.abs(problem.triples) - 1] == np.sign(problem.triples)
    return bool((true.any(axis=1) & ~true.all(axis=1)).all())
