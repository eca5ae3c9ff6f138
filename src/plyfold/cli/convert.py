"""``plyfold convert``: an outline in another format."""

from __future__ import annotations

import argparse
from functools import partial
from typing import Any

from plyfold.cli.drawing import read_outline
from plyfold.cli.inputs import DISK, add_command, add_outputs, refuse_outputs, write_texts
from plyfold.cli.progress import Stopwatch

__all__ = ["add_convert_command"]


def add_convert_command(commands: Any) -> None:
    """Add the subcommand to a parser."""
    convert = add_command(commands, "convert", _convert, "write an outline in another format")
    add_outputs(convert, ".json .geojson .wkt .svg .csv")


def _convert(options: argparse.Namespace) -> int:
    from plyfold.io.outline_files import OUTLINE_WRITERS
    from plyfold.report import repair_lines

    refuse_outputs(options, tuple(OUTLINE_WRITERS))
    watch = Stopwatch()
    outline = read_outline(options, watch)
    watch.stop()
    loops = f"{outline.n_loops} loop" + "s" * (outline.n_loops > 1)
    print("\n".join([f"{loops}, {len(outline):,} points", *repair_lines(outline)]))
    write_texts(options, {ending: partial(write, outline) for ending, write in OUTLINE_WRITERS.items()})
    return DISK
