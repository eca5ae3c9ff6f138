"""``plyfold lift``: the layered surface, as mesh, solid, page or film."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from plyfold.cli.heights import add_height_options, height_options
from plyfold.cli.inputs import DISK, add_command, add_outputs, add_time_limit, prepare, title
from plyfold.cli.progress import Stopwatch, timing
from plyfold.clock import Clock

__all__ = ["add_lift_command"]

# These take minutes for a large surface, and say how far they are.
_FILMS = (".gif", ".mp4")


def add_lift_command(commands: Any) -> None:
    """Add the subcommand to a parser."""
    lift = add_command(commands, "lift", _lift, "lift a curve to a layered surface that does not cut itself")
    add_time_limit(lift, "all of it but writing")
    add_outputs(lift, ".glb .obj .ply .stl .3mf .html .gif .mp4")
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


def _lift(options: argparse.Namespace) -> int:
    from plyfold.surface.lift import lift

    watch, clock = Stopwatch(), Clock(options.time_limit)
    pages = () if options.thicken is not None else (".html", *_FILMS)
    endings = (".glb", ".obj", ".ply", ".stl", ".3mf", *pages)
    arranged = prepare(options, endings, watch, clock)
    surface = lift(
        arranged,
        gap=options.gap,
        triangles=options.triangles,
        time_limit=clock.left,
        progress=watch,
        allow_intersections=options.allow_intersections,
        **height_options(options),
    )
    watch("writing")
    _export(surface, options, watch)
    watch.stop()
    levels = int(surface.layering.level.max())
    print(
        f"Lifted: {len(surface.faces):,} triangles in {surface.layering.immersion.n_sheets} sheets, {levels} level(s)"
    )
    if surface.intersections:
        print(f"  it passes through itself along {len(surface.intersections)} curve(s)")
    print(timing(watch))
    for path in options.output:
        print(f"  wrote {path}")
    return DISK


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
