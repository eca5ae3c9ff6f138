"""The tables of the benchmarks: rows of measurements, ratios, growth, and what the project asks of itself."""

from __future__ import annotations

import datetime
import math
import os
import platform
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from importlib.metadata import version
from pathlib import Path
from statistics import linear_regression
from typing import Any

VERDICT = ("arrangement", "sheets")
TRIANGULATED = (*VERDICT, "triangulate")
LARGE = 10_000
MEASURED = ("stage", "seconds", "disk", "megabytes")
WORD: dict[bool | None, str] = {True: "disk", False: "no disk", None: "–"}


@dataclass
class Row:
    """Everything measured on one curve: seconds by stage, facts about the curve, peak of memory, and failures."""

    family: str
    vertices: int
    seconds: dict[str, float] = field(default_factory=dict)
    facts: dict[str, Any] = field(default_factory=dict)
    verdicts: dict[str, bool | None] = field(default_factory=dict)
    megabytes: float | None = None
    failures: dict[str, str] = field(default_factory=dict)

    def add(self, contender: str, line: dict[str, Any]) -> None:
        """Take over a line of a contender (see `contenders`)."""
        if "failed" in line:
            self.failures[contender] = line["failed"]
            return
        stage = line["stage"]
        self.seconds[stage] = line["seconds"]
        self.facts |= {key: value for key, value in line.items() if key not in MEASURED}
        if "disk" in line:
            self.verdicts[contender] = line["disk"]
        if contender in ("plyfold", "triangles"):
            self.megabytes = max(line["megabytes"], self.megabytes or 0.0)

    def total(self, stages: Iterable[str]) -> float | None:
        """Return the seconds of several stages together, None if one is missing."""
        parts = [self.seconds.get(stage) for stage in stages]
        return None if None in parts else sum(part for part in parts if part is not None)

    def ratio(self, stages: Iterable[str], to: str = "GEOS") -> float | None:
        """Return the seconds of some stages relative to those of another contender."""
        total, other = self.total(stages), self.seconds.get(to)
        return total / other if total is not None and other else None

    @property
    def size(self) -> int | None:
        """Vertices and crossings together."""
        return self.vertices + self.facts["k"] if "k" in self.facts else None


def exponent(rows: Sequence[Row], stages: Iterable[str]) -> float | None:
    """Return the power of n + k with which the time grows: least squares in logarithms over the last two decades.

    None if fewer than three curves or less than a decade was measured, or nothing large: there the start of every
    step takes longer than its work.
    """
    stages = tuple(stages)
    return growth([(row.size, row.total(stages)) for row in rows])


def growth_of_answer(rows: Sequence[Row]) -> float | None:
    """Return the power with which vertices and glued pairs of sheets grow, as if they were seconds."""
    return growth([(row.size, row.vertices + row.facts["glued"] if row.facts.get("glued") else None) for row in rows])


def growth(measured: Iterable[tuple[int | None, float | None]]) -> float | None:
    """Return the power of a size with which a measurement grows; see :func:`exponent`."""
    points = [(size, value) for size, value in measured if size and value]
    largest = max((size for size, _ in points), default=0)
    points = [(size, seconds) for size, seconds in points if size >= largest / 100]
    if len(points) < 3 or largest < max(LARGE, 10 * min(size for size, _ in points)):
        return None
    return linear_regression([math.log(size) for size, _ in points], [math.log(value) for _, value in points]).slope


def number(value: float | None, digits: int = 2) -> str:
    """Write a number with so many significant digits, without exponent; a dash for none."""
    if value is None:
        return "–"
    if value >= 10 ** (digits - 1) or value == 0:
        return f"{value:,.0f}"
    return f"{value:.{digits - 1 - math.floor(math.log10(value))}f}"


def markdown(heads: Sequence[str], lines: Iterable[Sequence[str]]) -> str:
    """Return a table with its first column to the left and all others to the right."""
    rule = ["---", *["---:"] * (len(heads) - 1)]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in [heads, rule, *lines])


COLUMNS: dict[str, Callable[[Row], str]] = {
    "family": lambda row: row.family,
    "n": lambda row: f"{row.vertices:,}",
    "k": lambda row: f"{row.facts['k']:,}" if "k" in row.facts else "–",
    "max w": lambda row: str(row.facts.get("w", "–")),
    "verdict": lambda row: WORD[row.verdicts.get("plyfold")],
    "arrangement s": lambda row: number(row.seconds.get("arrangement")),
    "all sheets s": lambda row: number(row.seconds.get("sheets")),
    "triangles s": lambda row: number(row.seconds.get("triangulate")),
    "count s": lambda row: number(row.seconds.get("count")),
    "GEOS s": lambda row: number(row.seconds.get("GEOS")),
    "sheets / GEOS": lambda row: number(row.ratio(VERDICT)),
    "triangles / GEOS": lambda row: number(row.ratio(TRIANGULATED)),
    "peak MB": lambda row: number(row.megabytes),
}


def main_table(rows: Sequence[Row]) -> str:
    """Return one line per curve."""
    return markdown(list(COLUMNS), [[cell(row) for cell in COLUMNS.values()] for row in rows])


