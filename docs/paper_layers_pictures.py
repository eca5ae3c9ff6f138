"""Rebuild the pictures and the tables of docs/paper-layers.md: ``python docs/paper_layers_pictures.py`` (two minutes).

With the word ``census`` the pictures stay as they are, and the curves with up to eight crossings are counted, too
(some five minutes more).
"""

from __future__ import annotations

import cmath
import math
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from itertools import islice, pairwise
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

import plyfold as pf
from plyfold.draw import plot_arrangement, plot_collapsed_graph, plot_layout, plot_marked_cell, plot_obstruction
from plyfold.draw.figures import save
from plyfold.gallery import CURVES
from plyfold.hard.flaps import PALEY, flap_disk
from plyfold.hard.formulas import formula_disk
from plyfold.paper import layering as paper
from plyfold.paper.collapsed import (
    edge_collapsed_graph,
    edge_collapsed_graphs,
    has_linear_spanning_subtrees,
    linear_spanning_subtrees,
)

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT / "tests"))

from paper.test_layering import LIFTS_ANOTHER_WAY, eight_crossings  # noqa: E402
from reference.planar_maps import census, may_bound_disk  # noqa: E402
from reference.random_curves import angle, glued_disk, ribbon_outline  # noqa: E402

IMAGES = ROOT / "docs" / "images"
PER_FAMILY = 2000
IMMERSIONS_TRIED = 50
FANO = [(1, 2, 3), (1, 4, 5), (1, 6, 7), (2, 4, 6), (2, 5, 7), (3, 4, 7), (3, 5, 6)]


# ---- pictures ------------------------------------------------------------------------------------------------------


def named_immersions(name: str) -> list[pf.Immersion]:
    """Return the immersions of a curve of the gallery, those that do not lift first."""
    return sorted(pf.immersions(CURVES[name].curve), key=lambda immersion: bool(pf.find_layering(immersion)))


def draw_graph(axes: Any, immersion: pf.Immersion, cell: int, layering: pf.Layering | None = None) -> None:
    """Draw the graph of a cell: with a linear spanning subtree if it has one, or the path that a layering takes."""
    graph = edge_collapsed_graph(immersion, cell)
    if layering is None:
        tree = next(iter(linear_spanning_subtrees(graph)), ())
    else:
        upward = sorted((node.sheet for node in graph.nodes), key=lambda sheet: layering.level[sheet])
        tree = [(min(pair), max(pair)) for pair in pairwise(upward)]
    plot_collapsed_graph(immersion, cell, axes, layering=layering, tree=tree)


def collapse() -> None:
    """Draw how a disk layout collapses, for the cell in the middle of the Bennequin-like curve, in two immersions."""
    immersions = named_immersions("bennequin")
    figure = Figure(figsize=(15, 7.2), layout="constrained")
    for row, immersion, words in zip(
        figure.subplots(2, 3), (immersions[0], immersions[-1]), ("does not lift", "lifts"), strict=True
    ):
        cell = int(immersion.arrangement.winding.argmax())
        plot_marked_cell(immersion.arrangement, cell, row[0])
        plot_layout(immersion, row[1])
        draw_graph(row[2], immersion, cell)
        path = edge_collapsed_graph(immersion, cell).has_linear_spanning_subtree
        titles = (
            "a cell with four sheets",
            f"an immersion that {words}",
            "its graph: a path" if path else "its graph: a star",
        )
        for axes, title in zip(row, titles, strict=True):
            axes.set_title(title)
    save(figure, IMAGES / "paper-layers-collapse.png", force=True)


def followed() -> None:
    """Draw cells of curves that lift, as the paper's figure 12, with the levels that follow their graphs."""
    figure = Figure(figsize=(15, 7.2), layout="constrained")
    for column, name in zip(figure.subplots(2, 4).T, ("exit-ramp", "stacked-spiral", "milnor", "ten-gon"), strict=True):
        immersion = named_immersions(name)[-1]
        layering = paper.find_layering(immersion)
        cell = max(range(immersion.arrangement.n_cells), key=lambda c: len(edge_collapsed_graph(immersion, c).nodes))
        plot_marked_cell(immersion.arrangement, cell, column[0])
        draw_graph(column[1], immersion, cell, layering)
        column[0].set_title(name)
        column[1].set_title("levels")
    save(figure, IMAGES / "paper-layers-followed.png", force=True)


