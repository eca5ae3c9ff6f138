"""Files with the layered drawing: SVG with a group for each layer and piece, and TikZ for documents in LaTeX."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from plyfold.arrays import Floats
from plyfold.colours import CUSP, INK
from plyfold.draw.over_under import DASHES, HIDDEN_OPACITY, HIDDEN_WIDTH, OverUnder, Strand, over_under
from plyfold.draw.svg import SvgPicture
from plyfold.errors import InputError
from plyfold.io.saving import refuse_output, save_bytes
from plyfold.layering.layering import Layering
from plyfold.options import refuse_unless_number

__all__ = ["OVER_UNDER_WRITERS", "over_under_svg", "over_under_tex", "over_under_tikz", "save_over_under"]

_PIXELS = 848.0
_MARGIN = 24.0
# Vector editors show such groups as layers.
_NAMESPACES = " xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape'"

_POINTS_PER_CENTIMETRE = 72.27 / 2.54
# TeX cannot hold lengths of six metres.
_WIDEST = 500.0
# The size of letters in a document, in points.
_LETTERS = 10.0

# Pieces overlap by so much, so that no light shines through between them.
_SEAM_PIXELS = 0.6
_SEAM_POINTS = 0.15


def save_over_under(layering: Layering, path: str | os.PathLike[str], force: bool = False, **options: Any) -> None:
    """Write the picture of a layered surface from above.

    Parameters
    ----------
    layering : Layering
        Of a drawing.
    path : path
        The ending chooses the format: ``.svg``, ``.tikz`` for a picture to be read into a document, ``.tex`` for a
        document.
    force : bool
        Replace an existing file.
    **options
        ``colours`` and ``hidden``, see :func:`plyfold.draw.over_under.over_under`.

    Raises
    ------
    InputError
        If the ending is none of these, the folder is missing, it is no layering, or an option is unknown.
    FileExistsError
        If the file exists and ``force`` is not set.
    """
    refuse_output(str(path), tuple(OVER_UNDER_WRITERS), force)
    save_bytes(path, OVER_UNDER_WRITERS[Path(path).suffix.lower()](layering, **options).encode(), force)


# ---- SVG -------------------------------------------------------------------------------------------------------------


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
        hidden strands, if they are drawn, the visible ones, and the signs of cusps.

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
    picture = SvgPicture(np.stack([-drawn.half, drawn.half]), _PIXELS, _MARGIN)
    visible, hidden = ([strand for strand in drawn.strands if strand.hidden == kind] for kind in (False, True))
    width = drawn.stroke * picture.scale
    parts = [*_layers(picture, drawn), *_strands(picture, "hidden", hidden, width)]
    parts += [*_strands(picture, "visible", visible, width), *_cusps(picture, drawn)]
    return picture.element(["<title>Over and under</title>", *parts], _NAMESPACES) + "\n"


def _layers(picture: SvgPicture, drawn: OverUnder) -> Iterator[str]:
    for number, pieces in enumerate(drawn.layers, start=1):
        yield f'<g id="layer-{number}" inkscape:groupmode="layer" inkscape:label="layer {number}">'
        for piece in pieces:
            name = f'id="layer-{number}-sheet-{piece.sheets[0]}" inkscape:label="{piece.name}"'
            style = f'fill="{piece.colour}" stroke="{piece.colour}" stroke-width="{_SEAM_PIXELS}"'
            outline = "".join(picture.path(ring) for ring in piece.rings)
            title = f"<title>{piece.name}, level {number}</title>"
            yield f'<g {name}>{title}<path {style} stroke-linejoin="round" fill-rule="evenodd" d="{outline}"/></g>'
        yield "</g>"


def _strands(picture: SvgPicture, name: str, strands: list[Strand], width: float) -> Iterator[str]:
    if not strands:
        return
    dashes = ""
    if name == "hidden":
        on, off = (share * width for share in DASHES)
        dashes = f' stroke-opacity="{HIDDEN_OPACITY}" stroke-dasharray="{on:g} {off:g}"'
        width *= HIDDEN_WIDTH
    style = f'fill="none" stroke="{INK}" stroke-width="{width:g}" stroke-linejoin="round"{dashes}'
    yield f'<g id="{name}-strands" inkscape:groupmode="layer" inkscape:label="{name} strands" {style}>'
    for strand in strands:
        yield f'<path d="{picture.path(strand.points, strand.closed)}"/>'
    yield "</g>"


def _cusps(picture: SvgPicture, drawn: OverUnder) -> Iterator[str]:
    if drawn.cusp_indices:
        yield '<g id="cusps" inkscape:groupmode="layer" inkscape:label="cusps">'
        yield from picture.cusps(drawn.cusps, drawn.cusp_indices, drawn.cusp_radius * picture.scale)
        yield "</g>"


# ---- TikZ ------------------------------------------------------------------------------------------------------------


def over_under_tikz(layering: Layering, *, size: float = 8.0, **options: Any) -> str:
    r"""Return a picture of a layered surface from above as a ``tikzpicture``, to be read with ``\input``.

    Parameters
    ----------
    layering : Layering
        Of a drawing.
    size : float
        Its larger side in centimetres.
    **options
        ``colours`` and ``hidden``, see :func:`plyfold.draw.over_under.over_under`.

    Returns
    -------
    str
        It needs the package ``tikz``.

    Raises
    ------
    InputError
        If it is no layering, an option is unknown, or TeX cannot draw that size.

    Examples
    --------
    >>> from plyfold import find_immersion, find_layering
    >>> print(over_under_tikz(find_layering(find_immersion([(0, 0), (1, 0), (0, 1)]))).splitlines()[0])
    \begin{tikzpicture}[line join=round]
    """
    refuse_unless_number("size", size)
    if not 0 < size <= _WIDEST:
        raise InputError(f"the size must be from 0 to {_WIDEST:g} centimetres, not {size!r}")
    drawn = over_under(layering, **options)
    lines = [*_tikz_pieces(drawn, size), *(_tikz_strand(strand, size, drawn.stroke) for strand in drawn.strands)]
    lines += _tikz_cusps(drawn, size)
    return "\n".join([r"\begin{tikzpicture}[line join=round]", *lines, r"\end{tikzpicture}"]) + "\n"


def over_under_tex(layering: Layering, **options: Any) -> str:
    """Return :func:`over_under_tikz` as a document of its own, of the class ``standalone``."""
    picture = over_under_tikz(layering, **options)
    return "\\documentclass[tikz,border=2mm]{standalone}\n\\begin{document}\n" + picture + "\\end{document}\n"


def _tikz_pieces(drawn: OverUnder, size: float) -> Iterator[str]:
    colours = sorted({piece.colour for piece in drawn.pieces} | {INK} | ({CUSP} if drawn.cusp_indices else set()))
    for colour in colours:
        yield rf"\definecolor{{{_tikz_name(colour)}}}{{HTML}}{{{colour[1:].upper()}}}"
    for number, pieces in enumerate(drawn.layers, start=1):
        yield f"% layer {number}"
        for piece in pieces:
            rings = "\n  ".join(_tikz_path(ring, size) + " -- cycle" for ring in piece.rings)
            style = f"{_tikz_name(piece.colour)}, even odd rule, line width={_SEAM_POINTS}pt"
            yield f"\\filldraw[{style}] % {piece.name}\n  {rings};"


def _tikz_strand(strand: Strand, size: float, stroke: float) -> str:
    width = stroke * size * _POINTS_PER_CENTIMETRE
    style = f"{_tikz_name(INK)}, line width={width:.3f}pt"
    if strand.hidden:
        on, off = (share * width for share in DASHES)
        dashes = f"dash pattern=on {on:.3f}pt off {off:.3f}pt"
        style = f"{_tikz_name(INK)}!{100 * HIDDEN_OPACITY:g}, line width={HIDDEN_WIDTH * width:.3f}pt, {dashes}"
    return f"\\draw[{style}]\n  {_tikz_path(strand.points, size)}{' -- cycle' if strand.closed else ''};"


def _tikz_cusps(drawn: OverUnder, size: float) -> Iterator[str]:
    radius = drawn.cusp_radius * size
    scale = 1.4 * radius * _POINTS_PER_CENTIMETRE / _LETTERS
    for (x, y), index in zip((drawn.cusps * size).tolist(), drawn.cusp_indices, strict=True):
        yield f"\\filldraw[{_tikz_name(CUSP)}, draw=white] ({x:.4f},{y:.4f}) circle[radius={radius:.4f}]"
        yield f"  node[white, scale={scale:.3f}] {{\\textsf{{\\textbf{{{index}}}}}}};"


def _tikz_name(colour: str) -> str:
    return f"plyfold{colour[1:]}"


def _tikz_path(points: Floats, size: float) -> str:
    """Return a polyline in centimetres, on lines that are not too long."""
    places = [f"({x:.4f},{y:.4f})" for x, y in (points * size).tolist()]
    rows = (" -- ".join(places[start : start + 6]) for start in range(0, len(places), 6))
    return "\n  -- ".join(rows)


OVER_UNDER_WRITERS: Mapping[str, Callable[..., str]] = {
    ".svg": over_under_svg,
    ".tikz": over_under_tikz,
    ".tex": over_under_tex,
}
