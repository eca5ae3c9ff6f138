"""Cusps as files and people write them: ``12``, ``0:12`` or ``0:12x2``, for loop 0, point 12 and index 2."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from plyfold.arrays import Ints
from plyfold.errors import FileFormatError

__all__ = ["CuspMark", "cusp_marks", "cusps_of_loops", "parse_cusp", "parse_cusps", "written_cusp"]

_CUSP = re.compile(r"(?:(\d+):)?(\d+)(?:[x×](\d+))?", re.ASCII)
_HINT = "write POINT, LOOP:POINT or LOOP:POINTxINDEX, all counted from 0, as in 12, 0:12 or 0:12x2"


class CuspMark(NamedTuple):
    """A point that is a cusp: its loop, its number in the loop, and by how many full turns its angle is larger."""

    loop: int
    point: int
    turns: int = 1


def parse_cusp(text: str) -> CuspMark:
    """Read one cusp.

    Raises
    ------
    FileFormatError
        If the text is none.

    Examples
    --------
    >>> parse_cusp("12"), parse_cusp("3:12x2")
    (CuspMark(loop=0, point=12, turns=1), CuspMark(loop=3, point=12, turns=2))
    """
    found = _CUSP.fullmatch(text.strip())
    if found is None:
        raise FileFormatError(f"{text.strip()[:40]!r} is no cusp", hint=_HINT)
    loop, point, index = found.groups()
    return CuspMark(int(loop or 0), int(point), int(index or 1))


def parse_cusps(text: str) -> list[CuspMark]:
    """Read cusps that are separated by blanks or commas.

    Examples
    --------
    >>> parse_cusps("12 0:17x2")
    [CuspMark(loop=0, point=12, turns=1), CuspMark(loop=0, point=17, turns=2)]
    """
    return [parse_cusp(word) for word in re.split(r"[\s,]+", text.strip()) if word]


def written_cusp(mark: CuspMark) -> str:
    """Return a cusp as text.

    Examples
    --------
    >>> written_cusp(CuspMark(0, 12)), written_cusp(CuspMark(0, 12, 2))
    ('0:12', '0:12x2')
    """
    return f"{mark.loop}:{mark.point}" + (f"x{mark.turns}" if mark.turns != 1 else "")


def cusp_marks(cusps: Sequence[Ints]) -> list[CuspMark]:
    """Return the cusps of an outline one by one.

    Examples
    --------
    >>> cusp_marks([np.array([0, 0, 2])])
    [CuspMark(loop=0, point=2, turns=2)]
    """
    return [
        CuspMark(loop, int(point), int(index[point]))
        for loop, index in enumerate(cusps)
        for point in np.flatnonzero(index)
    ]


def cusps_of_loops(value: Any, lengths: Sequence[int]) -> list[Mapping[int, int]]:
    """Return the cusps of each loop, by their points, from what stands in JSON.

    Parameters
    ----------
    value : object
        ``{"0:12": 2}``, a list such as ``["0:12", "0:17x2"]``, or for each loop a list with the index of every point,
        mostly 0; of a single loop, that list may stand alone.
    lengths : sequence of int
        How many points each loop has in the file.

    Raises
    ------
    FileFormatError
        If it is none of these, or a point is not there.

    Examples
    --------
    >>> cusps_of_loops({"1:2": 3}, [3, 3])
    [{}, {2: 3}]
    >>> cusps_of_loops([[0, 1, 0], [0, 0, 0]], [3, 3])
    [{1: 1}, {}]
    """
    if value is None:
        return [{} for _ in lengths]
    found: list[Mapping[int, int]] = [{} for _ in lengths]
    for mark in _marks(value, lengths):
        if mark.loop >= len(lengths) or mark.point >= lengths[mark.loop]:
            there = f"{len(lengths)} loop" + "s" * (len(lengths) != 1)
            raise FileFormatError(f"there is no point {mark.loop}:{mark.point} in its {there} to be a cusp", hint=_HINT)
        found[mark.loop] = {**found[mark.loop], mark.point: mark.turns}
    return found


def _marks(value: Any, lengths: Sequence[int]) -> list[CuspMark]:
    if isinstance(value, dict):
        return [parse_cusp(str(place))._replace(turns=_whole(index)) for place, index in value.items()]
    if isinstance(value, list) and all(isinstance(item, str) for item in value):
        return [parse_cusp(item) for item in value]
    if isinstance(value, list) and len(lengths) == 1 and not any(isinstance(item, list) for item in value):
        value = [value]
    if isinstance(value, list) and len(value) == len(lengths) and all(isinstance(item, list) for item in value):
        return [
            CuspMark(loop, point, _whole(index))
            for loop, given in enumerate(value)
            for point, index in enumerate(given)
            if index != 0
        ]
    raise FileFormatError(
        f"its cusps are not understood: {str(value)[:40]}", hint='write {"LOOP:POINT": INDEX}, as in {"0:12": 1}'
    )


def _whole(index: Any) -> int:
    if type(index) is not int or index < 0:
        raise FileFormatError(f"the index of a cusp is a whole number from 0 up, not {str(index)[:40]}", hint=_HINT)
    return index