def counterexample() -> None:
    """Draw the smallest curve on which the lemma fails: itself, its two layouts, its graphs, the chain of sheets."""
    refused, lifted = named_immersions("smallest-unliftable")
    figure = Figure(figsize=(16.5, 5.2), layout="constrained")
    drawing, first, second = figure.subplots(1, 3, width_ratios=(1.3, 1, 1))
    plot_arrangement(refused.arrangement, drawing, borders=True)
    drawing.set_title("eight crossings, two immersions")
    for axes, immersion, words in ((first, refused, "does not lift"), (second, lifted, "lifts")):
        plot_layout(immersion, axes)
        axes.set_title(f"the immersion that {words}")
    save(figure, IMAGES / "paper-layers-counterexample.png", force=True)
    graphs_of_every_cell(refused, lifted)
    chain = Figure(figsize=(9, 8.5), layout="constrained")
    plot_obstruction(refused, pf.find_layering(refused), chain.subplots())
    save(chain, IMAGES / "paper-layers-chain.png", force=True)


def graphs_of_every_cell(*immersions: pf.Immersion) -> None:
    """Draw the graphs of all cells that have nodes, a row for each immersion."""
    cells = [graph.cell for graph in edge_collapsed_graphs(immersions[0]) if graph.nodes]
    figure = Figure(figsize=(2.9 * len(cells), 9.5), layout="constrained")
    rows = figure.subplots(3, len(cells))
    for axes, cell in zip(rows[0], cells, strict=True):
        plot_marked_cell(immersions[0].arrangement, cell, axes)
        axes.set_title(f"cell {cell}")
    for row, immersion in zip(rows[1:], immersions, strict=True):
        lifts = "lifts" if pf.find_layering(immersion) else "does not lift"
        row[0].set_title(lifts, loc="left", weight="bold")
        for axes, cell in zip(row, cells, strict=True):
            draw_graph(axes, immersion, cell)
    save(figure, IMAGES / "paper-layers-graphs.png", force=True)


def another_way() -> None:
    """Draw the disk that lifts, but not along linear spanning subtrees: the cell that cannot follow any of its own."""
    (immersion,) = pf.immersions(pf.GaussCode(*LIFTS_ANOTHER_WAY).to_curve())
    (cell,) = paper.find_layering(immersion).value
    figure = Figure(figsize=(16, 4.6), layout="constrained")
    drawing, layout, graph = figure.subplots(1, 3)
    plot_arrangement(immersion.arrangement, drawing, borders=True)
    drawing.set_title("eight crossings, one immersion")
    plot_layout(immersion, layout)
    layout.set_title("its disk layout")
    plot_collapsed_graph(immersion, cell, graph, layering=pf.find_layering(immersion))
    graph.set_title("the graph of the deepest cell, and levels")
    save(figure, IMAGES / "paper-layers-another-way.png", force=True)


# ---- tables --------------------------------------------------------------------------------------------------------


COLUMNS: dict[str, Callable[[bool, bool, bool], bool]] = {
    "number": lambda linear, lifts, found: True,
    "linear, lift": lambda linear, lifts, found: linear and lifts,
    "found": lambda linear, lifts, found: linear and found,
    "linear, do not lift": lambda linear, lifts, found: linear and not lifts,
    "not linear, lift": lambda linear, lifts, found: not linear and lifts,
    "found along trees": lambda linear, lifts, found: not linear and found,
    "not linear, do not lift": lambda linear, lifts, found: not linear and not lifts,
}


def table(families: Iterable[tuple[str, Iterable[pf.Immersion]]]) -> None:
    """Print how the lemma's condition, the exact verdict and the paper's way agree, a line for each family."""
    print("| immersions of |", " | ".join(COLUMNS), "|")
    for name, immersions in families:
        counts = Counter(map(verdicts, immersions))
        cells = [sum(n for case, n in counts.items() if belongs(*case)) for belongs in COLUMNS.values()]
        print("|", " | ".join(map(str, (name, *cells))), "|", flush=True)


