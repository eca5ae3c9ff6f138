"""``plyfold lift``: the layered surface, as mesh, solid, page or film."""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from plyfold.cli.inputs import DISK, add_command, add_outputs, add_repair, add_time_limit, prepare, title
from plyfold.cli.progress import Stopwatch, timing
from plyfold.cli.standard_output import name_of_output, say_written
from plyfold.clock import Clock
from plyfold.errors import InputError
from plyfold.wording import counted

if TYPE_CHECKING:
    from plyfold.arrangement.arrangement import Arrangement
    from plyfold.layering.layering import Layering
    from plyfold.surface.heights import PinKey
    from plyfold.surface.lift import Surface
    from plyfold.surface.thicken import Solid

__all__ = ["add_lift_command"]

# These take minutes for a large surface, and say how far they are.
_FILMS = (".gif", ".mp4")

_JSON_GUIDE = """\
the object that --json prints:
  triangles, sheets, levels  of the surface, or of the one in the middle of the solid
  gap                        least distance of sheets over each other
  intersections              along how many curves it passes through itself
  solid                      object (with --thicken or --inflate): triangles; height, its largest thickness; volume;
                             wall, how thin it is across and where, {length, where: [x, y]}, or null if it is all rim;
                             overhang, which share of its area faces down and leans more than 45 degrees
  written                    list of files
  seconds                    object: stage -> seconds
or, with exit code 2, {error, where, hint}
"""


def add_lift_command(commands: Any) -> None:
    """Add the subcommand to a parser."""
    lift = add_command(commands, "lift", _lift, "lift a curve to a layered surface that does not cut itself")
    add_time_limit(lift, "all of it but writing")
    add_outputs(lift, ".glb .obj .ply .stl .3mf .html .gif .mp4")
    add_repair(lift)
    lift.add_argument(
        "--gap",
        type=float,
        help="least distance of sheets, in units of the drawing (default: 1/20 of its larger side, or 1/5 of the "
        "cloth's mean width if that is less)",
    )
    lift.add_argument(
        "--choose",
        choices=["low", "first", "nicest"],
        default="low",
        help="which layering: one that stays low, the first one, or the one that changes least often between over and "
        "under (default: %(default)s)",
    )
    lift.add_argument(
        "--allow-intersections",
        action="store_true",
        help="where no layered surface exists, lift one with the shortest self-intersections",
    )
    lift.add_argument("--triangles", type=int, default=4000, help="roughly how many triangles (default: %(default)s)")
    _add_height_options(lift)
    _add_solid_options(lift)
    _add_film_options(lift)
    lift.add_argument("--json", action="store_true", help="print one JSON object and nothing else (see below)")
    lift.epilog, lift.formatter_class = _JSON_GUIDE, argparse.RawDescriptionHelpFormatter
    lift.add_argument(
        "--colours",
        choices=["layers", "sheets"],
        default="layers",
        help="of a file that has some (default: %(default)s)",
    )
    lift.add_argument(
        "--no-unwrap", action="store_true", help="leave out texture coordinates and, from a GLB, the way to the disk"
    )


def _lift(options: argparse.Namespace) -> int:
    from plyfold.surface.lift import lift

    _refuse_mixed(options)
    watch, clock = Stopwatch(), Clock(options.time_limit)
    films = () if options.thicken is not None or options.inflate is not None else _FILMS
    arranged = prepare(options, (".glb", ".obj", ".ply", ".stl", ".3mf", ".html", *films), watch, clock)
    surface = lift(
        _by_heights(arranged, options),
        choose=options.choose,
        gap=options.gap,
        triangles=options.triangles,
        time_limit=clock.left,
        progress=watch,
        allow_intersections=options.allow_intersections,
        **_height_options(options),
    )
    solid = _solid(surface, options, watch, clock)
    watch("writing")
    _export(surface, solid, options, watch)
    watch.stop()
    figures = _figures(surface if solid is None else solid.surface, solid)
    if options.json:
        written = [name_of_output(path) for path in options.output]
        print(json.dumps(figures | {"written": written, "seconds": watch.seconds}), flush=True)
        return DISK
    print("\n".join([*_report(figures), timing(watch)]))
    for path in options.output:
        say_written(path)
    return DISK


