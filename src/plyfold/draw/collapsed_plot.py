"""Pictures of edge-collapsed graphs, as the paper's figures 10 to 12."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrays import Floats
from plyfold.colours import INK, OBSTRUCTION, PAPER, mix, sheet_colour, text_colour
from plyfold.draw.arrangement_plot import plot_arrangement
from plyfold.draw.canvas import blank, dots, grid, line, note_below, region, write
from plyfold.draw.placement import BorderCircle, Frame, cell_rings, drawn_points
from plyfold.options import refuse_unless_count
from plyfold.paper.collapsed import (
    CollapsedGraph,
    Edge,
    edge_collapsed_graph,
    edge_collapsed_graphs,
    linear_spanning_subtrees,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from plyfold.arrangement.arrangement import Arrangement
    from plyfold.immersion.immersion import Immersion
    from plyfold.layering.layering import Layering

__all__ = ["plot_collapsed_graph", "plot_collapsed_graphs", "plot_marked_cell"]


def plot_collapsed_graph(
    immersion: Immersion,
    cell: int,
    ax: Axes | None = None,
    *,
    layering: Layering | None = None,
    tree: Collection[Edge] = (),
) -> Axes:
    """Draw the edge-collapsed graph of a cell: one node for each sheet with own borders (§3.1 of [MGR11]_).

    Round it stand the cell's own borders in order, numbered; pale lines show which node each has collapsed into.
    Sheets have the colours of :func:`~plyfold.draw.plot_layout`.

    Parameters
    ----------
    immersion : Immersion
    cell : int
    ax : matplotlib Axes, optional
        Where to draw; by default on a new figure.
    layering : Layering, optional
        Write the levels into the nodes instead of the sheets' numbers, as in the paper's figure 11.
    tree : collection of (int, int), optional
        Edges to draw heavy: a spanning tree.

    Returns
    -------
    matplotlib Axes

    References
    ----------
    .. [MGR11] U. Mukherjee, M. Gopi, J. Rossignac, "Immersion and Embedding of Self-Crossing Loops",
       Sketch-Based Interfaces and Modeling, 2011.

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> ax = plot_collapsed_graph(find_immersion([(0, 0), (1, 0), (0, 1)]), cell=1)
    >>> [text.get_text() for text in ax.texts]
    ['0', '0']
    """
    axes = blank(ax)
    graph = edge_collapsed_graph(immersion, cell)
    places = _places(graph)
    line(axes, BorderCircle(1).arc(0), mix(INK, PAPER, 0.8), 0.8)
    _borders(axes, graph, places)
    for edge in graph.edges:
        chosen = edge in tree
        ends = np.stack([places[sheet] for sheet in edge])
        line(axes, ends, INK if chosen or not tree else mix(INK, PAPER, 0.6), 4.0 if chosen else 1.6, zorder=3)
    for sheet, place in places.items():
        colour = sheet_colour(sheet)
        dots(axes, place[None], colour, 300, edgecolors=INK, linewidths=1.2, zorder=4)
        label = f"{sheet if layering is None else layering.level[sheet]}"
        write(axes, place, label, 9.5, color=text_colour(colour), zorder=5)
    axes.update_datalim([(-1.2, -1.2), (1.2, 1.2)])
    return axes


def plot_collapsed_graphs(
    immersion: Immersion, ax: Axes | None = None, *, layering: Layering | None = None, most: int = 4
) -> Axes:
    """Draw the edge-collapsed graphs of the deepest cells, each under a drawing that marks the cell.

    A linear spanning subtree is heavy, where there is one.

    Parameters
    ----------
    immersion : Immersion
        Of a drawing.
    ax : matplotlib Axes, optional
        Where to draw; by default on a new figure. Each picture gets axes of its own inside these (``ax.child_axes``).
    layering : Layering, optional
        Write the levels into the nodes instead of the sheets' numbers.
    most : int, optional
        How many cells to draw; if more have a graph, a note says so.

    Returns
    -------
    matplotlib Axes

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> from plyfold.gallery import CURVES
    >>> ax = plot_collapsed_graphs(find_immersion(CURVES["exit-ramp"].curve), most=2)
    >>> len(ax.child_axes)
    4
    """
    graphs = [graph for graph in edge_collapsed_graphs(immersion) if graph.nodes]
    refuse_unless_count("most", most)
    deepest = sorted(graphs, key=lambda graph: -len(graph.nodes))[:most]
    axes = blank(ax, (3.2 * len(deepest), 6.4))
    for above, below, graph in zip(*grid(axes, 2, len(deepest)), deepest, strict=True):
        plot_marked_cell(immersion.arrangement, graph.cell, above)
        tree = next(iter(linear_spanning_subtrees(graph)), ())
        plot_collapsed_graph(immersion, graph.cell, below, layering=layering, tree=tree)
    if len(graphs) > len(deepest):
        note_below(axes, f"the {len(deepest)} deepest of {len(graphs)} cells")
    return axes


def plot_marked_cell(arrangement: Arrangement, cell: int, ax: Axes | None = None) -> Axes:
    """Draw the curve with one cell marked in red, as in the paper's figure 12.

    Parameters
    ----------
    arrangement : Arrangement
        With a drawing.
    cell : int
        A bounded cell.
    ax : matplotlib Axes, optional
        Where to draw; by default on a new figure.

    Returns
    -------
    matplotlib Axes

    Examples
    --------
    >>> from plyfold import arrange
    >>> ax = plot_marked_cell(arrange([(0, 0), (2, 2), (2, 0), (0, 2)]), cell=1)
    >>> len(ax.patches) > 0
    True
    """
    axes = plot_arrangement(arrangement, ax)
    frame = Frame(drawn_points(arrangement))
    region(axes, cell_rings(arrangement, cell, frame), OBSTRUCTION, alpha=0.45, zorder=1.5)
    return axes


def _places(graph: CollapsedGraph) -> dict[int, Floats]:
    """Return where the nodes are drawn: each in the middle of its borders, which stand round a circle."""
    circle, number = _circle(graph)
    inward = 0.8 if len(graph.nodes) > 1 else 0.0
    return {
        node.sheet: inward * np.mean([circle.middle(number[border]) for border in node.borders], axis=0)
        for node in graph.nodes
    }


def _circle(graph: CollapsedGraph) -> tuple[BorderCircle, dict[int, int]]:
    """Return a circle for the cell's own borders alone, and the place of each on it."""
    borders = sorted(border for node in graph.nodes for border in node.borders)
    return BorderCircle(max(len(borders), 1)), {border: place for place, border in enumerate(borders)}


def _borders(axes: Axes, graph: CollapsedGraph, places: dict[int, Floats]) -> None:
    circle, number = _circle(graph)
    for node in graph.nodes:
        colour = sheet_colour(node.sheet)
        for border in node.borders:
            spoke = np.stack([places[node.sheet], circle.middle(number[border])])
            line(axes, spoke, mix(colour, PAPER, 0.55), 1.6, zorder=2)
            line(axes, circle.arc(number[border]), colour, 5.0)
            write(axes, circle.middle(number[border], 1.14), str(border), 8.5)
