"""The command line: one small function per subcommand. The library does the work; only this module prints."""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from plyfold import __version__
from plyfold.errors import InputError, NotEmbeddableError, NotImmersibleError, PlyfoldError, TimeLimitError
from plyfold.io.saving import refuse_existing, save_bytes

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
  plyfold gallery                            named curves to begin with
  plyfold lift gallery:exit-ramp -o ramp.glb

FILE is an SVG, CSV, TXT, NPY, JSON, WKT or GeoJSON file, "-" for standard input, or gallery:NAME.

exit codes: 0 a disk (lift: written), 1 no disk or not to be lifted, 2 bad input, 3 unknown (time limit),
130 interrupted
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

_CLEAR_LINE = "\r\x1b[K"


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
        _clear_progress()
        print("plyfold: interrupted; nothing was left half-written", file=sys.stderr)
        return INTERRUPTED


def _complain(options: argparse.Namespace, error: Exception, code: int) -> int:
    _clear_progress()
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
    check = _command(commands, "check", _check, "say whether a curve bounds a disk, with all figures")
    check.add_argument("--json", action="store_true", help="print one JSON object and nothing else (see below)")
    check.epilog, check.formatter_class = _JSON_GUIDE, argparse.RawDescriptionHelpFormatter
    lift = _command(commands, "lift", _lift, "lift a curve to a layered surface that does not cut itself")
    _outputs(lift, ".glb .obj .ply .stl .html")
    lift.add_argument(
        "--gap", type=float, help="least distance of sheets, in units of the drawing (default: 1/20 of its larger side)"
    )
    lift.add_argument("--triangles", type=int, default=4000, help="roughly how many triangles (default: %(default)s)")
    draw = _command(commands, "draw", _draw, "draw the arrangement, the disk layout, the layers and the surface")
    _outputs(draw, ".svg .png .pdf")
    draw.add_argument(
        "--what", choices=["all", "arrangement", "layout", "layers", "surface"], default="all", help="one panel only"
    )
    _gallery_command(commands)
    return parser


def _command(commands: Any, name: str, run: Callable[..., int], summary: str) -> argparse.ArgumentParser:
    command: argparse.ArgumentParser = commands.add_parser(name, help=summary, description=summary.capitalize() + ".")
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
    command.add_argument("--time-limit", type=float, metavar="S", help="seconds for the search for a layering")
    return command


def _outputs(command: argparse.ArgumentParser, endings: str) -> None:
    command.add_argument("-o", "--output", action="append", required=True, metavar="OUT", help=f"one of {endings}")
    command.add_argument("--force", action="store_true", help="replace existing files")


def _gallery_command(commands: Any) -> None:
    gallery = commands.add_parser("gallery", help="list the named curves, or save one", description="Named curves.")
    gallery.set_defaults(run=_gallery)
    gallery.add_argument("name", nargs="?", help="a curve to print as CSV, or to save with -o")
    gallery.add_argument(
        "-o",
        "--output",
        metavar="OUT",
        help="a .csv or .json file, which is read back exactly, or an .svg file, whose view box moves the curve",
    )
    gallery.add_argument("--all", metavar="DIR", help="save all curves there, as CSV files")
    gallery.add_argument("--force", action="store_true", help="replace existing files")


def _progress_is_seen() -> bool:
    return sys.stderr is not None and sys.stderr.isatty()


def _clear_progress() -> None:
    """Wipe the line of progress, so that the next words begin a line of their own."""
    if _progress_is_seen():
        print(_CLEAR_LINE, end="", file=sys.stderr, flush=True)


