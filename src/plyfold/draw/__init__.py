"""Pictures of every stage, and the self-contained 3D page.

The functions below draw with matplotlib, each on axes of your own, ``ax=``, or on a new figure, and return the axes;
``plyfold.draw.save(ax.figure, "loop.pdf")`` writes a file. New figures are not registered with pyplot; a notebook shows
them, and their axes, as the last line of a cell. In all of them a sheet has the same colour. ``svg`` draws an
arrangement by hand for notebooks, ``over_under`` layers from above as SVG and TikZ, ``viewer`` makes one HTML file that
shows a surface, and ``colours`` is the one place that chooses colours.

>>> from plyfold import draw
>>> from plyfold.gallery import CURVES
>>> ax = draw.plot_arrangement(CURVES["exit-ramp"].curve, borders=True)
>>> ax.figure.get_size_inches().tolist()
[5.0, 5.0]
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from plyfold.draw.arrangement_plot import plot_arrangement
    from plyfold.draw.collapsed_plot import plot_collapsed_graph, plot_collapsed_graphs, plot_marked_cell
    from plyfold.draw.figures import overview, save
    from plyfold.draw.immersion_plot import plot_immersion, plot_immersions
    from plyfold.draw.layers_plot import plot_casing, plot_layers
    from plyfold.draw.layout_plot import plot_layout
    from plyfold.draw.obstruction_plot import plot_obstruction
    from plyfold.draw.surface_plot import plot_surface

__all__ = [
    "overview",
    "plot_arrangement",
    "plot_casing",
    "plot_collapsed_graph",
    "plot_collapsed_graphs",
    "plot_immersion",
    "plot_immersions",
    "plot_layers",
    "plot_layout",
    "plot_marked_cell",
    "plot_obstruction",
    "plot_surface",
    "save",
]

_ROOMS = {
    "arrangement_plot": ("plot_arrangement",),
    "collapsed_plot": ("plot_collapsed_graph", "plot_collapsed_graphs", "plot_marked_cell"),
    "figures": ("overview", "save"),
    "immersion_plot": ("plot_immersion", "plot_immersions"),
    "layers_plot": ("plot_casing", "plot_layers"),
    "layout_plot": ("plot_layout",),
    "obstruction_plot": ("plot_obstruction",),
    "surface_plot": ("plot_surface",),
}


def __getattr__(name: str) -> Any:
    # Pictures need every other room, and some of those need colours: so the functions are fetched when asked for.
    for room, names in _ROOMS.items():
        if name in names:
            return getattr(import_module(f"plyfold.draw.{room}"), name)
    raise AttributeError(f"module 'plyfold.draw' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
