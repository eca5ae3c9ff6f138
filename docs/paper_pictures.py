"""Rebuild the pictures and the random-disk figures of docs/paper.md: ``python docs/paper_pictures.py`` (a minute)."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

import plyfold as pf
from plyfold.colours import ACCENT, INK, PAPER, mix, sheet_colour, winding_colour
from plyfold.draw import plot_arrangement
from plyfold.draw.figures import save
from plyfold.draw.placement import BorderCircle, border_middle
from plyfold.gallery import chain
from plyfold.paper import procedure
from plyfold.paper.procedure import PaperRun, Reading, run_paper

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT / "tests"))

from reference.random_curves import MILNOR_LIKE, glued_disk, ribbon_outline  # noqa: E402

IMAGES = ROOT / "docs" / "images"
READINGS: tuple[Reading, ...] = ("literal", "repaired")
LIMACON = ([1, 0], [True, False], 1)
FIRST_FAILURE = ([3, 2, 1, 0, 5, 4, 7, 6], [1, 1, 0, 0, 1, 0, 1, 0], 3)
REPAIRED_FAILURE = (
    [9, 6, 7, 8, 19, 10, 1, 2, 3, 0, 5, 18, 15, 16, 17, 12, 13, 14, 11, 4],
    [1, 0, 1, 0, 0, 1, 1, 0, 1, 0, 0, 1, 1, 0, 1, 0, 1, 0, 0, 1],
    17,
)
FAMILIES: dict[str, tuple[Callable[..., Any], Sequence[int]]] = {
    "ribbons": (ribbon_outline, (12, 25, 50, 100, 200, 400, 800)),
    "dense disks": (glued_disk, (8, 16, 32, 64, 128, 256)),
}
PER_SIZE = 20


class Trial(NamedTuple):
    """One reading on one random disk."""

    crossings: int
    calls: int
    found: bool


def failure(name: str, code: tuple[list[int], list[int], int], reading: Reading) -> None:
    """Draw a curve that bounds one disk and that a reading gets wrong: its groups, and those of the immersion."""
    curve = pf.GaussCode(*code).to_curve()
    arranged = pf.arrange(curve)
    figure = Figure(figsize=(16.5, 4.8), layout="constrained")
    drawing, detail, wrong, right = figure.subplots(1, 4)
    plot_arrangement(arranged, ax=drawing, borders=True)
    plot_arrangement(arranged, ax=detail)
    drawing.set_title(f"{arranged.n_crossings} crossings, one immersion", pad=14)
    window = _window(arranged)
    _number_borders(detail, arranged, 0.09 * window[2])
    _enlarge(detail, drawing, *window)
    detail.set_title("its smallest cells, enlarged", pad=14)
    _draw_groups(wrong, run_paper(arranged, reading).groups)
    wrong.set_title(f"the groups of the {reading} reading", pad=14)
    _draw_groups(right, tuple(group.borders for group in pf.find_immersion(curve).disk_layout()))
    right.set_title("the groups of the immersion", pad=14)
    save(figure, IMAGES / name, force=True)


def accepted() -> None:
    """Draw the limaçon, which the pseudo-code accepts without a test of the turning number, and its groups."""
    curve = pf.GaussCode(*LIMACON).to_curve()
    figure = Figure(figsize=(8.6, 4.4), layout="constrained")
    drawing, groups = figure.subplots(1, 2)
    plot_arrangement(pf.arrange(curve), ax=drawing, borders=True)
    drawing.set_title("Pascal's limaçon turns twice")
    _draw_groups(groups, run_paper(pf.arrange(curve)).groups)
    groups.set_title("one group in each cell: no error")
    save(figure, IMAGES / "paper-limacon.png", force=True)


def _window(arranged: pf.Arrangement) -> tuple[float, float, float]:
    """Return middle and half the width of a square around the three smallest cells, in units of the drawing's size."""
    outlines = [arranged.cell_outline(cell) for cell in range(1, arranged.n_cells)]
    small = np.concatenate(sorted(outlines, key=lambda outline: float(np.ptp(outline, axis=0).max()))[:3])
    low, high = arranged.curve.points.min(axis=0), arranged.curve.points.max(axis=0)
    places = (small - (low + high) / 2) / (high - low).max()
    x, y = (places.min(axis=0) + places.max(axis=0)) / 2
    return float(x), float(y), 0.65 * float(np.ptp(places, axis=0).max())


def _number_borders(axes: Any, arranged: pf.Arrangement, distance: float) -> None:
    """Write the numbers of the borders beside them, in units of the drawing's size: on the right, if there is room."""
    taken = [text.get_position() for text in axes.texts]
    low, high = arranged.curve.points.min(axis=0), arranged.curve.points.max(axis=0)
    for border in range(arranged.n_borders):
        place, (dx, dy) = border_middle(arranged.border_points(border))
        middle = (np.asarray(place) - (low + high) / 2) / (high - low).max()
        sides = [middle + far * distance * np.array([dy, -dx]) for far in (1, -0.6, 0.6, -1)]
        room = [min(np.hypot(*(side - other)) for other in taken) for side in sides]
        chosen = next((side for side, free in zip(sides, room, strict=True) if free > 0.9 * distance), None)
        x, y = sides[int(np.argmax(room))] if chosen is None else chosen
        taken.append((x, y))
        axes.text(x, y, str(border), fontsize=7, ha="center", va="center")


