"""Where sheets touch: the least energy of cloth whose heights keep some distances, found from the forces of contact.

Cloth rests on cloth in few places, mostly at single points where an edge lies on a sheet. So the unknowns are not the
heights but the forces there. They start at none; in each round the worst places join, the forces that keep all places
apart follow from a small dense problem, and heights answer to forces at the cost of two sparse systems.

It ends when distances asked for a little too large are kept to within that little: then all distances are kept, and
no other heights that keep them have less energy but for this little.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from plyfold.arrays import Bools, Floats, Ints
from plyfold.clock import UNWATCHED, Watch
from plyfold.matrices import factorised, one_thread
from plyfold.surface.energy import Cloth, Response, held_response, response

__all__ = ["Distances", "Problem", "forced_heights", "least_forces", "sprung_heights"]


# More places than this are left to springs: the dense problem would outgrow the sparse ones.
_MOST_PLACES = 3000
# Forces below this fraction of the largest are rounding errors.
_NO_FORCE = 1e-11
# Places that miss less than this part of the worst are left for later: mostly, they come right without a force.
_WORTH_A_FORCE = 0.3
_ROUNDS_PER_PLACE = 5
# Answers found together: of more, the caches and the threads of BLAS make up to eight times as slow work.
_AT_ONCE = 8
_PATIENCE = 3


@dataclass(frozen=True, eq=False)
class Distances:
    """Rows of a matrix D, and the least values of Dz; the first rows must have exactly theirs.

    Parameters
    ----------
    rows : (c, v) sparse array
        Differences of heights, or weighted means of them.
    least : (c,) float
    exact : int
        How many rows must have exactly their value.
    beside : (e, 2) int
        Pairs of rows over neighbouring points.
    """

    rows: Any
    least: Floats
    exact: int
    beside: Ints

    def missing(self, z: Floats) -> Floats:
        """Return how much each distance is too small; of the exact ones, how far they are off."""
        missing = self.least - self.rows @ z
        missing[: self.exact] = np.abs(missing[: self.exact])
        return np.asarray(missing)


@dataclass(frozen=True, eq=False)
class Problem:
    """The least energy with given distances, in gaps.

    Parameters
    ----------
    cloth : Cloth
    wanted : Distances
    held : (v,) bool
        Vertices whose heights are given.
    given : (v,) float
        These heights; 0 for the others.
    tolerance : float
        By how much a distance may be smaller than wanted.
    """

    cloth: Cloth
    wanted: Distances
    held: Bools
    given: Floats
    tolerance: float


@one_thread()
def forced_heights(problem: Problem, watch: Watch) -> Floats | None:
    """Return the heights of least energy, from the forces that keep the distances.

    Parameters
    ----------
    problem : Problem
    watch : Watch

    Returns
    -------
    (v,) float or None
        Up to a constant if no vertex is held. None where there are too many places of contact, or where no forces keep
        them apart. Cost: two or three answers to forces for each place of contact.
    """
    cloth, held, wanted, tolerance = problem.cloth, problem.held, problem.wanted, problem.tolerance
    respond = held_response(cloth, held, watch) if held.any() else response(cloth, watch)
    base = problem.given - respond(cloth.stiffness @ problem.given) if held.any() else problem.given
    places, force, flexibility, done = np.empty(0, dtype=np.int64), np.empty(0), np.empty((0, 0)), 0.0
    z, short = base, wanted.least - wanted.rows @ base
    added = np.arange(wanted.exact) if wanted.exact else _worst(wanted, short, places, tolerance)
    while len(added):
        places = np.concatenate([places, added])
        if len(places) > _MOST_PLACES:
            return None
        there = wanted.rows[places]
        flexibility = _bordered(flexibility, _columns(there, respond, len(added)))
        pressing = np.append(force != 0, np.ones(len(added), dtype=bool))
        found = least_forces(flexibility, short[places], wanted.exact, pressing, watch)
        if found is None:
            return None
        force = found
        z = base + respond(there.T @ force)
        missing = wanted.missing(z)
        done = max(done, _share_done(missing, tolerance))
        watch.step(done)
        added = _worst(wanted, missing, places, tolerance)
    return z


def _worst(wanted: Distances, missing: Floats, places: Ints, tolerance: float) -> Ints:
    """Return the rows that miss most: more than all neighbours, and not yet among the places; a few at first."""
    most = missing.copy()
    first, second = wanted.beside.T
    np.maximum.at(most, first, missing[second])
    np.maximum.at(most, second, missing[first])
    peak = (missing >= most) & (missing > tolerance)
    peak[places] = False
    peaks = np.flatnonzero(peak)
    by_size = peaks[np.argsort(-missing[peaks], kind="stable")]
    large = by_size[missing[by_size] >= _WORTH_A_FORCE * missing[by_size[:1]]]
    return np.asarray(large[: 1 + len(places) // 2])


def _columns(rows: Any, respond: Response, count: int) -> Floats:
    """Return how the distances in all rows answer to forces at the last ones, each in a column."""
    parts = np.array_split(np.arange(rows.shape[0] - count, rows.shape[0]), -(-count // _AT_ONCE))
    return np.concatenate([rows @ respond(rows[part[0] : part[-1] + 1].T.toarray()) for part in parts], axis=1)


def _bordered(block: Floats, columns: Floats) -> Floats:
    """Return a symmetric matrix that begins with a block and ends with the given columns."""
    old, size = len(block), len(columns)
    whole = np.empty((size, size))
    whole[:old, :old], whole[:old, old:], whole[old:, :old] = block, columns[:old], columns[:old].T
    whole[old:, old:] = (columns[old:] + columns[old:].T) / 2
    return whole


def _share_done(missing: Floats, tolerance: float) -> float:
    """Return how far, on a scale of powers of ten, the largest miss is between the whole gap and the tolerance."""
    left = np.clip(missing.max(), tolerance, 1.0)
    return float(np.log(left) / np.log(tolerance))


def least_forces(
    flexibility: Floats, short: Floats, exact: int, pressing: Bools, watch: Watch = UNWATCHED
) -> Floats | None:
    """Return forces f, none of them pulling, that bring distances about at the least energy.

    Parameters
    ----------
    flexibility : (c, c) float
        Symmetric, positive definite: how distances grow with forces.
    short : (c,) float
        How much is missing without forces.
    exact : int
        So many of the first forces may pull too; they are pressing from the beginning.
    pressing : (c,) bool
        The places where forces are expected; others only cost time.
    watch : Watch, optional

    Returns
    -------
    (c,) float or None
        The minimum of ½ fᵀSf − fᵀs. By exchanging all wrong places at once, or, when this does not lead on, one. None
        if there is no end to it, because distances contradict each other or rounding errors decide.

    Examples
    --------
    >>> least_forces(np.array([[2.0, 1.0], [1.0, 2.0]]), np.array([3.0, -9.0]), 0, np.array([True, True])).tolist()
    [1.5, 0.0]
    """
    fewest, patience = len(short) + 1, _PATIENCE
    for _ in range(_ROUNDS_PER_PLACE * len(short) + 100):
        watch.step()
        force = np.zeros(len(short))
        try:
            force[pressing] = np.linalg.solve(flexibility[np.ix_(pressing, pressing)], short[pressing])
        except np.linalg.LinAlgError:
            return None
        wrong = _wrong(flexibility, short, force, pressing)
        wrong[:exact] = False
        count = int(wrong.sum())
        if not count:
            return force
        patience = _PATIENCE if count < fewest else patience - 1
        fewest = min(fewest, count)
        if patience < 0:
            wrong[: np.flatnonzero(wrong)[-1]] = False
        pressing = pressing ^ wrong
    return None


def _wrong(flexibility: Floats, short: Floats, force: Floats, pressing: Bools) -> Bools:
    """Tell which pressing places pull, and at which others a distance is too small."""
    missing = short - flexibility @ force
    pulls = force < -_NO_FORCE * np.abs(force).max(initial=0.0)
    return np.asarray(np.where(pressing, pulls, missing > _NO_FORCE * np.abs(short).max()))


# ---- where sheets touch in thousands of places -----------------------------------------------------------------------
#
# The method of multipliers: springs that become stiffer, and forces that take over the load of the springs after each
# round, until these have nothing left to carry. For given stiffness and forces the energy is convex and piecewise
# quadratic, so Newton's method ends after a few steps. (Stiff springs alone would leave a rest, above all where sheets
# touch in a single point, and removing it afterwards would draw a spike there.)

# Stiffness of the springs, with membrane energy and gap as units, for one round after the other.
_STIFFNESS = (1.0, 1e1, 1e2, *[1e3] * 6, *[1e4] * 6)
_NEWTON_STEPS = 25


def sprung_heights(problem: Problem, watch: Watch) -> Floats:
    """Return the heights of least energy that keep all distances as well as can be.

    Parameters
    ----------
    problem : Problem
    watch : Watch

    Returns
    -------
    (v,) float
        Cost: 15 to 25 factorisations of K with the springs; all of them only where no heights keep the distances.
    """
    wanted = problem.wanted
    z, force = problem.given, np.zeros(len(wanted.least))
    for done, stiffness in enumerate(_STIFFNESS):
        for step, better in enumerate(_newton_steps(problem, z, force, stiffness, watch)):
            z = better
            watch.step((done + step / _NEWTON_STEPS) / len(_STIFFNESS))
        if np.max(wanted.missing(z), initial=0.0) <= problem.tolerance:
            break
        force = force + stiffness * (wanted.least - wanted.rows @ z)
        force[wanted.exact :] = np.maximum(0, force[wanted.exact :])
    return z


def _newton_steps(problem: Problem, z: Floats, force: Floats, stiffness: float, watch: Watch) -> Iterator[Floats]:
    """Yield ever better minimisers of the energy with springs and forces, until the same contacts press again."""
    wanted, held = problem.wanted, problem.held.copy()
    # Heights may be known up to a constant only: hold one vertex.
    held[0] |= not held.any()
    free, matrix = np.flatnonzero(~held), problem.cloth.stiffness
    pressing = _pressing(wanted, z, force, stiffness)
    for _ in range(_NEWTON_STEPS):
        contact = wanted.rows[np.flatnonzero(pressing)]
        sprung = matrix + stiffness * (contact.T @ contact)
        load = contact.T @ (force + stiffness * wanted.least)[pressing] - sprung @ np.where(held, z, 0.0)
        z = z.copy()
        z[free] = factorised(sprung[free][:, free], watch).solve(load[free])
        yield z
        before, pressing = pressing, _pressing(wanted, z, force, stiffness)
        if (before == pressing).all():
            return


def _pressing(wanted: Distances, z: Floats, force: Floats, stiffness: float) -> Bools:
    """Tell which rows push; those with an exact value always count."""
    pressing = force + stiffness * (wanted.least - wanted.rows @ z) > 0
    pressing[: wanted.exact] = True
    return np.asarray(pressing)
