"""Pictures of edge-collapsed graphs, as the paper's figures 10 to 12."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrays import Floats
from plyfold.draw.colours import INK, OBSTRUCTION, PAPER, mix, sheet_colour, text_colour
from plyfold.draw.hyperbolic import BorderCircle
from plyfold.draw.places import middle_and_size
from plyfold.draw.plots import _blank, _dots, _line, _polygon, _text, plot_arrangement
from plyfold.layering.collapsed import CollapsedGraph, Edge, edge_collapsed_graph

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from plyfold.arrangement import Arrangement
    from plyfold.immersion import Immersion
    from plyfold.layering import Layering

__all__ = ["plot_collapsed_graph", "plot_marked_cell"]


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
    Sheets have the colours of :func:`~plyfold.draw.plots.plot_disk_layout`.

    Parameters
    ----------
    immersion : Immersion
    cell : int
    ax : matplotlib Axes, optional
        Where to draw; by default on a new figure.
    layering : Layering, optional
        Write the levels into the nodes instead of the sheets' numbers, as in the paper's figure 11.
    tree : collection of (int, int)
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
    axes = _blank(ax)
    graph = edge_collapsed_graph(immersion, cell)
    places = _places(graph)
    _line(axes, BorderCircle(1).arc(0), mix(INK, PAPER, 0.8), 0.8)
    _borders(axes, graph, places)
    for edge in graph.edges:
        chosen = edge in tree
        ends = np.stack([places[sheet] for sheet in edge])
        _line(axes, ends, INK if chosen or not tree else mix(INK, PAPER, 0.6), 4.0 if chosen else 1.6, zorder=3)
    for sheet, place in places.items():
        colour = sheet_colour(sheet)
        _dots(axes, place[None], colour, 300, edgecolors=INK, linewidths=1.2, zorder=4)
        label = f"{sheet if layering is None else layering.level[sheet]}"
        _text(axes, place, label, 9.5, color=text_colour(colour), zorder=5)
    axes.update_datalim([(-1.2, -1.2), (1.2, 1.2)])
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
    >>> from plyfold import arrangement
    >>> ax = plot_marked_cell(arrangement([(0, 0), (2, 2), (2, 0), (0, 2)]), cell=1)
    >>> len(ax.patches) > 0
    True
    """
    axes = plot_arrangement(arrangement, ax)
    assert arrangement.curve is not None, "plot_arrangement has refused it"
    middle, size = middle_and_size(arrangement.curve.points)
    outline = (arrangement.cell_outline(cell) - middle) / size
    _polygon(axes, outline, OBSTRUCTION, alpha=0.45, zorder=1.5)
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
            _line(axes, spoke, mix(colour, PAPER, 0.55), 1.6, zorder=2)
            _line(axes, circle.arc(number[border]), colour, 5.0)
            _text(axes, circle.middle(number[border], 1.14), str(border), 8.5)