def by_family(rows: Sequence[Row]) -> dict[str, list[Row]]:
    """Return the rows of each family, in order."""
    families: dict[str, list[Row]] = {}
    for row in rows:
        families.setdefault(row.family, []).append(row)
    return families


def growth_table(rows: Sequence[Row]) -> str:
    """Return the growth exponents of every family: of the times by stage, and of what there is to compute."""
    heads = ["family", "arrangement", "with all sheets", "with triangles", "GEOS", "size of the answer"]
    choices = (("arrangement",), VERDICT, TRIANGULATED, ("GEOS",))
    lines = [
        [family, *(number(exponent(own, stages), 3) for stages in choices), number(growth_of_answer(own), 3)]
        for family, own in by_family(rows).items()
    ]
    return markdown(heads, lines)


def lift_table(rows: Sequence[Row]) -> str:
    """Return the times of layering and lifting, where measured."""
    lifted = [row for row in rows if "layering" in row.seconds]
    cells = [
        [row.family, f"{row.vertices:,}", number(row.seconds["layering"]), number(row.seconds.get("lift"))]
        for row in lifted
    ]
    return markdown(["family", "n", "layering s", "lift s"], cells) if lifted else ""


def rivals_table(rows: Sequence[Row], rivals: Sequence[str]) -> str:
    """Return how the reference and the peers compare: their seconds, how many times ours, and whether they agree."""
    lines = []
    for row in rows:
        for name in rivals:
            seconds = row.seconds.get(name)
            if seconds is not None:
                ours = row.total(TRIANGULATED) or row.total(VERDICT)
                times = number(seconds / ours) if ours else "–"
                word = WORD[row.verdicts.get(name)]
                lines.append([name, row.family, f"{row.vertices:,}", number(seconds), number(ours), times, word])
    heads = ["program", "family", "n", "its s", "ours s", "its / ours", "its verdict"]
    return markdown(heads, lines) if lines else ""


def bars(rows: Sequence[Row]) -> list[tuple[str, float, float | None]]:
    """Return what is asked for: the sentence, the limit, and the measured value."""
    families = by_family(rows)

    def at(family: str, vertices: int) -> Row:
        found = (row for row in families.get(family, ()) if row.vertices == vertices)
        return next(found, Row(family, vertices))

    return [
        ("ribbon, n = 60,000: all sheets / GEOS", 1.0, at("ribbon", 60_000).ratio(VERDICT)),
        ("coil, n = 1,600: triangles / GEOS", 3.0, at("coil", 1_600).ratio(TRIANGULATED)),
        ("ribbon: growth exponent", 1.15, exponent(families.get("ribbon", []), VERDICT)),
        ("coil: growth exponent", 1.15, exponent(families.get("coil", []), VERDICT)),
    ]


def bars_table(rows: Sequence[Row]) -> str:
    """Return what is asked for and what was measured."""
    lines = []
    for sentence, limit, measured in bars(rows):
        met = "–" if measured is None else "yes" if measured <= limit else "no"
        lines.append([sentence, f"{limit:g}", number(measured, 3), met])
    return markdown(["aim", "at most", "measured", "met"], lines)


def machine(rows: Sequence[Row]) -> str:
    """Return the processor, memory, and versions, and the date."""
    names = [line.split(":")[1].strip() for line in _lines("/proc/cpuinfo") if line.startswith("model name")]
    memory = [int(line.split()[1]) / 2**20 for line in _lines("/proc/meminfo") if line.startswith("MemTotal")]
    geos = next((row.facts["version"] for row in rows if "version" in row.facts), "?")
    parts = [
        f"{os.cpu_count()} × {names[0] if names else platform.machine()}",
        *(f"{size:.0f} GB" for size in memory),
        platform.system(),
        f"Python {platform.python_version()}",
        *(f"{name} {version(name)}" for name in ("plyfold", "numpy", "shapely")),
        f"GEOS {geos}",
        datetime.date.today().isoformat(),
    ]
    return ", ".join(parts) + "."


def _lines(file: str) -> list[str]:
    return Path(file).read_text().splitlines() if Path(file).exists() else []


def notes(rows: Sequence[Row]) -> str:
    """Return what failed or ran out of time, and curves that had to be moved into general position."""
    lines = [
        f"{row.family}, n = {row.vertices:,}: {name} {failure}"
        for row in rows
        for name, failure in row.failures.items()
    ]
    lines += [
        f"{row.family}, n = {row.vertices:,}: {row.facts['moved']} repairs" for row in rows if row.facts.get("moved")
    ]
    return "\n".join(f"* {line}" for line in lines)


def report(rows: Sequence[Row], rivals: Sequence[str], skipped: Sequence[str]) -> str:
    """Return all tables, under their headings."""
    parts = {
        "": machine(rows),
        "### What is asked for": bars_table(rows),
        "### Curve by curve": main_table(rows),
        "### Growth exponents in n + k": growth_table(rows),
        "### The reference and other programs": rivals_table(rows, rivals),
        "### Layering and lifting": lift_table(rows),
        "### Not measured": "\n".join(filter(None, [notes(rows), *(f"* {line}" for line in skipped)])),
    }
    return "\n\n".join(f"{head}\n\n{text}".strip() for head, text in parts.items() if text)
