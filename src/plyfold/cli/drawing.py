"""The drawing that a command is about: all shapes of a file or one of them, with the cusps that were asked for."""

from __future__ import annotations

import argparse
import shlex
from typing import TYPE_CHECKING

from plyfold.cli.progress import Stopwatch
from plyfold.clock import Clock
from plyfold.errors import FileFormatError, InputError, NotEmbeddableError, TimeLimitError
from plyfold.loading import FOR_CROSSINGS, FOR_LAYERINGS, load_libraries
from plyfold.obstruction import Obstruction, Unknown

if TYPE_CHECKING:
    from plyfold.arrangement.arrangement import Arrangement
    from plyfold.io.cusp_notation import CuspMark
    from plyfold.io.reading import Contents
    from plyfold.outline.curve import Outline

__all__ = ["add_drawing_options", "named_drawing", "read_file", "read_outline"]


def add_drawing_options(command: argparse.ArgumentParser) -> None:
    """Give a subcommand the file and the options that say what in it is meant."""
    command.set_defaults(read_shape=None, shape={}, ribbon=None)
    command.add_argument("file", metavar="FILE", help='a drawing, "-" for standard input, or gallery:NAME')
    command.add_argument("--id", help="the element of an SVG, or the feature of a GeoJSON; by default all of it")
    command.add_argument("--index", type=int, metavar="N", help="which shape of the file, from 0 on; by default all")
    command.add_argument(
        "--each",
        action="store_true",
        help="each shape for itself, one after the other; outputs get their numbers before the ending",
    )
    command.add_argument(
        "--cusp",
        type=_cusp,
        action="append",
        default=[],
        metavar="[LOOP:]POINT[xM]",
        help="a point where the surface turns M full turns further than one sees (default: 1), counted from 0 in its "
        "loop: --cusp 12, --cusp 0:12, --cusp 0:12x2; as often as needed",
    )
    command.add_argument(
        "--cusps",
        choices=["auto"],
        help="have cusps proposed, if the outline bounds nothing and up to 3 turns are too many",
    )
    command.add_argument("--uv", action="store_true", help="of an OBJ or PLY, the texture coordinates as the flat mesh")
    command.add_argument("--tolerance", type=float, help="how far a Bézier or arc may be from its polyline")
    _add_width_options(command)


def _add_width_options(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--width",
        type=_width,
        metavar="W",
        help='make ribbons of this width out of lines: open paths, LineStrings, lists of points, tracks; "auto" takes '
        "the widths of strokes in an SVG; of a GPX in metres",
    )
    command.add_argument("--join", choices=["round", "mitre", "bevel"], help="what bends of ribbons look like outside")
    command.add_argument("--cap", choices=["flat", "round", "square"], help="what ends of ribbons look like")


def _width(text: str) -> float | str:
    if text == "auto":
        return text
    try:
        return float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text} is no width: a number, or auto") from None


def _cusp(text: str) -> CuspMark:
    from plyfold.io.cusp_notation import parse_cusp

    try:
        return parse_cusp(text)
    except FileFormatError as error:
        raise argparse.ArgumentTypeError(f"{error.message}: {error.hint}") from None


def named_drawing(options: argparse.Namespace) -> str:
    """Return how a command line names the drawing, quoted for the shell where that is needed.

    Examples
    --------
    >>> parser = argparse.ArgumentParser()
    >>> add_drawing_options(parser)
    >>> named_drawing(parser.parse_args(["my loop.svg", "--index", "2", "--cusp", "12"]))
    "'my loop.svg' --index 2 --cusp 0:12"
    """
    from plyfold.io.cusp_notation import written_cusp

    path = f"./{options.file}" if options.file.startswith("-") and options.file != "-" else options.file
    words = [path]
    for name in ("id", "index", "tolerance", "width", "join", "cap"):
        value = options.shape.get("index", options.index) if name == "index" else getattr(options, name)
        words += [] if value is None else [f"--{name}", str(value)]
    words += ["--uv"] * options.uv
    words += [word for mark in options.cusp for word in ("--cusp", written_cusp(mark))]
    return shlex.join(words)


