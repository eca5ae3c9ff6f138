"""Pauses of compiled loops. This module stays Python, for at every call of its functions the interpreter looks up."""

from __future__ import annotations

__all__ = ["pause"]


def pause() -> None:
    """Let other threads run, and Ctrl-C be heard; costs a tenth of a microsecond.

    Examples
    --------
    >>> pause()
    """
