"""The program ``plyfold``: wherever it is, Ctrl-C ends it at once, with no half-written file, and exit code 130.

This comes before the package, whose import takes some hundredths of a second, and imports little itself. An interrupt
is no exception here: one raised within an import, or in a call from foreign code, can be lost, or turn into another
one. And it need not wait for foreign code to come back: a thread of its own hears of it.
"""

from __future__ import annotations

import os
import signal
import sys
from _thread import RLock, start_new_thread
from contextlib import suppress
from typing import NoReturn

__all__ = ["CLEAR_LINE", "INTERRUPTED", "INTERRUPTED_SENTENCE", "end_at_interrupts", "main", "raise_interrupts"]

INTERRUPTED = 130
INTERRUPTED_SENTENCE = "plyfold: interrupted; nothing was left half-written"
CLEAR_LINE = "\r\x1b[K"

_leaving = RLock()


def main() -> NoReturn:
    """Run the command line."""
    end_at_interrupts()
    from plyfold.cli.commands import main

    sys.exit(main())


def end_at_interrupts() -> None:
    """Let Ctrl-C end the process, from now on; unless it was started with the wish that it does not."""
    if signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        return
    signal.signal(signal.SIGINT, _leave)
    if os.name == "posix":  # elsewhere, pipes that do not block are not to be had
        heard, written = os.pipe()
        os.set_blocking(written, False)
        signal.set_wakeup_fd(written, warn_on_full_buffer=False)
        start_new_thread(_listen, (heard,))


def raise_interrupts() -> None:
    """Let Ctrl-C raise KeyboardInterrupt again, for a command that has more to do then than to end."""
    if signal.getsignal(signal.SIGINT) is _leave:
        signal.set_wakeup_fd(-1)
        signal.signal(signal.SIGINT, signal.default_int_handler)


def _listen(heard: int) -> None:
    """Leave when a signal comes; the main thread does so itself if it is not in foreign code."""
    while signal.SIGINT not in os.read(heard, 1):
        pass
    _leave()


def _leave(*_: object) -> NoReturn:
    """End the process, in whichever thread is first; the other one gets no further than here."""
    with _leaving:
        saving = sys.modules.get("plyfold.io.saving")
        for draft in list(getattr(saving, "unfinished", ())):
            with suppress(OSError):
                draft.unlink()
        _say(INTERRUPTED_SENTENCE)
        os._exit(INTERRUPTED)


def _say(message: str) -> None:
    """Write to standard error past Python's streams: the signal may have come while these were being written to."""
    with suppress(OSError):
        os.write(2, ((CLEAR_LINE if os.isatty(2) else "") + message + "\n").encode())
