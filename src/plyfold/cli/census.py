"""``plyfold census``: every plane curve with so many crossings, each once, and what it bounds."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from plyfold.cli.progress import Stopwatch
from plyfold.cli.standard_output import say_written
from plyfold.cli.streams import complain
from plyfold.io.saving import refuse_existing, refuse_output, save_bytes

if TYPE_CHECKING:
    from plyfold.census.summary import Summary

__all__ = ["add_census_command"]

_GUIDE = """\
columns: code (which `plyfold.GaussCode.parse` reads), turning (without its sign), lowest and highest winding number,
symmetries, immersions, lifting (how many of these), layerings (of all of them together); with --homotopies also swept
(how many cells the least homotopy sweeps, each as often as it does) and branch_points

A census that was interrupted goes on where it was when the same command is given again: what is done lies in a folder
beside OUT, with .parts behind its name, until all is done.
"""
# A census with so many crossings takes minutes: what it will cost is measured and said first.
_LONG = 10


def add_census_command(commands: Any) -> None:
    """Add the subcommand to a parser."""
    census = commands.add_parser(
        "census",
        help="every plane curve with so many crossings, and what it bounds",
        description="Every generic closed curve in the plane with so many crossings, once up to start, direction and "
        "reflection, and what it bounds.",
        epilog=_GUIDE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    census.set_defaults(run=_census)
    census.add_argument("crossings", type=int, metavar="K", help="how many crossings")
    census.add_argument("-o", "--output", metavar="OUT", help="a .parquet, .csv or .jsonl file for all curves")
    census.add_argument(
        "--homotopies", action="store_true", help="least homotopies and branch points of all curves, too"
    )
    census.add_argument("--page", metavar="PAGE", help="an .html file for the summary, with pictures")
    census.add_argument("--cost", action="store_true", help="measure a sample, say what all would cost, and stop")
    census.add_argument("--force", action="store_true", help="replace existing files")
    add_workers(census)


def add_workers(command: argparse.ArgumentParser) -> None:
    """Give a subcommand the options that say who does the work."""
    command.add_argument("--workers", type=int, metavar="N", help="how many processes (default: one for each core)")
    command.add_argument("--scheduler", metavar="ADDRESS", help="a Dask cluster to do the work, instead")


def _census(options: argparse.Namespace) -> int:
    from plyfold.census.page import census_page, summary_lines
    from plyfold.census.summary import disagreements
    from plyfold.tables.files import require_writer

    ending = Path(options.output).suffix.lower() if options.output else ""
    if options.output:
        require_writer(ending)
        refuse_output(options.output, (ending,), options.force)
    if options.page:
        refuse_output(options.page, (".html",), options.force)
    if options.cost or options.crossings >= _LONG:
        _say_cost(options, ending)
    if options.cost:
        return 0
    summary = _made(options)
    for words, figure in summary_lines(summary):
        print(f"{words:<36}{figure:>14}")
    for wrong in disagreements(summary):
        complain(f"plyfold: this census is wrong: {wrong}")
    if options.output:
        say_written(options.output)
    if options.page:
        save_bytes(options.page, census_page(summary).encode(), options.force)
        say_written(options.page)
    return int(any(disagreements(summary)))


def _say_cost(options: argparse.Namespace, ending: str) -> None:
    from plyfold.census.job import cost_of_census

    cost = cost_of_census(options.crossings, ending, options.homotopies)
    size = f", and a file of {cost.size / 1e6:,.0f} MB" if ending else ""
    complain(f"about {cost.curves:,} curves: {_duration(cost.seconds)} of one core{size}")


def _duration(seconds: float) -> str:
    """Say how long it takes.

    Examples
    --------
    >>> _duration(5.2), _duration(400), _duration(90_000)
    ('5 s', '7 min', '25.0 h')
    """
    if seconds < 100:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"


def _made(options: argparse.Namespace) -> Summary:
    """Make the census, as a file if one is asked for."""
    from plyfold.census.job import census_job
    from plyfold.census.summary import Summary
    from plyfold.tables.cluster import connected
    from plyfold.tables.parts import count_parts, write_table

    watch = Stopwatch()
    job = census_job(options.crossings, homotopies=options.homotopies)
    with connected(options.scheduler) as client:
        if options.output:
            refuse_existing(options.output, options.force)
            notes = write_table(job, options.output, client or options.workers, options.force, watch)
        else:
            notes = count_parts(job, client or options.workers, watch)
    watch.stop()
    return Summary.together(map(Summary.from_note, notes))
