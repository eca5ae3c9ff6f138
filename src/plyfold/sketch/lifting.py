"""What does it look like, lifted? The surface over one layering, for the 3D view and for files."""

from __future__ import annotations

from functools import lru_cache
from time import perf_counter
from typing import Any

from plyfold.clock import Clock, Watch
from plyfold.draw.viewer import mesh_data
from plyfold.errors import NotEmbeddableError, NotImmersibleError, TimeLimitError
from plyfold.layering.layering import Layering
from plyfold.obstruction import Obstruction
from plyfold.sketch.drawings import immersed, immersion_count, layered
from plyfold.sketch.lie import obstruction_data
from plyfold.sketch.patience import patient
from plyfold.sketch.schema import VERSION, Surface
from plyfold.surface import lift as lifted
from plyfold.surface.lift import layering_of

__all__ = ["lifted_surface", "surface"]

_SECONDS_TO_INTERSECT = 10.0


def surface(question: Surface) -> dict[str, Any]:
    """Return a lifted surface as the 3D view reads it, or why there is none.

    Parameters
    ----------
    question : Surface

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
    >>> answer = surface(Surface((Stroke(((0, 0), (4, 0), (0, 3)), closed=True),), 0, 0, None, 100))
    >>> answer["gap"], answer["mesh"]["centre"]
    (0.2, [2.0, 1.5, 0.0])
    """
    began = perf_counter()
    try:
        made = lifted_surface(question)
    except (NotImmersibleError, NotEmbeddableError) as error:
        why = obstruction_data(error.obstruction)
        return {"version": VERSION, "obstruction": why, "seconds": perf_counter() - began}
    return {
        "version": VERSION,
        "mesh": mesh_data(made),
        "immersion": str(question.immersion % immersion_count(question.strokes)),
        "layering": str(layered(question.strokes, question.immersion, question.layering).number),
        "gap": made.gap,
        "seconds": perf_counter() - began,
    }


@lru_cache(maxsize=4)
def lifted_surface(question: Surface) -> lifted.Surface:
    """Return the surface that a question asks for.

    Raises
    ------
    NotImmersibleError
        If the loop bounds no disk.
    NotEmbeddableError
        If the disk cannot be lifted, unless the sheets may pass through each other.
    TimeLimitError
        If that was not decided in time.
    """
    found = layered(question.strokes, question.immersion, question.layering).found
    options: dict[str, Any] = {"gap": question.gap, "triangles": question.triangles}
    if isinstance(found, Layering):
        return lifted.lift(found, **options)
    if question.allow_intersections:
        disk = immersed(question.strokes, question.immersion)
        within = Watch(Clock(patient(_SECONDS_TO_INTERSECT)))
        return lifted.lift(layering_of(disk, True, within), **options)
    if isinstance(found, Obstruction):
        raise NotEmbeddableError(found)
    raise TimeLimitError(found.sentence)
