"""A time limit that runs from the moment it is made."""

from __future__ import annotations

import time
from dataclasses import dataclass, field
from threading import TIMEOUT_MAX

from plyfold.errors import InputError

__all__ = ["Clock"]


@dataclass(frozen=True)
class Clock:
    """How much time is left of a limit in seconds; there may be no limit.

    Examples
    --------
    >>> Clock(None).left is None, Clock(None).over, Clock(0.0).over
    (True, False, True)
    """

    limit: float | None
    started: float = field(default_factory=time.monotonic)

    def __post_init__(self) -> None:
        if self.limit is not None and not (isinstance(self.limit, int | float) and self.limit >= 0):
            raise InputError(f"a time limit is a number of seconds from 0 on, not {self.limit!r}")

    @property
    def spent(self) -> float:
        """Seconds since the start."""
        return time.monotonic() - self.started

    @property
    def left(self) -> float | None:
        """Seconds until the end, at least 0; None without a limit."""
        return None if self.limit is None or self.limit > TIMEOUT_MAX else max(self.limit - self.spent, 0.0)

    @property
    def over(self) -> bool:
        """Whether the end has come."""
        return self.left == 0
