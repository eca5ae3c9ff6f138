"""How does the cloth lie? One immersion, one layering of it, and what they look like unwound, and lifted."""

from __future__ import annotations

from dataclasses import asdict
from functools import lru_cache
from time import perf_counter
from typing import Any

import numpy as np

from plyfold.arrays import Floats
from plyfold.clock import Clock, Watch
from plyfold.draw.placement import BorderCircle
from plyfold.draw.viewer import mesh_data
from plyfold.errors import NotEmbeddableError, NotImmersibleError, TimeLimitError
from plyfold.immersion.compare import changed_borders
from plyfold.immersion.immersion import Immersion
from plyfold.layering.layering import Layering
from plyfold.obstruction import Obstruction, Unknown
from plyfold.report import cut_in_words, surface_in_words, touches_of, words
from plyfold.sketch.drawings import Layered, immersed, immersion_count, layered
from plyfold.sketch.patience import patient
from plyfold.sketch.schema import VERSION, Lie, Lift
from plyfold.surface.lift import Surface, layering_of, lift

__all__ = ["lie", "lifted", "lifted_surface"]

_DECIMALS = 4
_SECONDS_TO_INTERSECT = 10.0


def lie(question: Lie) -> dict[str, Any]:
    """Return one immersion of an outline, one of its layerings, and what is new in it.

    Parameters
    ----------
    question : Lie

    Returns
    -------
    dict
        As ``PROTOCOL.md`` says, ready for JSON. What cannot be decided or counted within seconds is null.

    Raises
    ------
    PlyfoldError
        If the strokes make no outline that can be used.

    Examples
    --------
    >>> from plyfold.gallery import CURVES
    >>> from plyfold.sketch.schema import Stroke
    >>> milnor = Stroke(tuple(map(tuple, CURVES["milnor"].curve.points.tolist())), closed=True)
    >>> answer = lie(Lie((milnor,), -1, 0, None))
    >>> answer["immersion"], answer["immersions"], answer["layerings"], answer["changed_borders"][:4]
    ('1', '2', '2', [0, 1, 2, 3])
    """
    began = perf_counter()
    try:
        disk = immersed(question.strokes, question.immersion)
    except NotImmersibleError as error:
        why = _obstruction(error.obstruction)
        return {"version": VERSION, "obstruction": why, "immersions": "0", "seconds": perf_counter() - began}
    count, touches = immersion_count(question.strokes), touches_of(disk)
    answer = {
        "version": VERSION,
        "immersion": str(_number(question.immersion, count)),
        "immersions": None if count is None else str(count),
        "changed_borders": _changed(question, disk, count),
        "sheets": _own_borders(disk),
        "sheet_cell": disk.sheet_cell.tolist(),
        "touches": touches,
        "cut": cut_in_words(disk.pieces) if touches else None,
        "layout": _layout(disk) if disk.is_disk else None,
    }
    found = layered(question.strokes, question.immersion, question.layering)
    answer |= _layering(found) | {"verdict": _verdict(disk, count, found.found, bool(touches))}
    return answer | {"seconds": perf_counter() - began}


def _obstruction(obstruction: Obstruction) -> dict[str, Any]:
    """Return an obstruction as plain data, with the sheets and cells that are in conflict."""
    places = obstruction.value if obstruction.reason in ("reversed pair", "cyclic order") else ()
    sheets = {sheet for _, *others in places for sheet in np.ravel(others).tolist()}
    return {
        "reason": obstruction.reason,
        "sentence": obstruction.sentence,
        "where": [list(place) for place in obstruction.where],
        "sheets": sorted(sheets),
        "cells": sorted({int(cell) for cell, *_ in places}),
    }


def _layering(layered: Layered) -> dict[str, Any]:
    found = layered.found
    lies = isinstance(found, Layering)
    return {
        "layering": str(layered.number),
        "layerings": None if layered.count is None else str(layered.count),
        "layerable": True if lies else False if isinstance(found, Obstruction) else None,
        "obstruction": _obstruction(found) if isinstance(found, Obstruction) else None,
        "levels": found.level.tolist() if isinstance(found, Layering) else None,
        "casing": found.casing.tolist() if isinstance(found, Layering) else None,
    }


