"""Which layering of an immersed surface is lifted: the one that stays lowest, unless another one is asked for.

Candidates are the first layering, the nicest one (or, where that takes too long, one with few changes), and what
:mod:`plyfold.surface.low` makes of the better of these. Their heights are solved and compared on the mesh of the
surface itself, the most promising candidate first; one that would be higher even if it touched itself at crossings
alone is left out. Triangles and the factors of their matrices are the same for all of them.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias, get_args

import numpy as np

from plyfold.arrays import Floats
from plyfold.clock import UNWATCHED, Clock, Watch
from plyfold.errors import InputError, PlyfoldError, TimeLimitError
from plyfold.layering.layering import Layering
from plyfold.layering.orders.intersections import IntersectingLayering
from plyfold.layering.orders.nicest import nicest_layering, walked_layering
from plyfold.layering.orders.search import OrderProblem, order_problem
from plyfold.matrices import one_thread
from plyfold.memory import number_of_tuples
from plyfold.mesh.cells import DEFAULT_TRIANGLES
from plyfold.surface.glue import LiftedMesh, stack_sheets
from plyfold.surface.heights import SpreadCloth, spread_cloth
from plyfold.surface.low import crossing_cloth, estimated, lowered
from plyfold.surface.making import Making, raised, steps_of
from plyfold.surface.stairs import Steps

__all__ = ["LayeringChoice", "Raised", "raised_as_chosen", "refuse_choice"]

LayeringChoice: TypeAlias = Literal["low", "first", "nicest"]

_STAGE = "choosing the layering"
# Of the time that is left: for candidates, and for heights of others than the most promising one.
_TO_FIND, _TO_COMPARE = 0.25, 0.5
# With more triples of sheets over cells than this, or more classes, or more seconds, candidates are not looked for, or
# not for the nicest.
_MOST_TRIPLES, _MOST_CLASSES, _LONGEST = 2_000_000, 150, 1.0
# Surfaces with more triangles are compared on a coarser mesh, if there is one with half of them.
_MANY = 20_000
# Rounding errors of ranges.
_SAME = 1e-5


@dataclass(frozen=True, eq=False)
class Raised:
    """A layering with its mesh and its vertices, (v, 3)."""

    layering: Layering | IntersectingLayering
    mesh: LiftedMesh
    vertices: Floats

    @property
    def height(self) -> float:
        """The range of heights."""
        return float(np.ptp(self.vertices[:, 2]))


def refuse_choice(choose: object) -> None:
    """Raise InputError for what is no choice."""
    if choose not in get_args(LayeringChoice):
        raise InputError(f"there is no choice {choose!r} of a layering", hint='use "low", "first" or "nicest"')


def raised_as_chosen(  # noqa: PLR0913 - as raised, for several layerings
    first: Layering | IntersectingLayering,
    choose: LayeringChoice,
    steps: Steps,
    gap: float,
    making: Making,
    *,
    watch: Watch = UNWATCHED,
) -> Raised:
    """Return the surface of the layering that is chosen, over the immersion of the first one.

    Parameters
    ----------
    first : Layering or IntersectingLayering
        The latter is taken as it is.
    choose : {"low", "first", "nicest"}
    steps : Steps
        Of the mesh that is made.
    gap : float
    making : Making
    watch : Watch, optional

    Returns
    -------
    Raised

    Raises
    ------
    TimeLimitError
        If the time is over before there is any surface, or the nicest layering is known.
    """
    ground = _Ground(steps, gap, making)
    if choose == "nicest" and isinstance(first, Layering):
        first = _nicest(first, watch)
    problem = _problem(first, watch) if choose == "low" and isinstance(first, Layering) else None
    if problem is None or not isinstance(first, Layering):
        return _raised(first, ground, watch)
    coarser = _coarser(first, ground, watch)
    if coarser is None:
        return _lowest(problem, first, ground, watch)
    return _raised(_lowest(problem, first, coarser, _quiet(watch)).layering, ground, watch)


@dataclass(frozen=True, eq=False)
class _Ground:
    """What all layerings have in common: the triangles over the cells, the options, and sometimes the cloth."""

    steps: Steps
    gap: float
    making: Making
    spread: SpreadCloth | None = None


def _raised(layering: Layering | IntersectingLayering, ground: _Ground, watch: Watch) -> Raised:
    mesh = stack_sheets(layering, ground.steps.cells, watch)
    vertices = raised(mesh, ground.steps, ground.gap, ground.making, watch=watch, spread=ground.spread)
    return Raised(layering, mesh, vertices)


def _coarser(first: Layering, ground: _Ground, watch: Watch) -> _Ground | None:
    """Return the same with fewer triangles; None where there are not many, or no less with less asked for."""
    is_least = ground.making.max_area is None and ground.making.triangles <= DEFAULT_TRIANGLES
    if is_least or (triangles := _count(first, ground.steps)) <= _MANY:
        return None
    making = replace(ground.making, triangles=DEFAULT_TRIANGLES, max_area=None)
    steps = steps_of(first, making, _quiet(watch))
    return _Ground(steps, ground.gap, making) if 2 * _count(first, steps) <= triangles else None


def _nicest(first: Layering, watch: Watch) -> Layering:
    watch.begin(_STAGE)
    found = nicest_layering(first.immersion, watch.clock.left)
    if isinstance(found, Layering):
        return found
    raise TimeLimitError(found.sentence, hint="allow more time, or choose another layering", stage=_STAGE)


def _count(layering: Layering, steps: Steps) -> int:
    return int(layering.immersion.arrangement.winding[steps.cells.cell].sum())


def _quiet(watch: Watch) -> Watch:
    """Return the watch over stages that nobody is told of."""
    return replace(watch, progress=None)


def _hurried(watch: Watch, part: float) -> Watch:
    """Return the same with a part of the time."""
    return replace(_quiet(watch), clock=watch.clock.share(part))


# ---- candidates ------------------------------------------------------------------------------------------------------


def _problem(first: Layering, watch: Watch) -> OrderProblem | None:
    """Return the problem that has several solutions, not counting upside down; None also where it is large."""
    if number_of_tuples(first.immersion.arrangement.winding, 3) > _MOST_TRIPLES:
        return None
    with suppress(TimeoutError):
        problem = order_problem(first.immersion, watch.begin(_STAGE).clock.share(_TO_FIND))
        return problem if isinstance(problem, OrderProblem) and problem.n_variables > 1 else None
    return None


def _nice(problem: OrderProblem, clock: Clock) -> Iterator[Layering]:
    """Yield the nicest layering, or one that is nice."""
    if problem.n_variables <= _MOST_CLASSES:
        seconds = _LONGEST if clock.left is None else min(_LONGEST, clock.left)
        found = nicest_layering(problem.immersion, seconds)
        if isinstance(found, Layering):
            yield found
            return
    with suppress(TimeoutError):
        yield walked_layering(problem, clock)


def _distinct(layerings: Iterator[Layering]) -> list[Layering]:
    """Return layerings without those that are the same as one before, or the same upside down."""
    kept: list[Layering] = []
    for layering in layerings:
        upside_down = layering.immersion.arrangement.winding[layering.immersion.sheet_cell] + 1 - layering.level
        if not any(np.array_equal(each.level, level) for each in kept for level in (layering.level, upside_down)):
            kept.append(layering)
    return kept


@one_thread()
def _candidates(
    problem: OrderProblem, first: Layering, mesh: LiftedMesh, spread: SpreadCloth | None, watch: Watch
) -> list[tuple[float, Layering]]:
    """Return layerings with bounds of their ranges in gaps, nearly, the lowest first; the bound is 0 if not known."""
    found = _distinct(_and_nice(problem, first, watch.clock))
    cloth = None if spread is None else crossing_cloth(problem, mesh, spread)
    if cloth is None:
        return [(0.0, layering) for layering in found]
    ranked = sorted(((estimated(cloth, each.level).height, each) for each in found), key=lambda pair: pair[0])
    with suppress(TimeLimitError):
        lower, estimate = lowered(problem, ranked[0][1], cloth, watch)
        if lower.level.tolist() not in [layering.level.tolist() for layering in found]:
            ranked.insert(0, (estimate.height, lower))
    return ranked


def _and_nice(problem: OrderProblem, first: Layering, clock: Clock) -> Iterator[Layering]:
    yield first
    yield from _nice(problem, clock)


# ---- comparing them --------------------------------------------------------------------------------------------------


def _lowest(problem: OrderProblem, first: Layering, ground: _Ground, watch: Watch) -> Raised:
    """Return the lowest of the candidates."""
    hurried = _hurried(watch, _TO_FIND)
    mesh = stack_sheets(first, ground.steps.cells, _quiet(watch))
    ground = replace(ground, spread=_spread(mesh, ground, _quiet(watch)))
    return _lowest_of(_candidates(problem, first, mesh, ground.spread, hurried), ground, watch)


def _spread(mesh: LiftedMesh, ground: _Ground, watch: Watch) -> SpreadCloth | None:
    """Return the cloth that all layerings have in common; None if pieces, stairs or pins make it another one each."""
    if ground.making.pins or len(ground.steps.outer) or mesh.piece.any():
        return None
    return spread_cloth(ground.steps.cells.points, mesh, ground.making.stiffness, ground.making.flat, watch)


def _lowest_of(candidates: list[tuple[float, Layering]], ground: _Ground, watch: Watch) -> Raised:
    """Return the lowest surface; of those that cannot be made or take too long there must be one less than all."""
    best, failed = None, None
    for bound, layering in candidates:
        if best is not None and bound * ground.gap >= best.height:
            break
        try:
            found = _raised(layering, ground, watch if best is None else _hurried(watch, _TO_COMPARE))
        except TimeLimitError:
            if best is None:
                raise
            break
        except PlyfoldError as error:
            failed = failed or error
            continue
        if best is None or found.height < best.height * (1 - _SAME):
            best = found
    if best is None:
        raise failed or PlyfoldError("internal check failed: there is a layering")
    return best
