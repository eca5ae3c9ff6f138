"""Draw a counterpart of each figure of the paper, on curves of our own: ``python docs/figures_pictures.py``."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
from matplotlib.axes import Axes
from panels import IMAGES, panels, titled

import plyfold as pf
from plyfold import draw
from plyfold.colours import INK, OBSTRUCTION, PAPER, mix, sheet_colour
from plyfold.disk.motion import Motion
from plyfold.draw.canvas import line, polygon, write
from plyfold.draw.placement import Frame
from plyfold.gallery import CURVES
from plyfold.paper.collapsed import edge_collapsed_graph, linear_spanning_subtrees

DRAWING = (-90.0, 90.0)
PIXELS = 360


def arranged(name: str) -> pf.Arrangement:
    """Return a curve of the gallery with its cells."""
    return pf.arrange(CURVES[name].curve)


def views(panels: Iterator[Axes], name: str, directions: Sequence[tuple[float, float]], **options: str) -> None:
    """Draw a curve, and then its surface from several directions."""
    draw.plot_arrangement(arranged(name), next(panels))
    surface = pf.lift(CURVES[name].curve)
    for view in directions:
        draw.plot_surface(surface, next(panels), view=view, pixels=PIXELS, **options)


def on_the_way(surface: pf.Surface, times: Sequence[float], panels: Iterator[Axes], colours: str) -> None:
    """Draw the cloth seen from above at several times of its way from the round disk to the drawing."""
    motion = Motion(surface.unwrap())
    for time in times:
        cloth = replace(surface, vertices=motion.at(time, thickness=1.0))
        draw.plot_surface(cloth, next(panels), view=DRAWING, colours=colours, pixels=PIXELS)


# ---- section 1 -----------------------------------------------------------------------------------------------------


def figure_1() -> None:
    """Draw a curve and the surface over it from several directions."""
    with panels("figure-01", 1, 4, (12, 3.2)) as axes:
        views(axes, "knotted-ribbon", [(-72, 52), (10, 35), (150, 25)], colours="cloth")


def figure_2() -> None:
    """Draw a disk that slides over itself in the plane, and one that is turned over."""
    with panels("figure-02", 2, 4, (11, 5.4)) as axes:
        on_the_way(pf.lift(CURVES["horseshoe"].curve), (0.0, 0.4, 0.75, 1.0), axes, "cloth")
        angle = 0.05 + 2 * np.pi * np.arange(120) / 120
        x, y = np.cos(angle), np.sin(angle)
        for turned in (0.0, 0.3, 0.7, 1.0):
            twisted = np.column_stack([x, 0.75 * y * np.cos(np.pi / 2 * turned * (1 + x))])
            draw.plot_arrangement(twisted, next(axes))


def figure_3() -> None:
    """Draw a curve with two immersions, whole and in the middle."""
    with panels("figure-03", 2, 3, (10, 7.0)) as axes:
        immersions = list(pf.immersions(CURVES["milnor"].curve))
        for title, half in (("the curve", None), ("its middle, enlarged", 0.15)):
            for number, ax in enumerate((next(axes), next(axes), next(axes))):
                if number:
                    draw.plot_immersion(immersions[number - 1], ax)
                else:
                    draw.plot_arrangement(arranged("milnor"), ax)
                titled(ax, f"immersion {number}" if number and half is None else "" if number else title)
                if half is not None:
                    enlarge(ax, half)


def enlarge(ax: Axes, half: float) -> None:
    """Show the middle of a drawing only."""
    ax.set_aspect("equal", adjustable="box")
    ax.set(xlim=(-1.2 * half, 1.2 * half), ylim=(-half, half))
    for text in ax.texts:
        text.set_visible(bool(np.abs(text.get_position() / np.array([1.2, 1.0])).max() < half))


def figure_4() -> None:
    """Draw how a disk becomes a ribbon with two loops, and the surface over it."""
    with panels("figure-04", 1, 5, (13.5, 3.0)) as axes:
        surface = pf.lift(CURVES["two-loops"].curve)
        on_the_way(surface, (0.0, 0.35, 0.7, 1.0), axes, "sheets")
        draw.plot_surface(surface, next(axes), colours="sheets", pixels=PIXELS)


# ---- section 2 -----------------------------------------------------------------------------------------------------


def figure_5() -> None:
    """Draw a curve with its borders in colours, its crossings and winding numbers."""
    with panels("figure-05", 1, 1, (4.6, 4.6)) as axes:
        arrangement, ax = arranged("horseshoe"), next(axes)
        draw.plot_arrangement(arrangement, ax, borders=True)
        frame = Frame(arrangement.curve.points)
        for border in range(arrangement.n_borders):
            line(ax, frame(arrangement.border_points(border)), sheet_colour(border + 1), 4.0, zorder=2.5)


def figure_6() -> None:
    """Draw an immersion, the disk it comes from, the disk layout, and the sheets one by one."""
    with panels("figure-06", 1, 4, (13, 3.6)) as axes:
        surface = pf.lift(CURVES["exit-ramp"].curve)
        immersion = surface.layering.immersion
        titled(draw.plot_immersion(immersion, next(axes)), "the immersion")
        disk = next(axes)
        on_the_way(surface, (0.0,), iter([disk]), "sheets")
        titled(disk, "its disk, unwound")
        titled(draw.plot_layout(immersion, next(axes)), "the disk layout")
        sheets_apart(immersion, next(axes))


def sheets_apart(immersion: pf.Immersion, ax: Axes) -> None:
    """Draw every sheet by itself, moved away from the middle of the drawing."""
    arrangement = immersion.arrangement
    frame = Frame(arrangement.curve.points)
    for sheet, cell in enumerate(immersion.sheet_cell.tolist()):
        outline = frame(arrangement.cell_outline(cell))
        middle = outline.mean(axis=0)
        turn = (sheet - immersion.sheets[cell].start) * np.array([0.28, 0.0])
        away = outline + 0.45 * middle + turn
        polygon(ax, away, mix(sheet_colour(sheet), PAPER, 0.35), edgecolor=INK, linewidth=1.0)
    titled(ax, "its sheets")


def figure_7() -> None:
    """Draw the lists of the paper's procedure, and the disk layout as more and more cells are grouped."""
    with panels("figure-07", 2, 3, (11, 7.4)) as axes:
        immersion = pf.find_embedding(CURVES["smallest-unliftable"].curve).immersion
        arrangement = immersion.arrangement
        draw.plot_arrangement(arrangement, next(axes), borders=True)
        lists(arrangement, next(axes))
        layout = immersion.disk_layout()
        for deepest in range(1, 5):
            groups = [group for group in layout if arrangement.winding[group.cell] <= deepest]
            titled(draw.plot_layout(immersion, next(axes), groups=groups), f"winding number up to {deepest}")