def _verdict(
    immersion: Immersion, count: int | None, found: Layering | Obstruction | Unknown, touches: bool
) -> dict[str, str]:
    """Return the verdict on the outline in words, now that it is known whether this immersion can be lifted."""
    obstruction = found.sentence if isinstance(found, Obstruction) else ""
    surface = surface_in_words(immersion.uncut_pieces)
    return asdict(words(count, obstruction, decided=not isinstance(found, Unknown), surface=surface, touches=touches))


def _number(immersion: int, count: int | None) -> int:
    """Return which of the immersions it is: there is one alone to be had where they are not counted."""
    return immersion % (count or 1)


def _changed(question: Lie, disk: Immersion, count: int | None) -> list[int]:
    """Return the borders that lie otherwise than before: by default in the immersion before this one, if any."""
    now = _number(question.immersion, count)
    before = now - 1 if question.before is None else _number(question.before, count)
    return [] if before < 0 else list(changed_borders(immersed(question.strokes, before), disk))


def _own_borders(disk: Immersion) -> list[list[int]]:
    borders: list[list[int]] = [[] for _ in range(disk.n_sheets)]
    for border, sheet in enumerate(disk.own_sheet.tolist()):
        borders[sheet].append(border)
    return borders


def _layout(disk: Immersion) -> dict[str, Any]:
    """Return the disk layout in the unit disk, as :func:`plyfold.draw.plot_layout` draws it."""
    circle = BorderCircle(disk.arrangement.n_borders)
    return {
        "borders": [_rounded(circle.arc(border)) for border in range(disk.arrangement.n_borders)],
        "groups": [
            {
                "sheet": group.sheet,
                "cell": group.cell,
                "borders": list(group.borders),
                "region": _rounded(circle.region(group.borders)),
                "arcs": [_rounded(circle.join(border, other)) for border, other in group.arcs],
            }
            for group in disk.disk_layout()
        ],
    }


def _rounded(points: Floats) -> list[list[float]]:
    return [[x, y] for x, y in points.round(_DECIMALS).tolist()]


# ---- lifted: the surface over one layering, for the 3D view and for files --------------------------------------------


def lifted(question: Lift) -> dict[str, Any]:
    """Return a lifted surface as the 3D view reads it, or why there is none.

    Parameters
    ----------
    question : Lift

    Returns
    -------
    dict
        As ``PROTOCOL.md`` says, ready for JSON.

    Raises
    ------
    PlyfoldError
        If the strokes make no loop that can be used, the gap is none, or it was not decided in time.

    Examples
    --------
    >>> from plyfold.sketch.schema import Stroke
    >>> answer = lifted(Lift((Stroke(((0, 0), (4, 0), (0, 3)), closed=True),), 0, 0, None, 100))
    >>> answer["gap"], answer["mesh"]["centre"]
    (0.2, [2.0, 1.5, 0.0])
    """
    began = perf_counter()
    try:
        made = lifted_surface(question)
    except (NotImmersibleError, NotEmbeddableError) as error:
        why = _obstruction(error.obstruction)
        return {"version": VERSION, "obstruction": why, "seconds": perf_counter() - began}
    return {
        "version": VERSION,
        "mesh": mesh_data(made),
        "immersion": str(_number(question.immersion, immersion_count(question.strokes))),
        "layering": str(layered(question.strokes, question.immersion, question.layering).number),
        "gap": made.gap,
        "seconds": perf_counter() - began,
    }


@lru_cache(maxsize=4)
def lifted_surface(question: Lift) -> Surface:
    """Return the surface that a question asks for.

    Raises
    ------
    NotImmersibleError
        If the outline bounds no surface.
    NotEmbeddableError
        If the surface cannot be lifted, unless the sheets may pass through each other.
    TimeLimitError
        If that was not decided in time.
    """
    found = layered(question.strokes, question.immersion, question.layering).found
    options: dict[str, Any] = {"gap": question.gap, "triangles": question.triangles}
    if isinstance(found, Layering):
        return lift(found, **options)
    if question.allow_intersections:
        disk = immersed(question.strokes, question.immersion)
        within = Watch(Clock(patient(_SECONDS_TO_INTERSECT)))
        return lift(layering_of(disk, True, within), **options)
    if isinstance(found, Obstruction):
        raise NotEmbeddableError(found)
    raise TimeLimitError(found.sentence)
