"""Where sheets touch: the least energy of cloth whose heights keep some distances, found from the forces of contact.

Cloth rests on cloth in few places, mostly at single points where an edge lies on a sheet. So the unknowns are not the
heights but the forces there. They start at none; in each round the worst places join, the forces that keep all places
apart follow from a small dense problem, and heights answer to forces at the cost of two sparse systems. Places that no
longer need a force leave.

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
from plyfold.matrices import definite_solution, factorised, one_thread
from plyfold.surface.answers import Answers
from plyfold.surface.energy import Cloth

__all__ = ["Distances", "Problem", "forced_heights", "least_forces", "sprung_heights"]


# More places than this are left to springs: the dense problem would take gigabytes.
_MOST_PLACES = 8000
# Forces below this fraction of the largest are rounding errors.
_NO_FORCE = 1e-11
# Places that miss less than this part of the worst are left for later: mostly, they come right without a force.
_WORTH_A_FORCE = 0.05
# So many places join in a round, at most, and as many again as there are.
_FIRST_PLACES = 16
# Places without a force for so many rounds are left out.
_IDLE = 2
# Every round proves a higher least energy, so no places come back all together; but rounding errors might bring them.
_MOST_ROUNDS = 1000
_ROUNDS_PER_PLACE = 5
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


@dataclass(frozen=True, eq=False)
class Balance:
    """Heights that balance forces on the distances of a problem: of all heights these forces ask for the least energy.

    Parameters
    ----------
    heights : (v,) float
    force : (c,) float
        None of them pulls, but on exact distances.
    """

    heights: Floats
    force: Floats

    def least_energy(self, problem: Problem) -> float:
        """Return an energy that no heights which keep the distances have less than (the Lagrangian dual)."""
        room = problem.wanted.rows @ self.heights - problem.wanted.least
        return problem.cloth.energy(self.heights) - float(self.force @ room)


@dataclass(frozen=True, eq=False)
class _Contacts:
    """Places where a force may act; those that had none for some rounds are left out again.

    Parameters
    ----------
    places : (p,) int
        Rows of the distances.
    force : (p,) float
    idle : (p,) int
        For how many rounds there was no force.
    flexibility : (p, p) float
        How distances grow with forces.
    """

    places: Ints
    force: Floats
    idle: Ints
    flexibility: Floats

    @classmethod
    def none(cls) -> _Contacts:
        """Return no places."""
        return cls(np.empty(0, dtype=np.int64), np.empty(0), np.empty(0, dtype=np.int64), np.empty((0, 0)))

    def joined(self, added: Ints, rows: Any, answers: Answers) -> _Contacts:
        """Return the contacts with more of them, with no force as yet."""
        if not len(added):
            return self
        places, none = np.append(self.places, added), np.zeros(len(added))
        flexibility = _bordered(self.flexibility, answers.between(rows[places], rows[added]))
        return _Contacts(places, np.append(self.force, none), np.append(self.idle, none.astype(np.int64)), flexibility)

    def with_forces(self, force: Floats, exact: int) -> _Contacts:
        """Return the contacts with other forces, without the places that are idle for long."""
        idle = np.where(force == 0, self.idle + 1, 0)
        kept = np.flatnonzero((idle < _IDLE) | (np.arange(len(idle)) < exact))
        if len(kept) == len(idle):
            return _Contacts(self.places, force, idle, self.flexibility)
        return _Contacts(self.places[kept], force[kept], idle[kept], self.flexibility[np.ix_(kept, kept)])

    def forces(self, count: int) -> Floats:
        """Return the forces on all distances, of which there are so many."""
        force = np.zeros(count)
        force[self.places] = self.force
        return force


@one_thread()
def forced_heights(problem: Problem, watch: Watch, answers: Answers | None = None) -> Balance | None:
    """Return the heights of least energy, from the forces that keep the distances.

    Parameters
    ----------
    problem : Problem
    watch : Watch
    answers : Answers, optional
        Those of the problem's cloth, if they are there already.

    Returns
    -------
    Balance or None
        Heights up to a constant if no vertex is held. None where there are too many places of contact, or where no
        forces keep them apart. Cost: an answer to forces in each of some dozens of rounds.
    """
    held, wanted, tolerance = problem.held, problem.wanted, problem.tolerance
    answers, across = answers or Answers(problem.cloth, held, watch), wanted.rows.T.tocsr()
    base = problem.given - (answers.heights(problem.cloth.stiffness @ problem.given) if held.any() else 0.0)
    found, contacts, done = Balance(base, np.zeros(len(wanted.least))), _Contacts.none(), 0.0
    added = (
        np.arange(wanted.exact) if wanted.exact else _worst(wanted, wanted.missing(base), contacts.places, tolerance)
    )
    for _ in range(_MOST_ROUNDS):
        if not len(added):
            return found
        contacts = contacts.joined(added, wanted.rows, answers)
        if len(contacts.places) > _MOST_PLACES:
            return None
        pushed = _pushed(contacts, wanted, found.heights, watch)
        if pushed is None:
            return None
        contacts, force = pushed, pushed.forces(len(wanted.least))
        found = Balance(base + answers.heights(across @ force), force)
        missing = wanted.missing(found.heights)
        done = max(done, _share_done(missing, tolerance))
        watch.step(done)
        added = _worst(wanted, missing, contacts.places, tolerance)
    return None


def _pushed(contacts: _Contacts, wanted: Distances, z: Floats, watch: Watch) -> _Contacts | None:
    """Return the contacts with the forces that keep their distances, given the heights at their present forces."""
    # What is missing without forces, from what is missing now: so rounding errors do not add up.
    missing = wanted.least[contacts.places] - wanted.rows[contacts.places] @ z
    short = missing + contacts.flexibility @ contacts.force
    pressing = (contacts.force != 0) | (contacts.idle == 0)
    force = least_forces(contacts.flexibility, short, wanted.exact, pressing, watch)
    return None if force is None else contacts.with_forces(force, wanted.exact)


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
    return np.asarray(large[: _FIRST_PLACES + len(places)])


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
    >>> least_forces(np.array([[4.0, 1.0], [1.0, 4.0]]), np.array([3.0, -9.0]), 0, np.array([True, True])).tolist()
    [0.75, 0.0]
    """
    fewest, patience = len(short) + 1, _PATIENCE
    for _ in range(_ROUNDS_PER_PLACE * len(short) + 100):
        watch.step()
        force = np.zeros(len(short))
        try:
            force[pressing] = definite_solution(flexibility[np.ix_(pressing, pressing)], short[pressing])
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

