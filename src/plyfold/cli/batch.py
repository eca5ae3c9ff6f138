"""``plyfold batch``: the verdict on every outline in many files, as one table."""

from __future__ import annotations

import argparse
from collections import Counter
from pathlib import Path
from typing import Any

from plyfold.cli.census import add_workers
from plyfold.cli.progress import Stopwatch
from plyfold.cli.standard_output import say_written
from plyfold.io.saving import refuse_output

__all__ = ["add_batch_command"]

_GUIDE = """\
each row is one outline: file, index (of the shape in its file; -1 if the file cannot be read), id, and by default
crossings, loops, turning, verdict, reason, error. --columns names others: place, immersions, embeddable, levels, repair

IN is a file that plyfold reads, each shape of it an outline; a folder of such; JSON lines (.jsonl, .ndjson, .geojsonl),
each line as a .json or a GeoJSON feature; or Parquet with geometries as WKB.

A batch that was interrupted goes on where it was when the same command is given again: what is done lies in a folder
beside OUT, with .parts behind its name, until all is done.

exit codes: 0 if there is no error in any row, else 2
"""


def add_batch_command(commands: Any) -> None:
    """Add the subcommand to a parser."""
    batch = commands.add_parser(
        "batch",
        help="the verdict on every outline in many files, as one table",
        description="Tell of every outline in many files what it bounds, as one table. A bad outline is a row with its "
        "error.",
        epilog=_GUIDE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    batch.set_defaults(run=_batch)
    batch.add_argument("inputs", nargs="+", metavar="IN", help="files or folders")
    batch.add_argument("-o", "--output", required=True, metavar="OUT", help="a .parquet, .csv or .jsonl file")
    batch.add_argument("--columns", metavar="NAMES", help="columns after file, index and id, separated by commas")
    batch.add_argument("--time-limit", type=float, metavar="S", help="seconds for each question about one outline")
    batch.add_argument("--force", action="store_true", help="replace an existing file")
    add_workers(batch)


def _batch(options: argparse.Namespace) -> int:
    from plyfold.many.batch import batch_job
    from plyfold.many.sources import files_in
    from plyfold.many.verdicts import DEFAULT_COLUMNS, checked_columns
    from plyfold.tables.cluster import connected
    from plyfold.tables.files import require_writer
    from plyfold.tables.parts import write_table

    ending = Path(options.output).suffix.lower()
    require_writer(ending)
    refuse_output(options.output, (ending,), options.force)
    asked = DEFAULT_COLUMNS if options.columns is None else options.columns.split(",")
    columns = checked_columns(name.strip() for name in asked)
    watch = Stopwatch()
    watch("looking for outlines")
    job = batch_job(files_in(options.inputs, Path(options.output)), columns, options.time_limit)
    with connected(options.scheduler) as client:
        notes = write_table(job, options.output, client or options.workers, options.force, watch)
    watch.stop()
    counts = sum(map(Counter, notes), Counter[str]())
    for verdict, count in sorted(counts.items(), key=lambda pair: (pair[0] == "error", -pair[1])):
        print(f"{verdict:<26}{count:>14,}")
    say_written(options.output)
    return 2 if counts["error"] else 0
