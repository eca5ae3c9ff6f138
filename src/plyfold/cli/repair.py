"""``plyfold repair``: an outline with small changes that make it that of a disk."""

from __future__ import annotations

import argparse
from functools import partial
from typing import Any

from plyfold.cli.drawing import read_outline
from plyfold.cli.inputs import (
    DISK,
    add_command,
    add_outputs,
    add_repair,
    add_time_limit,
    refuse_outputs,
    repaired,
    write_texts,
)
from plyfold.cli.progress import Stopwatch
from plyfold.clock import Clock

__all__ = ["add_repair_command"]


def add_repair_command(commands: Any) -> None:
    """Add the subcommand to a parser."""
    what = "leave out tiny loops and undo lenses, so that an outline bounds a disk"
    repair = add_command(commands, "repair", _repair, what)
    add_outputs(repair, ".json .geojson .wkt .svg .csv")
    add_repair(repair, is_option=False)
    add_time_limit(repair, "finding the changes")


def _repair(options: argparse.Namespace) -> int:
    from plyfold.io.outline_files import OUTLINE_WRITERS
    from plyfold.report import repair_lines

    refuse_outputs(options, tuple(OUTLINE_WRITERS))
    watch = Stopwatch()
    found = repaired(read_outline(options, watch), options, watch, Clock(options.time_limit))
    watch.stop()
    print("\n".join([str(found), *repair_lines(found.outline)]))
    write_texts(options, {ending: partial(write, found.outline) for ending, write in OUTLINE_WRITERS.items()})
    return DISK
