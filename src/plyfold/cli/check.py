"""``plyfold check``: the verdict, in words or as JSON."""

from __future__ import annotations

import argparse
import json
from typing import Any

from plyfold.cli.drawing import named_drawing
from plyfold.cli.inputs import DISK, NO_DISK, UNKNOWN, add_command, add_repair, add_time_limit, read_arrangement
from plyfold.cli.progress import Stopwatch, timing
from plyfold.loading import FOR_LAYERINGS, load_libraries

__all__ = ["add_check_command"]

_JSON_GUIDE = """\
the object that --json prints; with --each one on a line for each shape, of several files for each file:
  file                      which file it is in (of several)
  index, id                 which shape it is (with --each)
  points, loops             how many
  crossings                 how often two edges cross inside both
  contacts                  list of [x, y]: where points lie on foreign edges or on each other
  crossings_moved_apart     how many crossings there are when these are moved outward, infinitely little; without
                            contacts the same as crossings
  cusps                     list of {loop, point, index, where: [x, y]}
  cells                     object: winding number -> how many cells have it; strands run to and fro part none
  turning_number, reversed  of all loops together, after they were turned round, if they were
  repairs                   list of {kind, where: [x, y], size}: what was changed in the input
  immersible, immersions    whether the outline bounds a surface, and in how many ways; null: unknown, the time limit
  surface                   what it bounds, in words (if immersible)
  touches                   list of [x, y]: where the surface touches itself; empty if the outline bounds one that does
                            not (if immersible)
  pieces                    of the surface, cut where it touches itself, as in meshes: list of {loops,
                            euler_characteristic, genus}; loops are numbered as they are after the cuts (if immersible)
  euler_characteristic      of all pieces together (if immersible)
  sheets                    of each immersion: the winding numbers of all cells added up (if immersible)
  layerable                 whether an immersion can be lifted; null: unknown, the time limit (if immersible)
  examined, levels          immersions of a disk tried until one could be lifted, and the layers of that one
  reason, sentence, where   why not, in a word, in a sentence and at which places (if not immersible or layerable)
  branch_points             how many the disk has that it bounds (if not immersible, and it bounds a disk with some)
  offers                    list of what makes it one, as far as it is found in half a second (if not immersible): each
                            has kind, sentence and command. Kind "repair": changes (list of {kind, where, size, region,
                            layers}), region_change, layer_change, surface; "cusps": cusps (list as above), surface;
                            "fill"
  seconds                   object: stage -> seconds
or, with exit code 2, {error, where, hint}
"""


def add_check_command(commands: Any) -> None:
    """Add the subcommand to a parser."""
    check = add_command(commands, "check", _check, "say what surface an outline bounds, with all figures")
    add_time_limit(check)
    add_repair(check)
    check.add_argument("more", nargs="*", metavar="FILE", help="further drawings: a line of JSON for each")
    check.add_argument("--json", action="store_true", help="print one JSON object and nothing else (see below)")
    check.epilog, check.formatter_class = _JSON_GUIDE, argparse.RawDescriptionHelpFormatter


def _check(options: argparse.Namespace) -> int:
    from plyfold.report import describe, verdict

    watch = Stopwatch()
    arranged = read_arrangement(options, watch)
    load_libraries(FOR_LAYERINGS, watch)
    watch("finding immersions and layerings")
    figures = verdict(arranged, options.time_limit, named_drawing(options))
    watch.stop()
    if options.json:
        print(json.dumps(options.shape | figures | {"seconds": watch.seconds}), flush=True)
    else:
        print(describe(figures))
        print(timing(watch))
    return {True: DISK, False: NO_DISK, None: UNKNOWN}[figures["immersible"]]
