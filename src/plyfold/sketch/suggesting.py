"""Where would cusps help? A proposal for an outline that turns too often, at points of the drawing."""

from __future__ import annotations

from time import perf_counter
from typing import Any

from plyfold.immersion.immersion import Immersion
from plyfold.immersion.solve import find_immersion
from plyfold.offers.cusps import SuggestedCusps, suggest_cusps
from plyfold.report import surface_in_words
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
    ([{'where': [1.0, 1.0], 'index': 1}], 'A cusp would help here: with it, this is the outline of a disk of cloth.')
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
    immersion = find_immersion(found.outline)
    assert isinstance(immersion, Immersion)
    which, them = ("A cusp", "it") if len(found.cusps) == 1 else (f"{len(found.cusps)} cusps", "them")
    return f"{which} would help here: with {them}, this is the outline of {surface_in_words(immersion.pieces)}."
