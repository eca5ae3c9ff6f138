"""What a command on the command line says while it works, and how long its stages take."""

from __future__ import annotations

import sys
import time

from plyfold_command import CLEAR_LINE

__all__ = ["Stopwatch", "clear_progress", "timing"]

# Before so much of a stage is done, and so many seconds of it are over, what is left is a mere guess.
_LEAST_SHARE, _LEAST_SECONDS = 0.05, 2.0


def _progress_is_seen() -> bool:
    return sys.stderr is not None and sys.stderr.isatty()


def clear_progress() -> None:
    """Wipe the line of progress, so that the next words begin a line of their own."""
    if _progress_is_seen():
        print(CLEAR_LINE, end="", file=sys.stderr, flush=True)


class Stopwatch:
    """Seconds per stage, and one line of progress on a terminal."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}
        self._stage, self._since = "", time.perf_counter()

    def __call__(self, stage: str, done: float = 0.0) -> None:
        """Show the stage, and start it if it is not the current one."""
        if stage != self._stage:
            self.stop()
            self._stage = stage
        if stage and _progress_is_seen():
            told = f"{stage} {done:.0%}{_left(time.perf_counter() - self._since, done)}" if done else stage
            print(f"{CLEAR_LINE}{told}", end="", file=sys.stderr, flush=True)

    def stop(self) -> None:
        """End the current stage and clear the line."""
        now = time.perf_counter()
        if self._stage:
            self.seconds[self._stage] = self.seconds.get(self._stage, 0.0) + now - self._since
            clear_progress()
        self._stage, self._since = "", now


def _left(spent: float, done: float) -> str:
    """Say how much time a stage will take yet, if it goes on as it went so far and that can be told.

    Examples
    --------
    >>> _left(10.0, 0.25), _left(300.0, 0.5), _left(0.5, 0.5), _left(10.0, 0.01)
    (', about 30 s left', ', about 5 min left', '', '')
    """
    if done < _LEAST_SHARE or spent < _LEAST_SECONDS:
        return ""
    seconds = spent * (1 - done) / done
    return f", about {seconds:.0f} s left" if seconds < 100 else f", about {seconds / 60:.0f} min left"


def timing(watch: Stopwatch) -> str:
    """Return a line that tells how long each stage took."""
    return "  seconds: " + ", ".join(f"{stage} {seconds:.3f}" for stage, seconds in watch.seconds.items())
