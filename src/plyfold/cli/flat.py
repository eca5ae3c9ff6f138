"""What lies flat: ``plyfold split``, ``plyfold triangulate``, ``plyfold unwrap`` and ``plyfold word``."""

from __future__ import annotations

import argparse
from functools import partial
from typing import TYPE_CHECKING, Any

from plyfold.cli.inputs import DISK, NO_DISK, add_command, add_outputs, prepare, read_arrangement, write_texts
from plyfold.cli.progress import Stopwatch
from plyfold.loading import FOR_MESHES, load_libraries
from plyfold.wording import counted

if TYPE_CHECKING:
    from plyfold.arrangement.arrangement import Arrangement

__all__ = ["add_flat_commands"]


def add_flat_commands(commands: Any) -> None:
    """Add the subcommands to a parser."""
    split = add_command(commands, "split", _split, "cut a disk into simple polygons, or any curve into its cells")
    add_outputs(split, ".geojson .wkt .svg")
    split.add_argument(
        "--cells",
        action="store_true",
        help="the cells with their winding numbers, of a curve that need be no disk; "
        "one whose turning number is negative is turned round first",
    )
    triangles = add_command(
        commands, "triangulate", _triangulate, "cut a disk into triangles on the points of the curve"
    )
    add_outputs(triangles, ".obj .csv")
    unwrap = add_command(commands, "unwrap", _unwrap, "map a disk one-to-one onto the round disk: texture coordinates")
    add_outputs(unwrap, ".obj .ply .glb")
    unwrap.add_argument(
        "--immersion", type=int, default=0, metavar="N", help="which of several, from 0 (the default) on"
    )
    unwrap.add_argument("--triangles", type=int, default=4000, help="roughly how many triangles (default: %(default)s)")
    add_command(commands, "word", _word, "print Blank's word of a curve, and its groupings").add_argument(
        "--most", type=int, default=20, help="how many groupings to print (default: %(default)s)"
    )


def _split(options: argparse.Namespace) -> int:
    from plyfold.io.pieces import POLYGON_WRITERS

    watch = Stopwatch()
    arranged = prepare(options, tuple(POLYGON_WRITERS), watch)
    load_libraries(() if options.cells else FOR_MESHES, watch)
    watch("cutting")
    if options.cells:
        from plyfold.flat.coverage import coverage

        cells = coverage(arranged)
        polygons = [cell.polygon for cell in cells]
        told = [{"winding": cell.winding, "reversed": arranged.reversed} for cell in cells]
    else:
        from plyfold.flat.decompose import decompose

        polygons = decompose(arranged)
        told = [{"piece": number} for number in range(len(polygons))]
    watch.stop()
    print(f"{len(polygons)} " + (f"cell(s), {_direction(arranged)}" if options.cells else "simple polygon(s)"))
    write_texts(options, {ending: partial(write, polygons, told) for ending, write in POLYGON_WRITERS.items()})
    return DISK


def _direction(arranged: Arrangement) -> str:
    """Say whose sign the winding numbers of the cells have."""
    if arranged.reversed:
        return "with winding numbers of the curve turned round, for the drawing turns clockwise"
    return "with winding numbers in the direction of the drawing"


def _triangulate(options: argparse.Namespace) -> int:
    from plyfold.flat.triangulate import triangulate
    from plyfold.io.pieces import TRIANGLE_WRITERS
    from plyfold.outline.given import as_outline

    watch = Stopwatch()
    arranged = prepare(options, tuple(TRIANGLE_WRITERS), watch)
    watch("triangulating")
    faces = triangulate(arranged)
    watch.stop()
    drawn = as_outline(arranged)
    points = (drawn.reversed() if arranged.reversed else drawn).points
    print(f"{len(faces):,} triangles")
    write_texts(options, {ending: partial(write, points, faces) for ending, write in TRIANGLE_WRITERS.items()})
    return DISK


def _unwrap(options: argparse.Namespace) -> int:
    from plyfold.disk.unwrap import DISK_ENDINGS, unwrap
    from plyfold.immersion.immersion import Immersion
    from plyfold.immersion.solve import find_immersion, nth_immersion

    watch = Stopwatch()
    arranged = prepare(options, DISK_ENDINGS, watch)
    watch("finding the immersion")
    found = find_immersion(arranged)
    if found and options.immersion != 0:
        found = nth_immersion(arranged, options.immersion)
    load_libraries(FOR_MESHES, watch)
    watch("unwinding")
    unwound = unwrap(found if isinstance(found, Immersion) else arranged, triangles=options.triangles)
    watch("writing")
    for path in options.output:
        unwound.export(path, options.force)
    watch.stop()
    sheets = counted(unwound.immersion.n_sheets, "sheet")
    print(f"{len(unwound.faces):,} triangles in {sheets}, none of them flipped in the disk")
    for path in options.output:
        print(f"  wrote {path}")
    return DISK


def _word(options: argparse.Namespace) -> int:
    from itertools import islice

    from plyfold.immersion.blank_word import blank_word

    word = blank_word(read_arrangement(options, watch := Stopwatch()))
    watch.stop()
    print(word)
    groupings = word.groupings()
    shown = [word.bracketed(grouping) for grouping in islice(groupings, max(options.most, 0))]
    print(f"\n{len(shown)}{' or more' if next(groupings, None) else ''} grouping(s)", *shown, sep="\n  ")
    return DISK if shown else NO_DISK
