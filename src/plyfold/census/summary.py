"""What a census found, counted: of one part or of all, and whether it agrees with what is known."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np

from plyfold.arrays import Bools, Ints
from plyfold.tables.table import DataTable

__all__ = ["PLANE_CURVES", "POINTED_CURVES", "Record", "Summary", "disagreements", "number_of_plane_curves"]

# Plane curves with k = 0, 1, 2 ... crossings up to start, direction and reflection: A008983 of the OEIS.
PLANE_CURVES = (1, 2, 5, 20, 82, 435, 2645, 18489, 141326, 1153052, 9819315, 86305315)
# Curves on the oriented sphere with a start and a direction: A054993 of the OEIS.
POINTED_CURVES = (1, 2, 8, 42, 260, 1796, 13396, 105706, 870772, 7420836, 65004584, 582521748, 5320936416)

_GROWTH = 9

# So many codes of each kind of remarkable curves are kept.
_MOST_CODES = 60


@dataclass(frozen=True)
class Record:
    """The most of something, and the first curve that has so much of it."""

    most: int = 0
    code: str = ""


@dataclass(frozen=True)
class Summary:
    """Counts of all curves of a census, or of a part.

    Parameters
    ----------
    n_crossings : int
    curves : int, optional
        How many.
    names : int, optional
        In how many ways they can be named: each in 8k ways, but for those that its symmetries make the same.
    turning : dict of int to int, optional
        How many curves have each turning number.
    disks, immersions, lifting, layerings : int, optional
        Curves that bound immersed disks; their immersions, how many of these can be layered, and in how many ways.
    several : int, optional
        Curves with more than one immersion.
    partly, never : int, optional
        Disks of which some immersions cannot be layered, and of which none can.
    most_immersions, most_layerings, most_symmetries : Record, optional
        Among the curves that bound disks.
    partly_codes, never_codes : tuple of str, optional
        The first ones of them.
    swept, unavoidable : int, optional
        How many cells the least homotopies of all curves sweep together, and how many winding numbers make unavoidable.
    branched : dict of int to int, optional
        How many curves bound a disk with so many branch points. These three are 0 and empty if that was not asked for.

    Examples
    --------
    >>> from plyfold.census import census_table, plane_curves
    >>> summary = Summary.together(Summary.of(4, census_table(batch)) for batch in plane_curves(4))
    >>> summary.curves, summary.disks, summary.layerings
    (82, 7, 20)
    """

    n_crossings: int
    curves: int = 0
    names: int = 0
    turning: dict[int, int] = field(default_factory=dict)
    disks: int = 0
    immersions: int = 0
    lifting: int = 0
    layerings: int = 0
    several: int = 0
    partly: int = 0
    never: int = 0
    most_immersions: Record = Record()
    most_layerings: Record = Record()
    most_symmetries: Record = Record()
    partly_codes: tuple[str, ...] = ()
    never_codes: tuple[str, ...] = ()
    swept: int = 0
    unavoidable: int = 0
    branched: dict[int, int] = field(default_factory=dict)

    @classmethod
    def of(cls, n_crossings: int, table: DataTable) -> Summary:
        """Count the rows of a table."""
        immersions, lifting = table["immersions"], table["lifting"]
        is_disk = immersions > 0
        never, partly = is_disk & (lifting == 0), (lifting < immersions) & (lifting > 0)
        turning, how_many = np.unique(table["turning"], return_counts=True)
        return cls(
            n_crossings,
            curves=len(table),
            names=int((max(8 * n_crossings, 1) // table["symmetries"].astype(np.int64)).sum()),
            turning=dict(zip(turning.tolist(), how_many.tolist(), strict=True)),
            disks=int(is_disk.sum()),
            immersions=int(immersions.sum()),
            lifting=int(lifting.sum()),
            layerings=int(table["layerings"].sum()),
            several=int((immersions > 1).sum()),
            partly=int(partly.sum()),
            never=int(never.sum()),
            most_immersions=_record(table, immersions),
            most_layerings=_record(table, table["layerings"]),
            most_symmetries=_record(table, table["symmetries"] * is_disk),
            partly_codes=_codes(table, partly),
            never_codes=_codes(table, never),
            **_contractions(table),
        )

    def note(self) -> dict[str, Any]:
        """Return it for JSON."""
        return asdict(self)

    @classmethod
    def from_note(cls, note: dict[str, Any]) -> Summary:
        """Read what :meth:`note` gave, through JSON or not."""
        read = dict(note)
        for name, value in note.items():
            if name in ("turning", "branched"):
                read[name] = {int(key): number for key, number in value.items()}
            elif isinstance(value, dict):
                read[name] = Record(**value)
            elif isinstance(value, list | tuple):
                read[name] = tuple(value)
        return cls(**read)

    @classmethod
    def together(cls, parts: Iterable[Summary]) -> Summary:
        """Add up the parts of a census."""
        parts = list(parts)
        first = parts[0]
        joined: dict[str, Any] = {"n_crossings": first.n_crossings}
        for name, value in vars(first).items():
            values = [getattr(part, name) for part in parts]
            if isinstance(value, Record):
                joined[name] = max(values, key=lambda record: record.most)
            elif isinstance(value, tuple):
                joined[name] = sum(values, ())[:_MOST_CODES]
            elif isinstance(value, dict):
                joined[name] = dict(sorted(sum(map(Counter, values), Counter()).items()))
            elif name != "n_crossings":
                joined[name] = sum(values)
        return cls(**joined)


def _contractions(table: DataTable) -> dict[str, Any]:
    """Count what least homotopies sweep, if the table has them."""
    if "swept" not in table.columns:
        return {}
    points, how_many = np.unique(np.ma.compressed(table["branch_points"]), return_counts=True)
    return {
        "swept": int(table["swept"].sum()),
        "unavoidable": int(table["unavoidable"].sum()),
        "branched": dict(zip(points.tolist(), how_many.tolist(), strict=True)),
    }


def _record(table: DataTable, figures: Ints) -> Record:
    if not len(table) or figures.max() == 0:
        return Record()
    row = int(figures.argmax())
    return Record(int(figures[row]), table["code"][row].decode())


def _codes(table: DataTable, rows: Bools) -> tuple[str, ...]:
    return tuple(code.decode() for code in table["code"][rows][:_MOST_CODES].tolist())


def disagreements(summary: Summary) -> Iterator[str]:
    """Yield what contradicts the counts that others published, as far as these go, or itself."""
    k = summary.n_crossings
    if k < len(PLANE_CURVES) and summary.curves != PLANE_CURVES[k]:
        yield f"{summary.curves} curves, but A008983 has {PLANE_CURVES[k]}"
    # Curves on the sphere with start and direction, and any of the k + 2 cells as the unbounded one.
    if 0 < k < len(POINTED_CURVES) and summary.names != (k + 2) * POINTED_CURVES[k]:
        yield f"{summary.names} named curves, but the mass formula has {(k + 2) * POINTED_CURVES[k]}"
    # A curve sweeps no less than it winds, and disks without branch points are those that are immersed.
    if summary.swept < summary.unavoidable:
        yield f"{summary.swept} cells are swept, but {summary.unavoidable} is the least"
    if summary.unavoidable and summary.branched.get(0, 0) != summary.disks:
        yield f"{summary.branched.get(0, 0)} disks without branch points, but {summary.disks} that are immersed"


def number_of_plane_curves(n_crossings: int) -> int:
    """Return how many plane curves there are: as published, and beyond that about.

    Examples
    --------
    >>> number_of_plane_curves(10), number_of_plane_curves(12)
    (9819315, 776747835)
    """
    beyond = max(n_crossings + 1 - len(PLANE_CURVES), 0)
    return PLANE_CURVES[n_crossings - beyond] * int(_GROWTH**beyond)
