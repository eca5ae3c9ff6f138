"""Another source tree beside this one, on the same curves: ``run.py --against DIR``.

Each tree is measured by its own `contenders`, so its calls may have other names. The two take turns, each time in a
process of its own, and the least of each one's times counts: what else the machine does hits both alike.
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from statistics import geometric_mean
from typing import Any

from tables import markdown, number

HERE = Path(__file__).parent
STAGES = {
    "plyfold": ("arrangement", "sheets", "count"),
    "triangles": ("triangulate",),
    "lift": ("layering", "lift"),
}
"""The contenders that are asked of both trees, and their stages."""


@dataclass(frozen=True)
class Tree:
    """A folder with plyfold's ``src`` and ``benchmarks``."""

    folder: Path

    @property
    def contenders(self) -> str:
        """The program that measures it."""
        return str(self.folder / "benchmarks" / "contenders.py")

    @property
    def environment(self) -> dict[str, str]:
        """The variables under which Python imports this tree's plyfold."""
        return {**os.environ, "PYTHONPATH": str(self.folder / "src")}


@dataclass
class Pair:
    """The least seconds on one curve, by stage, of the other tree and of this one."""

    family: str
    vertices: int
    theirs: dict[str, float] = field(default_factory=dict)
    ours: dict[str, float] = field(default_factory=dict)

    def ratio(self, stage: str) -> float:
        """Return this tree's seconds by the other one's; not a number where one of them has none."""
        return self.ours.get(stage, math.nan) / self.theirs.get(stage, math.nan)


def measure(pair: Pair, other: Path, rounds: int, run: Callable[[Tree, str], Iterable[dict[str, Any]]]) -> None:
    """Let both trees take turns on a curve; ``run`` has a contender of a tree measure it, and yields its lines."""
    sides = ((Tree(other), pair.theirs), (Tree(HERE.parent), pair.ours))
    for turn in range(rounds):
        for contender in STAGES:
            for tree, least in sides[:: 1 if turn % 2 else -1]:
                for line in run(tree, contender):
                    if "stage" in line:
                        least[line["stage"]] = min(line["seconds"], least.get(line["stage"], math.inf))


def table(pairs: Sequence[Pair]) -> str:
    """Return the ratio of every curve and stage, with this tree's milliseconds, and the mean of each stage."""
    stages = [stage for names in STAGES.values() for stage in names]
    rows = [[pair.family, f"{pair.vertices:,}", *(_cell(pair, stage) for stage in stages)] for pair in pairs]
    means = [number(_mean(pair.ratio(stage) for pair in pairs), 3) for stage in stages]
    return markdown(["family", "n", *stages], [*rows, ["geometric mean", "", *means]])


def _cell(pair: Pair, stage: str) -> str:
    ratio = pair.ratio(stage)
    return "–" if math.isnan(ratio) else f"{ratio:.2f} ({number(1000 * pair.ours[stage])} ms)"


def _mean(ratios: Iterator[float]) -> float | None:
    known = [ratio for ratio in ratios if not math.isnan(ratio)]
    return geometric_mean(known) if known else None
