"""Where sheets touch in thousands of places: springs at the contacts, instead of one unknown force after the other.

The method of multipliers: springs that become stiffer, and forces that take over the load of the springs after each
round, until these have nothing left to carry. For given stiffness and forces the energy is convex and piecewise
quadratic, so Newton's method ends after a few steps. (Stiff springs alone would leave a rest, above all where sheets
touch in a single point, and removing it afterwards would draw a spike there.)
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from plyfold.arrays import Bools, Floats
from plyfold.clock import Watch
from plyfold.surface.contact import Distances, Problem
from plyfold.surface.energy import factorised

__all__ = ["sprung_heights"]

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
