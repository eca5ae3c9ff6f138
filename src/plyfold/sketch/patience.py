"""How long the server waits for answers: on a slow or busy machine the environment can ask it to wait longer."""

from __future__ import annotations

import os

from plyfold.errors import InputError

__all__ = ["patient"]

_VARIABLE = "PLYFOLD_PATIENCE"


def patient(seconds: float) -> float:
    """Return a time limit, multiplied by the environment's ``PLYFOLD_PATIENCE``, 1 where it is not set.

    Raises
    ------
    InputError
        If the variable is not a positive number.

    Examples
    --------
    >>> patient(20) == 20 * float(os.environ.get("PLYFOLD_PATIENCE", 1))
    True
    """
    text = os.environ.get(_VARIABLE, "1")
    try:
        factor = float(text)
    except ValueError:
        factor = 0.0
    if not factor > 0:
        raise InputError(f"{_VARIABLE} is {text!r}", hint="set it to the number by which time limits are multiplied")
    return seconds * factor