def read_outline(options: argparse.Namespace, watch: Stopwatch) -> Outline:
    """Read the outline that is meant, and mark its cusps."""
    watch("reading")
    outline = _with_cusps(_read(options), options.cusp)
    return _with_proposed_cusps(outline, options, watch) if options.cusps else outline


def _read(options: argparse.Namespace) -> Outline:
    outline: Outline
    if options.read_shape is not None:
        outline, options.ribbon = options.read_shape()
        return outline
    if options.file.startswith("gallery:"):
        from plyfold.gallery import named_curve

        if options.width is not None:
            raise InputError("a curve of the gallery is no line to be given a width", hint="leave out --width")
        return named_curve(options.file.removeprefix("gallery:")).outline
    outline, options.ribbon = read_file(options).outline_and_ribbon(options.index)
    return outline


def read_file(options: argparse.Namespace) -> Contents:
    """Return what the file holds, before it is made one outline."""
    from plyfold.io.reading import read_contents
    from plyfold.io.widths import wide_lines

    wide = wide_lines(options.width, options.join, options.cap)
    return read_contents(options.file, id=options.id, tolerance=options.tolerance, uv=options.uv, wide=wide)


def _with_cusps(outline: Outline, marks: list[CuspMark]) -> Outline:
    """Return the outline with some more cusps, or with other indices."""
    if not marks:
        return outline
    from plyfold.outline.given import outline_with
    from plyfold.outline.vertices import whole_turns

    cusps = [index.copy() for index in outline.cusps]
    for loop, point, turns in marks:
        if loop >= len(cusps) or point >= len(cusps[loop]):
            loops = f"the outline has {len(cusps)} loop" + "s" * (len(cusps) > 1)
            there = f"loop {loop} has points 0 to {len(cusps[loop]) - 1}" if loop < len(cusps) else loops
            raise InputError(f"there is no point {loop}:{point} to be a cusp", hint=f"both count from 0: {there}")
        cusps[loop][point] = whole_turns(turns)
    return outline_with(outline, cusps)


def _with_proposed_cusps(outline: Outline, options: argparse.Namespace, watch: Stopwatch) -> Outline:
    """Return the outline with cusps for the turns that are too many, if there are some; its repairs say which."""
    from plyfold.arrangement.arrangement import arrange
    from plyfold.offers.cusps import suggest_cusps
    from plyfold.outline.given import outline_with
    from plyfold.outline.points import Repair

    load_libraries(FOR_CROSSINGS, watch)
    watch("finding the crossings")
    arranged = arrange(outline, options.general_position)
    load_libraries(FOR_LAYERINGS, watch)
    watch("finding immersions")
    clock = Clock(getattr(options, "time_limit", None))
    if _turns_as_it_should(arranged, clock):
        return outline
    watch("looking for cusps")
    found = suggest_cusps(arranged, time_limit=clock.left)
    if isinstance(found, Unknown):
        raise _not_decided(found)
    if isinstance(found, Obstruction):
        raise NotEmbeddableError(found, hint="name the cusps with --cusp")
    places = [found.outline.loops[loop][point].tolist() for loop, point in found.cusps]
    proposed = [Repair("cusp proposed", (x, y), 0.0) for x, y in places]
    return outline_with(found.outline, repairs=(*found.outline.repairs, *proposed))


def _turns_as_it_should(arranged: Arrangement, clock: Clock) -> bool:
    """Tell whether an outline has no turns too many: as one piece with or without handles, or as the pieces it bounds.

    Whether several loops bound pieces is asked where there are too many turns for one piece alone.
    """
    from plyfold.immersion.solve import find_immersion

    if arranged.euler_characteristic <= 2 - arranged.n_loops:
        return True
    found = find_immersion(arranged, time_limit=clock.left) if arranged.n_loops > 1 else None
    if isinstance(found, Unknown):
        raise _not_decided(found)
    return bool(found)


def _not_decided(why: Unknown) -> TimeLimitError:
    return TimeLimitError(f"{why}", hint="name the cusps with --cusp, or give it more time")
