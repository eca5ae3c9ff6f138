"""Whole figures: everything that is known about a curve on one page, and saving without overwriting."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from plyfold.arrangement.arrangement import Arrangement
from plyfold.colours import INK, PAPER
from plyfold.draw.arrangement_plot import plot_arrangement
from plyfold.draw.immersion_plot import plot_immersion
from plyfold.draw.layers_plot import plot_layers
from plyfold.draw.layout_plot import plot_layout
from plyfold.draw.surface_plot import plot_surface
from plyfold.errors import InputError
from plyfold.immersion.immersion import Immersion
from plyfold.io.saving import refuse_existing, save_bytes
from plyfold.layering.layering import Layering
from plyfold.layering.orders.intersections import IntersectingLayering
from plyfold.surface.lift import Surface

if TYPE_CHECKING:
    from os import PathLike

    from matplotlib.figure import Figure, SubFigure

    from plyfold.obstruction import Obstruction

Panels: TypeAlias = list[tuple[str, Callable[..., object]]]

__all__ = ["overview", "picture_bytes", "save", "summary"]

_PANEL = 3.7


def overview(value: Arrangement | Immersion | Layering | Surface, obstruction: Obstruction | None = None) -> Figure:
    """Draw all that is known: the arrangement, the immersion, the layers, and the surface from two sides.

    Of a disk the immersion is shown as the disk layout, of another surface as it lies over the drawing.

    Parameters
    ----------
    value : Arrangement, Immersion, Layering or Surface
        The furthest stage that was reached; those before it are drawn too.
    obstruction : Obstruction, optional
        Why it went no further; marked in the drawing.

    Returns
    -------
    matplotlib Figure
        Shown by a notebook as the last line of a cell.

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> len(overview(find_immersion([(0, 0), (1, 0), (0, 1)])).axes)
    2
    """
    from plyfold.draw.canvas import ShownFigure

    if isinstance(value, Surface):
        flat, lifted = _panels(value.layering, obstruction), _views(value)
        figure = ShownFigure(figsize=(3 * _PANEL, 2.1 * _PANEL), layout="constrained")
        rows = figure.subfigures(2, 1, squeeze=False, height_ratios=[1.0, 1.05])[:, 0]
        _fill(rows[0], flat)
        _fill(rows[1], lifted)
    else:
        flat = _panels(value, obstruction)
        figure = ShownFigure(figsize=(_PANEL * len(flat), _PANEL + 0.3), layout="constrained")
        _fill(figure, flat)
    return figure


def summary(surface: Surface, path: str | PathLike[str], force: bool = False) -> None:
    """Save the :func:`overview` of a surface: one picture of the whole way. See :func:`save` for the rest."""
    save(overview(surface), path, force)


def save(figure: Figure, path: str | PathLike[str], force: bool = False) -> None:
    """Save a figure; the file appears complete or not at all.

    Parameters
    ----------
    figure : matplotlib Figure
    path : path
        The ending chooses the format: ``.png``, ``.svg`` or ``.pdf``.
    force : bool, optional
        Replace an existing file.

    Raises
    ------
    InputError
        If matplotlib knows no format with this ending.
    FileExistsError
        If the file exists and ``force`` is not set.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> save(Figure(), "picture.txt")
    Traceback (most recent call last):
    plyfold.errors.InputError: picture.txt: a picture cannot be written so
      hint: use .png, .svg or .pdf
    """
    kind = Path(path).suffix[1:].lower()
    if kind not in figure.canvas.get_supported_filetypes():
        raise InputError(f"{Path(path).name}: a picture cannot be written so", hint="use .png, .svg or .pdf")
    refuse_existing(path, force)
    save_bytes(path, picture_bytes(figure, kind), force)


def picture_bytes(figure: Figure, kind: str) -> bytes:
    """Return a figure as a file of some kind, like ``"png"``."""
    drawn = BytesIO()
    figure.savefig(drawn, format=kind, dpi=160, facecolor=PAPER)
    return drawn.getvalue()


def _panels(
    value: Arrangement | Immersion | Layering | IntersectingLayering, obstruction: Obstruction | None
) -> Panels:
    """Return the title and the picture of every stage up to this one."""
    if isinstance(value, Layering | IntersectingLayering):
        return [*_panels(value.immersion, obstruction), ("The layers", partial(plot_layers, value))]
    if isinstance(value, Immersion):
        title, plot = ("The disk layout", plot_layout) if value.is_disk else ("The surface laid flat", plot_immersion)
        return [*_panels(value.arrangement, obstruction), (title, partial(plot, value))]
    picture = partial(plot_arrangement, value, obstruction=obstruction, borders=True)
    what = "curve" if value.n_loops == 1 else "outline"
    return [(f"The {what}, its winding numbers and borders", picture)]


def _views(surface: Surface) -> Panels:
    return [
        ("The lifted surface", partial(plot_surface, surface, view="above", colours="sheets")),
        ("The same from the side", partial(plot_surface, surface, view="side", colours="sheets")),
    ]


def _fill(figure: Figure | SubFigure, panels: Panels) -> None:
    for ax, (title, draw) in zip(figure.subplots(1, len(panels), squeeze=False)[0], panels, strict=True):
        draw(ax=ax)
        ax.set_title(title, color=INK, fontsize=11)
