"""Files of a drawing and of what it is: meshes, pictures, the 3D page, and the document itself."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Floats
from plyfold.colours import INK
from plyfold.draw.canvas import ShownFigure, blank, line
from plyfold.draw.figures import overview, picture_bytes
from plyfold.draw.over_under_files import over_under_svg, over_under_tikz
from plyfold.draw.placement import closed
from plyfold.draw.svg import arrangement_svg
from plyfold.errors import InputError, NotEmbeddableError, NotImmersibleError, PlyfoldError, TimeLimitError
from plyfold.io.svg_writing import polylines_svg
from plyfold.layering.layering import Layering
from plyfold.obstruction import Obstruction
from plyfold.sketch.drawings import arranged, immersed
from plyfold.sketch.lie import lifted_surface
from plyfold.sketch.pictures import png_with, svg_with
from plyfold.sketch.schema import Document, Export, document_data

__all__ = ["FORMATS", "export"]

_TYPES = {
    "glb": "model/gltf-binary",
    "obj": "model/obj",
    "stl": "model/stl",
    "ply": "application/octet-stream",
    "3mf": "model/3mf",
    "html": "text/html; charset=utf-8",
    "svg": "image/svg+xml",
    "png": "image/png",
    "tikz": "text/plain; charset=utf-8",
    "json": "application/json",
}
FORMATS = tuple(_TYPES)


def export(order: Export) -> tuple[bytes, str]:
    """Return a file and its type.

    Parameters
    ----------
    order : Export

    Returns
    -------
    bytes
        JSON, SVG and PNG carry the document, whether it is finished or not.
    str
        The type, as in ``Content-Type``.

    Raises
    ------
    InputError
        If there is no such format.
    PlyfoldError
        If the drawing has nothing that the format could hold.

    Examples
    --------
    >>> from plyfold.sketch.schema import Lift
    >>> export(Export(Document(()), "json", Lift((), 0, 0, None, 100)))[1]
    'application/json'
    """
    if order.format not in _TYPES:
        raise InputError(f"there is no format {order.format[:20]!r}", hint=f"there are {' '.join(FORMATS)}")
    return _WRITERS.get(order.format, _mesh)(order), _TYPES[order.format]


def _mesh(order: Export) -> bytes:
    made = lifted_surface(order.surface)
    with tempfile.TemporaryDirectory(prefix="plyfold-") as folder:
        path = Path(folder) / f"drawing.{order.format}"
        made.export(path, title="plyfold")
        return path.read_bytes()


def _json(order: Export) -> bytes:
    return (json.dumps(document_data(order.document), allow_nan=False) + "\n").encode()


def _tikz(order: Export) -> bytes:
    layering = lifted_surface(order.surface).layering
    if not isinstance(layering, Layering):
        raise InputError("TikZ shows layers, and these sheets pass through each other", hint="choose SVG or PNG")
    return over_under_tikz(layering).encode()


def _svg(order: Export) -> bytes:
    return svg_with(order.document, _svg_picture(order)).encode()


def _svg_picture(order: Export) -> str:
    """Return the picture of the furthest stage that the drawing reaches: cloth in layers, cells, or bare strokes."""
    try:
        drawn = arranged(order.surface.strokes)
    except PlyfoldError:
        return _strokes_svg(order.document)
    stage, _ = _furthest(order, drawn)
    layering = getattr(stage, "layering", None)
    return over_under_svg(layering) if isinstance(layering, Layering) else arrangement_svg(drawn)


def _png(order: Export) -> bytes:
    return png_with(order.document, _png_picture(order))


def _png_picture(order: Export) -> bytes:
    try:
        figure = overview(*_furthest(order, arranged(order.surface.strokes)))
    except PlyfoldError:
        figure = _strokes_figure(order.document)
    return picture_bytes(figure, "png")


_WRITERS: dict[str, Callable[[Export], bytes]] = {"json": _json, "svg": _svg, "png": _png, "tikz": _tikz}


def _furthest(order: Export, drawn: Arrangement) -> tuple[Any, Obstruction | None]:
    """Return the furthest stage that the loop reaches, and the obstruction that ended it."""
    try:
        return lifted_surface(order.surface), None
    except NotImmersibleError as error:
        return drawn, error.obstruction
    except NotEmbeddableError as error:
        return immersed(order.surface.strokes, order.surface.immersion), error.obstruction
    except TimeLimitError:
        return immersed(order.surface.strokes, order.surface.immersion), None


# ---- bare strokes ----------------------------------------------------------------------------------------------------


def _strokes_svg(document: Document) -> str:
    return polylines_svg(_lines(document))


def _strokes_figure(document: Document) -> ShownFigure:
    figure = ShownFigure(figsize=(5, 5), layout="constrained")
    axes = blank(figure.subplots())
    for points in _lines(document):
        line(axes, points, INK, 1.5)
    return figure


def _lines(document: Document) -> list[Floats]:
    """Return the strokes as polylines, closed ones with the first point at the end again."""
    drawn = [(np.array(stroke.points, dtype=np.float64), stroke.closed) for stroke in document.strokes if stroke.points]
    return [closed(points) if is_closed else points for points, is_closed in drawn]
