"""Arrangements as codes that the references understand."""

from itertools import pairwise

from plyfold.arrangement.arrangement import Arrangement
from reference.outlines import OutlineCode


def code_of(arranged: Arrangement) -> OutlineCode:
    """The visits, cusps and bridges of an arrangement."""
    visits = arranged.first_visit.tolist()
    return OutlineCode(
        tuple(end - start for start, end in pairwise(visits)),
        tuple(arranged.partner.tolist()),
        tuple(arranged.ccw.tolist()),
        tuple(arranged.cusp_index.tolist()),
        tuple((first, second) for first, second in arranged.bridges.tolist()),
        arranged.cells[0],
    )