# Stiffness of the springs, with membrane energy and gap as units, at first and at most; how much stiffer they become
# where a round does not leave a small part of what was missing.
_SOFT, _STIFF, _STIFFER = 1.0, 1e9, 10.0
_LEFT = 0.25
_SPRING_ROUNDS = 60
_NEWTON_STEPS = 25


def sprung_heights(problem: Problem, watch: Watch) -> Balance:
    """Return the heights of least energy that keep all distances as well as can be.

    Parameters
    ----------
    problem : Problem
    watch : Watch

    Returns
    -------
    Balance
        Cost: some dozens of factorisations of K with the springs; hundreds only where no heights keep the distances.
    """
    wanted, tolerance = problem.wanted, problem.tolerance
    found, stiffness, before = Balance(problem.given, np.zeros(len(wanted.least))), _SOFT, np.inf
    for done in range(_SPRING_ROUNDS):
        for step, better in enumerate(_newton_steps(problem, found, stiffness, watch)):
            sprung = better
            watch.step((done + step / _NEWTON_STEPS) / _SPRING_ROUNDS)
        found = sprung
        missing = float(np.max(wanted.missing(found.heights), initial=0.0))
        if missing <= tolerance:
            break
        if missing > _LEFT * before:
            stiffness = min(_STIFFER * stiffness, _STIFF)
        before = missing
    return found


def _newton_steps(problem: Problem, found: Balance, stiffness: float, watch: Watch) -> Iterator[Balance]:
    """Yield ever better minimisers of the energy with springs and forces, until the same contacts press again."""
    wanted, held, z, force = problem.wanted, problem.held.copy(), found.heights, found.force
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
        # What the springs carry, forces take over.
        carried = np.where(pressing, force + stiffness * (wanted.least - wanted.rows @ z), 0.0)
        carried[wanted.exact :] = np.maximum(0, carried[wanted.exact :])
        yield Balance(z, carried)
        before, pressing = pressing, _pressing(wanted, z, force, stiffness)
        if (before == pressing).all():
            return


def _pressing(wanted: Distances, z: Floats, force: Floats, stiffness: float) -> Bools:
    """Tell which rows push; those with an exact value always count."""
    pressing = force + stiffness * (wanted.least - wanted.rows @ z) > 0
    pressing[: wanted.exact] = True
    return np.asarray(pressing)
