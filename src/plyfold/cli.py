"""The command line: one small function per subcommand. The library does the work; only this module prints."""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from plyfold import __version__
from plyfold.cli_gallery import add_gallery_command, named_curve
from plyfold.cli_heights import add_height_options, height_options
from plyfold.cli_progress import Stopwatch, clear_progress
from plyfold.cli_sketch import add_sketch_command
from plyfold.errors import InputError, NotEmbeddableError, NotImmersibleError, PlyfoldError, TimeLimitError
from plyfold.io.saving import refuse_output, save_bytes

if TYPE_CHECKING:
    from plyfold.arrangement import Arrangement

__all__ = ["main"]

DISK, NO_DISK, BAD_INPUT, UNKNOWN, INTERRUPTED, BROKEN_PIPE = 0, 1, 2, 3, 130, 141

_GUIDE = """\
examples:
  plyfold check loop.svg                     is it the outline of a disk of cloth? in how many ways?
  plyfold check loop.svg --json              the same for a program
  plyfold lift loop.svg -o loop.html         the layered surface, as a 3D page for any browser
  plyfold lift loop.csv -o a.glb -o a.obj    as meshes; the ending chooses the format
  plyfold draw loop.svg -o loop.png          cells, disk layout, layers and surface in one picture
  plyfold split loop.svg -o pieces.geojson   simple polygons that cover the disk once
  plyfold word loop.svg                      Blank's word and its groupings
  plyfold gallery                            named curves to begin with
  plyfold sketch                             draw in the browser, and see at once how it lies
  plyfold lift gallery:exit-ramp -o ramp.glb

FILE is an SVG, CSV, TXT, NPY, JSON, WKT or GeoJSON file, "-" for standard input, or gallery:NAME.

exit codes: 0 a disk (or written), 1 no disk or not to be lifted, 2 bad input,
3 unknown whether it can be lifted (lift, draw: time limit), 130 interrupted
"""

_JSON_GUIDE = """\
the object that --json prints:
  points, crossings         how many
  cells                     object: winding number -> how many cells have it
  turning_number, reversed  of the curve after it was turned counter-clockwise, if it was
  repairs                   list of {kind, where: [x, y], size}: what was changed in the input
  immersible, immersions    whether the curve bounds a disk, and in how many ways
  sheets                    of each immersion (if immersible)
  layerable                 whether an immersion can be lifted; null: unknown, the time limit (if immersible)
  examined, levels          immersions tried until one could be lifted, and the layers of that one
  reason, sentence, where   why not, in a word, in a sentence and at which places (if not immersible or layerable)
  seconds                   object: stage -> seconds
or, with exit code 2, {error, where, hint}
"""


def main(arguments: list[str] | None = None) -> int:
    """Run the command line.

    Parameters
    ----------
    arguments : list of str, optional
        The words after ``plyfold``; those of the process by default.

    Returns
    -------
    int
        The exit code.

    Examples
    --------
    >>> main(["gallery", "circle", "-o", "no/such/folder/circle.csv"])
    2
    """
    options = _parser().parse_args(arguments)
    try:
        code = int(options.run(options))
        print(end="", flush=True)
        return code
    except (NotImmersibleError, NotEmbeddableError) as error:
        return _complain(options, error, NO_DISK)
    except TimeLimitError as error:
        return _complain(options, error, UNKNOWN)
    except BrokenPipeError:
        # The reader has gone; give the interpreter somewhere to flush to.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return BROKEN_PIPE
    except (PlyfoldError, OSError, MemoryError) as error:
        return _complain(options, error, BAD_INPUT)
    except KeyboardInterrupt:
        clear_progress()
        print("plyfold: interrupted; nothing was left half-written", file=sys.stderr)
        return INTERRUPTED


def _complain(options: argparse.Namespace, error: Exception, code: int) -> int:
    clear_progress()
    message = str(error) or type(error).__name__
    if getattr(options, "json", False):
        where = [list(place) for place in getattr(error, "where", ())]
        short = getattr(error, "message", message)
        print(json.dumps({"error": short, "where": where, "hint": getattr(error, "hint", "")}))
    else:
        print(f"plyfold: {message}", file=sys.stderr)
    return code


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="plyfold",
        description="Closed curves that cross themselves: are they outlines of disks of cloth, and how do these lie?",
        epilog=_GUIDE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"plyfold {__version__}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    for add in (_add_check, _add_lift, _add_draw, _add_flat, add_gallery_command, add_sketch_command):
        add(commands)
    return parser


def _add_check(commands: Any) -> None:
    check = _command(commands, "check", _check, "say whether a curve bounds a disk, with all figures")
    _time_limit(check)
    check.add_argument("--json", action="store_true", help="print one JSON object and nothing else (see below)")
    check.epilog, check.formatter_class = _JSON_GUIDE, argparse.RawDescriptionHelpFormatter


