"""Time and memory on families of curves, beside GEOS, the reference and other programs: ``make benchmark``.

Every curve is drawn once; every contender gets it in a process of its own. The tables come from this one run, so the
ratios hold on any machine. Ctrl-C prints what was measured so far.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

import against
from contenders import CONTENDERS
from families import FAMILIES
from peers import Peer
from tables import Row, number, report

HERE = Path(__file__).parent
DOCS = HERE.parent / "docs"
BEGIN, END = "<!-- made by make benchmark-docs: begin -->", "<!-- made by make benchmark-docs: end -->"
REFERENCE_UP_TO = 200
LIFT_UP_TO = 2_000
SHARES = {"triangles": 0.3, "reference": 0.1, "lift": 0.1}
"""What part of a family's budget some contenders may take for one curve: the verdicts are to reach large curves."""


class Clock:
    """The time that a family may take."""

    def __init__(self, seconds: float) -> None:
        self.end = time.monotonic() + seconds

    def left(self) -> float:
        """Return the seconds left, never negative."""
        return max(0.0, self.end - time.monotonic())


def say(text: str) -> None:
    """Show progress."""
    print(text, file=sys.stderr, flush=True)


def lines_of(words: list[str], limit: float, environment: Mapping[str, str] | None = None) -> Iterator[dict[str, Any]]:
    """Run a contender and yield the lines it printed, also if it had to be stopped."""
    command = [sys.executable, *words]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, text=True, start_new_session=True, env=environment
    ) as process:
        try:
            printed, _ = process.communicate(timeout=limit)
        except subprocess.TimeoutExpired:
            process.kill()
            printed, _ = process.communicate()
            printed += json.dumps({"failed": f"stopped after {limit:.0f} s"}) + "\n"
        except BaseException:
            process.kill()
            raise
    yield from (json.loads(line) for line in printed.splitlines(keepends=True) if line.endswith("\n"))
    if process.returncode > 0:
        yield {"failed": f"exit code {process.returncode}"}


def contenders(vertices: int, options: argparse.Namespace, tired: set[str]) -> list[str | Peer]:
    """Return who gets a curve: the slow ones only small curves, and none that failed on a smaller one."""
    largest = {"reference": options.reference_up_to, "lift": options.lift_up_to}
    names = [name for name in CONTENDERS if vertices <= largest.get(name, vertices) and name not in tired]
    return [*names, *(peer for peer in options.peer if peer.name not in tired)]


def draw(family: str, vertices: int, seed: int, points: Path) -> bool:
    """Write a curve to a file, and tell whether there is one."""
    words = [str(HERE / "families.py"), family, str(vertices), str(seed), str(points)]
    return subprocess.run([sys.executable, *words], check=False, start_new_session=True).returncode == 0


def measure(row: Row, options: argparse.Namespace, clock: Clock, tired: set[str]) -> None:
    """Draw the curve of a row and give it to all contenders; the row is filled as they finish."""
    with tempfile.TemporaryDirectory() as folder:
        points = Path(folder, "points.npy")
        if not draw(row.family, row.vertices, options.seed, points):
            row.failures["drawing"] = "failed"
            return
        for contender in contenders(row.vertices, options, tired):
            if not clock.left():
                break
            if isinstance(contender, Peer):
                row.add(contender.name, contender.measure(points.with_suffix(".txt"), clock.left()))
                continue
            limit = min(clock.left(), SHARES.get(contender, 1.0) * options.budget)
            words = [str(HERE / "contenders.py"), contender, str(points), *(["--plain"] if options.plain else [])]
            for line in lines_of(words, limit):
                row.add(contender, line)
    tired.update(row.failures)


def progress(row: Row) -> str:
    """Return a short line about a curve."""
    times = ", ".join(f"{stage} {number(seconds)} s" for stage, seconds in row.seconds.items())
    failures = "".join(f"; {name} {failure}" for name, failure in row.failures.items())
    return f"{row.family} {row.vertices:,}: k = {row.facts.get('k', '–')}; {times}{failures}"


