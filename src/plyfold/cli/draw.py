"""``plyfold draw``: a picture of every stage, and over/under drawings."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from plyfold.cli.inputs import (
    DISK,
    NO_DISK,
    add_command,
    add_outputs,
    add_repair,
    add_time_limit,
    prepare,
    read_as_given,
    refuse_outputs,
    write_texts,
)
from plyfold.cli.progress import Stopwatch
from plyfold.cli.standard_output import say_written
from plyfold.cli.streams import complain
from plyfold.errors import InputError, NotEmbeddableError, NotImmersibleError
from plyfold.io.saving import save_bytes

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from plyfold.arrangement.arrangement import Arrangement
    from plyfold.outline.curve import Outline

__all__ = ["add_draw_command"]

# More pixels in a row or a column would take more memory than a picture is worth.
_MOST_COLUMNS = 20_000


def add_draw_command(commands: Any) -> None:
    """Add the subcommand to a parser."""
    draw = add_command(commands, "draw", _draw, "draw the arrangement, the disk layout, the layers and the surface")
    add_time_limit(draw, "lifting it")
    add_outputs(draw, ".svg .png .pdf; of the view over-under .svg .tikz .tex; of a mask .png .npy .csv")
    add_repair(draw)
    draw.add_argument(
        "--what",
        choices=["all", "arrangement", "layout", "layers", "surface", "over-under"],
        default="all",
        help="one panel only, or the surface from above with what is hidden removed",
    )
    draw.add_argument(
        "--mask",
        type=_columns,
        metavar="COLUMNS",
        help="the winding number at the centre of each pixel instead, so many of them across; nothing is moved",
    )
    draw.add_argument(
        "--hidden",
        choices=["removed", "dashed"],
        default="removed",
        help="over-under: what is covered (default: %(default)s)",
    )
    draw.add_argument(
        "--colours",
        choices=["cloth", "layers", "sheets"],
        default="cloth",
        help="over-under: of what (default: %(default)s)",
    )


def _columns(text: str) -> int:
    columns = int(text) if text.isascii() and text.isdigit() else 0
    if not 1 <= columns <= _MOST_COLUMNS:
        raise argparse.ArgumentTypeError(f"{text} is not a number of columns from 1 to {_MOST_COLUMNS}")
    return columns


def _draw(options: argparse.Namespace) -> int:
    if options.mask is not None:
        return _draw_mask(options)
    if options.what == "over-under":
        return _draw_over_under(options)
    from plyfold.draw.figures import save

    watch = Stopwatch()
    arranged = prepare(options, (".svg", ".png", ".pdf"), watch)
    value, obstruction = _furthest(arranged, options, watch)
    watch("drawing")
    figure = _figure(value, obstruction, options.what)
    for path in options.output:
        save(figure, path, options.force)
    watch.stop()
    if obstruction is not None:
        complain(f"plyfold: {obstruction}")
    for path in options.output:
        say_written(path)
    return DISK if obstruction is None else NO_DISK


def _draw_over_under(options: argparse.Namespace) -> int:
    from plyfold.clock import Clock, Watch
    from plyfold.draw.over_under_files import OVER_UNDER_WRITERS
    from plyfold.surface.lift import layering_of

    watch = Stopwatch()
    arranged = prepare(options, tuple(OVER_UNDER_WRITERS), watch)
    layering = layering_of(arranged, False, Watch(Clock(options.time_limit), watch))
    watch.stop()
    choices = {"colours": options.colours, "hidden": options.hidden}
    write_texts(options, {ending: partial(write, layering, **choices) for ending, write in OVER_UNDER_WRITERS.items()})
    return DISK


def _draw_mask(options: argparse.Namespace) -> int:
    from plyfold.io.masks import MASK_WRITERS

    watch = Stopwatch()
    refuse_outputs(options, tuple(MASK_WRITERS))
    drawn = read_as_given(options, watch)
    watch("counting")
    mask, transform = _mask(drawn, options.mask)
    watch.stop()
    rows, columns = mask.shape
    print(f"{rows} rows of {columns} pixels, transform {' '.join(f'{number:.12g}' for number in transform)}")
    for path in options.output:
        save_bytes(path, MASK_WRITERS[Path(path).suffix.lower()](mask), options.force)
        say_written(path)
    return DISK


def _mask(drawn: Outline, columns: int) -> tuple[npt.NDArray[np.int32], tuple[float, ...]]:
    """Return the winding numbers of pixels that cover the outline, so many of them across, and their transform."""
    from plyfold.flat.fills import coverage_mask

    (left, low), (right, high) = drawn.points.min(axis=0).tolist(), drawn.points.max(axis=0).tolist()
    # As large as the drawing is wide, or high where it is higher than so many pixels.
    size = max(right - left, (high - low) / _MOST_COLUMNS * columns) / columns
    rows = max(1, math.ceil((high - low) / size))
    transform = (size, 0.0, left, 0.0, -size, high)
    return coverage_mask(drawn, (rows, columns), transform), transform


def _furthest(arranged: Arrangement, options: argparse.Namespace, watch: Stopwatch) -> tuple[Any, Any]:
    """Return the furthest stage that the curve reaches, and the obstruction that ended it."""
    from plyfold.immersion.solve import find_immersion
    from plyfold.surface.lift import lift

    try:
        return lift(arranged, time_limit=options.time_limit, progress=watch), None
    except NotEmbeddableError as error:
        return find_immersion(arranged), error.obstruction
    except NotImmersibleError as error:
        return arranged, error.obstruction


def _figure(value: Any, obstruction: Any, what: str) -> Any:
    from plyfold import draw
    from plyfold.draw.figures import overview

    if what == "all":
        return overview(value, obstruction)
    layering = getattr(value, "layering", None)
    immersion = getattr(layering, "immersion", value)
    panels: dict[str, tuple[Any, Callable[..., Any]]] = {
        "arrangement": (getattr(immersion, "arrangement", immersion), draw.plot_arrangement),
        "layout": (immersion if hasattr(immersion, "disk_layout") else None, draw.plot_layout),
        "layers": (layering, draw.plot_layers),
        "surface": (value if layering is not None else None, draw.plot_surface),
    }
    subject, plot = panels[what]
    if subject is None:
        raise InputError(f"this curve has no {what} to draw: {obstruction}")
    ax = plot(subject, obstruction=obstruction) if what == "arrangement" else plot(subject)
    return ax.figure