def verdicts(immersion: pf.Immersion) -> tuple[bool, bool, bool]:
    """Return whether all cells have linear spanning subtrees, whether it lifts, and whether the paper's way sees it."""
    linear = all(has_linear_spanning_subtrees(immersion).values())
    return linear, bool(pf.find_layering(immersion)), bool(paper.find_layering(immersion))


def of_codes(codes: Iterable[Any]) -> Iterator[pf.Immersion]:
    """Yield all immersions of curves given by codes."""
    return (immersion for code in codes for immersion in pf.immersions(pf.Arrangement.from_gauss(*code)))


def of_polygons(seed: int, outline: Callable[[np.random.Generator], Any], number: int) -> Iterator[pf.Immersion]:
    """Yield immersions of random curves, up to fifty of each."""
    rng = np.random.default_rng(seed)
    for _ in range(number):
        yield from islice(pf.immersions(pf.arrange(outline(rng))), IMMERSIONS_TRIED)


def symmetric_disk(rng: np.random.Generator, order: int, triangles: int) -> list[tuple[float, float]]:
    """Return the outline of a disk glued from triangles round a regular polygon, the same after a turn by 1 / order."""
    turn = cmath.exp(2j * math.pi / order)
    part, angles = [1 + 0j], [math.pi * (1 - 2 / order)]
    while len(part) <= triangles:
        i = int(rng.integers(len(part)))
        j = (i + 1) % len(part)
        u, v, apex = part[i], part[j] if j else part[0] * turn, 2 * complex(*rng.normal(size=2))
        at_u, at_v = _angle(apex, u, v), _angle(u, v, apex)
        sums = {i: angles[i] + at_u + (at_v if i == j else 0)} | ({j: angles[j] + at_v} if i != j else {})
        if ((apex - u) * (v - u).conjugate()).imag < 0 and max(sums.values()) < 1.99 * math.pi:
            for corner, total in sums.items():
                angles[corner] = total
            part.insert(i + 1, apex)
            angles.insert(i + 1, _angle(u, apex, v))
    return [(p.real, p.imag) for step in range(order) for p in np.array(part) * turn**step]


def _angle(p: complex, q: complex, r: complex) -> float:
    return angle(*((z.real, z.imag) for z in (p, q, r)))


def random_flaps(seed: int, number: int) -> Iterator[pf.Immersion]:
    """Yield disks with three to six flaps that cover each other's handles at random."""
    rng = np.random.default_rng(seed)
    for _ in range(number):
        n = int(rng.integers(3, 7))
        covers = rng.random((n, n)) < 0.4
        yield flap_disk(n, [(i, j) for i in range(n) for j in range(n) if i != j and covers[i, j]]).immersion


def hard_families() -> Iterator[tuple[str, Iterable[pf.Immersion]]]:
    """Yield the families that were built to be hard, and random ones to compare."""
    for name in ("milnor", "ten-gon", "smallest-unliftable", "bennequin"):
        yield name, named_immersions(name)
    yield "random ribbons", of_polygons(1, lambda rng: ribbon_outline(rng, int(rng.integers(10, 120))), 200)
    yield "random dense disks", of_polygons(2, lambda rng: glued_disk(rng, int(rng.integers(10, 60))), 200)
    for order in (3, 4, 5):
        yield (
            f"symmetric, order {order}",
            of_polygons(order, lambda rng, n=order: symmetric_disk(rng, n, int(rng.integers(4, 7))), PER_FAMILY),
        )
    yield "random flaps", random_flaps(6, 100)
    yield "Paley's seven flaps", [flap_disk(7, PALEY).immersion]
    yield "Fano's formula", [formula_disk(FANO).disk.immersion]


if __name__ == "__main__":
    if sys.argv[1:] == ["census"]:
        for_k = {k: filter(may_bound_disk, census(k)) for k in (0, 2, 4, 6)} | {8: eight_crossings()}
        table((f"{k} crossings", of_codes(codes)) for k, codes in for_k.items())
    else:
        collapse()
        followed()
        counterexample()
        another_way()
    table(hard_families())
