"""The layered drawing as TikZ, for documents in LaTeX."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from plyfold.arrays import Floats
from plyfold.colours import INK
from plyfold.draw.over_under import OverUnder, Strand, over_under
from plyfold.errors import InputError
from plyfold.layering.layering import Layering
from plyfold.options import refuse_unless_number

__all__ = ["over_under_tex", "over_under_tikz"]

_POINTS_PER_CENTIMETRE = 72.27 / 2.54
# Pieces overlap by so many points, so that no light shines through between them.
_SEAM = 0.15
# TeX cannot hold lengths of six metres.
_WIDEST = 500.0


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
    lines = [*_pieces(drawn, size), *(_strand(strand, size, drawn.stroke) for strand in drawn.strands)]
    return "\n".join([r"\begin{tikzpicture}[line join=round]", *lines, r"\end{tikzpicture}"]) + "\n"


def over_under_tex(layering: Layering, **options: Any) -> str:
    """Return :func:`over_under_tikz` as a document of its own, of the class ``standalone``."""
    picture = over_under_tikz(layering, **options)
    return "\\documentclass[tikz,border=2mm]{standalone}\n\\begin{document}\n" + picture + "\\end{document}\n"


def _pieces(drawn: OverUnder, size: float) -> Iterator[str]:
    colours = sorted({piece.colour for piece in drawn.pieces} | {INK})
    for colour in colours:
        yield rf"\definecolor{{{_name(colour)}}}{{HTML}}{{{colour[1:].upper()}}}"
    for number, pieces in enumerate(drawn.layers, start=1):
        yield f"% layer {number}"
        for piece in pieces:
            rings = "\n  ".join(_path(ring, size) + " -- cycle" for ring in piece.rings)
            style = f"{_name(piece.colour)}, even odd rule, line width={_SEAM}pt"
            yield f"\\filldraw[{style}] % {piece.name}\n  {rings};"


def _strand(strand: Strand, size: float, stroke: float) -> str:
    width = stroke * size * _POINTS_PER_CENTIMETRE
    style = f"{_name(INK)}, line width={width:.3f}pt"
    if strand.hidden:
        dashes = f"dash pattern=on {2.2 * width:.3f}pt off {1.8 * width:.3f}pt"
        style = f"{_name(INK)}!60, line width={0.7 * width:.3f}pt, {dashes}"
    return f"\\draw[{style}]\n  {_path(strand.points, size)}{' -- cycle' if strand.closed else ''};"


def _name(colour: str) -> str:
    return f"plyfold{colour[1:]}"


def _path(points: Floats, size: float) -> str:
    """Return a polyline in centimetres, on lines that are not too long."""
    places = [f"({x:.4f},{y:.4f})" for x, y in (points * size).tolist()]
    rows = (" -- ".join(places[start : start + 6]) for start in range(0, len(places), 6))
    return "\n  -- ".join(rows)
