"""The 3D page: one HTML file that shows a surface in any browser, with no network and from any place.

Everything is inside the file: the triangles as base64 arrays, the vendored part of three.js and a small script.
"""

from __future__ import annotations

import base64
import html
import json
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from plyfold import colours
from plyfold.arrays import Floats, Ints
from plyfold.disk.motion import Motion
from plyfold.draw.placement import middle_and_size, natural_stretch
from plyfold.errors import InputError, PrecisionError
from plyfold.io.mesh.model import split_vertices
from plyfold.options import refuse_unless_count
from plyfold.surface.thicken import Solid

if TYPE_CHECKING:
    from plyfold.surface.lift import Surface

__all__ = ["frame", "mesh_data", "page"]

# So many positions on the way from the disk to the drawing go into a page, and only two if it would grow too large.
_FRAMES = 10
_MANY_VERTICES = 20_000


def page(surface: Surface | Solid, title: str = "plyfold", figures: Mapping[str, object] | None = None) -> str:
    """Return a self-contained HTML page of a surface or solid: orbit, zoom, top view, see-through, layers torn apart.

    Parameters
    ----------
    surface : Surface or Solid
        What to show.
    title : str
        Heading of the page.
    figures : mapping of str to object, optional
        Names and values for the caption, for example ``{"crossings": 4}``; by default the size of the surface.

    Returns
    -------
    str
        The page, about 0.6 MB plus 32 bytes for each triangle. Coordinates are stored relative to the middle of the
        drawing as 32-bit floats, so the page is right for drawings of any size and place.

    Raises
    ------
    InputError
        If the title is no text.

    Examples
    --------
    >>> from plyfold import lift
    >>> text = page(lift([(0, 0), (4, 0), (0, 3)]), title="A triangle")
    >>> "<title>A triangle</title>" in text
    True
    """
    if not isinstance(title, str):
        raise InputError(f"the title must be text, not {title!r}")
    shown = _default_figures(surface) if figures is None else figures
    return _fill(
        _static("viewer.html"),
        {
            "title": html.escape(title),
            "description": html.escape(f"{title}: a surface in three dimensions. Arrow keys turn it, + and - zoom."),
            "figures": _definition_list(shown),
            "css": colours.page_style() + _static("viewer.css"),
            "surface": json.dumps(mesh_data(surface), separators=(",", ":")),
            "three": _static("three.min.js"),
            "cloth": _static("cloth.js"),
            "viewer": _static("viewer.js"),
        },
    )


def frame(surface: Surface, title: str = "plyfold", height: int = 480) -> str:
    """Return the page inside an ``<iframe>``, as notebooks show it (``height`` in pixels)."""
    refuse_unless_count("height", height)
    style = f"width:100%;height:{height}px;border:0"
    return (
        f'<iframe srcdoc="{html.escape(page(surface, title))}" style="{style}" title="{html.escape(title)}"></iframe>'
    )


def mesh_data(shown: Surface | Solid) -> dict[str, Any]:
    """Return what the page's script reads: arrays in base64 (little-endian), scale, centre and colours.

    A vertex is ``centre + scale * stored``, with the drawing about 2 across in stored units; ``stretch`` is the
    vertical scale to begin with. A solid is shown in its true height, and without the way from the disk.
    """
    surface, vertices, faces = _parts(shown)
    centre, _ = middle_and_size(vertices)
    scale = middle_and_size(vertices[:, :2])[1] / 2
    stored = (vertices - centre) / scale
    level = np.asarray(surface.layering.level)
    levels = surface.n_layers
    return {
        "centre": centre.tolist(),
        "scale": scale,
        "stretch": natural_stretch(vertices) if surface is shown else 1.0,
        "vertices": _base64(stored, "<f4"),
        "faces": _base64(faces, "<u4"),
        "sheet": _base64(shown.sheet, "<u4"),
        "level": _base64(level, "<u4"),
        "sheetCell": np.asarray(surface.layering.immersion.sheet_cell).tolist(),
        "boundary": _base64(surface.boundary, "<u4"),
        "cusps": _base64(surface.cusps, "<u4"),
        "frames": [_base64((frame - centre[:2]) / scale, "<f4") for frame in _frames(shown)],
        "intersections": [_base64((polyline - centre) / scale, "<f4") for polyline in surface.intersections],
        "palette": {
            "cloth": [colours.CLOTH_LOW, colours.CLOTH_HIGH],
            "back": colours.BACK,
            "ink": colours.INK,
            "lineOnDark": colours.LINE_ON_DARK,
            "pale": colours.PALE,
            "cusp": colours.CUSP,
            "intersection": colours.OBSTRUCTION,
            "layers": [colours.layer_colour(i + 1, levels) for i in range(levels)],
            "sheets": [colours.sheet_colour(i) for i in range(3 * len(colours.SHEETS))],
        },
    }


def _parts(shown: Surface | Solid) -> tuple[Surface, Floats, Ints]:
    """Return the surface that is shown or in the middle of what is, and vertices and triangles, smooth where joined."""
    if not isinstance(shown, Solid):
        return shown, shown.vertices, shown.faces
    source, faces, _ = split_vertices(shown.faces, shown.smooth)
    return shown.surface, shown.vertices[source], faces


def _frames(surface: Surface | Solid) -> list[Floats]:
    """Return where the vertices are on their way from the round disk to the drawing, at equal times from 0 to 1.

    None of a solid, if it is no disk, or if doubles cannot hold that: then the page shows no way.
    """
    if isinstance(surface, Solid) or not surface.is_disk:
        return []
    try:
        motion = Motion(surface.unwrap())
    except PrecisionError:
        return []
    count = _FRAMES if len(surface.vertices) < _MANY_VERTICES else 2
    return [motion.at(number / count)[:, :2] for number in range(count)]


def _base64(values: npt.ArrayLike, kind: str) -> str:
    return base64.b64encode(np.ascontiguousarray(values, dtype=kind).tobytes()).decode("ascii")


def _default_figures(shown: Surface | Solid) -> dict[str, object]:
    return {"triangles": f"{len(shown.faces):,}", "layers": _parts(shown)[0].n_layers}


def _definition_list(figures: Mapping[str, object]) -> str:
    rows = "".join(f"<div><dt>{html.escape(k)}</dt><dd>{html.escape(str(v))}</dd></div>" for k, v in figures.items())
    return f"<dl>{rows}</dl>" if rows else ""


@cache
def _static(name: str) -> str:
    return files("plyfold.draw").joinpath("static", name).read_text(encoding="utf-8")


def _fill(template: str, values: Mapping[str, str]) -> str:
    """Put the values where the template says ``{{name}}``, each once, without reading the values again."""
    out = []
    for piece in template.split("{{"):
        name, found, rest = piece.partition("}}")
        out.append(values[name] + rest if found and name in values else piece)
    return "".join(out)
