"""Options that are of the wrong kind are refused by name, before any work."""

from __future__ import annotations

import numpy as np

from plyfold.errors import InputError

__all__ = ["refuse_unless_flag", "refuse_unless_number"]


def refuse_unless_number(name: str, value: object) -> None:
    """Raise InputError for anything but a real number; truth values and NaN are none.

    Examples
    --------
    >>> refuse_unless_number("gap", 0.5)
    >>> refuse_unless_number("gap", "wide")
    Traceback (most recent call last):
    plyfold.errors.InputError: gap must be a number, not 'wide'
    """
    real = isinstance(value, int | float | np.integer | np.floating) and not isinstance(value, bool)
    if not real or value != value:  # noqa: PLR0124 - only NaN differs from itself
        raise InputError(f"{name} must be a number, not {value!r}")


def refuse_unless_flag(name: str, value: object) -> None:
    """Raise InputError for anything but True or False.

    Examples
    --------
    >>> refuse_unless_flag("force", False)
    >>> refuse_unless_flag("force", "no")
    Traceback (most recent call last):
    plyfold.errors.InputError: force must be True or False, not 'no'
    """
    if not isinstance(value, bool | np.bool_):
        raise InputError(f"{name} must be True or False, not {value!r}")