def _add_lift(commands: Any) -> None:
    lift = _command(commands, "lift", _lift, "lift a curve to a layered surface that does not cut itself")
    _time_limit(lift)
    _outputs(lift, ".glb .obj .ply .stl .3mf .html .gif .mp4")
    lift.add_argument(
        "--gap", type=float, help="least distance of sheets, in units of the drawing (default: 1/20 of its larger side)"
    )
    lift.add_argument(
        "--allow-intersections",
        action="store_true",
        help="where no layered surface exists, lift one with the shortest self-intersections",
    )
    lift.add_argument("--triangles", type=int, default=4000, help="roughly how many triangles (default: %(default)s)")
    add_height_options(lift)
    lift.add_argument(
        "--thicken",
        type=float,
        metavar="T",
        help="a solid to be printed, T thick in vertical direction; less than the gap",
    )
    lift.add_argument(
        "--colours",
        choices=["layers", "sheets"],
        default="layers",
        help="of a file that has some (default: %(default)s)",
    )
    lift.add_argument(
        "--no-unwrap", action="store_true", help="leave out texture coordinates and, from a GLB, the way to the disk"
    )


def _add_draw(commands: Any) -> None:
    draw = _command(commands, "draw", _draw, "draw the arrangement, the disk layout, the layers and the surface")
    _time_limit(draw)
    _outputs(draw, ".svg .png .pdf; of the view over-under .svg .tikz .tex")
    draw.add_argument(
        "--what",
        choices=["all", "arrangement", "layout", "layers", "surface", "over-under"],
        default="all",
        help="one panel only, or the surface from above with what is hidden removed",
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


def _add_flat(commands: Any) -> None:
    split = _command(commands, "split", _split, "cut a disk into simple polygons, or any curve into its cells")
    _outputs(split, ".geojson .wkt .svg")
    split.add_argument(
        "--cells", action="store_true", help="the cells with their winding numbers, of a curve that need be no disk"
    )
    triangles = _command(commands, "triangulate", _triangulate, "cut a disk into triangles on the points of the curve")
    _outputs(triangles, ".obj .csv")
    _command(commands, "word", _word, "print Blank's word of a curve, and its groupings").add_argument(
        "--most", type=int, default=20, help="how many groupings to print (default: %(default)s)"
    )


def _command(commands: Any, name: str, run: Callable[..., int], summary: str) -> argparse.ArgumentParser:
    command: argparse.ArgumentParser = commands.add_parser(
        name, help=summary, description=summary[0].upper() + summary[1:] + "."
    )
    command.set_defaults(run=run)
    command.add_argument("file", metavar="FILE", help='a drawing, "-" for standard input, or gallery:NAME')
    command.add_argument("--id", help="the element of an SVG to read")
    command.add_argument("--tolerance", type=float, help="how far a Bézier or arc may be from its polyline")
    command.add_argument(
        "--general-position",
        choices=["perturb", "raise"],
        default="perturb",
        help="where strands touch: move vertices a little and say so, or refuse (default: %(default)s)",
    )
    return command


def _time_limit(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--time-limit", type=_seconds, metavar="S", help="seconds for the search for a layering; then it is unknown"
    )


def _seconds(text: str) -> float:
    seconds = float(text)
    if not seconds >= 0:
        raise argparse.ArgumentTypeError(f"{text} is not a number of seconds from 0 on")
    return seconds


def _outputs(command: argparse.ArgumentParser, endings: str) -> None:
    command.add_argument("-o", "--output", action="append", required=True, metavar="OUT", help=f"one of {endings}")
    command.add_argument("--force", action="store_true", help="replace existing files")


def _arranged(options: argparse.Namespace, watch: Stopwatch) -> Arrangement:
    from plyfold.arrangement import arrangement
    from plyfold.io import read

    watch("reading")
    if options.file.startswith("gallery:"):
        curve = named_curve(options.file.removeprefix("gallery:")).curve
    else:
        curve = read(options.file, id=options.id, tolerance=options.tolerance)
    watch("finding the crossings")
    return arrangement(curve, options.general_position)


def _check(options: argparse.Namespace) -> int:
    from plyfold.report import describe, verdict

    watch = Stopwatch()
    arranged = _arranged(options, watch)
    watch("finding immersions and layerings")
    figures = verdict(arranged, options.time_limit)
    watch.stop()
    if options.json:
        print(json.dumps(figures | {"seconds": watch.seconds}))
    else:
        print(describe(figures))
        print(_timing(watch))
    return DISK if figures["immersible"] else NO_DISK


def _timing(watch: Stopwatch) -> str:
    return "  seconds: " + ", ".join(f"{stage} {seconds:.3f}" for stage, seconds in watch.seconds.items())


def _lift(options: argparse.Namespace) -> int:
    from plyfold.surface import lift

    watch = Stopwatch()
    pages = () if options.thicken is not None else (".html", ".gif", ".mp4")
    endings = (".glb", ".obj", ".ply", ".stl", ".3mf", *pages)
    arranged = _prepared(options, endings, watch)
    surface = lift(
        arranged,
        gap=options.gap,
        triangles=options.triangles,
        time_limit=options.time_limit,
        progress=watch,
        allow_intersections=options.allow_intersections,
        **height_options(options),
    )
    watch("writing")
    _export(surface, options)
    watch.stop()
    levels = int(surface.layering.level.max())
    print(
        f"Lifted: {len(surface.faces):,} triangles in {surface.layering.immersion.n_sheets} sheets, {levels} level(s)"
    )
    if surface.intersections:
        print(f"  it passes through itself along {len(surface.intersections)} curve(s)")
    print(_timing(watch))
    for path in options.output:
        print(f"  wrote {path}")
    return DISK


def _export(surface: Any, options: argparse.Namespace) -> None:
    solid = None if options.thicken is None else surface.thicken(options.thicken)
    for path in options.output:
        choices: dict[str, Any] = {"colours": options.colours, "unwrapped": False if options.no_unwrap else None}
        if solid is not None:
            solid.export(path, options.force, **choices)
        else:
            surface.export(path, options.force, _title(options.file), **choices)


def _title(file: str) -> str:
    return "plyfold" if file == "-" else Path(file.removeprefix("gallery:")).stem


def _draw(options: argparse.Namespace) -> int:
    if options.what == "over-under":
        return _draw_over_under(options)
    from plyfold.draw.figures import save

    watch = Stopwatch()
    arranged = _prepared(options, (".svg", ".png", ".pdf"), watch)
    value, obstruction = _furthest(arranged, options, watch)
    watch("drawing")
    figure = _figure(value, obstruction, options.what)
    for path in options.output:
        save(figure, path, options.force)
    watch.stop()
    if obstruction is not None:
        print(f"plyfold: {obstruction}", file=sys.stderr)
    for path in options.output:
        print(f"wrote {path}")
    return DISK if obstruction is None else NO_DISK


def _draw_over_under(options: argparse.Namespace) -> int:
    from plyfold.draw.over_under_files import OVER_UNDER_WRITERS
    from plyfold.surface.surface import layering_of

    watch = Stopwatch()
    arranged = _prepared(options, tuple(OVER_UNDER_WRITERS), watch)
    layering = layering_of(arranged, False, options.time_limit, watch)
    watch.stop()
    choices = {"colours": options.colours, "hidden": options.hidden}
    _write(options, {ending: partial(write, layering, **choices) for ending, write in OVER_UNDER_WRITERS.items()})
    return DISK


def _furthest(arranged: Arrangement, options: argparse.Namespace, watch: Stopwatch) -> tuple[Any, Any]:
    """Return the furthest stage that the curve reaches, and the obstruction that ended it."""
    from plyfold.immersion import find_immersion
    from plyfold.surface import lift

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


def _split(options: argparse.Namespace) -> int:
    from plyfold.flat import coverage, decompose
    from plyfold.io.pieces import POLYGON_WRITERS

    watch = Stopwatch()
    arranged = _prepared(options, tuple(POLYGON_WRITERS), watch)
    watch("cutting")
    if options.cells:
        cells = coverage(arranged)
        polygons, told = [cell.polygon for cell in cells], [{"winding": cell.winding} for cell in cells]
    else:
        polygons = decompose(arranged)
        told = [{"piece": number} for number in range(len(polygons))]
    watch.stop()
    print(f"{len(polygons)} {'cell(s)' if options.cells else 'simple polygon(s)'}")
    _write(options, {ending: partial(write, polygons, told) for ending, write in POLYGON_WRITERS.items()})
    return DISK


def _triangulate(options: argparse.Namespace) -> int:
    from plyfold.curve import as_curve
    from plyfold.flat import triangulate
    from plyfold.io.pieces import TRIANGLE_WRITERS

    watch = Stopwatch()
    arranged = _prepared(options, tuple(TRIANGLE_WRITERS), watch)
    watch("triangulating")
    faces = triangulate(arranged)
    watch.stop()
    drawn = as_curve(arranged)
    points = (drawn.reversed() if arranged.reversed else drawn).points
    print(f"{len(faces):,} triangles")
    _write(options, {ending: partial(write, points, faces) for ending, write in TRIANGLE_WRITERS.items()})
    return DISK


def _prepared(options: argparse.Namespace, endings: tuple[str, ...], watch: Stopwatch) -> Arrangement:
    """Refuse outputs that cannot be written, then read the input."""
    options.output = list(dict.fromkeys(options.output))
    for path in options.output:
        refuse_output(path, endings, options.force)
    return _arranged(options, watch)


def _write(options: argparse.Namespace, content: dict[str, Callable[[], str]]) -> None:
    for path in options.output:
        save_bytes(path, content[Path(path).suffix.lower()]().encode(), options.force)
        print(f"  wrote {path}")


def _word(options: argparse.Namespace) -> int:
    from itertools import islice

    from plyfold.immersion import blank_word

    word = blank_word(_arranged(options, watch := Stopwatch()))
    watch.stop()
    print(word)
    groupings = word.groupings()
    shown = [word.bracketed(grouping) for grouping in islice(groupings, max(options.most, 0))]
    print(f"\n{len(shown)}{' or more' if next(groupings, None) else ''} grouping(s)", *shown, sep="\n  ")
    return DISK if shown else NO_DISK


if __name__ == "__main__":
    sys.exit(main())
