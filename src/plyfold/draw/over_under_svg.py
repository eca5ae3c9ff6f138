"""The layered drawing as SVG: a group for each layer and piece, which vector editors show as layers."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from plyfold.arrays import Floats
from plyfold.colours import INK
from plyfold.draw.over_under import Piece, Strand, over_under
from plyfold.layering.layering import Layering

__all__ = ["over_under_svg"]

_SIZE = 800.0
_MARGIN = 24.0
# Pieces overlap by so much, so that no light shines through between them.
_SEAM = 0.6
_NAMESPACES = 'xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'


def over_under_svg(layering: Layering, **options: Any) -> str:
    """Return a picture of a layered surface from above as SVG.

    Parameters
    ----------
    layering : Layering
        Of a drawing.
    **options
        ``colours`` and ``hidden``, see :func:`plyfold.draw.over_under.over_under`.

    Returns
    -------
    str
        Back to front: a group for each layer with a group for each piece in it, named after its sheets, then the
        hidden strands, if they are drawn, and the visible ones.

    Raises
    ------
    InputError
        If it is no layering, or an option is unknown.

    Examples
    --------
    >>> from plyfold import find_immersion, find_layering
    >>> picture = over_under_svg(find_layering(find_immersion([(0, 0), (1, 0), (0, 1)])))
    >>> picture.startswith("<svg"), picture.count("<path")
    (True, 2)
    """
    drawn = over_under(layering, **options)
    origin = _SIZE * drawn.half + _MARGIN
    parts = [
        *_layers(drawn.layers, origin),
        *_strands("hidden", [strand for strand in drawn.strands if strand.hidden], origin, drawn.stroke * _SIZE),
        *_strands("visible", [strand for strand in drawn.strands if not strand.hidden], origin, drawn.stroke * _SIZE),
    ]
    width, height = (f"{2 * x:.0f}" for x in origin)
    size = f'width="{width}" height="{height}" viewBox="0 0 {width} {height}"'
    return f"<svg {_NAMESPACES} {size}>\n<title>Over and under</title>\n" + "\n".join(parts) + "\n</svg>\n"


def _layers(layers: Iterable[Iterable[Piece]], origin: Floats) -> Iterator[str]:
    for number, pieces in enumerate(layers, start=1):
        yield f'<g id="layer-{number}" inkscape:groupmode="layer" inkscape:label="layer {number}">'
        for piece in pieces:
            name = f'id="layer-{number}-sheet-{piece.sheets[0]}" inkscape:label="{piece.name}"'
            style = f'fill="{piece.colour}" stroke="{piece.colour}" stroke-width="{_SEAM}" stroke-linejoin="round"'
            outline = "".join(_path(ring, origin) + "Z" for ring in piece.rings)
            title = f"<title>{piece.name}, level {number}</title>"
            yield f'<g {name}>{title}<path {style} fill-rule="evenodd" d="{outline}"/></g>'
        yield "</g>"


def _strands(name: str, strands: list[Strand], origin: Floats, width: float) -> Iterator[str]:
    if not strands:
        return
    dashes = f' stroke-opacity="0.6" stroke-dasharray="{2.2 * width:g} {1.8 * width:g}"' if name == "hidden" else ""
    width = 0.7 * width if name == "hidden" else width
    style = f'fill="none" stroke="{INK}" stroke-width="{width:g}" stroke-linejoin="round"{dashes}'
    yield f'<g id="{name}-strands" inkscape:groupmode="layer" inkscape:label="{name} strands" {style}>'
    for strand in strands:
        yield f'<path d="{_path(strand.points, origin)}{"Z" if strand.closed else ""}"/>'
    yield "</g>"


def _path(points: Floats, origin: Floats) -> str:
    """Return a polyline in pixels, to a hundredth, y down."""
    pixels = (points * (_SIZE, -_SIZE) + origin).round(2)
    return "M" + "L".join(f"{x:g},{y:g}" for x, y in pixels.tolist())
