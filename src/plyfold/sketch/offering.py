"""What to do about a "no": small changes, cusps, or the pieces, each as a drawing that takes the place of this one."""

from __future__ import annotations

from itertools import chain
from time import perf_counter
from typing import Any

import numpy as np
import shapely

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Floats, Ints
from plyfold.errors import PrecisionError
from plyfold.flat.decompose import decompose
from plyfold.homotopy.homotopy import least_homotopy
from plyfold.immersion.verdict import bounds_disk
from plyfold.obstruction import Obstruction
from plyfold.offers.cusps import SuggestedCusps
from plyfold.offers.offers import offers
from plyfold.offers.repair import LENS, LOOP, Repaired
from plyfold.outline.curve import Curve
from plyfold.outline.direction import sense
from plyfold.report import offer_in_words, repair_in_words, surface_with_cusps
from plyfold.sketch.drawings import arranged, first_immersion
from plyfold.sketch.patience import patient
from plyfold.sketch.schema import VERSION, Offer

__all__ = ["loop_data", "offered"]

_SECONDS_TO_FIND = 5.0
# Sketches are coarse: what is left out may be a larger part of them than of outlines in files.
_ALLOWED_REGION, _ALLOWED_LAYERS = 0.25, 0.5
_SMALL = 0.05
_MOST_PIECES = 200


def offered(question: Offer) -> dict[str, Any]:
    """Return what can be done about an outline that bounds no surface.

    Parameters
    ----------
    question : Offer

    Returns
    -------
    dict
        As ``PROTOCOL.md`` says, ready for JSON; no offers if it bounds one, or if nothing is found within seconds.

    Raises
    ------
    PlyfoldError
        If the strokes make no outline that can be used.

    Examples
    --------
    >>> from plyfold.sketch.schema import Stroke
    >>> limacon = ((3, 0), (1, 3), (-2, 0), (1, -3), (3, 0.5), (1, 1), (0.5, 0), (1, -1))
    >>> answer = offered(Offer((Stroke(limacon, closed=True),)))
    >>> [offer["label"] for offer in answer["offers"]]
    ['Leave out a loop', 'A cusp here', 'Show the pieces']
    >>> answer["offers"][1]["cusps"], answer["offers"][1]["sentence"]
    ([{'where': [1.0, -1.0], 'index': 1}], '1 turn is too many: with a cusp as shown, it is a disk of cloth.')
    """
    began = perf_counter()
    drawn = arranged(question.strokes)
    listed = _listed(drawn) if isinstance(first_immersion(question.strokes), Obstruction) else []
    return {"version": VERSION, "offers": listed, "seconds": perf_counter() - began}


def _listed(drawn: Arrangement) -> list[dict[str, Any]]:
    found = offers(drawn, patient(_SECONDS_TO_FIND), _ALLOWED_REGION, _ALLOWED_LAYERS)
    pieces = _pieces_offer(drawn)
    listed = [] if found.repaired is None else [_repair_offer(found.repaired)]
    listed += [] if found.cusps is None else [_cusps_offer(found.cusps)]
    return listed + ([] if pieces is None else [pieces])


def loop_data(points: Floats, index: Ints | None = None) -> dict[str, Any]:
    """Return a loop as plain data: its points, and the indices of those that are cusps."""
    marks = {} if index is None else {str(point): int(index[point]) for point in np.flatnonzero(index)}
    return {"points": points.tolist(), "cusps": marks}


def _offer(kind: str, label: str, sentence: str, **shown: Any) -> dict[str, Any]:
    nothing: dict[str, Any] = {"where": [], "areas": [], "cusps": [], "loops": None}
    return {"kind": kind, "label": label, "sentence": sentence} | nothing | shown


# ---- small changes ---------------------------------------------------------------------------------------------------


def _repair_offer(found: Repaired) -> dict[str, Any]:
    sentence = repair_in_words(found)
    return _offer(
        "repair",
        _label([change.kind for change in found.changes], "small " if found.layer_change <= _SMALL else ""),
        f"{sentence[0].upper()}{sentence[1:]}.",
        where=[list(change.where) for change in found.changes],
        areas=[polygon.tolist() for change in found.changes for polygon in change.polygons],
        loops=list(map(loop_data, found.outline.loops, found.outline.cusps)),
    )


def _label(kinds: list[str], small: str = "") -> str:
    """Return what is done, as a button says it.

    Examples
    --------
    >>> _label([LOOP, LOOP], "small "), _label([LENS]), _label([LOOP, LENS, LENS])
    ('Leave out 2 small loops', 'Undo this crossing', 'Leave out a loop, undo 2 crossings')
    """
    loops, lenses = kinds.count(LOOP), kinds.count(LENS)
    done = [f"leave out {f'a {small}loop' if loops == 1 else f'{loops} {small}loops'}"] * (loops > 0)
    done += [f"undo {'this crossing' if lenses == 1 else f'{lenses} crossings'}"] * (lenses > 0)
    words = ", ".join(done) or "leave out the spikes"
    return words[0].upper() + words[1:]


# ---- cusps -----------------------------------------------------------------------------------------------------------


def _cusps_offer(found: SuggestedCusps) -> dict[str, Any]:
    marks = [
        {"where": found.outline.loops[loop][point].tolist(), "index": index}
        for (loop, point), index in found.cusps.items()
    ]
    return _offer(
        "cusps",
        "A cusp here" if len(marks) == 1 else "Cusps here",
        f"{offer_in_words([*found.cusps.values()], surface_with_cusps(found), 'as shown')}.",
        where=[mark["where"] for mark in marks],
        cusps=marks,
    )


# ---- pieces ----------------------------------------------------------------------------------------------------------


def _pieces_offer(drawn: Arrangement) -> dict[str, Any] | None:
    """Offer the loops that a curve is cut into when it contracts, or, where these are not found, simple polygons."""
    rings, kind = _loops_of_disks(drawn), "loop"
    if not rings:
        rings, kind = _polygons(drawn), "simple polygon"
    if not 0 < len(rings) <= _MOST_PIECES:
        return None
    count = f"one {kind}" if len(rings) == 1 else f"{len(rings)} {kind}s"
    each = ", each the outline of a disk of cloth" if kind == "loop" else ""
    areas = [ring.tolist() for ring in rings]
    sentence = f"It can be cut into {count}{each}."
    return _offer("pieces", "Show the pieces", sentence, areas=areas, loops=list(map(loop_data, rings)))


def _loops_of_disks(drawn: Arrangement) -> list[Floats]:
    """Return the loops of the least homotopy of one curve, each with its disk on the left.

    None if time is short, or if their corners at crossings, which are rounded, make other loops of them.
    """
    if drawn.n_loops > 1 or drawn.cusp_index.any() or len(drawn.contacts):
        return []
    found = least_homotopy(drawn, time_limit=patient(_SECONDS_TO_FIND))
    if not found.optimal:
        return []
    curves = [loop.curve if loop.sign > 0 else loop.curve.reversed() for loop in found.loops]
    rings = [curve.points for curve in curves if isinstance(curve, Curve)]
    return rings if len(rings) == len(curves) and all(map(bounds_disk, rings)) else []


def _polygons(drawn: Arrangement) -> list[Floats]:
    """Return simple polygons that add up to the winding numbers, counter-clockwise; none where rounding fails."""
    assert drawn.given is not None
    try:
        rings = [shapely.get_coordinates(piece)[:-1] for piece in chain(*decompose(drawn.given, signed=True))]
    except PrecisionError:
        return []
    return [ring if sense(ring) > 0 else ring[::-1] for ring in rings]
