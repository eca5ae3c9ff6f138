"""Many closed curves decided one after the other, without going back to Python between them."""

from __future__ import annotations

from collections.abc import Callable

from plyfold.core.buffers import RealBuffer, WholeBuffer
from plyfold.core.verdict import NO, NOT_TOLD, YES, PlainCurve

__all__ = ["decide_each"]

_NO, _YES, _NOT_TOLD = NO, YES, NOT_TOLD


def decide_each(
    points: RealBuffer, start: WholeBuffer, told: WholeBuffer, figures: WholeBuffer, step: Callable[[], None]
) -> None:
    """Tell of many closed curves whether they bound disks, and how they cross, turn and wind.

    Parameters
    ----------
    points : buffer of float
        Coordinates of all curves, point after point.
    start : buffer of m + 1 int
        Curve i has points ``start[i]`` up to ``start[i + 1]``.
    told : buffer of m int
        Filled with what :func:`~plyfold.core.verdict.decide` returns.
    figures : buffer of 3m int
        Filled with the number of crossings, the turning number and the lowest winding number on the left of a border,
        curve after curve; left as it is where nothing is told because of the points.
    step : callable
        Called now and then; it may raise.

    Examples
    --------
    >>> from array import array
    >>> told, figures = array("q", [0, 0]), array("q", [0] * 6)
    >>> points = array("d", [0, 0, 1, 0, 0, 1, 0, 0, 2, 2, 2, 0, 0, 2])
    >>> decided = decide_each(memoryview(points), array("q", [0, 3, 7]), told, figures, lambda: None)
    >>> told.tolist(), figures.tolist()
    ([1, 0], [0, 1, 1, 1, 0, 0])
    """
    for row in range(len(told)):
        told[row] = _NOT_TOLD
        curve = PlainCurve(step)
        if not curve.draw(points[2 * start[row] : 2 * start[row + 1]]):
            continue
        curve.find_direction()
        figures[3 * row] = curve.k
        figures[3 * row + 1], figures[3 * row + 2] = curve.direction.turning, curve.direction.lowest
        if curve.direction.turning != 1 or curve.direction.lowest < 1:
            told[row] = _NO
        elif curve.k == 0:
            # A curve that does not cross itself bounds a disk, without a word.
            told[row] = _YES
        else:
            curve.find_cells()
            curve.write_word()
            told[row] = curve.has_grouping()
