"""From strokes to the values the library reads, remembered for the last few drawings, so that ←/→ is quick."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import islice

from plyfold.arrangement.arrangement import Arrangement, arrange
from plyfold.errors import CurveError, NotImmersibleError, StrokeError
from plyfold.immersion.immersion import Immersion
from plyfold.immersion.solve import count_immersions, find_immersion, nth_immersion
from plyfold.layering.layering import Layering
from plyfold.layering.orders.counting import count_layerings
from plyfold.layering.orders.listing import layerings
from plyfold.layering.orders.search import find_layering
from plyfold.obstruction import Obstruction, Unknown
from plyfold.outline.curve import Curve
from plyfold.sketch.patience import patient
from plyfold.sketch.schema import Stroke

__all__ = ["Layered", "arranged", "curve_of", "immersed", "immersion_count", "layered"]

_REMEMBERED = 8
_SECONDS_TO_DECIDE = 5.0
_SECONDS_TO_COUNT = 1.0
_MOST_LISTED = 10_000
_MOST_CROSSINGS = 20_000


def curve_of(strokes: Sequence[Stroke]) -> Curve:
    """Join the strokes into the loop that they draw; a single closed one is a loop already.

    Raises
    ------
    StrokeError
        If they do not make one closed loop.
    CurveError
        If the loop is degenerate.

    Examples
    --------
    >>> len(curve_of([Stroke(((0, 0), (4, 0))), Stroke(((0, 3), (4, 0))), Stroke(((0, 0), (0, 3)))]))
    3
    """
    if len(strokes) == 1 and strokes[0].closed:
        return Curve(strokes[0].points)
    closed = [stroke.points[0] for stroke in strokes if stroke.closed and stroke.points]
    if closed:
        what = "several closed loops" if len(closed) > 1 else "a closed loop and other strokes beside it"
        raise StrokeError(f"the drawing has {what}, and it should be one loop", closed, "erase what does not belong")
    try:
        return Curve.from_strokes(stroke.points for stroke in strokes)
    except StrokeError as error:
        if len(error.where) != 2:
            raise
        sentence = "the ends are too far apart to be joined" if len(strokes) == 1 else "the strokes make no closed loop"
        raise StrokeError(sentence, error.where, "draw the missing part between the rings") from error


@lru_cache(maxsize=_REMEMBERED)
def arranged(strokes: tuple[Stroke, ...]) -> Arrangement:
    """Return the arrangement of the loop that strokes draw; refuse one that crosses itself more than 20,000 times."""
    drawn = arrange(curve_of(strokes))
    if drawn.n_crossings > _MOST_CROSSINGS:
        crossings = f"the loop crosses itself {drawn.n_crossings:,} times, more than {_MOST_CROSSINGS:,}"
        raise CurveError(crossings, hint="draw a simpler one, or use plyfold from Python or the command line")
    return drawn


@lru_cache(maxsize=_REMEMBERED)
def immersion_count(strokes: tuple[Stroke, ...]) -> int:
    """Return the number of immersions of the loop."""
    return count_immersions(arranged(strokes))


@lru_cache(maxsize=4 * _REMEMBERED)
def immersed(strokes: tuple[Stroke, ...], number: int) -> Immersion:
    """Return an immersion of the loop by its number, which wraps round.

    Raises
    ------
    NotImmersibleError
        If there is none.
    """
    count = immersion_count(strokes)
    if count:
        return nth_immersion(arranged(strokes), number % count)
    why = find_immersion(arranged(strokes))
    assert isinstance(why, Obstruction)
    raise NotImmersibleError(why)


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
