"""One answer for every question, as bytes with a type and a status; errors become sentences. This runs in a worker."""

from __future__ import annotations

import json
import sys
import traceback
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from plyfold.errors import CurveError, InputError, MemoryLimitError, PlyfoldError, StrokeError, TimeLimitError
from plyfold.sketch.export import export
from plyfold.sketch.lie import lie
from plyfold.sketch.lifting import surface
from plyfold.sketch.look import look
from plyfold.sketch.opening import gallery, opened
from plyfold.sketch.schema import VERSION, Export, Lie, Look, Surface, parse, read_question

__all__ = ["Answer", "answer", "error_answer", "json_answer"]

# What is part of drawing is no failure: browsers would write of it in their consoles.
_STATUS = {
    "unfinished": 200,
    "drawing": 200,
    "superseded": 200,
    "file": 200,
    "input": 400,
    "refused": 403,
    "not found": 404,
    "too large": 413,
    "busy": 503,
    "time limit": 503,
    "internal": 500,
}


@dataclass(frozen=True)
class Answer:
    """What goes back to the page."""

    status: int
    content_type: str
    body: bytes
    headers: Mapping[str, str] = field(default_factory=dict)


def answer(name: str, body: bytes, headers: Mapping[str, str]) -> Answer:
    """Answer a question.

    Parameters
    ----------
    name : str
        The last part of its address, for example ``"look"``.
    body : bytes
        What was sent.
    headers : mapping of str to str
        With what was sent, names in small letters.

    Returns
    -------
    Answer
        Whatever happens: no error gets out of here.

    Examples
    --------
    >>> answer("look", b'{"version": 1, "points": [[0, 0], [1, 1], [2, 2]]}', {}).body.decode()
    '{"version":1,"error":{"kind":"drawing","sentence":"all points lie on one line","where":[[0.0,0.0],[2.0,2.0]],\
"hint":"a curve that runs back and forth on one line bounds nothing"}}'
    """
    try:
        return _ANSWERS[name](body, headers)
    except PlyfoldError as error:
        return error_answer(_kind(error), error.message or str(error), error.where, error.hint)
    except MemoryError:
        return error_answer("too large", "this takes more memory than there is", hint="ask for fewer triangles")
    except Exception:  # a mistake in plyfold: the page gets a sentence, the terminal the details
        traceback.print_exc(file=sys.stderr)
        return error_answer("internal", "plyfold made a mistake here", hint="the terminal has the details")


def json_answer(value: Any, status: int = 200) -> Answer:
    """Return plain data as an answer in JSON."""
    return Answer(status, "application/json", json.dumps(value, separators=(",", ":"), allow_nan=False).encode())


def error_answer(
    kind: str, sentence: str, where: Iterable[Iterable[float]] = (), hint: str = "", status: int | None = None
) -> Answer:
    """Return an error as an answer: its kind, a sentence, the places and what to do."""
    error = {"kind": kind, "sentence": sentence, "where": [list(place) for place in where], "hint": hint}
    return json_answer({"version": VERSION, "error": error}, status or _STATUS[kind])


def _kind(error: PlyfoldError) -> str:
    if isinstance(error, TimeLimitError):
        return "time limit"
    if isinstance(error, MemoryLimitError):
        return "too large"
    if isinstance(error, StrokeError):
        return "unfinished"
    return "input" if isinstance(error, InputError) and not isinstance(error, CurveError) else "drawing"


def _look(body: bytes, _headers: Mapping[str, str]) -> Answer:
    return json_answer(look(read_question(Look, parse(body))))


def _lie(body: bytes, _headers: Mapping[str, str]) -> Answer:
    return json_answer(lie(read_question(Lie, parse(body))))


def _surface(body: bytes, _headers: Mapping[str, str]) -> Answer:
    return json_answer(surface(read_question(Surface, parse(body))))


def _export(body: bytes, _headers: Mapping[str, str]) -> Answer:
    order = read_question(Export, parse(body))
    content, kind = export(order)
    return Answer(200, kind, content, {"Content-Disposition": f'attachment; filename="drawing.{order.format}"'})


def _open(body: bytes, headers: Mapping[str, str]) -> Answer:
    try:
        return json_answer(opened(body, headers))
    except InputError as error:
        return error_answer("file", error.message or str(error), error.where, error.hint)


def _gallery(_body: bytes, _headers: Mapping[str, str]) -> Answer:
    return json_answer(gallery())


_ANSWERS: dict[str, Callable[[bytes, Mapping[str, str]], Answer]] = {
    "look": _look,
    "lie": _lie,
    "surface": _surface,
    "export": _export,
    "open": _open,
    "gallery": _gallery,
}