class _Stopwatch:
    """Seconds per stage, and one line of progress on a terminal."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}
        self._stage, self._since = "", time.perf_counter()

    def __call__(self, stage: str, done: float = 0.0) -> None:
        if stage != self._stage:
            self.stop()
            self._stage = stage
        if stage and _progress_is_seen():
            share = f" {done:.0%}" if done else ""
            print(f"{_CLEAR_LINE}{stage}{share}", end="", file=sys.stderr, flush=True)

    def stop(self) -> None:
        """End the current stage and clear the line."""
        now = time.perf_counter()
        if self._stage:
            self.seconds[self._stage] = self.seconds.get(self._stage, 0.0) + now - self._since
            _clear_progress()
        self._stage, self._since = "", now


def _arranged(options: argparse.Namespace, watch: _Stopwatch) -> Arrangement:
    from plyfold.arrangement import arrangement
    from plyfold.io import read

    watch("reading")
    if options.file.startswith("gallery:"):
        curve = _named(options.file.removeprefix("gallery:")).curve
    else:
        curve = read(options.file, id=options.id, tolerance=options.tolerance)
    watch("finding the crossings")
    return arrangement(curve, options.general_position)


def _named(name: str) -> Any:
    from plyfold.gallery import CURVES

    if name not in CURVES:
        raise InputError(f"the gallery has no curve {name!r}", hint=f"it has {', '.join(CURVES)}")
    return CURVES[name]


def _check(options: argparse.Namespace) -> int:
    from plyfold.report import describe, verdict

    watch = _Stopwatch()
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


def _timing(watch: _Stopwatch) -> str:
    return "  seconds: " + ", ".join(f"{stage} {seconds:.3f}" for stage, seconds in watch.seconds.items())


def _lift(options: argparse.Namespace) -> int:
    from plyfold.surface import lift

    options.output = list(dict.fromkeys(options.output))
    for path in options.output:
        _refuse_output(path, (".glb", ".obj", ".ply", ".stl", ".html"), options.force)
    watch = _Stopwatch()
    arranged = _arranged(options, watch)
    surface = lift(
        arranged, gap=options.gap, triangles=options.triangles, time_limit=options.time_limit, progress=watch
    )
    watch("writing")
    for path in options.output:
        surface.export(path, force=options.force, title=_title(options.file))
    watch.stop()
    levels = int(surface.layering.level.max())
    print(
        f"Lifted: {len(surface.faces):,} triangles in {surface.layering.immersion.n_sheets} sheets, {levels} level(s)"
    )
    print(_timing(watch))
    for path in options.output:
        print(f"  wrote {path}")
    return DISK


def _refuse_output(path: str, endings: tuple[str, ...], force: bool) -> None:
    """Refuse before any work is done what could not be written after it."""
    if Path(path).suffix.lower() not in endings:
        raise InputError(f"{path} cannot be written: its ending is none of {' '.join(endings)}")
    if not Path(path).absolute().parent.is_dir():
        raise InputError(f"{path} cannot be written: there is no folder {Path(path).parent}")
    refuse_existing(path, force)


def _title(file: str) -> str:
    return "plyfold" if file == "-" else Path(file.removeprefix("gallery:")).stem


def _draw(options: argparse.Namespace) -> int:
    from plyfold.draw.figures import save

    options.output = list(dict.fromkeys(options.output))
    for path in options.output:
        _refuse_output(path, (".svg", ".png", ".pdf"), options.force)
    watch = _Stopwatch()
    arranged = _arranged(options, watch)
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


def _furthest(arranged: Arrangement, options: argparse.Namespace, watch: _Stopwatch) -> tuple[Any, Any]:
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
    from plyfold.draw import plots
    from plyfold.draw.figures import overview

    if what == "all":
        return overview(value, obstruction)
    layering = getattr(value, "layering", None)
    immersion = getattr(layering, "immersion", value)
    panels: dict[str, tuple[Any, Callable[..., Any]]] = {
        "arrangement": (getattr(immersion, "arrangement", immersion), plots.plot_arrangement),
        "layout": (immersion if hasattr(immersion, "disk_layout") else None, plots.plot_disk_layout),
        "layers": (layering, plots.plot_layers),
        "surface": (value if layering is not None else None, plots.plot_surface),
    }
    subject, plot = panels[what]
    if subject is None:
        raise InputError(f"this curve has no {what} to draw: {obstruction}")
    ax = plot(subject, obstruction=obstruction) if what == "arrangement" else plot(subject)
    return ax.figure


def _gallery(options: argparse.Namespace) -> int:
    if options.all is not None:
        _save_gallery(options)
    elif options.name is None:
        _list_gallery(options)
    elif options.output is None:
        print(_as_csv(_named(options.name).curve.points.tolist()), end="")
    else:
        _save_named(options)
    return DISK


def _list_gallery(options: argparse.Namespace) -> None:
    from plyfold.gallery import CURVES

    if options.output is not None:
        raise InputError("no curve was named to be saved", hint="give a NAME, or --all DIR for all curves")
    print(f"{'name':<18}{'crossings':>9}{'turning':>9}{'immersions':>12}{'lifted':>8}  title")
    for curve in CURVES.values():
        figures = f"{curve.crossings:>9}{curve.turning_number:>9}{curve.immersions:>12}{curve.embeddable:>8}"
        print(f"{curve.name:<18}{figures}  {curve.title}")


def _save_named(options: argparse.Namespace) -> None:
    points = _named(options.name).curve.points.tolist()
    writers = {".csv": _as_csv, ".json": _as_json, ".svg": _as_svg}
    _refuse_output(options.output, tuple(writers), options.force)
    content = writers[Path(options.output).suffix.lower()](points)
    save_bytes(options.output, content.encode(), options.force)
    print(f"wrote {options.output}")


def _save_gallery(options: argparse.Namespace) -> None:
    from plyfold.gallery import CURVES

    if options.name is not None or options.output is not None:
        raise InputError("--all saves every curve", hint="leave out the NAME and -o")
    Path(options.all).mkdir(parents=True, exist_ok=True)
    paths = {name: Path(options.all) / f"{name}.csv" for name in CURVES}
    for path in paths.values():
        refuse_existing(path, options.force)
    for name, path in paths.items():
        save_bytes(path, _as_csv(CURVES[name].curve.points.tolist()).encode(), options.force)
        print(f"wrote {path}")


def _as_csv(points: list[list[float]]) -> str:
    return "x,y\n" + "".join(f"{x!r},{y!r}\n" for x, y in points)


def _as_json(points: list[list[float]]) -> str:
    return json.dumps({"points": points}) + "\n"


def _as_svg(points: list[list[float]]) -> str:
    """Return an SVG in the curve's own units, y down, with a margin."""
    xs, ys = [x for x, _ in points], [-y for _, y in points]
    size = max(max(xs) - min(xs), max(ys) - min(ys))
    margin = 0.05 * size
    box = f"{min(xs) - margin} {min(ys) - margin} {max(xs) - min(xs) + 2 * margin} {max(ys) - min(ys) + 2 * margin}"
    corners = " ".join(f"{x!r},{y!r}" for x, y in zip(xs, ys, strict=True))
    style = f'fill="none" stroke="#1d2638" stroke-width="{size / 200}" stroke-linejoin="round"'
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}">\n<polygon {style} points="{corners}"/>\n</svg>\n'


if __name__ == "__main__":
    sys.exit(main())