def lists(arrangement: pf.Arrangement, ax: Axes) -> None:
    """Write the paper's three lists."""
    borders = range(arrangement.n_borders)
    winding = arrangement.winding[arrangement.left_cell].tolist()
    by_winding = sorted(borders, key=lambda border: winding[border])
    of_cell = [[b for b in borders if arrangement.left_cell[b] == c] for c in range(arrangement.n_cells)]
    rows = ["c:list", spaced(borders), "", "w:list", spaced(by_winding), "", "f:list"]
    rows += [f"cell {cell}:  {spaced(own)}" for cell, own in enumerate(of_cell) if own]
    write(ax, (0.0, 0.5), "\n".join(rows), 8.5, transform=ax.transAxes, ha="left", va="center", linespacing=1.5)


def spaced(numbers: Sequence[int]) -> str:
    """Return numbers in a row."""
    return " ".join(map(str, numbers))


def figure_8() -> None:
    """Write the sums over diagonal cells around a crossing of a curve that bounds no disk, and of one that does."""
    with panels("figure-08", 1, 2, (9, 4.4)) as axes:
        for name, title in (("figure-eight", "|1| + |−1| ≠ 0 + 0"), ("horseshoe", "2 + 0 = 1 + 1")):
            arrangement, ax = arranged(name), next(axes)
            draw.plot_arrangement(arrangement, ax)
            (place,) = Frame(arrangement.curve.points)(arrangement.crossings[0])
            ring = {"facecolors": "none", "edgecolors": OBSTRUCTION, "linewidths": 1.6, "zorder": 6}
            ax.scatter(*place, s=500, **ring)
            titled(ax, title)