def _refuse_mixed(options: argparse.Namespace) -> None:
    """Refuse options that do not go together."""
    if options.thicken is not None and options.inflate is not None:
        raise InputError("--thicken and --inflate make different solids", hint="choose one of them")
    if options.min_wall is not None and options.thicken is None:
        raise InputError("--min-wall is for slabs, which --thicken makes", hint="add --thicken T")
    if options.profile is not None and options.inflate is None:
        raise InputError("--profile is for round bodies, which --inflate makes", hint="add --inflate")
    _refuse_film_options(options)


def _solid(surface: Surface, options: argparse.Namespace, watch: Stopwatch, clock: Clock) -> Solid | None:
    """Return the solid that is asked for, if any."""
    if options.inflate is not None:
        height = None if options.inflate is True else options.inflate
        return surface.inflate(height, options.profile or "round", time_limit=clock.left, progress=watch)
    return None if options.thicken is None else surface.thicken(options.thicken, options.min_wall)


def _figures(surface: Surface, solid: Solid | None) -> dict[str, Any]:
    """Return what is reported; see the guide."""
    figures = {
        "triangles": len(surface.faces),
        "sheets": surface.n_sheets,
        "levels": surface.n_layers,
        "gap": surface.gap,
        "intersections": len(surface.intersections),
    }
    if solid is None:
        return figures
    wall = None if solid.wall is None else {"length": solid.wall.length, "where": list(solid.wall.where)}
    size = {"triangles": len(solid.faces), "height": solid.height, "volume": solid.volume}
    return figures | {"solid": size | {"wall": wall, "overhang": solid.overhang()}}


def _report(figures: dict[str, Any]) -> Iterator[str]:
    """Yield the lines that say the same to people."""
    sheets = counted(figures["sheets"], "sheet")
    yield f"Lifted: {figures['triangles']:,} triangles in {sheets}, {figures['levels']} level(s)"
    if figures["intersections"]:
        yield f"  it passes through itself along {figures['intersections']} curve(s)"
    if solid := figures.get("solid"):
        yield f"  a solid {solid['height']:.4g} thick at most, volume {solid['volume']:.4g}"
        if wall := solid["wall"]:
            yield f"  its thinnest wall is {wall['length']:.4g}, at ({wall['where'][0]:.6g}, {wall['where'][1]:.6g})"
        yield f"  {solid['overhang']:.0%} of it faces down and leans more than 45 degrees"


def _by_heights(arranged: Arrangement, options: argparse.Namespace) -> Arrangement | Layering:
    """Return the layering that the heights of lines ask for, or the arrangement, if there are none.

    Raises NotEmbeddableError if no cloth follows the heights.
    """
    if options.ribbon is None or arranged.cusp_index.any():
        return arranged
    from plyfold.errors import NotEmbeddableError
    from plyfold.layering.levels.heights import layering_by_heights
    from plyfold.obstruction import Obstruction

    found = layering_by_heights(options.ribbon)
    if isinstance(found, Obstruction):
        raise NotEmbeddableError(found, hint="leave the heights out of the file, and any order will do")
    print("Over and under are those of the heights in the file")
    return found


def _export(surface: Surface, solid: Solid | None, options: argparse.Namespace, watch: Stopwatch) -> None:
    unwrapped = False if options.no_unwrap else None
    for path in options.output:
        if solid is not None:
            solid.export(path, options.force, title(options.file), colours=options.colours, unwrapped=unwrapped)
        elif Path(path).suffix.lower() in _FILMS:
            _film(surface, path, options, watch)
        else:
            surface.export(path, options.force, title(options.file), colours=options.colours, unwrapped=unwrapped)


def _film(surface: Surface, path: str, options: argparse.Namespace, watch: Stopwatch) -> None:
    from plyfold.draw.film import save_film

    save_film(surface, path, options.force, watch, **_film_options(options))
    watch("writing")


