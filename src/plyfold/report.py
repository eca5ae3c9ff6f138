"""The verdict on an outline: in words, which the command line and the page show, and all figures as plain data."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrangement.as_given import contacts_of, crossings_as_given, given_windings
from plyfold.errors import TimeLimitError
from plyfold.homotopy.homotopy import least_homotopy
from plyfold.immersion.immersion import Immersion, Piece
from plyfold.immersion.obstructions import may_bound_disk
from plyfold.immersion.solve import bounds_strictly, count_immersions, find_immersion, immersions
from plyfold.io.cusp_notation import CuspMark, cusp_marks, written_cusp
from plyfold.layering.embedding import find_embedding
from plyfold.layering.orders.search import first_layering
from plyfold.obstruction import Obstruction, Unknown
from plyfold.offers.cusps import SuggestedCusps
from plyfold.offers.offers import offers
from plyfold.offers.repair import Repaired, percent
from plyfold.outline.curve import Outline

__all__ = [
    "A_DISK",
    "Words",
    "branched_in_words",
    "cut_in_words",
    "describe",
    "in_words",
    "offer_in_words",
    "repair_in_words",
    "repair_lines",
    "surface_in_words",
    "surface_with_cusps",
    "touches_of",
    "verdict",
    "words",
]

A_DISK = "a disk of cloth"
"""What one curve without cusps bounds, if it bounds a surface without handles."""

_SECONDS_FOR_OFFERS = 0.5
_MOST_CROSSINGS_TO_CONTRACT = 3_000
# What does what is offered, given how commands name the drawing.
_COMMANDS = {
    "repair": "plyfold repair {} -o OUT",
    "cusps": "plyfold check {} --cusps auto",
    "fill": "plyfold split {} --fill nonzero -o OUT",
}
_SHOWN_REPAIRS = _SHOWN_CUSPS = _SHOWN_PLACES = 5
_LONGEST_NUMBER = 12
_UNDECIDED = "Whether it can be lifted was not decided in time."


@dataclass(frozen=True)
class Words:
    """The verdict for people: a headline, and a sentence that says more."""

    headline: str
    sentence: str


def words(
    immersions: int | None, obstruction: str = "", decided: bool = True, surface: str = A_DISK, touches: bool = False
) -> Words:
    """Return the verdict on an outline in words.

    Parameters
    ----------
    immersions : int or None
        In how many ways it bounds a surface; None if it does, and they were not counted in time.
    obstruction : str
        The sentence that says why it bounds none, or why the one that is looked at cannot be lifted.
    decided : bool
        Whether it is known if that one can be lifted.
    surface : str
        What it bounds, or might have bounded, as :func:`surface_in_words` says.
    touches : bool
        Whether that touches itself, so that the outline is a limit of outlines of such surfaces.

    Examples
    --------
    >>> words(2).headline, words(2).sentence
    ('A disk of cloth, in 2 ways', 'This is the outline of a disk of cloth, which can lie in 2 ways.')
    >>> words(1, surface="a ring of cloth").sentence
    'This is the outline of a ring of cloth, which can lie in one way.'
    >>> words(1, touches=True).headline
    'A disk of cloth that touches itself'
    >>> words(0, "The curve turns 2 times, and the outline of a disk turns once.").headline
    'No disk'
    """
    if immersions == 0:
        return Words("No disk" if surface == A_DISK else "No surface", obstruction)
    ways = f", in {in_words(immersions)} ways" if immersions is not None and immersions > 1 else ""
    if touches:
        surface += " that touches itself" if surface.startswith("a ") else ", which touch themselves or each other"
    headline = f"{surface[0].upper()}{surface[1:]}{ways}"
    if obstruction:
        return Words(f"{headline}; this one cannot be lifted", obstruction)
    return Words(headline, f"This is the outline of {surface}{_ways(immersions)}." if decided else _UNDECIDED)


def _ways(immersions: int | None) -> str:
    if immersions is None:
        return "; in how many ways it can lie was not counted in time"
    return ", which can lie in " + ("one way" if immersions == 1 else f"{in_words(immersions)} ways")


def surface_in_words(pieces: Sequence[Piece]) -> str:
    """Say what kind of surface some pieces are together.

    Examples
    --------
    >>> surface_in_words([Piece((0,), 1)]), surface_in_words([Piece((0, 1), 0)])
    ('a disk of cloth', 'a ring of cloth')
    >>> surface_in_words([Piece((0, 1, 2), -1)]), surface_in_words([Piece((0,), -1)])
    ('a disk of cloth with 2 holes', 'a disk of cloth with a handle')
    >>> surface_in_words([Piece((0,), 1), Piece((1,), 1), Piece((2, 3), -2)])
    '3 pieces of cloth: 2 disks and a disk with a hole and a handle'
    """
    if len(pieces) == 1:
        kind, more = _kind_of_piece(pieces[0])
        return f"a {kind} of cloth{more}"
    kinds = Counter(map(_kind_of_piece, pieces))
    named = [f"a {kind}{more}" if count == 1 else f"{count} {kind}s{more}" for (kind, more), count in kinds.items()]
    listed = named[0] if len(named) == 1 else f"{', '.join(named[:-1])} and {named[-1]}"
    return f"{len(pieces)} pieces of cloth: {listed}"


def cut_in_words(pieces: Sequence[Piece]) -> str:
    """Say what is left of a surface that is cut where it touches itself.

    Examples
    --------
    >>> cut_in_words([Piece((0,), 1), Piece((1,), 1)]), cut_in_words([])
    ('2 pieces of cloth: 2 disks', 'nothing is left')
    """
    return surface_in_words(pieces) if pieces else "nothing is left"


def _kind_of_piece(piece: Piece) -> tuple[str, str]:
    """Return what a piece is, and what it has besides."""
    holes, handles = len(piece.loops) - 1, piece.genus
    if (holes, handles) == (1, 0):
        return "ring", ""
    parts = [
        f"a {what}" if count == 1 else f"{count} {what}s"
        for what, count in (("hole", holes), ("handle", handles))
        if count
    ]
    return "disk", f" with {' and '.join(parts)}" if parts else ""


def offer_in_words(indices: Sequence[int], surface: str, where: str) -> str:
    """Say what an outline that turns too often bounds with cusps of some indices.

    Examples
    --------
    >>> offer_in_words([1], "a disk of cloth", "at its tip")
    '1 turn is too many: with a cusp at its tip, it is a disk of cloth'
    """
    turns = sum(indices)
    many = "1 turn is" if turns == 1 else f"{turns} turns are"
    which = "a cusp" if len(indices) == 1 else "cusps"
    return f"{many} too many: with {which} {where}, it is {surface}"


def in_words(count: int) -> str:
    """Return a count as people read it; from a million million on, only how large it is.

    Examples
    --------
    >>> in_words(12345), in_words(2**400)
    ('12,345', 'about 2.58 · 10^120')
    """
    if len(str(count)) <= _LONGEST_NUMBER:
        return f"{count:,}"
    exponent = len(str(count)) - 1
    leading = math.floor(count // 10 ** (exponent - 3) / 10) / 100
    return f"about {leading:.2f} · 10^{exponent}"


def verdict(arrangement: Arrangement, time_limit: float | None = None, drawing: str = "FILE") -> dict[str, Any]:
    """Return everything that is known of an outline as plain data, ready for JSON.

    Parameters
    ----------
    arrangement : Arrangement
    time_limit : float, optional
        Seconds for the search for a layering, and, where the outline cannot be that of a disk alone, for each of the
        other questions; when they are over, ``layerable``, ``immersible`` or ``immersions`` is None: unknown.
    drawing : str, optional
        What stands for the drawing in the commands that are offered.

    Returns
    -------
    dict
        ``points``, ``loops``, ``cusps`` (of each: ``loop``, ``point``, ``index``, ``where``), ``crossings`` (of edges,
        inside both), ``contacts`` (places of points on foreign edges or points), ``crossings_moved_apart`` (with those
        that are made where contacts are moved apart), ``cells`` (number of cells by winding number),
        ``turning_number``, ``reversed``, ``repairs``, ``immersible``, ``immersions``; for a surface also ``surface``
        (in words), ``touches`` (where it touches itself; no places if the outline bounds one that does not), ``pieces``
        and ``euler_characteristic`` (of the first, cut where it touches itself), ``sheets`` (over all cells),
        ``layerable``, and if so ``levels``, and, for a disk, ``examined`` (immersions), otherwise ``reason``,
        ``sentence`` and ``where``, and ``branch_points`` if it bounds a disk with so many; and for a drawing
        ``offers``, what can be done: each has a ``kind``, ``"repair"``,
        ``"cusps"`` or ``"fill"``, a ``sentence`` and a ``command``, and the first two what they change and the
        ``surface`` that it would bound.

    Examples
    --------
    >>> from plyfold import arrange
    >>> found = verdict(arrange([(0, 0), (2, 2), (2, 0), (0, 2)]))
    >>> found["immersible"], found["reason"], found["cells"]
    (False, 'turning number', {-1: 1, 0: 1, 1: 1})
    >>> verdict(arrange([[(0, 0), (9, 0), (0, 9)], [(1, 1), (1, 3), (3, 1)]]))["surface"]
    'a ring of cloth'
    """
    outline, windings = arrangement.outline, given_windings(arrangement)
    figures: dict[str, Any] = {
        "points": 0 if outline is None else len(outline),
        "loops": arrangement.n_loops,
        "cusps": _cusps(outline),
        "crossings": crossings_as_given(arrangement),
        "contacts": contacts_of(arrangement),
        "crossings_moved_apart": arrangement.n_crossings,
        "cells": dict(sorted(Counter(windings.tolist()).items())),
        "turning_number": arrangement.turning_number,
        "reversed": arrangement.reversed,
        "repairs": _repairs(outline),
    }
    limit = None if may_bound_disk(arrangement) else time_limit
    found = find_immersion(arrangement, time_limit=limit)
    if isinstance(found, Unknown):
        return figures | {"immersible": None, "immersions": None}
    if isinstance(found, Obstruction):
        return figures | {"immersible": False, "immersions": 0} | _obstructed(found) | _no_surface(arrangement, drawing)
    count = count_immersions(arrangement, time_limit=limit)
    figures |= {"immersible": True, "immersions": None if isinstance(count, Unknown) else count}
    figures |= _surface(found) | {"sheets": int(windings.sum())}
    figures |= (_layerable if may_bound_disk(arrangement) else _embeddable)(arrangement, time_limit)
    return figures | ({"levels": int(windings.max())} if figures["layerable"] else {})


def _no_surface(arrangement: Arrangement, drawing: str) -> dict[str, Any]:
    """Return what an outline bounds that bounds no surface, and what can be done about it."""
    return _branched(arrangement) | _offers(arrangement, drawing)


def _branched(arrangement: Arrangement) -> dict[str, Any]:
    """Return how many branch points the disk has that a curve bounds, if it bounds one and that is found soon."""
    may_be = arrangement.n_loops == 1 and not arrangement.cusp_index.any() and arrangement.winding.min() >= 0
    if not may_be or arrangement.turning_number < 2 or arrangement.n_crossings > _MOST_CROSSINGS_TO_CONTRACT:
        return {}
    found = least_homotopy(arrangement, _SECONDS_FOR_OFFERS)
    if found.branch_points is None:
        return {}
    return {"branch_points": found.branch_points}


def branched_in_words(branch_points: int) -> str:
    """Say what a curve bounds that bounds a disk with branch points.

    Examples
    --------
    >>> branched_in_words(0), branched_in_words(1), branched_in_words(2)
    ('a disk of cloth', 'a disk of cloth with a branch point', 'a disk of cloth with 2 branch points')
    """
    many = {0: "", 1: " with a branch point"}
    return A_DISK + many.get(branch_points, f" with {branch_points} branch points")


def _offers(arrangement: Arrangement, drawing: str) -> dict[str, Any]:
    """Return what can be done about an outline that bounds no surface; of a code, nothing is said."""
    if arrangement.outline is None:
        return {}
    found = offers(arrangement, _SECONDS_FOR_OFFERS)
    listed = [] if found.repaired is None else [_repair_offer(found.repaired)]
    listed += [] if found.cusps is None else [_cusps_offer(found.cusps)]
    listed.append({"kind": "fill", "sentence": "what it paints can be cut into polygons"})
    return {"offers": [offer | {"command": _COMMANDS[offer["kind"]].format(drawing)} for offer in listed]}


def repair_in_words(found: Repaired) -> str:
    """Say what a repair does, and what comes of it.

    Examples
    --------
    >>> from plyfold import repair
    >>> repair_in_words(repair([(0, 0), (60, 0), (60, 41), (61, 41), (61, 40), (0, 40)]))
    'leaving out 1 loop, 0.0416% of the region, makes it a disk of cloth'
    """
    return f"{found.done}, {percent(found.region_change)} of the region, makes it {_repaired_surface(found)}"


def _repaired_surface(found: Repaired) -> str:
    return A_DISK if found.outline.n_loops == 1 else "a surface"


def _repair_offer(found: Repaired) -> dict[str, Any]:
    changes = [
        {
            "kind": change.kind,
            "where": list(change.where),
            "size": change.size,
            "region": change.region,
            "layers": change.layers,
        }
        for change in found.changes
    ]
    return {
        "kind": "repair",
        "sentence": repair_in_words(found),
        "surface": _repaired_surface(found),
        "changes": changes,
        "region_change": found.region_change,
        "layer_change": found.layer_change,
    }


def surface_with_cusps(found: SuggestedCusps) -> str:
    """Say what an outline bounds with cusps that are proposed: a surface in one piece, without handles.

    Examples
    --------
    >>> from plyfold import suggest_cusps
    >>> limacon = [(3, 0), (1, 3), (-2, 0), (1, -3), (3, 0.5), (1, 1), (0.5, 0), (1, -1)]
    >>> surface_with_cusps(suggest_cusps(limacon))
    'a disk of cloth'
    """
    loops = tuple(range(found.outline.n_loops))
    return surface_in_words([Piece(loops, 2 - len(loops))])


def _cusps_offer(found: SuggestedCusps) -> dict[str, Any]:
    surface = surface_with_cusps(found)
    marks = [CuspMark(loop, point, turns) for (loop, point), turns in found.cusps.items()]
    cusps = _described_cusps(found.outline, marks)
    sentence = offer_in_words([*found.cusps.values()], surface, _listed_cusps(cusps))
    return {"kind": "cusps", "sentence": sentence, "cusps": cusps, "surface": surface}


def _surface(immersion: Immersion) -> dict[str, Any]:
    pieces = [
        {"loops": list(piece.loops), "euler_characteristic": piece.euler_characteristic, "genus": piece.genus}
        for piece in immersion.pieces
    ]
    return {
        "surface": surface_in_words(immersion.uncut_pieces),
        "touches": touches_of(immersion),
        "pieces": pieces,
        "euler_characteristic": immersion.euler_characteristic,
    }


def touches_of(immersion: Immersion) -> list[list[float]]:
    """Return where a surface touches itself; nothing, if the outline also bounds a surface in the strict sense.

    Examples
    --------
    >>> touches_of(find_immersion([(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)]))
    [[1.0, 1.0]]
    """
    if not immersion.touches or bounds_strictly(immersion.arrangement):
        return []
    return [list(place) for place in immersion.touches]


def _cusps(outline: Outline | None) -> list[dict[str, Any]]:
    return [] if outline is None else _described_cusps(outline, cusp_marks(outline.cusps))


def _described_cusps(outline: Outline, marks: Sequence[CuspMark]) -> list[dict[str, Any]]:
    return [
        {
            "loop": loop,
            "point": _point_as_given(outline, loop, point),
            "index": turns,
            "where": outline.loops[loop][point].tolist(),
        }
        for loop, point, turns in marks
    ]


def _point_as_given(outline: Outline, loop: int, point: int) -> int:
    """Return which point of its loop a point was before repeated ones were left out."""
    rows = outline.rows[outline.first_point[loop] : outline.first_point[loop + 1]]
    return int(rows[point] - rows[0]) if (np.diff(rows) > 0).all() else point


def _repairs(outline: Outline | None) -> list[dict[str, Any]]:
    repairs = () if outline is None else outline.repairs
    return [{"kind": repair.kind, "where": list(repair.where), "size": repair.size} for repair in repairs]


def _obstructed(obstruction: Obstruction) -> dict[str, Any]:
    where = [list(place) for place in obstruction.where]
    return {"reason": obstruction.reason, "sentence": str(obstruction), "where": where}


def _layerable(arrangement: Arrangement, time_limit: float | None) -> dict[str, Any]:
    """Return whether one of the immersions can be layered, and how many were examined."""
    try:
        found, examined = first_layering(immersions(arrangement), time_limit)
    except TimeLimitError:
        return {"layerable": None}
    if isinstance(found, Obstruction):
        return {"layerable": False, "examined": examined} | _obstructed(found)
    return {"layerable": True, "examined": examined}


def _embeddable(arrangement: Arrangement, time_limit: float | None) -> dict[str, Any]:
    """Return whether some immersion can be layered, asked of all of them at once."""
    found = find_embedding(arrangement, time_limit)
    if isinstance(found, Unknown):
        return {"layerable": None}
    if isinstance(found, Obstruction):
        return {"layerable": False} | _obstructed(found)
    return {"layerable": True}


def describe(figures: dict[str, Any]) -> str:
    """Return the verdict as text: a sentence, and the figures one on a line."""
    rows = _rows(figures)
    width = max(map(len, rows)) + 2
    lines = [f"  {name:<{width}}{value}" for name, value in rows.items()]
    return "\n".join([_headline(figures), *lines, *_repair_lines(figures["repairs"])])


def _rows(figures: dict[str, Any]) -> dict[str, str]:
    cells = ", ".join(f"{count} with {winding}" for winding, count in figures["cells"].items())
    which = "curve was" if figures["loops"] == 1 else "loops were"
    turned = f" (the {which} turned round, to have the surface on the left)" if figures["reversed"] else ""
    rows = {
        "points": f"{figures['points']:,}",
        "loops": f"{figures['loops']:,}" if figures["loops"] > 1 else "",
        "crossings": f"{figures['crossings']:,}",
        "in contact at": _listed_places(figures["contacts"]),
        "crossings when moved apart": f"{figures['crossings_moved_apart']:,}" if figures["contacts"] else "",
        "cells by winding number": cells,
        "turning number": f"{figures['turning_number']}{turned}",
        "cusps": _listed_cusps(figures["cusps"]),
        "Euler characteristic": "" if figures.get("touches") else str(figures.get("euler_characteristic", "")),
        "immersions": "unknown" if figures["immersions"] is None else f"{figures['immersions']:,}",
        "touches itself at": _listed_places(figures["touches"]) if figures["immersible"] else "",
        "cut there": _cut(figures) if figures["immersible"] and figures["touches"] else "",
        "layering": _layering_sentence(figures) if figures["immersible"] else "",
    }
    if rows["Euler characteristic"] == "1" and not rows["loops"]:
        rows["Euler characteristic"] = ""
    return {name: value for name, value in rows.items() if value}


def _cut(figures: dict[str, Any]) -> str:
    pieces = [Piece(tuple(piece["loops"]), piece["euler_characteristic"]) for piece in figures["pieces"]]
    return f"{cut_in_words(pieces)}; Euler characteristic {figures['euler_characteristic']}"


def _listed_places(places: list[list[float]]) -> str:
    more = f" and {len(places) - _SHOWN_PLACES} more" if len(places) > _SHOWN_PLACES else ""
    return ", ".join("({:.6g}, {:.6g})".format(*place) for place in places[:_SHOWN_PLACES]) + more


def _listed_cusps(cusps: list[dict[str, Any]]) -> str:
    more = f" and {len(cusps) - _SHOWN_CUSPS} more" if len(cusps) > _SHOWN_CUSPS else ""
    return ", ".join(map(_cusp_and_place, cusps[:_SHOWN_CUSPS])) + more


def _cusp_and_place(cusp: dict[str, Any]) -> str:
    mark = written_cusp(CuspMark(cusp["loop"], cusp["point"], cusp["index"]))
    return "{} at ({:.6g}, {:.6g})".format(mark, *cusp["where"])


def _headline(figures: dict[str, Any]) -> str:
    if figures["immersible"]:
        said = words(figures["immersions"], surface=figures["surface"], touches=bool(figures["touches"]))
        return f"Yes. {said.sentence}"
    if figures["immersible"] is None:
        return "Unknown. Whether this is the outline of a surface was not decided in time."
    plain = figures["loops"] == 1 and not figures["cusps"]
    said = words(0, figures["sentence"], surface=A_DISK if plain else "a surface")
    places = "".join(f"\n  at ({x:.6g}, {y:.6g})" for x, y in figures["where"])
    branched = f"\n  It bounds {branched_in_words(figures['branch_points'])}." if "branch_points" in figures else ""
    return f"{said.headline}. {said.sentence}{places}{branched}{_offer_lines(figures)}"


def _offer_lines(figures: dict[str, Any]) -> str:
    return "".join(f"\n  {offer['sentence']}: {offer['command']}" for offer in figures.get("offers", ()))


def _layering_sentence(figures: dict[str, Any]) -> str:
    if figures["layerable"] is None:
        return f"unknown. {_UNDECIDED}"
    if "examined" not in figures:
        return f"yes, on {figures['levels']} level(s)" if figures["layerable"] else f"no. {figures['sentence']}"
    if figures["layerable"]:
        which = f"immersion {figures['examined']} of {figures['immersions']:,}"
        return f"yes, on {figures['levels']} level(s), found for {which}"
    return f"none of the {figures['examined']} immersion(s) can be lifted. {figures['sentence']}"


def repair_lines(outline: Outline) -> list[str]:
    """Return what was changed in the input, each kind of change on a line."""
    return _repair_lines(_repairs(outline))


def _repair_lines(repairs: list[dict[str, Any]]) -> list[str]:
    lines = []
    for kind, count in Counter(repair["kind"] for repair in repairs).items():
        these = [repair for repair in repairs if repair["kind"] == kind]
        places = ", ".join(map(_repair_place, these[:_SHOWN_REPAIRS]))
        more = f" and {count - _SHOWN_REPAIRS} more" if count > _SHOWN_REPAIRS else ""
        lines.append(f"  note: {kind} at {places}{more}")
    return lines


def _repair_place(repair: dict[str, Any]) -> str:
    size = f" by {repair['size']:.3g}" if repair["size"] else ""
    return "({:.6g}, {:.6g})".format(*repair["where"]) + size
