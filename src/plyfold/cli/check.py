"""``plyfold check``: the verdict, in words or as JSON."""

from __future__ import annotations

import argparse
import json
from typing import Any

from plyfold.cli.inputs import DISK, NO_DISK, add_command, add_time_limit, read_arrangement
from plyfold.cli.progress import Stopwatch, timing
from plyfold.loading import FOR_LAYERINGS, load_libraries

__all__ = ["add_check_command"]

_JSON_GUIDE = """\
the object that --json prints:
  points, crossings         how many
  cells                     object: winding number -> how many cells have it
  turning_number, reversed  of the curve after it was turned round, if it was
  repairs                   list of {kind, where: [x, y], size}: what was changed in the input
  immersible, immersions    whether the curve bounds a disk, and in how many ways
  sheets                    of each immersion (if immersible)
  layerable                 whether an immersion can be lifted; null: unknown, the time limit (if immersible)
  examined, levels          immersions tried until one could be lifted, and the layers of that one
  reason, sentence, where   why not, in a word, in a sentence and at which places (if not immersible or layerable)
  seconds                   object: stage -> seconds
or, with exit code 2, {error, where, hint}
"""


def add_check_command(commands: Any) -> None:
    """Add the subcommand to a parser."""
    check = add_command(commands, "check", _check, "say whether a curve bounds a disk, with all figures")
    add_time_limit(check)
    check.add_argument("--json", action="store_true", help="print one JSON object and nothing else (see below)")
    check.epilog, check.formatter_class = _JSON_GUIDE, argparse.RawDescriptionHelpFormatter


def _check(options: argparse.Namespace) -> int:
    from plyfold.report import describe, verdict

    watch = Stopwatch()
    arranged = read_arrangement(options, watch)
    load_libraries(FOR_LAYERINGS, watch)
    watch("finding immersions and layerings")
    figures = verdict(arranged, options.time_limit)
    watch.stop()
    if options.json:
        print(json.dumps(figures | {"seconds": watch.seconds}))
    else:
        print(describe(figures))
        print(timing(watch))
    return DISK if figures["immersible"] else NO_DISK