def figure_9() -> None:
    """Mark what keeps curves from bounding a disk: a cell, or the crossing where a lobe is one too many."""
    with panels("figure-09", 1, 4, (13, 3.7)) as axes:
        for name in ("figure-eight", "kinked-circle", "limacon", "doubled-circle"):
            arrangement = arranged(name)
            draw.plot_obstruction(arrangement, pf.find_immersion(arrangement), ax=next(axes))


# ---- sections 3 and 4 ----------------------------------------------------------------------------------------------


def graph(immersion: pf.Immersion, cell: int, ax: Axes, layering: pf.Layering | None = None) -> None:
    """Draw the edge-collapsed graph of a cell, with a linear spanning subtree if it has one."""
    tree = next(iter(linear_spanning_subtrees(edge_collapsed_graph(immersion, cell))), ())
    draw.plot_collapsed_graph(immersion, cell, ax, layering=layering, tree=tree)


def deepest(immersion: pf.Immersion) -> int:
    """Return the cell with most nodes in its graph."""
    cells = range(1, immersion.arrangement.n_cells)
    return max(cells, key=lambda cell: len(edge_collapsed_graph(immersion, cell).nodes))


def unliftable_and_liftable() -> tuple[pf.Immersion, pf.Immersion]:
    """Return two immersions of the Bennequin-like curve."""
    both = sorted(pf.immersions(CURVES["bennequin"].curve), key=lambda each: bool(pf.find_layering(each)))
    return both[0], both[-1]


def figure_10() -> None:
    """Draw how the arcs of a cell collapse, in two immersions."""
    with panels("figure-10", 2, 3, (10.5, 7)) as axes:
        for immersion in unliftable_and_liftable():
            cell = deepest(immersion)
            draw.plot_marked_cell(immersion.arrangement, cell, next(axes))
            own = [group for group in immersion.disk_layout() if group.cell == cell]
            draw.plot_layout(immersion, next(axes), groups=own)
            graph(immersion, cell, next(axes))


def figure_11() -> None:
    """Draw a graph that is a path, with levels, and one that is a star."""
    with panels("figure-11", 1, 2, (7, 3.5)) as axes:
        star, path = unliftable_and_liftable()
        graph(path, deepest(path), next(axes), pf.find_layering(path))
        graph(star, deepest(star), next(axes))


def figure_12() -> None:
    """Draw cells and their graphs: two that are paths, and one cell whose graph depends on the immersion."""
    star, path = unliftable_and_liftable()
    ramps = [pf.find_immersion(CURVES[name].curve) for name in ("exit-ramp", "stacked-spiral")]
    columns = [*ramps, path, star]
    with panels("figure-12", 2, 4, (12, 6.2)) as axes:
        for immersion in columns:
            draw.plot_marked_cell(immersion.arrangement, deepest(immersion), next(axes))
        for immersion in columns:
            ax = next(axes)
            graph(immersion, deepest(immersion), ax)
            titled(ax, "lifts" if pf.find_layering(immersion) else "does not lift")


def figure_13() -> None:
    """Draw sketches and views of their surfaces."""
    with panels("figure-13", 4, 4, (10.5, 10)) as axes:
        for name in ("pentagram", "stacked-spiral", "smallest-unliftable", "pretzel"):
            views(axes, name, [(-72, 52), (15, 30), (140, 20)], colours="sheets")


if __name__ == "__main__":
    IMAGES.mkdir(exist_ok=True)
    for number in range(1, 14):
        globals()[f"figure_{number}"]()
