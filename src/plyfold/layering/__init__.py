"""Layerings: vertical orders of the sheets that lift an immersed disk into a layered surface (§3 of the paper)."""

from plyfold.layering.casing import embed_cased
from plyfold.layering.collapsed import (
    CollapsedGraph,
    edge_collapsed_graph,
    edge_collapsed_graphs,
    has_linear_spanning_subtrees,
)
from plyfold.layering.counting import count_layerings
from plyfold.layering.intersections import IntersectingLayering, least_intersecting_layering
from plyfold.layering.layering import Layering
from plyfold.layering.listing import layerings
from plyfold.layering.nicest import nicest_layering
from plyfold.layering.search import Progress, find_layering, first_layering

__all__ = [
    "CollapsedGraph",
    "IntersectingLayering",
    "Layering",
    "Progress",
    "count_layerings",
    "edge_collapsed_graph",
    "edge_collapsed_graphs",
    "embed_cased",
    "find_layering",
    "first_layering",
    "has_linear_spanning_subtrees",
    "layerings",
    "least_intersecting_layering",
    "nicest_layering",
]