def _film_options(options: argparse.Namespace) -> dict[str, int]:
    """Return the arguments of :func:`plyfold.draw.save_film` that were given."""
    given = {"size": options.size, "frames": options.frames}
    return {name: value for name, value in given.items() if value is not None}


def _refuse_film_options(options: argparse.Namespace) -> None:
    """Refuse options of films before any work: where there is no film, and where no film can be so."""
    films = [path for path in options.output if Path(path).suffix.lower() in _FILMS]
    given = _film_options(options)
    if given and not films:
        raise InputError(f"--{next(iter(given))} is for films", hint="write one: -o film.gif")
    if given:
        from plyfold.draw.film import refuse_film

        for path in films:
            refuse_film(path, **given)


# ---- the options of ``plyfold lift`` ---------------------------------------------------------------------------------


def _add_height_options(command: argparse.ArgumentParser) -> None:
    """Give the options to a subcommand."""
    command.add_argument(
        "--stiffness",
        type=float,
        metavar="S",
        help="the length below which the cloth would rather slope than bend, by its mean width (default: 0.5)",
    )
    command.add_argument(
        "--pin",
        type=_pin,
        action="append",
        metavar="PLACE=Z",
        help="hold a sheet (--pin 3=0.5), a point (--pin=1.5,-2=0.5) or one of the sheets over a point "
        "(--pin=1.5,-2,3=0.5) at a height; as often as needed",
    )
    command.add_argument(
        "--flat",
        nargs="?",
        type=float,
        const=True,
        metavar="W",
        help="keep parts level that nothing overlaps: they are W times as stiff, 100 times if no number follows",
    )


def _add_solid_options(command: argparse.ArgumentParser) -> None:
    """Give the options of slabs and of round bodies to a subcommand."""
    command.add_argument(
        "--thicken",
        type=float,
        metavar="T",
        help="a solid to be printed, T thick in vertical direction; less than the gap",
    )
    command.add_argument(
        "--min-wall",
        type=float,
        metavar="W",
        help="with --thicken: make the solid thicker where it is steep, until it is W thick across everywhere",
    )
    command.add_argument(
        "--inflate",
        nargs="?",
        type=float,
        const=True,
        metavar="HEIGHT",
        help="a round body, thick in the middle and thin at the outline, HEIGHT thick at most (default: by its width)",
    )
    command.add_argument(
        "--profile",
        choices=["round", "flat"],
        help="with --inflate: elliptic, or a plateau with a round rim (default: round)",
    )


def _add_film_options(command: argparse.ArgumentParser) -> None:
    """Give the options of films to a subcommand."""
    command.add_argument(
        "--size", type=int, metavar="PIXELS", help="of a film: width and height, from 16 to 1600 (default: 480)"
    )
    command.add_argument(
        "--frames", type=int, metavar="N", help="of a film: pictures from disk to surface, from 3 to 101 (default: 33)"
    )


def _height_options(options: argparse.Namespace) -> dict[str, Any]:
    """Return the arguments of :func:`plyfold.lift` that were given."""
    pins = dict(options.pin) if options.pin else None
    given = {"stiffness": options.stiffness, "pins": pins, "flat": options.flat}
    return {name: value for name, value in given.items() if value is not None}


def _pin(text: str) -> tuple[PinKey, float]:
    """Read a pin.

    Examples
    --------
    >>> _pin("3=0.5"), _pin("1.5,-2=1"), _pin("1.5,-2,3=1")
    ((3, 0.5), ((1.5, -2.0), 1.0), ((1.5, -2.0, 3), 1.0))
    """
    place, _, height = text.rpartition("=")
    parts = place.split(",")
    try:
        if len(parts) == 1:
            return int(place), float(height)
        x, y = map(float, parts[:2])
        sheet = [int(part) for part in parts[2:]]
        return (x, y, *sheet), float(height)  # type: ignore[return-value]
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text} is no pin: SHEET=Z, X,Y=Z or X,Y,SHEET=Z") from None
