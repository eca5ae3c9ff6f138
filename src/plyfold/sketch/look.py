"""What is this outline? Its crossings, borders, cells and the verdict, as the page shows them while one draws."""

from __future__ import annotations

from collections import Counter
from dataclasses import asdict
from hashlib import blake2s
from time import perf_counter
from typing import Any

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrangement.as_given import contacts_of, crossings_as_given, given_windings
from plyfold.arrangement.gauss import GaussCode
from plyfold.draw.placement import border_line, cusps_drawn, label_circle, outer_ring_first
from plyfold.immersion.blank_word import blank_word
from plyfold.immersion.immersion import Immersion
from plyfold.obstruction import Obstruction, Unknown
from plyfold.outline.direction import even_odd_directions, sense
from plyfold.report import (
    A_DISK,
    Words,
    branch_points_of,
    branched_in_words,
    cut_in_words,
    surface_in_words,
    touches_of,
    words,
)
from plyfold.sketch.drawings import arranged, first_immersion, immersion_count
from plyfold.sketch.offering import loop_data
from plyfold.sketch.schema import VERSION, Look

__all__ = ["look_at"]

_LONGEST_WORD = 60
_SECONDS_TO_CONTRACT = 0.05
_LABEL_TOLERANCE = 0.02
_NOTHING_WRONG: dict[str, Any] = {"reason": None, "where": [], "touches": [], "cut": None}


def look_at(question: Look) -> dict[str, Any]:
    """Return all that is known of an outline without asking how its cloth lies.

    Parameters
    ----------
    question : Look

    Returns
    -------
    dict
        As ``PROTOCOL.md`` says, ready for JSON. A few milliseconds for sketches.

    Raises
    ------
    PlyfoldError
        If the strokes make no outline that can be used.

    Examples
    --------
    >>> from plyfold.sketch.schema import Stroke
    >>> answer = look_at(Look((Stroke(((0, 0), (2, 2), (2, 0), (0, 2)), closed=True),)))
    >>> answer["turning_numbers"], answer["verdict"]["reason"], answer["verdict"]["where"]
    ([0], 'turning number', [[1.0, 1.0]])
    """
    began = perf_counter()
    drawn = arranged(question.strokes)
    outline, given = drawn.outline, drawn.given
    assert outline is not None
    assert given is not None
    return {
        "version": VERSION,
        "loops": list(map(loop_data, given.loops, given.cusps)),
        "cusps": _cusps(drawn),
        "repairs": [{"kind": r.kind, "where": list(r.where), "size": r.size} for r in outline.repairs],
        "contacts": contacts_of(drawn),
        "reversed": drawn.reversed,
        "turning_numbers": list(drawn.turning_numbers),
        "crossings": drawn.crossings.tolist(),
        "crossings_as_given": crossings_as_given(drawn),
        "borders": [_border(drawn, border) for border in range(drawn.n_borders)],
        "visits": np.stack([drawn.border_before, drawn.border_after], axis=1).tolist(),
        "cells": [_cell(drawn, cell) for cell in range(1, drawn.n_cells)],
        "cells_by_winding": [list(row) for row in sorted(Counter(given_windings(drawn)[1:].tolist()).items())],
        "verdict": _verdict(question, drawn),
        "code": _code(drawn),
        **_texts(drawn),
        "seconds": perf_counter() - began,
    }


def _cusps(drawn: Arrangement) -> list[dict[str, Any]]:
    places, indices = cusps_drawn(drawn)
    return [{"where": place, "index": index} for place, index in zip(places.tolist(), indices, strict=True)]


def _border(drawn: Arrangement, border: int) -> list[list[float]]:
    return [[x, y] for x, y in border_line(drawn, border).tolist()]


def _cell(drawn: Arrangement, cell: int) -> dict[str, Any]:
    outline, *holes = rings = outer_ring_first(drawn, cell)
    x, y, radius = label_circle(drawn, cell, _LABEL_TOLERANCE, rings)
    return {
        "cell": cell,
        "winding": int(drawn.winding[cell]),
        "outline": outline.tolist(),
        "holes": [hole.tolist() for hole in holes],
        "label": [x, y],
        "radius": radius,
        "borders": sorted({dart // 2 for dart in drawn.cells[cell]}),
    }


def _code(drawn: Arrangement) -> str:
    """Return a text that is the same as long as crossings and cusps stay as they are."""
    parts = (drawn.partner, drawn.ccw, drawn.first_visit, drawn.cusp_index, drawn.cell_of_dart)
    return blake2s(b"".join(array.tobytes() for array in parts), digest_size=16).hexdigest()


def _texts(drawn: Arrangement) -> dict[str, str | None]:
    """Return the codes that one curve without cusps has; the word where it is short."""
    if not _is_plain(drawn):
        return {"gauss": None, "word": None}
    return {"gauss": str(GaussCode.of(drawn)), "word": _word(drawn)}


def _verdict(question: Look, drawn: Arrangement) -> dict[str, Any]:
    found = first_immersion(question.strokes)
    match found:
        case Immersion():
            said = _immersed(question, found)
        case Obstruction():
            said = _obstructed(drawn, found)
        case Unknown():
            said = _undecided(found)
    return _NOTHING_WRONG | {"figures": _figures(drawn)} | said | {"turn": _loops_to_turn(drawn)}


def _undecided(unknown: Unknown) -> dict[str, Any]:
    return {"immersible": None, "immersions": None, **asdict(Words("Not decided in time", unknown.sentence))}


def _immersed(question: Look, found: Immersion) -> dict[str, Any]:
    count, touches = immersion_count(question.strokes), touches_of(found)
    cut = {"cut": cut_in_words(found.pieces), "figures": []} if touches else {}
    return cut | {
        "immersible": True,
        "immersions": None if count is None else str(count),
        "touches": touches,
        **asdict(words(count, surface=surface_in_words(found.uncut_pieces), touches=bool(touches))),
    }


def _obstructed(drawn: Arrangement, obstruction: Obstruction) -> dict[str, Any]:
    sentence, branch_points = obstruction.sentence, branch_points_of(drawn, _SECONDS_TO_CONTRACT)
    if branch_points:
        sentence += f" It bounds {branched_in_words(branch_points)}."
    return {
        "immersible": False,
        "immersions": "0",
        "reason": obstruction.reason,
        **asdict(words(0, sentence, surface=A_DISK if _is_plain(drawn) else "a surface")),
        "where": [list(place) for place in obstruction.where],
    }


def _is_plain(drawn: Arrangement) -> bool:
    return drawn.n_loops == 1 and not drawn.cusp_index.any()


def _figures(drawn: Arrangement) -> list[list[str]]:
    """Return what distinguishes other surfaces from a disk."""
    return [] if _is_plain(drawn) else [["Euler characteristic", str(drawn.euler_characteristic)]]


def _loops_to_turn(drawn: Arrangement) -> list[int]:
    """Return the loops that cross no other and run the other way than if every second one were a hole."""
    if drawn.outline is None or drawn.n_loops == 1:
        return []
    loops = drawn.outline.loops
    wanted = even_odd_directions(loops)
    return [loop for loop, direction in enumerate(wanted) if direction == -sense(loops[loop]) != 0]


def _word(drawn: Arrangement) -> str | None:
    word = blank_word(drawn)
    return " ".join(map(str, word.letters)) if len(word) <= _LONGEST_WORD else None
