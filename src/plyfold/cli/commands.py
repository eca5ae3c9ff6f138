"""The command line: which subcommand runs, and what its errors mean to the shell."""

from __future__ import annotations

import argparse
import importlib
import json

from plyfold import __version__
from plyfold.cli.batch import add_batch_command
from plyfold.cli.census import add_census_command
from plyfold.cli.check import add_check_command
from plyfold.cli.convert import add_convert_command
from plyfold.cli.draw import add_draw_command
from plyfold.cli.each import each_file, each_shape
from plyfold.cli.flat import add_flat_commands
from plyfold.cli.gallery import add_gallery_command
from plyfold.cli.homotopy import add_homotopy_command
from plyfold.cli.inputs import BAD_INPUT, NO_DISK, UNKNOWN
from plyfold.cli.lift import add_lift_command
from plyfold.cli.progress import clear_progress
from plyfold.cli.repair import add_repair_command
from plyfold.cli.sketch import add_sketch_command
from plyfold.cli.standard_output import through_standard_output
from plyfold.cli.streams import complain, is_of_a_stream, over_any_streams
from plyfold.errors import NotEmbeddableError, NotImmersibleError, PlyfoldError, TimeLimitError
from plyfold_command import INTERRUPTED, INTERRUPTED_SENTENCE

__all__ = ["main"]

_COMMANDS = (
    add_check_command,
    add_lift_command,
    add_draw_command,
    add_flat_commands,
    add_repair_command,
    add_homotopy_command,
    add_convert_command,
    add_gallery_command,
    add_batch_command,
    add_census_command,
    add_sketch_command,
)

_GUIDE = """\
examples:
  plyfold check loop.svg                     is it the outline of a disk of cloth? in how many ways?
  plyfold check loop.svg --json              the same for a program
  plyfold check map.geojson --each           of every shape in it
  plyfold check a.svg b.svg c.svg            of several files, a line of JSON for each
  plyfold check contour.json --cusp 0:12x2   with a point where the surface turns further than one sees
  plyfold lift loop.svg -o loop.html         the layered surface, as a 3D page for any browser
  plyfold lift loop.csv -o a.glb -o a.obj    as meshes; the ending chooses the format
  plyfold lift loop.csv -o - --format stl    to standard output
  plyfold draw loop.svg -o loop.png          cells, disk layout, layers and surface in one picture
  plyfold repair stroke.svg -o disk.svg      without its tiny loops, where these keep it from being a disk
  plyfold homotopy loop.svg -o loop.html     how it contracts and sweeps the least area, as a film
  plyfold split loop.svg -o pieces.geojson   simple polygons that cover the disk once
  plyfold unwrap loop.svg -o loop.obj        texture coordinates: the disk one-to-one onto the round one
  plyfold convert letter.svg -o letter.json  the outline in another format, with its holes and cusps
  plyfold word loop.svg                      Blank's word and its groupings
  plyfold gallery                            named curves to begin with
  plyfold batch outlines/ -o verdicts.csv    a table for any number of files, by all cores
  plyfold census 8 --page census.html        all plane curves with 8 crossings
  plyfold sketch                             draw in the browser, and see at once how it lies
  plyfold lift gallery:exit-ramp -o ramp.glb

FILE is an SVG, CSV, TXT, NPY, JSON, WKT or GeoJSON file, a flat mesh as OBJ or PLY, "-" for standard input, or
gallery:NAME. All that it holds is one outline, unless --id, --index or --each say otherwise.

exit codes: 0 a disk or another surface (or written), 1 none or not to be lifted, 2 bad input,
3 unknown whether it can be lifted (time limit), 130 interrupted; of several: 2, 3 or 1 if one of them ends so
"""


@over_any_streams
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
    return each_file(options, _each)


def _each(options: argparse.Namespace) -> int:
    return each_shape(options, _answer) if getattr(options, "each", False) else _answer(options)


def _answer(options: argparse.Namespace) -> int:
    """Run a command, and return its exit code; errors are sentences."""
    try:
        return int(through_standard_output(options, options.run))
    except (NotImmersibleError, NotEmbeddableError) as error:
        return _complain(options, error, NO_DISK)
    except TimeLimitError as error:
        return _complain(options, error, UNKNOWN)
    except OSError as error:
        if is_of_a_stream(error):
            raise
        return _complain(options, error, BAD_INPUT)
    except (PlyfoldError, MemoryError) as error:
        return _complain(options, error, BAD_INPUT)
    except KeyboardInterrupt:
        clear_progress()
        complain(INTERRUPTED_SENTENCE)
        return INTERRUPTED


def _complain(options: argparse.Namespace, error: Exception, code: int) -> int:
    clear_progress()
    message = str(error) or type(error).__name__
    if getattr(options, "json", False):
        where = [list(place) for place in getattr(error, "where", ())]
        short = getattr(error, "message", message)
        print(
            json.dumps(
                getattr(options, "shape", {}) | {"error": short, "where": where, "hint": getattr(error, "hint", "")}
            )
        )
    else:
        complain(f"plyfold: {message}")
    return code


class _Version(argparse.Action):
    """Say which version this is, and whether its hot loops are compiled."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        why_plain = importlib.import_module("plyfold.core").WHY_PLAIN
        print(f"plyfold {__version__} ({f'plain: {why_plain}' if why_plain else 'compiled'})")
        parser.exit()


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="plyfold",
        description="Outlines that cross themselves: what pieces of cloth do they bound, and how do these lie?",
        epilog=_GUIDE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="show program's version number and exit")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    for add in _COMMANDS:
        add(commands)
    return parser
