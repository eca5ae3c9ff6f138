"""The verdicts on many outlines, as a table."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from plyfold.arrangement.arrangement import Arrangement, arrange
from plyfold.arrangement.as_given import crossings_as_given, given_windings
from plyfold.arrays import Bools, Ints
from plyfold.core.buffers import flat
from plyfold.core.many import decide_each
from plyfold.core.pauses import pause
from plyfold.core.verdict import NO, YES
from plyfold.errors import InputError, PlyfoldError
from plyfold.immersion.obstructions import may_bound_disk
from plyfold.immersion.solve import count_immersions, find_immersion
from plyfold.layering.embedding import find_embedding
from plyfold.many.answers import in_batches
from plyfold.many.given import ManyOutlines, ManyOutlinesLike, as_many
from plyfold.obstruction import Obstruction, Unknown
from plyfold.offers.repair import Repaired, repair
from plyfold.report import touches_of
from plyfold.tables.table import Column, DataTable, joined

if TYPE_CHECKING:
    from distributed import Client

__all__ = ["DEFAULT_COLUMNS", "VERDICT_COLUMNS", "checked_columns", "verdicts", "verdicts_of_batch"]

DEFAULT_COLUMNS = ("crossings", "loops", "turning", "verdict", "reason", "error")
"""Those that cost no more than the verdict."""

VERDICT_COLUMNS = (*DEFAULT_COLUMNS, "place", "immersions", "embeddable", "levels", "repair")
"""All that there are."""

# What each of them is made of: missing numbers and truth values are masked, missing objects None.
_KIND = {
    "crossings": np.int64,
    "loops": np.int64,
    "turning": np.int64,
    "verdict": object,
    "reason": object,
    "error": object,
    "place_x": np.float64,
    "place_y": np.float64,
    "immersions": object,
    "embeddable": np.bool_,
    "levels": np.int64,
    "repair": np.float64,
}
_OF_DISKS = frozenset(("immersions", "embeddable", "levels", "repair"))
_OF_OTHERS = frozenset(("place", "repair"))


def verdicts(
    outlines: ManyOutlinesLike,
    columns: Iterable[str] = DEFAULT_COLUMNS,
    *,
    time_limit: float | None = None,
    client: Client | None = None,
) -> DataTable:
    """Return the verdicts on many outlines as a table, one row each.

    Parameters
    ----------
    outlines : iterable, or tuple of two arrays
        Arrays of shape (n, 2), geometries of shapely, the bytes of WKB, or whatever else stands for an outline, in a
        list, an array, a column of pandas or Arrow, a ``GeoSeries`` or ``GeoDataFrame``; an array of shape (m, n, 2);
        or ``(coordinates, offsets)`` of shapes (n, 2) and (m + 1,): curve i has the points ``offsets[i]`` up to
        ``offsets[i + 1]``.
    columns : iterable of str, optional
        Which, in which order; by default the first six.

        * ``crossings``: how often two edges cross inside both; ``loops``; ``turning``, the turning number.
        * ``verdict``: ``"disk"``, ``"surface"`` (another one), either with ``" that touches itself"`` behind it,
          ``"none"``, or ``"unknown"``, at the time limit.
        * ``reason``: why there is none, see :class:`Obstruction`.
        * ``error``: what is wrong with what is no outline, or what went wrong later; all that it left unknown is
          missing.
        * ``place``: two columns, ``place_x`` and ``place_y``: a place of the obstruction or of the error.
        * ``immersions``: how many, whole numbers of any size.
        * ``embeddable``: whether one of them can be lifted; ``levels``: in how many layers, if so.
        * ``repair``: the part of the covered area that :func:`~plyfold.repair` changes to make it a disk, or, if it has
          several loops, a surface; missing if it does not.
    time_limit : float, optional
        Seconds for each question about an outline that cannot be that of a disk alone, for ``embeddable``, and for
        ``repair``; what is not told then is missing. None by default.
    client : distributed.Client, optional
        A Dask cluster that does the work.

    Returns
    -------
    DataTable
        With ``to_numpy``, ``to_arrow`` and ``to_pandas``. Missing numbers are masked, missing text is None.

    Raises
    ------
    InputError
        If there is no such column, or what is given does not hold outlines. Bad outlines are rows with their error.

    Notes
    -----
    Every row has what the single calls say: `arrange`, `find_immersion`, `count_immersions`, `find_embedding` and
    `repair`. Plain points go through the stages one after the other in compiled code, without a value and without a
    call between them: a simple 30-gon takes about 15 µs, a random curve with 40 points and 300 crossings 50 µs. All
    else takes what the single calls take, milliseconds each; and so do the columns that are not there by default, but
    for curves that do not cross themselves.

    Examples
    --------
    >>> table = verdicts([[(0, 0), (4, 0), (0, 3)], [(0, 0), (2, 2), (2, 0), (0, 2)], [(0, 0), (1, 1)]])
    >>> table["verdict"].tolist(), table["crossings"].tolist()
    (['disk', 'none', None], [0, 1, None])
    >>> table["error"][2]
    'the curve has only 2 different point(s), at (0, 0), (1, 1)'
    """
    wanted, given = checked_columns(columns), as_many(outlines)
    call = partial(verdicts_of_batch, columns=wanted, time_limit=time_limit)
    return joined([call(given.rows(0, 0)), *in_batches(given, call, client)])


def checked_columns(columns: Iterable[str]) -> tuple[str, ...]:
    """Return the names of columns, or refuse one that there is not."""
    wanted = (columns,) if isinstance(columns, str) else tuple(dict.fromkeys(columns))
    for name in wanted:
        if name not in VERDICT_COLUMNS:
            raise InputError(f"there is no column {name!r}", hint=f"choose of {', '.join(VERDICT_COLUMNS)}")
    return wanted


def verdicts_of_batch(outlines: ManyOutlines, columns: Collection[str], time_limit: float | None = None) -> DataTable:
    """Return the rows of a table of verdicts, all in memory at once."""
    decided = _Decided.of(outlines)
    settled = decided.settled(columns)
    found = {name: _column(name, decided, settled) for name in _names(columns)}
    for row in np.flatnonzero(~settled).tolist():
        for name, value in _row_by_values(outlines, row, columns, time_limit).items():
            if name in found and value is not None:
                found[name][row] = value
    return DataTable(found)


def _names(columns: Collection[str]) -> list[str]:
    return [name for column in columns for name in (("place_x", "place_y") if column == "place" else (column,))]


@dataclass(frozen=True)
class _Decided:
    """What compiled code tells of plain curves: the verdict, if it does, and how they cross, turn and wind."""

    told: Ints
    crossings: Ints
    turning: Ints
    lowest: Ints

    @classmethod
    def of(cls, outlines: ManyOutlines) -> _Decided:
        """Decide many outlines; nothing is told of others than plain curves."""
        told, figures = np.empty(len(outlines), dtype=np.int64), np.zeros((len(outlines), 3), dtype=np.int64)
        decide_each(flat(outlines.points), flat(outlines.first), flat(told), flat(figures), pause)
        crossings, turning, lowest = figures.T
        return cls(told, crossings, turning, lowest)

    def settled(self, columns: Collection[str]) -> Bools:
        """Tell in which rows all columns follow from that."""
        is_disk, is_none = self.told == YES, self.is_none
        if not _OF_DISKS.isdisjoint(columns):
            is_disk &= self.crossings == 0
        return np.asarray(is_disk | is_none if _OF_OTHERS.isdisjoint(columns) else is_disk)

    @property
    def is_none(self) -> Bools:
        """Which curves bound nothing at all: those that turn -1, -3, … times may bound disks with handles."""
        return np.asarray((self.told == NO) & ((self.turning >= 0) | (self.turning % 2 == 0)))

    @property
    def verdict(self) -> Column:
        """The words for disks and for curves that bound nothing."""
        found: Column = np.array(["none", "disk"], dtype=object)[(self.told == YES).astype(np.int64)]
        return found

    @property
    def reason(self) -> Column:
        """Why a curve bounds nothing; None for disks."""
        reasons = np.array([None, "turning number", "negative winding", "no grouping"], dtype=object)
        of_once = np.where(self.lowest < 1, 2, 3)
        found: Column = reasons[np.where(self.told == YES, 0, np.where(self.turning == 1, of_once, 1))]
        return found


def _column(name: str, decided: _Decided, settled: Bools) -> Column:
    """Return a column with the rows that are settled; all others are missing."""
    is_disk = decided.told == YES
    missing = np.ones(len(settled), dtype=bool)
    match name:
        case "crossings" | "turning" | "verdict" | "reason":
            values, missing = getattr(decided, name), ~settled
        case "loops":
            values, missing = np.ones(len(settled), dtype=np.int64), ~settled
        case "immersions":
            values, missing = is_disk.astype(object) + 0, ~settled
        case "embeddable":
            values, missing = is_disk, ~settled
        case "levels":
            values, missing = is_disk.astype(np.int64), ~(settled & is_disk)
        case "repair":
            values, missing = np.zeros(len(settled)), ~settled
        case _:
            values = np.zeros(len(settled), dtype=_KIND[name])
    if _KIND[name] is object:
        return np.asarray(np.where(missing, None, values))
    return np.ma.MaskedArray(values.astype(_KIND[name]), missing)


def _row_by_values(
    outlines: ManyOutlines, row: int, columns: Collection[str], time_limit: float | None
) -> Mapping[str, Any]:
    """Return what single calls say of an outline, as far as they come."""
    told: dict[str, Any] = {}
    try:
        arranged = arrange(outlines.outline(row))
        told |= _drawn(arranged)
        told |= _verdict(arranged, time_limit)
        if not _OF_DISKS.isdisjoint(columns):
            told |= _on_demand(arranged, columns, told["verdict"], time_limit)
    except (PlyfoldError, MemoryError) as error:
        told |= {"error": _sentence(error)} | _place(getattr(error, "where", ()))
    return told


def _sentence(error: Exception) -> str:
    """Return what an error says, without its hint."""
    return str(error).partition("\n")[0] or type(error).__name__


def _drawn(arranged: Arrangement) -> dict[str, Any]:
    return {
        "crossings": crossings_as_given(arranged),
        "loops": arranged.n_loops,
        "turning": arranged.turning_number,
    }


def _verdict(arranged: Arrangement, time_limit: float | None) -> dict[str, Any]:
    found = find_immersion(arranged, time_limit=time_limit)
    if isinstance(found, Unknown):
        return {"verdict": "unknown"}
    if isinstance(found, Obstruction):
        return {"verdict": "none", "reason": found.reason} | _place(found.where)
    surface = "disk" if may_bound_disk(arranged) else "surface"
    return {"verdict": surface + " that touches itself" * bool(touches_of(found))}


def _place(where: tuple[tuple[float, ...], ...]) -> dict[str, float]:
    return dict(zip(("place_x", "place_y"), where[0][:2], strict=False)) if where else {}


def _on_demand(
    arranged: Arrangement, columns: Collection[str], verdict: str, time_limit: float | None
) -> dict[str, Any]:
    """Return what is asked for besides the verdict."""
    told: dict[str, Any] = {}
    if "immersions" in columns:
        told["immersions"] = _if_known(count_immersions(arranged, time_limit=time_limit))
    if "embeddable" in columns or "levels" in columns:
        found = find_embedding(arranged, time_limit)
        told["embeddable"] = _if_known(bool(found) if not isinstance(found, Unknown) else found)
        told["levels"] = int(given_windings(arranged).max()) if found else None
    if "repair" in columns:
        mended = repair(arranged, time_limit=time_limit)
        told["repair"] = mended.region_change if isinstance(mended, Repaired) else None
    return told


def _if_known(answer: object) -> object:
    return None if isinstance(answer, Unknown) else answer
