"""What numbers alone show: an outline that bounds no surface, because of its turns, its windings or its cusps."""

from __future__ import annotations

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.immersion.shorter_loops import place_of_turning
from plyfold.obstruction import Obstruction

__all__ = ["impossible_cusp", "negative_winding", "no_surface"]


def no_surface(arranged: Arrangement) -> Obstruction | None:
    """Return the obstruction that numbers alone show, if there is one: the turns, a winding number or a cusp.

    The outline of a connected surface that lies flat turns 2 times less 2 for each handle and 1 for each of its loops.
    The full turns that are too many at cusps do not count.

    Examples
    --------
    >>> limacon = Arrangement.from_gauss([1, 0], [True, False], outer=1, cusps={0: 1})
    >>> print(no_surface(limacon))
    A cusp of index 1 needs 2 sheets on the left of the curve, and there is only 1.
    """
    return _impossible_turns(arranged) or negative_winding(arranged) or impossible_cusp(arranged)


def _impossible_turns(arranged: Arrangement) -> Obstruction | None:
    loops, turns = arranged.n_loops, arranged.euler_characteristic
    if turns <= loops and (loops - turns) % 2 == 0:
        return None
    who, most = ("curve turns", "once") if loops == 1 else (f"{loops} curves together turn", f"{loops} times")
    at_cusps = " besides those at its cusps" if arranged.cusp_index.any() else ""
    sentence = f"The {who} {turns} times{at_cusps}; what bounds a surface turns {most}, or less by an even number."
    return Obstruction("turning number", sentence, place_of_turning(arranged), turns, _subject(arranged))


def negative_winding(arranged: Arrangement) -> Obstruction | None:
    """Return the obstruction of a negative winding number, if there is one: the lowest of them."""
    lowest = int(np.argmin(arranged.winding))
    winding = int(arranged.winding[lowest])
    if winding >= 0:
        return None
    who = "curve winds" if arranged.n_loops == 1 else "curves wind"
    sentence = f"The {who} {winding} times around a cell, and cloth cannot cover it a negative number of times."
    place = (arranged.cell_point(lowest),) if arranged.outline else ()
    return Obstruction("negative winding", sentence, place, winding, _subject(arranged))


def impossible_cusp(arranged: Arrangement) -> Obstruction | None:
    """Return the obstruction of a cusp with too few sheets on its left, if there is one: where most are lacking.

    The surface makes as many full turns round it as its index says, and a little more: each on another sheet.
    """
    sheets = arranged.winding[arranged.left_cell[arranged.border_after]]
    lacking = np.where(arranged.cusp_index > 0, arranged.cusp_index + 1 - sheets, 0)
    worst = int(lacking.argmax()) if len(lacking) else 0
    if not (lacking > 0).any():
        return None
    index, there = int(arranged.cusp_index[worst]), int(sheets[worst])
    only = f"there {'is' if there == 1 else 'are'} only {there}"
    sentence = f"A cusp of index {index} needs {index + 1} sheets on the left of the curve, and {only}."
    places = arranged.visit_point[lacking == lacking[worst]].tolist() if arranged.outline else []
    return Obstruction("cusp", sentence, tuple((x, y) for x, y in places), there, _subject(arranged))


def _subject(arranged: Arrangement) -> Arrangement | None:
    """Return what a picture of an obstruction shows; there is none yet of several curves."""
    return arranged if arranged.n_loops == 1 else None
