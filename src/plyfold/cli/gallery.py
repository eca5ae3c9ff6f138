"""The gallery on the command line: list the named curves and outlines, print one, or save them."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from plyfold.cli.inputs import add_format
from plyfold.cli.standard_output import say_written
from plyfold.errors import InputError
from plyfold.io.saving import refuse_existing, refuse_output

__all__ = ["add_gallery_command"]


def add_gallery_command(commands: Any) -> None:
    """Add the subcommand to a parser."""
    named = "named curves and outlines"
    gallery = commands.add_parser(
        "gallery", help=f"list the {named}, or save one", description=f"{named.capitalize()}."
    )
    gallery.set_defaults(run=_gallery)
    gallery.add_argument("name", nargs="?", help="one to print as CSV, or to save with -o")
    gallery.add_argument(
        "-o",
        "--output",
        metavar="OUT",
        help="a .csv, .json, .geojson, .wkt or .svg file, all of which are read back exactly, or - for standard output",
    )
    add_format(gallery)
    gallery.add_argument("--all", metavar="DIR", help="save all curves there, as CSV files")
    gallery.add_argument("--force", action="store_true", help="replace existing files")


def _gallery(options: argparse.Namespace) -> int:
    if options.all is not None:
        _save_gallery(options)
    elif options.name is None:
        _list_gallery(options)
    elif options.output is None:
        from plyfold.gallery import named_curve
        from plyfold.io.outline_files import OUTLINE_WRITERS

        print(OUTLINE_WRITERS[".csv"](named_curve(options.name).outline), end="")
    else:
        _save_curve(options)
    return 0


def _list_gallery(options: argparse.Namespace) -> None:
    from plyfold.gallery import CURVES, OUTLINES

    if options.output is not None:
        raise InputError("no curve was named to be saved", hint="give a NAME, or --all DIR for all curves")
    for known in (CURVES, OUTLINES):
        print(f"{'name':<18}{'crossings':>9}{'turning':>9}{'immersions':>12}{'lifted':>8}  title")
        for named in known.values():
            figures = f"{named.crossings:>9}{named.turning_number:>9}{named.immersions:>12}{named.embeddable:>8}"
            print(f"{named.name:<18}{figures}  {named.title}")


def _save_curve(options: argparse.Namespace) -> None:
    from plyfold.gallery import named_curve
    from plyfold.io.outline_files import OUTLINE_WRITERS, save

    refuse_output(options.output, tuple(OUTLINE_WRITERS), options.force)
    save(named_curve(options.name).outline, options.output, force=options.force)
    say_written(options.output)


def _save_gallery(options: argparse.Namespace) -> None:
    from plyfold.gallery import CURVES, OUTLINES
    from plyfold.io.outline_files import save

    if options.name is not None or options.output is not None:
        raise InputError("--all saves every curve", hint="leave out the NAME and -o")
    Path(options.all).mkdir(parents=True, exist_ok=True)
    gallery = {Path(options.all) / f"{named.name}.csv": named for named in (*CURVES.values(), *OUTLINES.values())}
    for path in gallery:
        refuse_existing(path, options.force)
    for path, named in gallery.items():
        save(named.outline, path, force=options.force)
        say_written(str(path))
