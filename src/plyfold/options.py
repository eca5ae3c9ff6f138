"""Options that are of the wrong kind are refused by name, before any work."""

from __future__ import annotations

import numpy as np

from plyfold.errors import InputError

__all__ = ["refuse_unless_count", "refuse_unless_flag", "refuse_unless_number"]


def refuse_unless_number(name: str, value: object) -> None:
    """Raise InputError for anything but a real number; truth values are none. Whether it is in range, the caller says.

    Examples
    --------
    >>> refuse_unless_number("gap", 0.5)
    >>> refuse_unless_number("gap", "wide")
    Traceback (most recent call last):
    plyfold.errors.InputError: gap must be a number, not 'wide'
    """
    if isinstance(value, bool) or not isinstance(value, int | float | np.integer | np.floating):
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


def refuse_unless_count(name: str, value: object, most: int = 1_000_000) -> None:
    """Raise InputError for anything but a whole number from 1 to ``most``.

    Examples
    --------
    >>> refuse_unless_count("pixels", 900)
    >>> refuse_unless_count("pixels", 0, most=20_000)
    Traceback (most recent call last):
    plyfold.errors.InputError: pixels must be a whole number from 1 to 20,000, not 0
    """
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or not 1 <= value <= most:
        raise InputError(f"{name} must be a whole number from 1 to {most:,}, not {value!r}")
