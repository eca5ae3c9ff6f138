"""The verdict on a curve: in words, which the command line and the page show, and with all figures as plain data."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass
from typing import Any

from plyfold.arrangement.arrangement import Arrangement
from plyfold.errors import TimeLimitError
from plyfold.immersion.solve import count_immersions, find_immersion, immersions
from plyfold.layering.orders.search import first_layering
from plyfold.obstruction import Obstruction
from plyfold.outline.curve import Curve

__all__ = ["Words", "describe", "in_words", "verdict", "words"]

_SHOWN_REPAIRS = 5
_LONGEST_NUMBER = 12
_UNDECIDED = "Whether it can be lifted was not decided in time."


@dataclass(frozen=True)
class Words:
    """The verdict for people: a headline, and a sentence that says more."""

    headline: str
    sentence: str


def words(immersions: int, obstruction: str = "", decided: bool = True) -> Words:
    """Return the verdict on a curve in words.

    Parameters
    ----------
    immersions : int
        In how many ways it bounds a disk.
    obstruction : str
        The sentence that says why it bounds none, or why the one that is looked at cannot be lifted.
    decided : bool
        Whether it is known if that one can be lifted.

    Examples
    --------
    >>> words(2).headline, words(2).sentence
    ('A disk of cloth, in 2 ways', 'This is the outline of a disk of cloth, which can lie in 2 ways.')
    >>> words(0, "The curve turns 2 times, and the outline of a disk turns once.").headline
    'No disk'
    """
    if immersions == 0:
        return Words("No disk", obstruction)
    headline = "A disk of cloth" if immersions == 1 else f"A disk of cloth, in {in_words(immersions)} ways"
    if obstruction:
        return Words(f"{headline}; this one cannot be lifted", obstruction)
    ways = "in one way" if immersions == 1 else f"in {in_words(immersions)} ways"
    return Words(headline, f"This is the outline of a disk of cloth, which can lie {ways}." if decided else _UNDECIDED)


def in_words(count: int) -> str:
    """Return a count as people read it; from a million million on, only how large it is.

    Examples
    --------
    >>> in_words(12345), in_words(2**400)
    ('12,345', 'about 2.58 · 10^120')
    """
    if len(str(count)) <= _LONGEST_NUMBER:
        return f"{count:,}"
    exponent = len(str(count)) - 1
    leading = math.floor(count // 10 ** (exponent - 3) / 10) / 100
    return f"about {leading:.2f} · 10^{exponent}"


def verdict(arrangement: Arrangement, time_limit: float | None = None) -> dict[str, Any]:
    """Return everything that is known of a curve as plain data, ready for JSON.

    Parameters
    ----------
    arrangement : Arrangement
    time_limit : float, optional
        Seconds for the search for a layering; when they are over, ``layerable`` is None: unknown.

    Returns
    -------
    dict
        ``points``, ``crossings``, ``cells`` (number of cells by winding number), ``turning_number``, ``reversed``,
        ``repairs``, ``immersible``, ``immersions``; for a disk also ``layerable``, ``examined`` (immersions) and
        ``sheets``, otherwise ``reason``, ``sentence`` and ``where``.

    Examples
    --------
    >>> from plyfold import arrange
    >>> found = verdict(arrange([(0, 0), (2, 2), (2, 0), (0, 2)]))
    >>> found["immersible"], found["reason"], found["cells"]
    (False, 'turning number', {-1: 1, 0: 1, 1: 1})
    """
    curve = arrangement.curve
    figures: dict[str, Any] = {
        "points": 0 if curve is None else len(curve),
        "crossings": arrangement.n_crossings,
        "cells": dict(sorted(Counter(arrangement.winding.tolist()).items())),
        "turning_number": arrangement.turning_number,
        "reversed": arrangement.reversed,
        "repairs": _repairs(curve),
    }
    found = find_immersion(arrangement)
    if isinstance(found, Obstruction):
        return figures | {"immersible": False, "immersions": 0} | _obstructed(found)
    figures |= {"immersible": True, "immersions": count_immersions(arrangement), "sheets": found.n_sheets}
    return figures | _layerable(arrangement, time_limit)


def _repairs(curve: Curve | None) -> list[dict[str, Any]]:
    repairs = () if curve is None else curve.repairs
    return [{"kind": repair.kind, "where": list(repair.where), "size": repair.size} for repair in repairs]


def _obstructed(obstruction: Obstruction) -> dict[str, Any]:
    where = [list(place) for place in obstruction.where]
    return {"reason": obstruction.reason, "sentence": str(obstruction), "where": where}


def _layerable(arrangement: Arrangement, time_limit: float | None) -> dict[str, Any]:
    """Return whether one of the immersions can be layered, and how many were examined."""
    try:
        found, examined = first_layering(immersions(arrangement), time_limit)
    except TimeLimitError:
        return {"layerable": None}
    if isinstance(found, Obstruction):
        return {"layerable": False, "examined": examined} | _obstructed(found)
    return {"layerable": True, "examined": examined, "levels": int(found.level.max())}


def describe(figures: dict[str, Any]) -> str:
    """Return the verdict as text: a sentence, and the figures one on a line."""
    cells = ", ".join(f"{count} with {winding}" for winding, count in figures["cells"].items())
    turned = " (the curve was turned round, so that it can have the surface on its left)" if figures["reversed"] else ""
    rows = {
        "points": f"{figures['points']:,}",
        "crossings": f"{figures['crossings']:,}",
        "cells by winding number": cells,
        "turning number": f"{figures['turning_number']}{turned}",
        "immersions": f"{figures['immersions']:,}",
    }
    if figures["immersible"]:
        rows["layering"] = _layering_sentence(figures)
    width = max(map(len, rows)) + 2
    lines = [f"  {name:<{width}}{value}" for name, value in rows.items()]
    return "\n".join([_headline(figures), *lines, *_repair_lines(figures["repairs"])])


def _headline(figures: dict[str, Any]) -> str:
    if figures["immersible"]:
        return f"Yes. {words(figures['immersions']).sentence}"
    said = words(0, figures["sentence"])
    places = "".join(f"\n  at ({x:.6g}, {y:.6g})" for x, y in figures["where"])
    return f"{said.headline}. {said.sentence}{places}"


def _layering_sentence(figures: dict[str, Any]) -> str:
    if figures["layerable"] is None:
        return f"unknown. {_UNDECIDED}"
    if figures["layerable"]:
        which = f"immersion {figures['examined']} of {figures['immersions']:,}"
        return f"yes, on {figures['levels']} level(s), found for {which}"
    return f"none of the {figures['examined']} immersion(s) can be lifted. {figures['sentence']}"


def _repair_lines(repairs: list[dict[str, Any]]) -> list[str]:
    lines = []
    for kind, count in Counter(repair["kind"] for repair in repairs).items():
        these = [repair for repair in repairs if repair["kind"] == kind]
        places = ", ".join(map(_repair_place, these[:_SHOWN_REPAIRS]))
        more = f" and {count - _SHOWN_REPAIRS} more" if count > _SHOWN_REPAIRS else ""
        lines.append(f"  note: {kind} at {places}{more}")
    return lines


def _repair_place(repair: dict[str, Any]) -> str:
    size = f" by {repair['size']:.3g}" if repair["size"] else ""
    return "({:.6g}, {:.6g})".format(*repair["where"]) + size
