"""Why something does not exist: the certificate that stands in for an immersion or a layering."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

__all__ = ["Obstruction"]


@dataclass(frozen=True)
class Obstruction:
    """The theorem that failed, and the place where it failed.

    An obstruction is false as a truth value, where an :class:`~plyfold.Immersion` or a :class:`~plyfold.Layering`
    is true, so ``if find_immersion(curve):`` reads as it should.

    Parameters
    ----------
    reason : str
        One of ``"turning number"``, ``"negative winding"``, ``"no grouping"`` (no immersion), ``"reversed pair"``,
        ``"cyclic order"`` (no layering).
    sentence : str
        The same for a person, in one sentence.
    where : tuple of (x, y)
        Places in the drawing; empty if the curve is purely combinatorial.
    value : object
        The number or the cells that prove it: the turning number, the winding number, the chain of sheets.

    Examples
    --------
    >>> obstruction = Obstruction("turning number", "The curve turns twice; the outline of a disk turns once.", value=2)
    >>> bool(obstruction), str(obstruction)
    (False, 'The curve turns twice; the outline of a disk turns once.')
    """

    reason: str
    sentence: str
    where: tuple[tuple[float, float], ...] = ()
    value: Any = None

    def __bool__(self) -> bool:
        return False

    def __str__(self) -> str:
        return self.sentence
