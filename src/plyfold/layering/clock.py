"""A time limit that runs from the moment it is made."""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from threading import TIMEOUT_MAX
from typing import TypeVar

from plyfold.errors import InputError

__all__ = ["NO_LIMIT", "Clock"]

Item = TypeVar("Item")

# So many items of a long list are gone through between two looks at the clock.
_ITEMS_AT_A_TIME = 4096


def _now() -> float:
    return time.monotonic()


@dataclass(frozen=True)
class Clock:
    """How much time is left of a limit in seconds; there may be no limit.

    Examples
    --------
    >>> Clock(None).left is None, Clock(None).over, Clock(0.0).over
    (True, False, True)
    """

    limit: float | None
    started: float = field(default_factory=_now)

    def __post_init__(self) -> None:
        if self.limit is not None and not (isinstance(self.limit, int | float) and self.limit >= 0):
            raise InputError(f"a time limit is a number of seconds from 0 on, not {self.limit!r}")

    @property
    def spent(self) -> float:
        """Seconds since the start."""
        return _now() - self.started

    @property
    def left(self) -> float | None:
        """Seconds until the end, at least 0; None without a limit."""
        return None if self.limit is None or self.limit > TIMEOUT_MAX else max(self.limit - self.spent, 0.0)

    @property
    def over(self) -> bool:
        """Whether the end has come."""
        return self.left == 0

    def check(self) -> None:
        """Raise TimeoutError when the time is over."""
        if self.over:
            raise TimeoutError

    def while_time(self, items: Iterable[Item]) -> Iterator[Item]:
        """Yield the items; raises TimeoutError soon after the time is over.

        Examples
        --------
        >>> list(Clock(None).while_time("abc"))
        ['a', 'b', 'c']
        """
        for number, item in enumerate(items):
            if number % _ITEMS_AT_A_TIME == 0:
                self.check()
            yield item


NO_LIMIT = Clock(None)
