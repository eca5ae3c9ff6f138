"""Everything that plyfold can raise on purpose.

::

    PlyfoldError
    ├── InputError            the input is not a usable closed curve
    │   ├── CurveError        bad points: NaN, too few, all on one line
    │   ├── StrokeError       strokes that cannot be joined into one loop
    │   ├── FileFormatError   a file that cannot be read as a curve
    │   ├── GaussCodeError    a code that no closed plane curve has
    │   └── WallError         a solid cannot have walls as thick as was asked for
    ├── GeneralPositionError  touching or overlapping strands, and perturbing was not allowed or did not help
    ├── NotImmersibleError    a disk was asked for, and the curve bounds none (carries the obstruction)
    ├── NotEmbeddableError    a layered surface was asked for, and there is none (carries the obstruction)
    ├── CertificateError      a check of a mesh fails (:mod:`plyfold.certify`)
    ├── PrecisionError        double precision cannot hold the mesh (the decision itself is exact)
    ├── TimeLimitError        a step was stopped before it had an answer
    └── MemoryLimitError      an answer, or a step on the way to it, does not fit into memory
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from plyfold.obstruction import Obstruction

__all__ = [
    "CertificateError",
    "CurveError",
    "FileFormatError",
    "GaussCodeError",
    "GeneralPositionError",
    "InputError",
    "MemoryLimitError",
    "NotEmbeddableError",
    "NotImmersibleError",
    "PlyfoldError",
    "PrecisionError",
    "StrokeError",
    "TimeLimitError",
    "WallError",
]


class PlyfoldError(Exception):
    """Root of all errors that plyfold raises on purpose.

    Parameters
    ----------
    message : str
        One sentence saying what is wrong.
    where : iterable of (x, y), optional
        The places concerned, in the coordinates of the input; empty if there is no place.
    hint : str, optional
        One sentence saying what to try.

    Examples
    --------
    >>> error = PlyfoldError("two strands touch", where=[(1.0, 2.0)], hint="move one of them")
    >>> print(error)
    two strands touch, at (1, 2)
      hint: move one of them
    """

    def __init__(self, message: str, where: Iterable[Iterable[float]] = (), hint: str = "") -> None:
        self.message = message
        self.where: tuple[tuple[float, ...], ...] = tuple(tuple(float(x) for x in place) for place in where)
        self.hint = hint
        super().__init__(self._sentence())

    def _sentence(self) -> str:
        shown = ", ".join("(" + ", ".join(f"{x:.12g}" for x in place) + ")" for place in self.where[:5])
        more = f" and {len(self.where) - 5} more" if len(self.where) > 5 else ""
        place = f", at {shown}{more}" if shown else ""
        hint = f"\n  hint: {self.hint}" if self.hint else ""
        message = self.message.removesuffix(".") if place else self.message
        return f"{message}{place}{hint}"


class InputError(PlyfoldError, ValueError):
    """The input is not a usable closed curve."""


class CurveError(InputError):
    """The points do not make a closed curve: NaN or infinite, fewer than three distinct, or all on one line."""


class StrokeError(InputError):
    """The strokes cannot be joined into one closed loop."""


class FileFormatError(InputError):
    """The file is empty, broken, too large or holds no curve."""


class GaussCodeError(InputError):
    """The signed Gauss code belongs to no closed plane curve."""


class WallError(InputError):
    """The walls of a solid cannot be as thick as was asked for: sheets over each other leave no room there."""


class GeneralPositionError(PlyfoldError):
    """Strands touch, overlap or meet three at a point, and they were not (or could not be) moved apart."""


class _ObstructedError(PlyfoldError):
    """An answer that was asked for does not exist; ``obstruction`` says why."""

    def __init__(self, obstruction: Obstruction, hint: str = "") -> None:
        super().__init__(str(obstruction), obstruction.where, hint)
        self.obstruction = obstruction

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.obstruction, self.hint)


class NotImmersibleError(_ObstructedError):
    """The curve is not the boundary of an immersed disk."""


class NotEmbeddableError(_ObstructedError):
    """No immersion of the curve can be layered without cutting itself."""


class CertificateError(PlyfoldError):
    """A checked mesh breaks a condition; the message names the condition and the place."""


class PrecisionError(PlyfoldError):
    """Double precision cannot hold what was to be drawn, a mesh or polygons; the combinatorial answers stay exact."""


class TimeLimitError(PlyfoldError):
    """The time limit ended a step before it had an answer; ``stage`` names it, where there are several.

    Examples
    --------
    >>> TimeLimitError("not done after 5 seconds", stage="smoothing heights").stage
    'smoothing heights'
    """

    def __init__(self, message: str, where: Iterable[Iterable[float]] = (), hint: str = "", stage: str = "") -> None:
        super().__init__(message, where, hint)
        self.stage = stage


class MemoryLimitError(PlyfoldError, MemoryError):
    """An answer would not fit into memory; the sentence says how large it is, and the hint which call does without."""
