"""The census in parts, and what it will cost."""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import partial
from typing import Any

from plyfold.census.columns import census_table
from plyfold.census.plane_curves import CIRCLE, plane_curves
from plyfold.census.summary import Summary, number_of_plane_curves
from plyfold.tables.files import table_bytes
from plyfold.tables.parts import Job
from plyfold.tables.table import DataTable, joined

__all__ = ["Cost", "census_job", "cost_of_census"]

# A part has about so many curves, but every part begins with drawing where all parts begin.
_CURVES_PER_PART = 50_000
_MOST_PARTS = 1000
# With least homotopies.
_TIMES_AS_LONG = 10
_SAMPLES_PER_PART = 8


@dataclass(frozen=True)
class Cost:
    """What a census will take: an estimate from a sample.

    Attributes
    ----------
    curves : int
        How many curves there are.
    seconds : float
        Of one core.
    size : int
        Of the file, in bytes.
    """

    curves: int
    seconds: float
    size: int


def census_job(n_crossings: int, n_parts: int | None = None, homotopies: bool = False) -> Job:
    """Return the census of curves with so many crossings, by default in as many parts as are of a handy size."""
    handy = _CURVES_PER_PART // _TIMES_AS_LONG if homotopies else _CURVES_PER_PART
    n_parts = n_parts or min(max(number_of_plane_curves(n_crossings) // handy, 1), _MOST_PARTS)
    what = {"census": n_crossings, "homotopies": homotopies}
    return Job(what, range(n_parts), partial(_part, n_crossings, n_parts, homotopies))


def _part(n_crossings: int, of: int, homotopies: bool, number: int) -> tuple[DataTable, dict[str, Any]]:
    batches = list(plane_curves(n_crossings, number, of)) or [CIRCLE.rows(slice(0))]
    table = joined([census_table(batch, homotopies) for batch in batches])
    return table, Summary.of(n_crossings, table).note()


def cost_of_census(n_crossings: int, ending: str, homotopies: bool = False) -> Cost:
    """Measure a sample of the census, a few seconds long.

    Parameters
    ----------
    n_crossings : int
    ending : str
        Of the file to be written.
    homotopies : bool, optional
        Whether it has the columns of least homotopies.

    Returns
    -------
    Cost
    """
    of = _SAMPLES_PER_PART * len(census_job(n_crossings, None, homotopies).parts)
    started = time.process_time()
    tables = [_part(n_crossings, of, homotopies, number)[0] for number in range(of // 6, of, of // 3)]
    seconds, curves = time.process_time() - started, number_of_plane_curves(n_crossings)
    sample = joined(tables)
    share = curves / len(sample)
    return Cost(curves, seconds * share, round(len(table_bytes(sample, ending)) * share) if ending else 0)
