"""From strokes to the values the library reads, remembered for the last few drawings, so that ←/→ is quick."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

from plyfold.arrangement import Arrangement, arrangement
from plyfold.curve import Curve
from plyfold.errors import StrokeError
from plyfold.sketch.schema import Stroke

__all__ = ["arranged", "curve_of"]

_REMEMBERED = 8


def curve_of(strokes: Sequence[Stroke]) -> Curve:
    """Join the strokes into the loop that they draw; a single closed one is a loop already.

    Raises
    ------
    StrokeError
        If they do not make one closed loop.
    CurveError
        If the loop is degenerate.
    """
    if len(strokes) == 1 and strokes[0].closed:
        return Curve(strokes[0].points)
    closed = [stroke.points[0] for stroke in strokes if stroke.closed and stroke.points]
    if closed:
        what = "several closed loops" if len(closed) > 1 else "a closed loop and other strokes beside it"
        raise StrokeError(f"the drawing has {what}, and it should be one loop", closed, "erase what does not belong")
    return Curve.from_strokes(stroke.points for stroke in strokes)


@lru_cache(maxsize=_REMEMBERED)
def arranged(strokes: tuple[Stroke, ...]) -> Arrangement:
    """Return the arrangement of the loop that strokes draw."""
    return arrangement(curve_of(strokes))
