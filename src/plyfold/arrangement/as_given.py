"""What people count in an arrangement whose points in contact were moved apart: the drawing as it was given."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrangement.noding import node_outline
from plyfold.arrays import Bools, Floats, Ints
from plyfold.outline.curve import Outline
from plyfold.predicates import orient

if TYPE_CHECKING:
    from plyfold.arrangement.arrangement import Arrangement

__all__ = ["contacts_of", "crossings_as_given", "given_windings"]


def given_windings(arrangement: Arrangement) -> Ints:
    """Return the winding number of each cell that was drawn, the unbounded one first.

    Where points in contact were moved apart, those are the cells of the points as given, as :func:`~plyfold.coverage`
    has them: strands that are run to and fro do not part cells.

    Examples
    --------
    >>> from plyfold import arrange
    >>> given_windings(arrange([(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)])).tolist()
    [0, 1, 1]
    """
    given = _given_otherwise(arrangement)
    return arrangement.winding if given is None else node_outline(given).winding


def _given_otherwise(arrangement: Arrangement) -> Outline | None:
    """Return the outline as given if points in contact were moved apart."""
    return None if arrangement.given is arrangement.outline else arrangement.given


def crossings_as_given(arrangement: Arrangement) -> int:
    """Return how often two edges of an outline cross inside both, where the points were given.

    Examples
    --------
    >>> from plyfold import arrange
    >>> eight_through_a_vertex = arrange([(0, 0), (1, 1), (2, 2), (2, 0), (0, 2)])
    >>> crossings_as_given(eight_through_a_vertex), eight_through_a_vertex.n_crossings
    (0, 1)
    """
    given = _given_otherwise(arrangement)
    if given is None:
        return arrangement.n_crossings
    first = arrangement.crossing_visits[arrangement.ccw[arrangement.crossing_visits]]
    one, other = (_ends(given, arrangement.visit_edge[visits]) for visits in (first, arrangement.partner[first]))
    return int(np.count_nonzero(_on_both_sides(*one, *other) & _on_both_sides(*other, *one)))


def _ends(outline: Outline, edge: Ints) -> tuple[Floats, Floats]:
    return outline.points[edge], outline.points[outline.next_point[edge]]


def _on_both_sides(a: Floats, b: Floats, p: Floats, q: Floats) -> Bools:
    """Tell whether p and q lie off the line through a and b, on different sides."""
    return np.asarray(orient(a, b, p) * orient(a, b, q) < 0)


def contacts_of(arrangement: Arrangement) -> list[list[float]]:
    """Return the places of points that lie on other edges or on each other, each once, from left to right.

    Examples
    --------
    >>> from plyfold import arrange
    >>> contacts_of(arrange([(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)]))
    [[1.0, 1.0]]
    """
    given = _given_otherwise(arrangement)
    return [] if given is None else np.unique(given.points[arrangement.contacts], axis=0).tolist()
