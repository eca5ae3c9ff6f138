"""Long tables of numbers as text, fast."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

__all__ = ["rows_as_text"]

_AT_ONCE = 1 << 16


def rows_as_text(template: str, rows: npt.NDArray[np.generic]) -> str:
    """Return the template filled with each row; ``%r`` gives a number that reads back exactly, ``%d`` an integer.

    Examples
    --------
    >>> rows_as_text("v %r %r;", np.array([(0.1, 2.0), (3.0, 4.0)]))
    'v 0.1 2.0;v 3.0 4.0;'
    """
    parts = (rows[start : start + _AT_ONCE] for start in range(0, len(rows), _AT_ONCE))
    return "".join(template * len(part) % tuple(part.ravel().tolist()) for part in parts)
