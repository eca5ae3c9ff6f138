"""What is this loop? Its crossings, borders, cells and the verdict, as the page shows them while one draws."""

from __future__ import annotations

from dataclasses import asdict
from time import perf_counter
from typing import Any

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrangement.gauss import GaussCode
from plyfold.draw.placement import label_circle
from plyfold.immersion.blank_word import blank_word
from plyfold.immersion.solve import count_immersions, find_immersion
from plyfold.obstruction import Obstruction
from plyfold.offers.kinks import Kink, find_kink
from plyfold.report import words
from plyfold.sketch.drawings import arranged
from plyfold.sketch.schema import VERSION, Look

__all__ = ["look_at"]

_LONGEST_WORD = 60
_LABEL_TOLERANCE = 0.02


def look_at(question: Look) -> dict[str, Any]:
    """Return all that is known of a loop without asking how its cloth lies.

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
        If the strokes make no loop that can be used.

    Examples
    --------
    >>> from plyfold.sketch.schema import Stroke
    >>> answer = look_at(Look((Stroke(((0, 0), (2, 2), (2, 0), (0, 2)), closed=True),)))
    >>> answer["turning_number"], answer["verdict"]["reason"], answer["verdict"]["where"]
    (0, 'turning number', [[1.0, 1.0]])
    """
    began = perf_counter()
    drawn = arranged(question.strokes)
    curve = drawn.curve
    assert curve is not None
    return {
        "version": VERSION,
        "points": curve.points.tolist(),
        "repairs": [{"kind": r.kind, "where": list(r.where), "size": r.size} for r in curve.repairs],
        "reversed": drawn.reversed,
        "turning_number": drawn.turning_number,
        "crossings": drawn.crossings.tolist(),
        "borders": [_border(drawn, border) for border in range(drawn.n_borders)],
        "cells": [_cell(drawn, cell) for cell in range(1, drawn.n_cells)],
        "verdict": _verdict(drawn),
        "gauss": str(GaussCode.of(drawn)),
        "word": _word(drawn),
        "seconds": perf_counter() - began,
    }


def _border(drawn: Arrangement, border: int) -> list[list[float]]:
    points = drawn.border_points(border)
    whole = points if drawn.n_crossings else np.concatenate([points, points[:1]])
    return [[x, y] for x, y in whole.tolist()]


def _cell(drawn: Arrangement, cell: int) -> dict[str, Any]:
    x, y, radius = label_circle(drawn, cell, _LABEL_TOLERANCE)
    return {
        "cell": cell,
        "winding": int(drawn.winding[cell]),
        "outline": drawn.cell_outline(cell).tolist(),
        "holes": [],
        "label": [x, y],
        "radius": radius,
        "borders": sorted({dart // 2 for dart in drawn.cells[cell]}),
    }


def _verdict(drawn: Arrangement) -> dict[str, Any]:
    found = find_immersion(drawn)
    if isinstance(found, Obstruction):
        return _no_disk(drawn, found)
    count = count_immersions(drawn)
    return {
        "immersible": True,
        "immersions": str(count),
        "reason": None,
        **asdict(words(count)),
        "where": [],
        "kink": None,
    }


def _no_disk(drawn: Arrangement, obstruction: Obstruction) -> dict[str, Any]:
    kink = find_kink(drawn)
    return {
        "immersible": False,
        "immersions": "0",
        "reason": obstruction.reason,
        **asdict(words(0, obstruction.sentence)),
        "where": [list(place) for place in obstruction.where],
        "kink": kink and _kink(kink),
    }


def _kink(kink: Kink) -> dict[str, Any]:
    return {
        "where": [list(place) for place in kink.places],
        "lobes": [lobe.tolist() for lobe in kink.lobes],
        "points": kink.rest.tolist(),
    }


def _word(drawn: Arrangement) -> str | None:
    word = blank_word(drawn)
    return " ".join(map(str, word.letters)) if len(word) <= _LONGEST_WORD else None
