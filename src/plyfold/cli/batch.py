"""``plyfold batch``: a table with the verdict on every outline of any number of files."""

from __future__ import annotations

import argparse
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Any

from plyfold.cli.census import add_workers
from plyfold.cli.inputs import DISK, add_time_limit
from plyfold.cli.progress import Stopwatch
from plyfold.cli.standard_output import say_written
from plyfold.errors import InputError
from plyfold.io.saving import refuse_existing, refuse_output

if TYPE_CHECKING:
    from plyfold.tables.parts import Note

__all__ = ["add_batch_command"]

_GUIDE = """\
IN is a file or a folder: SVG, JSON, GeoJSON, WKT, CSV, NPY, GPX, OBJ and PLY as other commands read them, each shape a
row; JSON lines (.jsonl, .ndjson, .geojsonl), each line a list of points, an object with loops, or GeoJSON; Parquet, a
column of WKB.

columns: file, index (which shape, line or row of it, from 0 on) and id, always; then those that --columns names:
  crossings,loops,turning,verdict,reason,error     the default
  place (two columns: place_x, place_y), immersions, embeddable, levels, repair
verdict is disk, surface, none or unknown; a bad outline is a row with its error.

A run that was interrupted goes on where it was when the same command is given again: what is done lies in a folder
beside OUT, with .parts behind its name, until all is done.
"""


def add_batch_command(commands: Any) -> None:
    """Add the subcommand to a parser."""
    batch = commands.add_parser(
        "batch",
        help="a table with the verdict on every outline of many files",
        description="The verdicts on all outlines of files and folders, as a table.",
        epilog=_GUIDE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    batch.set_defaults(run=_batch)
    batch.add_argument("inputs", nargs="+", metavar="IN", help="files and folders")
    batch.add_argument("-o", "--output", required=True, metavar="OUT", help="a .parquet, .csv or .jsonl file")
    batch.add_argument("--columns", metavar="NAMES", help="which, with commas between them (see below)")
    batch.add_argument("--column", metavar="NAME", help="of Parquet, where the WKB is, if the file does not say so")
    batch.add_argument("--force", action="store_true", help="replace an existing file, but never one that is read")
    add_time_limit(batch, "each question about an outline that can take long")
    add_workers(batch)


def _batch(options: argparse.Namespace) -> int:
    from plyfold.many.batch import batch_job
    from plyfold.many.verdicts import DEFAULT_COLUMNS
    from plyfold.tables.cluster import connected
    from plyfold.tables.files import require_writer
    from plyfold.tables.parts import write_table

    _refuse(options)
    require_writer(ending := Path(options.output).suffix.lower())
    refuse_output(options.output, (ending,), options.force)
    watch = Stopwatch()
    watch("looking through the files")
    columns = options.columns.split(",") if options.columns else DEFAULT_COLUMNS
    job = batch_job(options.inputs, columns, time_limit=options.time_limit, column=options.column, but=options.output)
    with connected(options.scheduler) as client:
        refuse_existing(options.output, options.force)
        notes = write_table(job, options.output, client or options.workers, options.force, watch)
    watch.stop()
    print(_in_words(notes))
    say_written(options.output)
    return DISK


def _refuse(options: argparse.Namespace) -> None:
    """Refuse an output that is one of the inputs; in a folder it is passed over."""
    for path in options.inputs:
        if Path(path).exists() and Path(options.output).exists() and Path(path).samefile(options.output):
            raise InputError(f"{options.output} is one of the files that are read", hint="write to another file")


def _in_words(notes: list[Note]) -> str:
    """Say what was found.

    Examples
    --------
    >>> _in_words([{"rows": 3, "errors": 1, "disk": 2}, {"rows": 1000, "errors": 0, "none": 1000}])
    '1,003 outlines: 2 disk, 1,000 none, 1 with an error'
    """
    found: Counter[str] = Counter()
    for note in notes:
        found.update(note)
    told = [f"{found[name]:,} {name}" for name in ("disk", "surface", "none", "unknown") if found[name]]
    told += [f"{found['errors']:,} with an error"] * bool(found["errors"])
    return f"{found['rows']:,} outlines" + (f": {', '.join(told)}" if told else "")
