"""Where would cusps help? A proposal for an outline that turns too often, at points of the drawing."""

from __future__ import annotations

from time import perf_counter
from typing import Any

from plyfold.immersion.immersion import Piece
from plyfold.offers.cusps import SuggestedCusps, suggest_cusps
from plyfold.report import offer_in_words, surface_in_words
from plyfold.sketch.drawings import arranged
from plyfold.sketch.patience import patient
from plyfold.sketch.schema import VERSION, Suggest

__all__ = ["suggested"]

_SECONDS_TO_SUGGEST = 5.0


def suggested(question: Suggest) -> dict[str, Any]:
    """Return cusps with which an outline bounds a surface, if some are found in seconds.

    Parameters
    ----------
    question : Suggest

    Returns
    -------
    dict
        As ``PROTOCOL.md`` says, ready for JSON.

    Raises
    ------
    PlyfoldError
        If the strokes make no outline that can be used.

    Examples
    --------
    >>> from plyfold.sketch.schema import Stroke
    >>> limacon = ((3, 0), (1, 3), (-2, 0), (1, -3), (3, 0.5), (1, 1), (0.5, 0), (1, -1))
    >>> answer = suggested(Suggest((Stroke(limacon, closed=True),)))
    >>> answer["cusps"], answer["sentence"]
    ([{'where': [1.0, -1.0], 'index': 1}], '1 turn is too many: with a cusp as shown, it is a disk of cloth.')
    """
    began = perf_counter()
    found = suggest_cusps(arranged(question.strokes), time_limit=patient(_SECONDS_TO_SUGGEST))
    none: dict[str, Any] = {"cusps": [], "sentence": None}
    said = {"cusps": _places(found), "sentence": _sentence(found)} if isinstance(found, SuggestedCusps) else none
    return {"version": VERSION, **said, "seconds": perf_counter() - began}


def _places(found: SuggestedCusps) -> list[dict[str, Any]]:
    return [
        {"where": found.outline.loops[loop][point].tolist(), "index": index}
        for (loop, point), index in found.cusps.items()
    ]


def _sentence(found: SuggestedCusps) -> str:
    loops = tuple(range(found.outline.n_loops))
    surface = surface_in_words([Piece(loops, 2 - len(loops))])
    return f"{offer_in_words([*found.cusps.values()], surface, 'as shown')}."
