"""Time of the verdict on layerings: ``python benchmarks/layering.py``, about a minute.

Families: ribbons, dense disks, chains of Milnor's doodle, disks of random formulas near the threshold, Paley's digraph.
For each the time of the drawing with its immersion and that of ``find_layering``; and, where it ends within the limit,
that of trying all 2^k casings (tests/reference/casings.py), which settles the curve, whatever the immersion.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from families import glued_disk, ribbon_disk
from tables import number

import plyfold as pf
from plyfold.gallery import CURVES, chain
from plyfold.hard.flaps import PALEY, flap_disk
from plyfold.hard.formulas import formula_disk

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))

from reference.casings import casing_solutions
from reference.planar_maps import gauss_code

CASINGS_UP_TO = 16
LIMIT = 60.0


class Case(NamedTuple):
    """A curve of some size, and how to make its immersion."""

    family: str
    size: int
    immersion: Callable[[], pf.Immersion]


def cases() -> Iterator[Case]:
    for vertices in (30, 100, 300, 1_000, 3_000, 10_000):
        yield Case("ribbon", vertices, lambda n=vertices: pf.find_immersion(ribbon_disk(n)))
    for vertices in (12, 20, 50, 100, 200, 400):
        yield Case("dense disk", vertices, lambda n=vertices: pf.find_immersion(glued_disk(n)))
    for links in (1, 2, 3, 10, 30, 100):
        yield Case("chain", links, lambda n=links: pf.find_immersion(chain(CURVES["milnor"].draw(), n)))
    for clauses in (1, 2, 5, 10, 20):
        yield Case("formula", clauses, lambda n=clauses: formula_disk(random_formula(n)).disk.immersion)
    yield Case("Paley", 7, lambda: flap_disk(7, PALEY).immersion)


def random_formula(clauses: int, seed: int = 0) -> list[tuple[int, ...]]:
    """Return random clauses of three literals, 2.1 for each variable: about half of such formulas are satisfiable."""
    rng = np.random.default_rng(seed)
    names = max(3, round(clauses / 2.1))
    chosen = [(1 + rng.choice(names, 3, replace=False)) * rng.choice([-1, 1], 3) for _ in range(clauses)]
    return [tuple(clause.tolist()) for clause in chosen]


def timed(action: Callable[[], Any]) -> tuple[float, Any]:
    start = time.perf_counter()
    result = action()
    return time.perf_counter() - start, result


def casing_seconds(immersion: pf.Immersion) -> float | None:
    if not 1 <= immersion.arrangement.n_crossings <= CASINGS_UP_TO:
        return None
    code = gauss_code(*immersion.arrangement.gauss_code())
    return timed(lambda: sum(1 for _ in casing_solutions(code)))[0]


def row(case: Case) -> str:
    made, immersion = timed(case.immersion)
    arrangement = immersion.arrangement
    decided, found = timed(lambda: pf.find_layering(immersion, time_limit=LIMIT))
    verdict = "lifts" if found else getattr(found, "reason", "unknown")
    cells = [case.family, f"{case.size:,}", f"{arrangement.n_crossings:,}", str(arrangement.winding.max()), verdict]
    return f"| {' | '.join([*cells, *map(number, (made, decided, casing_seconds(immersion)))])} |"


def main() -> None:
    """Print the table, line by line."""
    print("| family | size | k | w | verdict | immersion (s) | layering (s) | all casings (s) |")
    print("|---|---:|---:|---:|---|---:|---:|---:|")
    for case in cases():
        print(row(case), flush=True)


if __name__ == "__main__":
    main()
