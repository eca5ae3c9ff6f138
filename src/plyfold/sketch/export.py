"""Files of a drawing and of what it is: meshes, pictures, the 3D page, and the document itself."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Floats
from plyfold.colours import INK
from plyfold.draw.svg import arrangement_svg
from plyfold.errors import InputError, NotEmbeddableError, NotImmersibleError, PlyfoldError, TimeLimitError
from plyfold.layering.layering import Layering
from plyfold.obstruction import Obstruction
from plyfold.sketch.drawings import arranged, immersed
from plyfold.sketch.lie import lifted_surface
from plyfold.sketch.pictures import png_with, svg_with
from plyfold.sketch.schema import Document, Export, Polyline, document_data

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
    from plyfold.draw.tikz import over_under_tikz

    layering = lifted_surface(order.surface).layering
    if not isinstance(layering, Layering):
        raise InputError("TikZ shows layers, and these sheets pass through each other", hint="choose SVG or PNG")
    return over_under_tikz(layering).encode()


def _svg(order: Export) -> bytes:
    return svg_with(order.document, _svg_picture(order)).encode()


def _svg_picture(order: Export) -> str:
    """Return the picture of the furthest stage that the drawing reaches: cloth in layers, cells, or bare strokes."""
    from plyfold.draw.over_under_svg import over_under_svg

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
    from plyfold.draw.figures import overview

    try:
        figure = overview(*_furthest(order, arranged(order.surface.strokes)))
    except PlyfoldError:
        figure = _strokes_figure(order.document)
    drawn = BytesIO()
    figure.savefig(drawn, format="png", dpi=160, facecolor="white")
    return drawn.getvalue()


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
    lines = [_line(stroke.points, stroke.closed) for stroke in document.strokes if stroke.points]
    low, high = _box(lines)
    x, y = float(low[0]), -float(high[1])
    width, height = (high - low).tolist()
    style = f'fill="none" stroke="{INK}" stroke-width="{max(width, height) / 200}" stroke-linejoin="round"'
    drawn = "".join(
        '<polyline points="{}"/>'.format(" ".join(f"{x!r},{-y!r}" for x, y in line.tolist())) for line in lines
    )
    start = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{x} {y} {width} {height}">'
    return f"{start}\n<g {style}>{drawn}</g>\n</svg>\n"


def _strokes_figure(document: Document) -> Any:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5, 5), layout="constrained")
    axes = figure.subplots()
    axes.set_aspect("equal")
    axes.set_axis_off()
    for stroke in document.strokes:
        if stroke.points:
            axes.plot(*_line(stroke.points, stroke.closed).T, color=INK)
    return figure


def _line(points: Polyline, closed: bool) -> Floats:
    return np.array([*points, *points[:1]] if closed else points, dtype=np.float64)


def _box(lines: list[Floats]) -> tuple[Floats, Floats]:
    """Return the lower left and upper right corner of a picture, with a margin; of nothing, a unit square."""
    if not lines:
        return np.zeros(2), np.ones(2)
    points = np.concatenate(lines)
    low, high = points.min(axis=0), points.max(axis=0)
    margin = 0.05 * (float((high - low).max()) or 1.0)
    return low - margin, high + margin
