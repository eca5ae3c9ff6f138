"""``plyfold lift``: the layered surface, as mesh, solid, page or film."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from plyfold.cli.inputs import DISK, add_command, add_outputs, add_repair, add_time_limit, prepare, title
from plyfold.cli.progress import Stopwatch, timing
from plyfold.cli.standard_output import say_written
from plyfold.clock import Clock
from plyfold.wording import counted

if TYPE_CHECKING:
    from plyfold.arrangement.arrangement import Arrangement
    from plyfold.layering.layering import Layering
    from plyfold.surface.heights import PinKey

__all__ = ["add_lift_command"]

# These take minutes for a large surface, and say how far they are.
_FILMS = (".gif", ".mp4")


def add_lift_command(commands: Any) -> None:
    """Add the subcommand to a parser."""
    lift = add_command(commands, "lift", _lift, "lift a curve to a layered surface that does not cut itself")
    add_time_limit(lift, "all of it but writing")
    add_outputs(lift, ".glb .obj .ply .stl .3mf .html .gif .mp4")
    add_repair(lift)
    lift.add_argument(
        "--gap", type=float, help="least distance of sheets, in units of the drawing (default: 1/20 of its larger side)"
    )
    lift.add_argument(
        "--allow-intersections",
        action="store_true",
        help="where no layered surface exists, lift one with the shortest self-intersections",
    )
    lift.add_argument("--triangles", type=int, default=4000, help="roughly how many triangles (default: %(default)s)")
    _add_height_options(lift)
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


def _lift(options: argparse.Namespace) -> int:
    from plyfold.surface.lift import lift

    watch, clock = Stopwatch(), Clock(options.time_limit)
    pages = () if options.thicken is not None else (".html", *_FILMS)
    endings = (".glb", ".obj", ".ply", ".stl", ".3mf", *pages)
    arranged = prepare(options, endings, watch, clock)
    surface = lift(
        _by_heights(arranged, options),
        gap=options.gap,
        triangles=options.triangles,
        time_limit=clock.left,
        progress=watch,
        allow_intersections=options.allow_intersections,
        **_height_options(options),
    )
    watch("writing")
    _export(surface, options, watch)
    watch.stop()
    sheets = counted(surface.n_sheets, "sheet")
    print(f"Lifted: {len(surface.faces):,} triangles in {sheets}, {surface.n_layers} level(s)")
    if surface.intersections:
        print(f"  it passes through itself along {len(surface.intersections)} curve(s)")
    print(timing(watch))
    for path in options.output:
        say_written(path)
    return DISK


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


def _export(surface: Any, options: argparse.Namespace, watch: Stopwatch) -> None:
    solid = None if options.thicken is None else surface.thicken(options.thicken)
    for path in options.output:
        choices: dict[str, Any] = {"colours": options.colours, "unwrapped": False if options.no_unwrap else None}
        if solid is not None:
            solid.export(path, options.force, **choices)
        elif Path(path).suffix.lower() in _FILMS:
            _film(surface, path, options.force, watch)
        else:
            surface.export(path, options.force, title(options.file), **choices)


def _film(surface: Any, path: str, force: bool, watch: Stopwatch) -> None:
    from plyfold.draw.film import save_film

    save_film(surface, path, force, watch)
    watch("writing")


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