def _enlarge(detail: Any, drawing: Any, x: float, y: float, half: float) -> None:
    """Show only the window in one picture; in the other mark it, and leave out the small numbers inside it."""
    detail.set_aspect("equal", adjustable="box")
    detail.set(xlim=(x - half, x + half), ylim=(y - half, y + half))
    for text in detail.texts:
        across, up = text.get_position()
        text.set_visible(max(abs(across - x), abs(up - y)) < 0.93 * half)
    drawing.add_patch(Rectangle((x - half, y - half), 2 * half, 2 * half, fill=False, edgecolor=ACCENT, linewidth=0.8))
    for text in drawing.texts:
        across, up = text.get_position()
        if text.get_fontsize() < 7 and max(abs(across - x), abs(up - y)) < half:
            text.set_visible(False)


def _draw_groups(axes: Any, groups: Sequence[Sequence[int]]) -> None:
    """Draw a disk layout that need not belong to an immersion: each group a region, with arcs between its borders."""
    axes.set_aspect("equal")
    axes.set_axis_off()
    circle = BorderCircle(sum(map(len, groups)))
    axes.fill(*BorderCircle(1).arc(0).T, color=mix(winding_colour(1), PAPER, 0.45))
    for number, group in enumerate(groups):
        colour = sheet_colour(number)
        region = circle.region(group)
        axes.fill(*region.T, color=mix(colour, "#ffffff", 0.62))
        for border, other in zip(group, [*group[1:], group[0]], strict=True):
            axes.plot(*circle.join(border, other).T, color=mix(colour, INK, 0.15), linewidth=1.5)
        for border in group:
            axes.plot(*circle.arc(border, 1.02).T, color=colour, linewidth=5)
            axes.text(*circle.middle(border, 1.13), str(border), ha="center", va="center")


def calls() -> None:
    """Draw and print the calls of PROCESS and RECURSE on random disks, and the number of immersions of chains."""
    figure = Figure(figsize=(13, 4.2), layout="constrained")
    *families, chains = figure.subplots(1, 3)
    for axes, name in zip(families, FAMILIES, strict=True):
        for reading, colour in zip(READINGS, (ACCENT, INK), strict=True):
            by_size = list(_by_size(name, reading))
            _print_table(name, reading, by_size)
            _scatter(axes, [trial for trials in by_size for trial in trials], colour, reading)
        axes.set(xscale="log", yscale="log", xlabel="crossings k", ylabel="calls", title=name)
        axes.legend(frameon=False)
    _draw_chains(chains)
    save(figure, IMAGES / "paper-calls.png", force=True)


def _by_size(name: str, reading: Reading) -> Iterator[list[Trial]]:
    outline, sizes = FAMILIES[name]
    for size in sizes:
        rng = np.random.default_rng(size)
        yield [_trial(pf.arrange(outline(rng, size)), reading) for _ in range(PER_SIZE)]


def _trial(arranged: pf.Arrangement, reading: Reading) -> Trial:
    run: PaperRun = run_paper(arranged, reading)
    found = run.stuck_at is None and bool(procedure.find_immersion(arranged, reading))
    return Trial(arranged.n_crossings, run.calls, found)


def _print_table(name: str, reading: Reading, by_size: list[list[Trial]]) -> None:
    for trials in by_size:
        crossings = float(np.mean([trial.crossings for trial in trials]))
        per_border = [trial.calls / max(2 * trial.crossings, 1) for trial in trials]
        found = sum(trial.found for trial in trials)
        print(
            f"{name:12} {reading:9} k ≈ {crossings:6.0f}  found {found:2} of {len(trials)}"
            f"  calls per border: median {np.median(per_border):5.2f}, most {max(per_border):6.2f}"
        )


def _scatter(axes: Any, trials: list[Trial], colour: str, reading: Reading) -> None:
    for found, marker in ((True, "o"), (False, "x")):
        chosen = [trial for trial in trials if trial.found == found and trial.crossings]
        label = f"{reading}, {'found' if found else 'failed'}"
        across, up = [trial.crossings for trial in chosen], [trial.calls for trial in chosen]
        axes.scatter(across, up, s=14, marker=marker, color=colour, alpha=0.6, label=label)


def _draw_chains(axes: Any) -> None:
    links = range(1, 41)
    arranged = [pf.arrange(chain(MILNOR_LIKE, number)) for number in links]
    crossings = np.array([each.n_crossings for each in arranged])
    axes.plot(crossings, [float(pf.count_immersions(each)) for each in arranged], color=ACCENT, label="immersions")
    axes.plot(crossings, crossings.astype(float) ** 2, color=INK, label="k²")
    axes.set(yscale="log", xlabel="crossings k", title="chains of Milnor-like loops")
    axes.legend(frameon=False)


if __name__ == "__main__":
    failure("paper-first-failure.png", FIRST_FAILURE, "literal")
    failure("paper-repaired-failure.png", REPAIRED_FAILURE, "repaired")
    accepted()
    calls()
