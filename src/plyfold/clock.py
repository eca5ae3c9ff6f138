"""Time limits: a clock that runs from the moment it is made, and a watch over long work, which keeps to it."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace
from functools import partial
from threading import TIMEOUT_MAX, Event, Thread
from typing import NoReturn, TypeAlias, TypeVar

from plyfold.errors import InputError, TimeLimitError

__all__ = ["NO_LIMIT", "UNWATCHED", "Clock", "Progress", "Watch", "make_call"]

Progress: TypeAlias = Callable[[str, float], None]
_Answer = TypeVar("_Answer")
_Item = TypeVar("_Item")

# Calls that concern fewer things than this do not last, and are not worth a thread.
_MANY = 50_000
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
        if self.limit is None:
            return
        if isinstance(self.limit, bool) or not (isinstance(self.limit, int | float) and self.limit >= 0):
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

    def while_time(self, items: Iterable[_Item]) -> Iterator[_Item]:
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

    def share(self, part: float) -> Clock:
        """Return a clock with a part of the time that is left."""
        left = self.left
        return Clock(None if left is None else part * left)


NO_LIMIT = Clock(None)


@dataclass(frozen=True)
class Watch:
    """What long work asks at every step: whether there is time left; and whom it tells how far it is.

    Parameters
    ----------
    clock : Clock
    progress : callable, optional
        Called with the name of the stage and the fraction of it done.
    stage : str
        What is being done: "smoothing heights", "gluing the sheets", ...

    Examples
    --------
    >>> watch = Watch(Clock(None), lambda stage, done: print(f"{stage}: {done:.0%}"))
    >>> watch.begin("counting").step(0.5)
    counting: 0%
    counting: 50%
    >>> Watch(Clock(0)).begin("counting")
    Traceback (most recent call last):
    plyfold.errors.TimeLimitError: the answer is unknown after 0 seconds, which ended while counting
      hint: allow more time
    """

    clock: Clock = NO_LIMIT
    progress: Progress | None = None
    stage: str = "working"

    def begin(self, stage: str) -> Watch:
        """Return a watch over a stage that begins now."""
        watch = replace(self, stage=stage)
        watch.step(0.0)
        return watch

    def step(self, done: float | None = None) -> None:
        """Go on: raise TimeLimitError if the time is over; tell how much of the stage is done, where that is known."""
        if self.progress is not None and done is not None:
            self.progress(self.stage, done)
        if self.clock.over:
            raise self._late()

    def wait_for(self, call: Callable[[], _Answer], size: int) -> _Answer:
        """Make a call of foreign code that cannot be stopped: the limit and Ctrl-C do not wait for its end.

        It is made in another thread, since signals have to wait for as long as this one is in foreign code. Where the
        time ends first, the call is left to itself: its answer is thrown away, and its thread ends with it. A process
        that wants to end waits for that, since foreign code must not lose its memory while it works.

        Parameters
        ----------
        call : callable
            Shares nothing that anybody goes on to use after an error.
        size : int
            How many things it concerns: a call for few of them is simply made.
        """
        self.step()
        if size < _MANY:
            return call()
        outcome: list[Callable[[], _Answer]] = []
        done = Event()
        Thread(target=make_call, args=(call, outcome, done)).start()
        if not done.wait(self.clock.left):
            raise self._late()
        return outcome[0]()

    def _late(self) -> TimeLimitError:
        sentence = f"the answer is unknown after {self.clock.limit or 0:.3g} seconds, which ended while {self.stage}"
        return TimeLimitError(sentence, hint="allow more time", stage=self.stage)


def make_call(call: Callable[[], _Answer], outcome: list[Callable[[], _Answer]], done: Event) -> None:
    """Make a call for another thread, which waits: leave a function that returns its answer, or raises its error."""
    try:
        answer = call()
        outcome.append(lambda: answer)
    except BaseException as error:  # it is raised in the thread that waits
        outcome.append(partial(_raise, error))
    finally:
        done.set()


def _raise(error: BaseException) -> NoReturn:
    raise error


UNWATCHED = Watch()
"""No limit, and nobody to tell."""
