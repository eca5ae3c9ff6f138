"""Questions and documents as the protocol describes them: checked, and refused in a sentence. See ``PROTOCOL.md``."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, NoReturn, TypeAlias, TypeVar, cast

from plyfold.errors import InputError

__all__ = [
    "DOCUMENT_VERSION",
    "MOST_BYTES",
    "MOST_POINTS",
    "VERSION",
    "Backdrop",
    "Document",
    "Export",
    "Lie",
    "Lift",
    "Look",
    "Offer",
    "Polyline",
    "Stroke",
    "Widen",
    "document_data",
    "parse",
    "read_document",
    "read_question",
]

VERSION = 3
"""Of questions and answers."""
DOCUMENT_VERSION = 2
"""Of what is kept, shared and put into files: documents of versions before it open, too."""
MOST_BYTES = 16 * 2**20
MOST_POINTS = 50_000
_MOST_TRIANGLES = 200_000
_MOST_SETTINGS = 64
_LONGEST_INDEX = 1000
_MOST_TURNS = 1000
_PICTURE = re.compile(r"data:image/(png|jpeg|gif|webp);base64,[A-Za-z0-9+/]*={0,2}")
_INDEX = re.compile(rf"-?[0-9]{{1,{_LONGEST_INDEX}}}")

Polyline: TypeAlias = tuple[tuple[float, float], ...]
Setting: TypeAlias = str | float | bool | None


@dataclass(frozen=True)
class Stroke:
    """Polyline in the order of the pen; ``closed`` if the last one is joined to the first: then it is a loop.

    ``cusps`` has pairs (point, index), ascending: by how many full turns the surface's angle there is larger than the
    one that is seen.
    """

    points: Polyline
    closed: bool = False
    cusps: tuple[tuple[int, int], ...] = ()


@dataclass(frozen=True)
class Backdrop:
    """A picture to draw after: its data address, and (x, y, width, height) of its place, from the lower left corner."""

    href: str
    place: tuple[float, float, float, float] | None = None
    opacity: float = 0.5


@dataclass(frozen=True)
class Document:
    """All that a user would miss: the strokes, the picture behind them and the settings of the page."""

    strokes: tuple[Stroke, ...]
    image: Backdrop | None = None
    view: dict[str, Setting] = field(default_factory=dict)


@dataclass(frozen=True)
class Look:
    """The question what an outline is."""

    strokes: tuple[Stroke, ...]


@dataclass(frozen=True)
class Offer:
    """The question what to do about an outline that bounds nothing."""

    strokes: tuple[Stroke, ...]


@dataclass(frozen=True)
class Widen:
    """The wish that open strokes become ribbons of a width."""

    strokes: tuple[Stroke, ...]
    width: float


@dataclass(frozen=True)
class Lie:
    """The question how its cloth lies in one of many ways, and what is new in that after another way."""

    strokes: tuple[Stroke, ...]
    immersion: int
    layering: int
    before: int | None


@dataclass(frozen=True)
class Lift:
    """The question what it looks like, lifted."""

    strokes: tuple[Stroke, ...]
    immersion: int
    layering: int
    gap: float | None
    triangles: int
    allow_intersections: bool = False


@dataclass(frozen=True)
class Export:
    """The order of a file."""

    document: Document
    format: str
    surface: Lift


Q = TypeVar("Q", Look, Offer, Widen, Lie, Lift, Export)


# ---- reading ---------------------------------------------------------------------------------------------------------


def parse(text: bytes) -> Any:
    """Read JSON strictly: no NaN, no infinity, nothing nested beyond reason.

    Raises
    ------
    InputError
        If it is not JSON in UTF-8.

    Examples
    --------
    >>> parse(b'{"points": [[0, NaN]]}')
    Traceback (most recent call last):
    plyfold.errors.InputError: NaN is no number that JSON has
      hint: send finite numbers
    """
    try:
        return json.loads(text.decode(), parse_constant=_refuse_constant)
    except json.JSONDecodeError as error:
        raise InputError(f"this is no JSON: line {error.lineno}, {error.msg.lower()}") from error
    except InputError:
        raise
    except (ValueError, RecursionError) as error:
        raise InputError("this is no JSON that can be read", hint=str(error)) from error


def _refuse_constant(name: str) -> NoReturn:
    raise InputError(f"{name} is no number that JSON has", hint="send finite numbers")


def read_question(kind: type[Q], data: Any) -> Q:
    """Check a question and return it.

    Parameters
    ----------
    kind : {Look, Offer, Widen, Lie, Lift, Export}
    data : object
        What its JSON says.

    Raises
    ------
    InputError
        If anything in it is not as the protocol says.

    Examples
    --------
    >>> read_question(Look, {"version": 3, "points": [[0, 0], [1, 0], [0, 1]]}).strokes[0].closed
    True
    """
    question = _object(data, "the question")
    if question.get("version") != VERSION:
        _refuse(f"the question has the version {question.get('version')!r}, and this is {VERSION}", "reload the page")
    return cast(Q, _READERS[kind](question))


def read_document(data: Any) -> Document:
    """Check a document and return it.

    Raises
    ------
    InputError
        If anything in it is not as the protocol says.

    Examples
    --------
    >>> read_document({"plyfold": 2, "strokes": [{"points": [[0, 0], [1, 0]], "closed": False}]}).strokes
    (Stroke(points=((0.0, 0.0), (1.0, 0.0)), closed=False, cusps=()),)
    """
    document = _object(data, "the document")
    version = document.get("plyfold")
    if isinstance(version, bool) or version not in range(1, DOCUMENT_VERSION + 1):
        _refuse(
            f"the document has the version {version!r}, and this is {DOCUMENT_VERSION}", "open it with a newer plyfold"
        )
    strokes = _strokes(document.get("strokes"), "document.strokes")
    return Document(strokes, _image(document.get("image")), _view(document.get("view", {})))


def document_data(document: Document) -> dict[str, Any]:
    """Return a document as plain data, ready for JSON.

    Examples
    --------
    >>> document_data(Document((), None, {"dark": True}))
    {'plyfold': 2, 'strokes': [], 'image': None, 'view': {'dark': True}}
    """
    image = document.image
    return {
        "plyfold": DOCUMENT_VERSION,
        "strokes": [_stroke_data(stroke) for stroke in document.strokes],
        "image": image and {"href": image.href, "place": image.place and list(image.place), "opacity": image.opacity},
        "view": dict(document.view),
    }


def _stroke_data(stroke: Stroke) -> dict[str, Any]:
    data: dict[str, Any] = {"points": list(map(list, stroke.points)), "closed": stroke.closed}
    return data | ({"cusps": {str(point): index for point, index in stroke.cusps}} if stroke.cusps else {})


def _look(question: dict[str, Any]) -> Look:
    return Look(_drawing(question))


def _offer(question: dict[str, Any]) -> Offer:
    return Offer(_drawing(question))


def _ribbon(question: dict[str, Any]) -> Widen:
    width = _number(question.get("width"), "width")
    if width <= 0:
        _refuse("width is not a positive number")
    return Widen(_drawing(question), width)


def _lie(question: dict[str, Any]) -> Lie:
    before = question.get("before")
    return Lie(
        _drawing(question),
        _index(question, "immersion"),
        _index(question, "layering"),
        None if before is None else _index(question, "before"),
    )


def _lift(question: dict[str, Any]) -> Lift:
    return _lift_of(question, _drawing(question))


def _export(question: dict[str, Any]) -> Export:
    document = read_document(question.get("document"))
    kind = question.get("format")
    if not isinstance(kind, str):
        _refuse("format must be a word such as glb")
    return Export(document, kind, _lift_of(question, document.strokes))


_READERS: dict[type, Callable[[dict[str, Any]], Look | Offer | Widen | Lie | Lift | Export]] = {
    Look: _look,
    Offer: _offer,
    Widen: _ribbon,
    Lie: _lie,
    Lift: _lift,
    Export: _export,
}


def _lift_of(question: dict[str, Any], strokes: tuple[Stroke, ...]) -> Lift:
    triangles = question.get("triangles", 3000)
    if isinstance(triangles, bool) or not isinstance(triangles, int) or not 1 <= triangles <= _MOST_TRIANGLES:
        _refuse(f"triangles must be a whole number from 1 to {_MOST_TRIANGLES}")
    gap = question.get("gap")
    allowed = question.get("allow_intersections", False)
    return Lift(
        strokes,
        _index(question, "immersion"),
        _index(question, "layering"),
        None if gap is None else _number(gap, "gap"),
        triangles,
        _truth(allowed, "allow_intersections"),
    )


# ---- the parts -------------------------------------------------------------------------------------------------------


def _drawing(question: dict[str, Any]) -> tuple[Stroke, ...]:
    names = [name for name in ("points", "strokes", "loops") if name in question]
    if len(names) != 1:
        _refuse("a question has either points or strokes or loops")
    if names == ["points"]:
        return _limited((Stroke(_points(question["points"], "points"), closed=True),))
    return _strokes(question[names[0]], names[0])


def _strokes(data: Any, name: str) -> tuple[Stroke, ...]:
    strokes = enumerate(_list(data, name))
    return _limited(tuple(_stroke(stroke, f"{name}[{number}]", name == "loops") for number, stroke in strokes))


def _stroke(data: Any, name: str, is_loop: bool) -> Stroke:
    if not isinstance(data, dict):
        return Stroke(_points(data, name), is_loop)
    points = _points(data.get("points"), f"{name}.points")
    closed = is_loop or _truth(data.get("closed", False), "closed")
    return Stroke(points, closed, _marks(data.get("cusps", {}), len(points), f"{name}.cusps"))


def _marks(data: Any, points: int, name: str) -> tuple[tuple[int, int], ...]:
    found = [(_vertex(vertex, points, name), _turns(index, name)) for vertex, index in _object(data, name).items()]
    return tuple(sorted(mark for mark in found if mark[1]))


def _vertex(data: str, points: int, name: str) -> int:
    if not (data.isascii() and data.isdecimal() and len(data) < 10 and int(data) < points):
        _refuse(f"{name} names the point {data[:20]!r}, and there are {points}")
    return int(data)


def _turns(data: Any, name: str) -> int:
    if isinstance(data, bool) or not isinstance(data, int) or not 0 <= data <= _MOST_TURNS:
        _refuse(f"{name} has an index that is no whole number from 0 to {_MOST_TURNS}")
    return data


def _limited(strokes: tuple[Stroke, ...]) -> tuple[Stroke, ...]:
    count = sum(len(stroke.points) for stroke in strokes)
    if count > MOST_POINTS:
        _refuse(f"the drawing has {count:,} points, more than {MOST_POINTS:,}", "thin them out")
    return strokes


def _points(data: Any, name: str) -> Polyline:
    return tuple(_point(place, f"{name}[{number}]") for number, place in enumerate(_list(data, name)))


def _point(data: Any, name: str) -> tuple[float, float]:
    if not isinstance(data, list) or len(data) != 2:
        _refuse(f"{name} is not a point [x, y]")
    return _number(data[0], name), _number(data[1], name)


def _image(data: Any) -> Backdrop | None:
    if data is None:
        return None
    image = _object(data, "document.image")
    href, place = image.get("href"), image.get("place")
    if not isinstance(href, str) or not _PICTURE.fullmatch(href):
        _refuse("document.image.href is not the data address of a PNG, JPEG, GIF or WebP picture")
    return Backdrop(href, None if place is None else _place(place), _share(image.get("opacity", 0.5)))


def _place(data: Any) -> tuple[float, float, float, float]:
    if not isinstance(data, list) or len(data) != 4:
        _refuse("document.image.place is not [x, y, width, height]")
    x, y, width, height = (_number(value, "document.image.place") for value in data)
    if width <= 0 or height <= 0:
        _refuse("document.image.place has no width or no height")
    return x, y, width, height


def _share(data: Any) -> float:
    share = _number(data, "document.image.opacity")
    if not 0 <= share <= 1:
        _refuse("document.image.opacity is not between 0 and 1")
    return share


def _view(data: Any) -> dict[str, Setting]:
    view = _object(data, "document.view")
    if len(view) > _MOST_SETTINGS or any(isinstance(value, dict | list) for value in view.values()):
        _refuse(f"document.view has more than {_MOST_SETTINGS} settings, or one that is no single value")
    return view


def _index(question: dict[str, Any], name: str) -> int:
    value = question.get(name, 0)
    if isinstance(value, bool) or not isinstance(value, int | str) or not _INDEX.fullmatch(str(value)):
        _refuse(f"{name} is not a whole number")
    return int(value)


def _number(data: Any, name: str) -> float:
    if isinstance(data, bool) or not isinstance(data, int | float):
        _refuse(f"{name} has something in it that is not a number")
    try:
        number = float(data)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        _refuse(f"{name} has a number in it that is too large")
    return number


def _truth(data: Any, name: str) -> bool:
    if not isinstance(data, bool):
        _refuse(f"{name} is neither true nor false")
    return data


def _list(data: Any, name: str) -> list[Any]:
    if not isinstance(data, list):
        _refuse(f"{name} is not a list")
    return data


def _object(data: Any, name: str) -> dict[str, Any]:
    if not isinstance(data, dict):
        _refuse(f"{name} is not an object")
    return data


def _refuse(sentence: str, hint: str = "") -> NoReturn:
    raise InputError(sentence, hint=hint)
