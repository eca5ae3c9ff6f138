"""Where the edges of an outline meet: its crossings and touches, in the outline's own numbers."""

from __future__ import annotations

from plyfold.arrangement.crossings import Contacts, Visits, find_contacts, order_visits
from plyfold.clock import UNWATCHED, Watch
from plyfold.outline.curve import Outline

__all__ = ["meetings", "visits_along"]


def meetings(outline: Outline, watch: Watch = UNWATCHED) -> Contacts:
    """Return the pairs of edges of an outline that cross, and the vertices that lie on foreign edges."""
    return find_contacts(outline.points, watch, outline.first_point)


def visits_along(outline: Outline, contacts: Contacts) -> Visits:
    """Return the visits of an outline to its crossings, in order along one loop after the other."""
    return order_visits(outline.points, contacts, outline.first_point)
