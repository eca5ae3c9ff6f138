"""From files to documents (a first version: the named curves and nothing)."""

from __future__ import annotations

from plyfold.sketch.answers import Answer, json_answer
from plyfold.sketch.schema import MOST_BYTES, MOST_POINTS, VERSION


def start_answer(file: str | None) -> Answer:
    """Return the answer to what the page should begin with."""
    limits = {"bytes": MOST_BYTES, "points": MOST_POINTS}
    return json_answer({"version": VERSION, "document": None, "name": file, "limits": limits})
