"""Open strokes as ribbons: lines that are given a width, so that each is the outline of a disk."""

from __future__ import annotations

from time import perf_counter
from typing import Any

import numpy as np

from plyfold.arrays import Floats
from plyfold.errors import CurveError, InputError
from plyfold.outline.ribbons.ribbon import ribbon
from plyfold.sketch.offering import loop_data
from plyfold.sketch.schema import VERSION, Stroke, Widen

__all__ = ["ribbons"]


def ribbons(question: Widen) -> dict[str, Any]:
    """Return the outline of a ribbon along every open stroke, in order.

    Parameters
    ----------
    question : Widen

    Returns
    -------
    dict
        As ``PROTOCOL.md`` says, ready for JSON.

    Raises
    ------
    CurveError
        If a stroke is no line, or bends too tightly for the width; it names the place.

    Examples
    --------
    >>> len(ribbons(Widen((Stroke(((0, 0), (9, 0))),), 2))["loops"])
    1
    """
    began = perf_counter()
    loops = [loop_data(_ribbon(stroke, question.width)) for stroke in question.strokes if not stroke.closed]
    return {"version": VERSION, "loops": loops, "seconds": perf_counter() - began}


def _ribbon(stroke: Stroke, width: float) -> Floats:
    line = np.array(stroke.points, dtype=np.float64).reshape(-1, 2)
    try:
        return ribbon(line, width, "round", "round", closed=False).loops[0]
    except InputError as error:  # to be drawn otherwise: the question itself was in order
        raise CurveError(error.message, where=error.where, hint=error.hint) from error