def run(options: argparse.Namespace, rows: list[Row], skipped: list[str]) -> None:
    """Measure all families, adding rows as they come; what the budget does not allow is named in `skipped`."""
    for family in options.families or FAMILIES:
        clock, tired = Clock(options.budget), set[str]()
        for vertices in options.sizes or FAMILIES[family].sizes:
            if clock.left() < 1 or "plyfold" in tired:
                skipped.append(f"{family}, n = {vertices:,} and more: over {options.budget:.0f} s, the family's budget")
                break
            rows.append(Row(family, vertices))
            measure(rows[-1], options, clock, tired)
            say(progress(rows[-1]))


def compare(options: argparse.Namespace, pairs: list[against.Pair]) -> None:
    """Measure both source trees on all families, adding pairs as they come."""
    for family in options.families or FAMILIES:
        clock = Clock(options.budget)
        for vertices in options.sizes or FAMILIES[family].sizes:
            if clock.left() < 1:
                break
            pairs.append(against.Pair(family, vertices))
            compare_on(pairs[-1], options, clock)
            say(f"{family} {vertices:,}")


def compare_on(pair: against.Pair, options: argparse.Namespace, clock: Clock) -> None:
    """Draw a curve and give it to both source trees, as long as there is time."""
    with tempfile.TemporaryDirectory() as folder:
        points = Path(folder, "points.npy")

        def lines(tree: against.Tree, contender: str) -> Iterator[dict[str, Any]]:
            words = [tree.contenders, contender, str(points), *(["--plain"] if options.plain else [])]
            return lines_of(words, clock.left(), tree.environment) if clock.left() else iter(())

        if draw(pair.family, pair.vertices, options.seed, points):
            against.measure(pair, options.against, options.rounds, lines)


def write_docs(text: str, rows: list[Row]) -> None:
    """Put the tables between the markers of docs/benchmarks.md, and draw the plot beside it."""
    from plot import plot

    page = DOCS / "benchmarks.md"
    before, _, rest = page.read_text(encoding="utf-8").partition(BEGIN)
    after = rest.partition(END)[2]
    page.write_text(f"{before}{BEGIN}\n\n{text}\n\n{END}{after}", encoding="utf-8")
    plot(rows, DOCS / "images" / "benchmark.png")


def arguments() -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--families", nargs="+", metavar="NAME", help="default: all")
    parser.add_argument("--sizes", nargs="+", type=int, metavar="N", help="vertices; default: those of each family")
    parser.add_argument("--budget", type=float, default=60, metavar="SECONDS", help="for each family; default 60")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument(
        "--peer", type=Peer.parse, action="append", default=[], metavar="NAME=COMMAND", help="with {file}; see peers.py"
    )
    parser.add_argument("--reference-up-to", type=int, default=REFERENCE_UP_TO, metavar="N")
    parser.add_argument("--lift-up-to", type=int, default=LIFT_UP_TO, metavar="N")
    parser.add_argument("--plain", action="store_true", help="with the hot loops as plain Python")
    parser.add_argument(
        "--against",
        type=Path,
        metavar="DIR",
        help="another source tree of plyfold: both take turns on each curve, and the ratios are printed",
    )
    parser.add_argument("--rounds", type=int, default=3, help="turns of each source tree; default 3")
    parser.add_argument("--docs", action="store_true", help="write the tables and the plot into docs/")
    return parser.parse_args()


def print_comparison(options: argparse.Namespace) -> int:
    """Measure two source trees, and print their ratios so far."""
    pairs: list[against.Pair] = []
    with suppress(KeyboardInterrupt):
        compare(options, pairs)
    print(against.table(pairs))
    return 0


def main() -> int:
    """Measure, and print the tables."""
    options = arguments()
    if options.against:
        return print_comparison(options)
    rows: list[Row] = []
    skipped: list[str] = []
    try:
        run(options, rows, skipped)
    except KeyboardInterrupt:
        skipped.append("stopped by Ctrl-C")
    text = report(rows, ["reference", *(peer.name for peer in options.peer)], skipped)
    print(text)
    if options.docs:
        write_docs(text, rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
