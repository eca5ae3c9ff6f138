"""What lies flat: ``plyfold split``, ``plyfold triangulate``, ``plyfold unwrap`` and ``plyfold word``."""

from __future__ import annotations

import argparse
import math
from functools import partial
from typing import TYPE_CHECKING, Any, TypeAlias

from plyfold.cli.inputs import (
    DISK,
    NO_DISK,
    add_command,
    add_outputs,
    add_repair,
    arrange_outline,
    prepare,
    read_arrangement,
    read_as_given,
    read_drawing,
    refuse_outputs,
    say_notes,
    write_texts,
)
from plyfold.cli.progress import Stopwatch
from plyfold.cli.standard_output import say_written
from plyfold.loading import FOR_MESHES, load_libraries
from plyfold.wording import counted

if TYPE_CHECKING:
    from shapely import Polygon

    from plyfold.arrangement.arrangement import Arrangement
    from plyfold.outline.curve import Outline

__all__ = ["add_flat_commands"]

Polygons: TypeAlias = "tuple[list[Polygon], list[dict[str, Any]], str]"
"""Polygons, what is told of each, and what they are."""


def add_flat_commands(commands: Any) -> None:
    """Add the subcommands to a parser."""
    split = add_command(commands, "split", _split, "cut a disk into simple polygons, or any curves into cells or fills")
    add_outputs(split, ".geojson .wkt .svg")
    add_repair(split)
    what = split.add_mutually_exclusive_group()
    what.add_argument(
        "--cells",
        action="store_true",
        help="the cells with their winding numbers, of curves that need be no disk; nothing is moved, and "
        "one curve whose turning number is negative is turned round first",
    )
    what.add_argument(
        "--fill",
        choices=["nonzero", "evenodd", "positive", "negative"],
        help="what is painted by a fill rule, of the points as given; nothing is moved",
    )
    what.add_argument("--at-least", type=int, metavar="J", help="the places with winding number J or a larger one")
    triangles = add_command(
        commands, "triangulate", _triangulate, "cut a disk into triangles on the points of the curve"
    )
    add_outputs(triangles, ".obj .csv")
    add_repair(triangles)
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
    refuse_outputs(options, tuple(POLYGON_WRITERS))
    is_filled = options.fill is not None or options.at_least is not None
    if is_filled or options.cells:
        drawn = read_as_given(options, watch)
        watch("cutting")
        polygons, told, kind = _filled(drawn, options) if is_filled else _cells(drawn)
    else:
        arranged = read_arrangement(options, watch)
        say_notes(arranged.outline)
        load_libraries(FOR_MESHES, watch)
        watch("cutting")
        polygons, told, kind = _pieces(arranged)
    watch.stop()
    print(f"{len(polygons)} {kind}")
    write_texts(options, {ending: partial(write, polygons, told) for ending, write in POLYGON_WRITERS.items()})
    return DISK


def _pieces(arranged: Arrangement) -> Polygons:
    from plyfold.flat.decompose import decompose

    polygons = decompose(arranged)
    return polygons, [{"piece": number} for number in range(len(polygons))], "simple polygon(s)"


def _cells(drawn: Outline) -> Polygons:
    from plyfold.flat.coverage import directed_coverage

    cells, turned = directed_coverage(drawn)
    told = [{"winding": cell.winding, "reversed": turned} for cell in cells]
    return [cell.polygon for cell in cells], told, f"cell(s), {_direction(turned)}"


def _filled(drawn: Outline, options: argparse.Namespace) -> Polygons:
    from plyfold.flat.fills import fill

    parts = list(fill(drawn, options.fill or "nonzero", at_least=options.at_least).geoms)
    painted = {"fill": options.fill} if options.at_least is None else {"at_least": options.at_least}
    return parts, [painted] * len(parts), "polygon(s)"


def _direction(turned: bool) -> str:
    """Say whose sign the winding numbers of the cells have."""
    if turned:
        return "with winding numbers of the curve turned round, for the drawing turns clockwise"
    return "with winding numbers in the direction of the drawing"


def _triangulate(options: argparse.Namespace) -> int:
    from plyfold.flat.triangulate import chosen_immersion, triangulate
    from plyfold.io.pieces import as_csv, as_obj

    watch = Stopwatch()
    refuse_outputs(options, (".obj", ".csv"))
    outline = read_drawing(options, watch)
    arranged = arrange_outline(outline, options, watch)
    say_notes(arranged.outline)
    watch("triangulating")
    immersion = chosen_immersion(arranged, None)
    faces = triangulate(outline, immersion)

    def mesh() -> str:
        """Return a mesh of round triangles whose pieces have no vertex in common."""
        return as_obj(*triangulate(outline, immersion, refine=math.inf))

    watch.stop()
    print(f"{len(faces):,} triangles")
    write_texts(options, {".obj": mesh, ".csv": partial(as_csv, faces)})
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
    sheets = counted(len(set(unwound.sheet.tolist())), "sheet")
    print(f"{len(unwound.faces):,} triangles in {sheets}, none of them flipped in the disk")
    for path in options.output:
        say_written(path)
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
