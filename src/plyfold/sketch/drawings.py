"""From strokes to the values the library reads, remembered for the last few drawings, so that ←/→ is quick."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import islice

from plyfold.arrangement.arrangement import Arrangement, arrange
from plyfold.errors import CurveError, NotImmersibleError, StrokeError, TimeLimitError
from plyfold.immersion.immersion import Immersion
from plyfold.immersion.solve import count_immersions, find_immersion, nth_immersion
from plyfold.layering.layering import Layering
from plyfold.layering.orders.counting import count_layerings
from plyfold.layering.orders.listing import layerings
from plyfold.layering.orders.search import find_layering
from plyfold.obstruction import Obstruction, Unknown
from plyfold.outline.curve import Curve, Outline
from plyfold.outline.given import outline_of_curves
from plyfold.outline.vertices import naming_the_curve
from plyfold.sketch.patience import patient
from plyfold.sketch.schema import Stroke

__all__ = ["Layered", "arranged", "first_immersion", "immersed", "immersion_count", "layered", "outline_of"]

_REMEMBERED = 8
_SECONDS_TO_FIND = 5.0
_SECONDS_TO_NUMBER = 1.0
_SECONDS_TO_DECIDE = 5.0
_SECONDS_TO_COUNT = 1.0
_MOST_LISTED = 10_000
_MOST_CROSSINGS = 20_000


def outline_of(strokes: Sequence[Stroke]) -> Outline:
    """Return the outline that strokes draw: each closed one is a loop, and the open ones are joined into one more.

    Raises
    ------
    StrokeError
        If the open ones do not make a closed loop.
    CurveError
        If a loop is degenerate.

    Examples
    --------
    >>> len(outline_of([Stroke(((0, 0), (4, 0))), Stroke(((0, 3), (4, 0))), Stroke(((0, 0), (0, 3)))]))
    3
    >>> triangle = Stroke(((0, 0), (4, 0), (0, 3)), closed=True)
    >>> outline_of([triangle, Stroke(((9, 0), (8, 0), (9, 1)), closed=True, cusps=((1, 2),))]).cusps[1].tolist()
    [0, 2, 0]
    """
    loops = [stroke for stroke in strokes if stroke.closed]
    parts = [stroke for stroke in strokes if not stroke.closed]
    count = len(loops) + bool(parts)
    curves = []
    for number, stroke in enumerate(loops):
        with naming_the_curve(number, count):
            curves.append(Curve(stroke.points, cusps=dict(stroke.cusps)))
    if parts or not loops:
        curves.append(_joined(parts))
    return outline_of_curves(curves)


def _joined(strokes: Sequence[Stroke]) -> Curve:
    """Join open strokes into a loop, on which their cusps stay where they are."""
    try:
        curve = Curve.from_strokes(stroke.points for stroke in strokes)
    except StrokeError as error:
        if len(error.where) != 2:
            raise
        sentence = "the ends are too far apart to be joined" if len(strokes) == 1 else "the strokes make no closed loop"
        raise StrokeError(sentence, error.where, "draw the missing part between the rings") from error
    marks = {stroke.points[point]: index for stroke in strokes for point, index in stroke.cusps}
    places = [(x, y) for x, y in curve.points.tolist()]
    return Curve(curve.points, curve.repairs, [marks.get(place, 0) for place in places]) if marks else curve


@lru_cache(maxsize=_REMEMBERED)
def arranged(strokes: tuple[Stroke, ...]) -> Arrangement:
    """Return the arrangement of the outline that strokes draw; refuse one with more than 20,000 crossings."""
    drawn = arrange(outline_of(strokes))
    if drawn.n_crossings > _MOST_CROSSINGS:
        apart = ", moved apart where it touches itself," if len(drawn.contacts) else ""
        crossings = f"the outline{apart} crosses itself {drawn.n_crossings:,} times, more than {_MOST_CROSSINGS:,}"
        raise CurveError(crossings, hint="draw a simpler one, or use plyfold from Python or the command line")
    return drawn


@lru_cache(maxsize=_REMEMBERED)
def first_immersion(strokes: tuple[Stroke, ...]) -> Immersion | Obstruction | Unknown:
    """Return an immersion of the outline, or why there is none; Unknown if that is not decided in seconds."""
    return find_immersion(arranged(strokes), time_limit=patient(_SECONDS_TO_FIND))


@lru_cache(maxsize=_REMEMBERED)
def immersion_count(strokes: tuple[Stroke, ...]) -> int | None:
    """Return the number of immersions of the outline; None if that is not found in time."""
    count = count_immersions(arranged(strokes), time_limit=patient(_SECONDS_TO_NUMBER))
    return None if isinstance(count, Unknown) else count


@lru_cache(maxsize=4 * _REMEMBERED)
def immersed(strokes: tuple[Stroke, ...], number: int) -> Immersion:
    """Return an immersion of the outline by its number, which wraps round; the first, where they are not counted.

    Raises
    ------
    NotImmersibleError
        If there is none.
    TimeLimitError
        If that was not decided in time.
    """
    found = first_immersion(strokes)
    if isinstance(found, Obstruction):
        raise NotImmersibleError(found)
    if isinstance(found, Unknown):
        raise TimeLimitError(found.sentence)
    count = immersion_count(strokes)
    return found if count is None or count == 1 else nth_immersion(arranged(strokes), number % count)


@dataclass(frozen=True)
class Layered:
    """A layering of an immersion, or why there is none.

    Parameters
    ----------
    found : Layering, Obstruction or Unknown
    number : int
        Which of the layerings it is.
    count : int or None
        How many there are; None if that was not found in time.
    """

    found: Layering | Obstruction | Unknown
    number: int
    count: int | None


@lru_cache(maxsize=4 * _REMEMBERED)
def layered(strokes: tuple[Stroke, ...], immersion: int, layering: int) -> Layered:
    """Return a layering by its number, which wraps round, among the first 10,000 of them.

    Where the layerings are not counted in time, listing them may never come to an end either; then it is the one that
    was found first.
    """
    disk = immersed(strokes, immersion)
    found = find_layering(disk, patient(_SECONDS_TO_DECIDE))
    if not isinstance(found, Layering):
        return Layered(found, 0, 0 if isinstance(found, Obstruction) else None)
    count = count_layerings(disk, patient(_SECONDS_TO_COUNT))
    if isinstance(count, Unknown):
        return Layered(found, 0, None)
    number = layering % min(count, _MOST_LISTED)
    return Layered(next(islice(layerings(disk), number, None)), number, count)
