"""A time limit that runs from the moment it is made."""

from __future__ import annotations

import time
from dataclasses import dataclass, field

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

    @property
    def spent(self) -> float:
        """Seconds since the start."""
        return time.monotonic() - self.started

    @property
    def left(self) -> float | None:
        """Seconds until the end, at least 0; None without a limit."""
        return None if self.limit is None else max(self.limit - self.spent, 0.0)

    @property
    def over(self) -> bool:
        """Whether the end has come."""
        return self.left == 0
