"""One answer for every question, as bytes with a type and a status; errors become sentences. This runs in a worker."""

from __future__ import annotations

import json
import sys
import traceback
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, TypeAlias

from plyfold.errors import CurveError, InputError, MemoryLimitError, PlyfoldError, StrokeError, TimeLimitError
from plyfold.sketch.export import export
from plyfold.sketch.lie import lie, lifted
from plyfold.sketch.look import look_at
from plyfold.sketch.offering import offered
from plyfold.sketch.opening import gallery, opened
from plyfold.sketch.ribbons import ribbons
from plyfold.sketch.schema import VERSION, Export, Lie, Lift, Look, Offer, Q, Widen, parse, read_question

__all__ = ["Reply", "answer", "error_reply", "json_reply"]

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
class Reply:
    """What goes back to the page."""

    status: int
    content_type: str
    body: bytes
    headers: Mapping[str, str] = field(default_factory=dict)


_Answering: TypeAlias = Callable[[bytes, Mapping[str, str]], Reply]


def answer(name: str, body: bytes, headers: Mapping[str, str]) -> Reply:
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
    Reply
        Whatever happens: no error gets out of here.

    Examples
    --------
    >>> answer("look", b'{"version": 3, "points": [[0, 0], [1, 1], [2, 2]]}', {}).body.decode()
    '{"version":3,"error":{"kind":"drawing","sentence":"all points lie on one line","where":[[0.0,0.0],[2.0,2.0]],\
"hint":"a curve that runs back and forth on one line bounds nothing"}}'
    """
    try:
        return _ANSWERS[name](body, headers)
    except PlyfoldError as error:
        return error_reply(_kind(error), error.message or str(error), error.where, error.hint)
    except MemoryError:
        return error_reply("too large", "this takes more memory than there is", hint="ask for fewer triangles")
    except Exception:  # a mistake in plyfold: the page gets a sentence, the terminal the details
        traceback.print_exc(file=sys.stderr)
        return error_reply("internal", "plyfold made a mistake here", hint="the terminal has the details")


def json_reply(value: Any, status: int = 200) -> Reply:
    """Return plain data as an answer in JSON."""
    return Reply(status, "application/json", json.dumps(value, separators=(",", ":"), allow_nan=False).encode())


def error_reply(
    kind: str, sentence: str, where: Iterable[Iterable[float]] = (), hint: str = "", status: int | None = None
) -> Reply:
    """Return an error as an answer: its kind, a sentence, the places and what to do."""
    error = {"kind": kind, "sentence": sentence, "where": [list(place) for place in where], "hint": hint}
    return json_reply({"version": VERSION, "error": error}, status or _STATUS[kind])


def _kind(error: PlyfoldError) -> str:
    if isinstance(error, TimeLimitError):
        return "time limit"
    if isinstance(error, MemoryLimitError):
        return "too large"
    if isinstance(error, StrokeError):
        return "unfinished"
    return "input" if isinstance(error, InputError) and not isinstance(error, CurveError) else "drawing"


def _asked(kind: type[Q], find: Callable[[Q], dict[str, Any]]) -> _Answering:
    return lambda body, _headers: json_reply(find(read_question(kind, parse(body))))


def _export(body: bytes, _headers: Mapping[str, str]) -> Reply:
    order = read_question(Export, parse(body))
    content, kind = export(order)
    return Reply(200, kind, content, {"Content-Disposition": f'attachment; filename="drawing.{order.format}"'})


def _open(body: bytes, headers: Mapping[str, str]) -> Reply:
    try:
        return json_reply(opened(body, headers))
    except InputError as error:
        return error_reply("file", error.message or str(error), error.where, error.hint)


_ANSWERS: dict[str, _Answering] = {
    "look": _asked(Look, look_at),
    "offers": _asked(Offer, offered),
    "ribbon": _asked(Widen, ribbons),
    "lie": _asked(Lie, lie),
    "surface": _asked(Lift, lifted),
    "export": _export,
    "open": _open,
    "gallery": lambda _body, _headers: json_reply(gallery()),
}
