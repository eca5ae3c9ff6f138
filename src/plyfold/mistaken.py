"""What people give in place of points, and the call that they meant."""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Set
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

__all__ = ["Mistake", "mistaken_array", "mistaken_code", "mistaken_value"]


class Mistake(NamedTuple):
    """What something is, in place of points, and what to do with it: the message and the hint of an error."""

    message: str
    hint: str


_LONGEST_CODE = 100_000
_WKT = re.compile(r"\s*(SRID=\d+;\s*)?(POINT|LINE|POLYGON|MULTI|GEOMETRY|CURVE)", re.IGNORECASE)
_SIGNED_CODE = re.compile(r"/\s*outer\b")
_PD_CODE = re.compile(r"\s*(PD\b|X\s*[\[(]\s*\d)|[\s\[(]*(\d+\s*,\s*){3}\d+\s*[\])]", re.IGNORECASE)
_CODE_WITHOUT_OUTER = re.compile(r"\s*([^\W_]+\s*[-+−]\s*[,;]?\s*){2,}")
_KNOT_CODE = re.compile(r"\s*([OU]\d+[-+]?[\s,;]*)+", re.IGNORECASE)
_VISIT = re.compile(r"[-+]?(\d+|[^\W\d_])")

_SIGNED = Mistake("it is a signed Gauss code", "pf.GaussCode.parse(text) reads it")
_WITHOUT_OUTER = Mistake(
    "it is a signed Gauss code without its unbounded cell", "pf.GaussCode.parse reads '1+ 1- / outer 1'"
)
_PD = Mistake("it is a PD code", "pf.GaussCode.from_pd reads it")
_UNSIGNED = Mistake(
    "it is a Gauss code that does not say which way the strands cross",
    "no call takes it without signs yet; pf.GaussCode.parse reads codes like '1+ 1- / outer 1'",
)


def mistaken_code(value: str | npt.NDArray[Any]) -> Mistake | None:
    """Return what kind of code a text or an array of integers is; None if it is none.

    Examples
    --------
    >>> mistaken_code("1 2 3 1 2 3").message
    'it is a Gauss code that does not say which way the strands cross'
    """
    return _code_in_text(value) if isinstance(value, str) else _code_in_numbers(value)


def _code_in_text(text: str) -> Mistake | None:
    if len(text) > _LONGEST_CODE:
        return None
    if _SIGNED_CODE.search(text):
        return _SIGNED
    if _PD_CODE.match(text):
        return _PD
    return _UNSIGNED if _names_crossings_twice(text) or _KNOT_CODE.fullmatch(text) else None


def _names_crossings_twice(text: str) -> bool:
    """Tell whether a line names two crossings or more, by numbers or letters, each of them twice."""
    visits = re.split(r" *[,;] *| +", text.strip(" \t\r\n[]()"))
    crossings = Counter(visit.lstrip("+-") for visit in visits)
    return len(crossings) > 1 and all(map(_VISIT.fullmatch, visits)) and set(crossings.values()) == {2}


def _code_in_numbers(numbers: npt.NDArray[Any]) -> Mistake | None:
    """Every arc has two ends and every crossing two visits, so each number occurs twice."""
    code = _UNSIGNED if numbers.ndim == 1 else _PD if numbers.ndim == 2 and numbers.shape[1] == 4 else None
    if code is None or numbers.dtype.kind not in "iu" or not numbers.size:
        return None
    return code if (np.unique(np.abs(numbers), return_counts=True)[1] == 2).all() else None


def mistaken_value(value: object) -> Mistake | None:
    """Return what a value is that is neither an array nor a list; None if numpy may know.

    Examples
    --------
    >>> mistaken_value("loop.svg").hint
    "pf.read('loop.svg') reads a file"
    """
    match value:
        case str():
            return mistaken_code(value) or _mistaken_text(value)
        case bytes() | bytearray():
            return Mistake("bytes are not a list of points", "save them in a file for pf.read")
        case os.PathLike():
            return Mistake("a path is not a list of points", f"pf.read({os.fspath(value)!r}) reads the file")
        case Mapping():
            return Mistake("a mapping is not a list of points", "give numpy.column_stack([x, y])")
        case Set():
            return Mistake("the points of a set have no order", "give a list, in order along the curve")
    return _mistaken_object(value)


def _mistaken_object(value: object) -> Mistake | None:
    name, kind = type(value).__name__, getattr(value, "geom_type", "")
    if any(hasattr(value, word) for word in ("points", "to_polygons", "discrete")) or (isinstance(kind, str) and kind):
        hint = "it can be given as it is wherever a curve can, as in pf.arrange"
        return Mistake(f"a {name} is not a list of points", hint)
    if hasattr(value, "geom_type"):
        return Mistake(f"a {name} holds several geometries", "give one of them, like series.geometry.iloc[0]")
    if hasattr(value, "read"):
        return Mistake("an open file is not a list of points", "pf.read(path) reads a file by its name")
    if isinstance(value, Iterator):
        return Mistake(f"the points of a {name} can be read only once", "give list(points)")
    return None


def _mistaken_text(text: str) -> Mistake:
    if _CODE_WITHOUT_OUTER.fullmatch(text):
        return _WITHOUT_OUTER
    shown = text if len(text) <= 60 else f"{text[:60]}…"
    if text.startswith("gallery:"):
        hint = f"pf.gallery.named_curve({shown.removeprefix('gallery:')!r}) has that curve"
    elif _WKT.match(text):
        hint = "shapely.from_wkt reads well-known text"
    elif "\n" in text or text.lstrip()[:1] in ("<", "{", "["):
        hint = "save it in a file for pf.read"
    else:
        hint = f"pf.read({shown!r}) reads a file"
    return Mistake(f"text is not a list of points: {shown!r}", hint)


def mistaken_array(raw: npt.NDArray[Any]) -> Mistake | None:
    """Return what an array is that has no x and y in each row; None if it has, or nothing is known of it.

    Examples
    --------
    >>> import numpy as np
    >>> mistaken_array(np.array([[0, 1, 1, 0], [0, 0, 1, 1]])).hint
    'give numpy.transpose(points)'
    """
    if raw.dtype.kind == "c":
        return Mistake("the points are complex numbers, and not in one row", "give an array of shape (n,)")
    if raw.dtype.kind == "O" and any(hasattr(entry, "geom_type") or hasattr(entry, "points") for entry in raw.flat):
        return Mistake("these are curves, not points", "give one of them; pf.find_embedding takes a list of curves")
    if raw.ndim == 3:
        hint = "strokes of one curve go to pf.Curve.from_strokes, several curves to pf.find_embedding"
        return Mistake("these are lists of points, not points", hint)
    if raw.ndim == 2 and raw.shape[0] == 2 and raw.shape[1] > 3:
        return Mistake("all x are in one row and all y in another", "give numpy.transpose(points)")
    return _code_in_numbers(raw)
