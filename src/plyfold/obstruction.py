"""Why there is no answer of the kind asked for: it does not exist, or it was not found in time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from textwrap import shorten
from typing import Any

__all__ = ["IMMERSION_REASONS", "Obstruction", "Unknown"]

# What keeps an outline from bounding an immersed surface; other reasons keep an immersed one from being layered.
IMMERSION_REASONS = ("turning number", "negative winding", "cusp", "no grouping", "no gluing", "pieces")

# Longer sentences are cut where an obstruction is shown in a line.
_SHORT = 110


@dataclass(frozen=True)
class Obstruction:
    """The theorem that failed, and the place where it failed.

    An obstruction is false as a truth value, where an :class:`~plyfold.Immersion` or a :class:`~plyfold.Layering`
    is true, so ``if find_immersion(curve):`` reads as it should.

    Parameters
    ----------
    reason : str
        One of ``"turning number"``, ``"negative winding"``, ``"cusp"``, ``"no grouping"``, ``"no gluing"``,
        ``"pieces"`` (no immersion), ``"reversed pair"``, ``"cyclic order"``, ``"fixed orders"``, ``"casing"``,
        ``"heights"``, ``"no embedding"`` (no layering), ``"repair"`` (no small one), ``"paper's procedure"`` (it
        failed, which proves nothing).
    sentence : str
        The same for a person, in one sentence.
    where : tuple of (x, y)
        Places in the drawing; empty if the curve is purely combinatorial.
    value : object
        The number or the cells that prove it: the turning number, the winding number, the chain of sheets.
    subject : Arrangement or Immersion, optional
        What it is about, for its picture in notebooks. Obstructions are equal whatever their subjects.

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
    subject: Any = field(default=None, repr=False, compare=False)

    def __bool__(self) -> bool:
        return False

    def __str__(self) -> str:
        return self.sentence

    def __repr__(self) -> str:
        return f"<Obstruction, {self.reason}: {shorten(self.sentence, _SHORT, placeholder=' …')}>"

    def _repr_png_(self) -> bytes | None:
        from plyfold.draw.notebook import obstruction_png

        return obstruction_png(self)


@dataclass(frozen=True)
class Unknown:
    """Neither an answer nor a proof that there is none: the search was stopped before it had decided.

    It is false as a truth value, as an :class:`Obstruction` is; ``isinstance`` tells them apart.

    Parameters
    ----------
    reason : str
        ``"time limit"``, or ``"size"``: it would take too much memory.
    sentence : str
        The same for a person, with what was established.
    established : mapping of str to object
        What is certain: sizes of the problem, seconds spent, bounds, the best answer so far.

    Examples
    --------
    >>> unknown = Unknown("time limit", "Whether there is a layering is unknown after 2 s.", {"seconds": 2.0})
    >>> bool(unknown), str(unknown)
    (False, 'Whether there is a layering is unknown after 2 s.')
    """

    reason: str
    sentence: str
    established: Mapping[str, Any] = field(default_factory=dict, hash=False)

    def __bool__(self) -> bool:
        return False

    def __str__(self) -> str:
        return self.sentence
