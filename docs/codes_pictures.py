"""Draw every closed plane curve with up to three crossings from its signed Gauss code, and a few larger ones."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain, permutations, product
from pathlib import Path

from matplotlib.figure import Figure

import plyfold as pf
from plyfold.arrangement.gauss import GaussCode
from plyfold.colours import INK
from plyfold.draw import plot_arrangement
from plyfold.draw.figures import save
from plyfold.errors import GaussCodeError
from plyfold.gallery import CURVES

HERE = Path(__file__).parent
COLUMNS = 9
LARGER = ("stacked-spiral", "milnor", "two-loops", "ten-gon", "bennequin", "knotted-ribbon", "pentagram", "pretzel")


def codes(crossings: int) -> Iterator[GaussCode]:
    """Yield every code: between the two visits of a crossing lies an even number of visits."""
    for odd in permutations(range(1, 2 * crossings, 2)):
        for signs in product((False, True), repeat=crossings):
            partner, ccw = [0] * (2 * crossings), [False] * (2 * crossings)
            for half, other in enumerate(odd):
                partner[2 * half], partner[other] = other, 2 * half
                ccw[2 * half], ccw[other] = signs[half], not signs[half]
            yield from _with_each_cell_outside(tuple(partner), tuple(ccw))


def _with_each_cell_outside(partner: tuple[int, ...], ccw: tuple[bool, ...]) -> Iterator[GaussCode]:
    for dart in range(2 * len(partner)):
        try:
            yield GaussCode(partner, ccw, dart)
        except GaussCodeError:
            return


def census(crossings: int) -> list[GaussCode]:
    """Return one code for each curve up to its start, reversal and reflection."""
    return sorted({code.canonical() for code in codes(crossings)}, key=str)


def sheet() -> None:
    """Draw all curves with one to three crossings, and the codes of some named curves below."""
    small = chain.from_iterable(census(k) for k in (1, 2, 3))
    panels = [(str(code).split(" /")[0], code) for code in small]
    panels += [(f"{name}, redrawn", GaussCode.of(CURVES[name].curve)) for name in LARGER]
    rows = -(-len(panels) // COLUMNS)
    figure = Figure(figsize=(1.9 * COLUMNS, 2.1 * rows), layout="tight")
    axes = figure.subplots(rows, COLUMNS).ravel()
    for ax in axes:
        ax.axis("off")
    for ax, (title, code) in zip(axes, panels, strict=False):
        plot_arrangement(pf.arrange(code.to_curve()), ax=ax)
        ax.set_title(title, fontsize=8, color=INK)
    save(figure, HERE / "images" / "codes.png", force=True)


if __name__ == "__main__":
    sheet()
