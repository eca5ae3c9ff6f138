"""Processes that answer questions: warm, one question at a time, and killed when nobody waits for the answer.

A question can take as long as it likes, in code that cannot be interrupted. So it is put to a process of its own,
which is ended when its time is over, when a newer question takes its place, or when the page has gone; the next
question finds another one waiting. Where the system has a fork server, a new process takes some hundredths of a second,
with all modules loaded.
"""

from __future__ import annotations

import os
import signal
import socket
import sys
import threading
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from multiprocessing import connection, get_context, parent_process, resource_tracker
from multiprocessing.connection import Connection
from typing import Any

from plyfold.sketch.answers import Reply, answer, error_reply

__all__ = ["Question", "Workers"]

_WAITING = 2
_MOST = 8
_MOST_MEMORY = 3 * 2**30
_ONE_THREAD = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")

_SUPERSEDED = error_reply("superseded", "a newer question took the place of this one")
_GONE = error_reply("superseded", "the page has gone")
_DIED = error_reply("internal", "the process that worked on this has died", hint="perhaps it took too much memory")


@dataclass(frozen=True)
class Question:
    """What a page asks.

    Parameters
    ----------
    name : str
        The last part of the address.
    body : bytes
    headers : mapping of str to str
    seconds : float
        How long the answer may take.
    place : tuple of str or None
        A newer question with the same place takes it: this one is not answered any more.
    """

    name: str
    body: bytes
    headers: Mapping[str, str]
    seconds: float
    place: tuple[str, str] | None = None


@dataclass(eq=False)
class _Worker:
    process: Any
    pipe: Connection
    ended: Reply | None = None  # why it was or will be killed


def _warm_context() -> Any:
    """Return a way to start processes, from a server that forks them with all modules loaded, where that is safe."""
    for variable in _ONE_THREAD:  # small matrices; and a process with threads should not be forked
        os.environ.setdefault(variable, "1")
    if sys.platform != "linux":
        return get_context("spawn")
    context = get_context("forkserver")
    context.set_forkserver_preload(["plyfold.sketch.warm"])
    return context


@contextmanager
def _interrupts_kept_from_children() -> Iterator[None]:
    """Start processes that never hear of Ctrl-C, which is for the server; it hears it in its other threads meanwhile.

    A fork server and its forks import for a second before they could ignore it themselves.
    """
    if sys.platform == "win32":
        yield
        return
    resource_tracker.ensure_running()  # when it is started, it lets interrupts through again
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@dataclass
class Workers:
    """The processes. Threads may ask at the same time; ``close`` ends them all."""

    _context: Any = field(default_factory=_warm_context)
    _lock: threading.Lock = field(default_factory=threading.Lock)
    _waiting: list[_Worker] = field(default_factory=list)
    _working: dict[_Worker, tuple[str, str] | None] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._waiting += [self._start() for _ in range(_WAITING)]

    def ask(self, question: Question, page: socket.socket | None = None) -> Reply:
        """Put a question to a worker and wait for the answer, as long as the page's connection is open.

        Parameters
        ----------
        question : Question
        page : socket, optional
            Where the answer will go.

        Returns
        -------
        Reply
        """
        worker = self._take(question.place)
        if worker is None:
            return error_reply("busy", f"{_MOST} questions are being answered already", hint="wait a moment")
        try:
            worker.pipe.send((question.name, question.body, dict(question.headers)))
            found = _outcome(worker, question.seconds, page)
        except OSError:  # it was killed before it could read the question
            found = None
        return self._give_back(worker, found)

    def close(self) -> None:
        """End all processes, whatever they do."""
        with self._lock:
            for worker in (*self._waiting, *self._working):
                worker.process.kill()
            self._waiting.clear()

    def _start(self) -> _Worker:
        ours, theirs = self._context.Pipe()
        process = self._context.Process(target=_work, args=(theirs,), daemon=True)
        with _interrupts_kept_from_children():
            process.start()
        theirs.close()
        return _Worker(process, ours)

    def _take(self, place: tuple[str, str] | None) -> _Worker | None:
        """Take a waiting worker, the last one used first: it may remember the drawing. Stop the place's earlier one."""
        with self._lock:
            for other, taken in self._working.items():
                if place is not None and taken == place:
                    other.ended = _SUPERSEDED
                    other.process.kill()
            if len(self._working) >= _MOST:
                return None
            self._waiting[:] = [worker for worker in self._waiting if worker.process.is_alive()]
            worker = self._waiting.pop() if self._waiting else self._start()
            self._working[worker] = place
            return worker

    def _give_back(self, worker: _Worker, found: Reply | None) -> Reply:
        with self._lock:
            del self._working[worker]
            if found is not None and worker.ended is None and len(self._waiting) < _WAITING:
                self._waiting.append(worker)
                return found
            worker.process.kill()
            worker.pipe.close()
            if len(self._waiting) < _WAITING:
                self._waiting.insert(0, self._start())
        return found or worker.ended or _DIED


def _outcome(worker: _Worker, seconds: float, page: socket.socket | None) -> Reply | None:
    """Wait for the answer until the time is over, the page has gone, or the worker has died."""
    end = time.monotonic() + seconds
    watched: list[Any] = [worker.pipe] if page is None else [worker.pipe, page]
    while (left := end - time.monotonic()) > 0:
        ready = connection.wait(watched, left)
        if worker.pipe in ready:
            return _received(worker.pipe)
        if page in ready:
            if _has_gone(page):
                worker.ended = _GONE
                return None
            watched.remove(page)  # it sends its next question already
    hint = "draw something simpler, or ask for less"
    worker.ended = error_reply("time limit", f"there is no answer after {seconds:g} seconds", hint=hint)
    return None


def _received(pipe: Connection) -> Reply | None:
    try:
        found = pipe.recv()
    except (EOFError, OSError):
        return None
    assert isinstance(found, Reply)
    return found


def _has_gone(page: Any) -> bool:
    try:
        return not page.recv(1, socket.MSG_PEEK)
    except OSError:
        return True


# ---- in the worker ---------------------------------------------------------------------------------------------------


def _work(pipe: Connection) -> None:
    """Answer questions one after the other, until there is nobody left to ask."""
    import plyfold.sketch.warm  # noqa: F401

    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the server, which ends its workers
    _limit_memory()
    threading.Thread(target=_end_with_server, daemon=True).start()
    while True:
        try:
            question = pipe.recv()
        except (EOFError, OSError):
            return
        pipe.send(answer(*question))


def _limit_memory() -> None:
    """Let a question that would fill the machine's memory fail by itself."""
    if sys.platform == "linux":
        import resource

        _, most = resource.getrlimit(resource.RLIMIT_AS)
        limit = _MOST_MEMORY if most == resource.RLIM_INFINITY else min(most, _MOST_MEMORY)
        resource.setrlimit(resource.RLIMIT_AS, (limit, most))


def _end_with_server() -> None:
    """Leave no worker behind if the server is killed."""
    server = parent_process()
    assert server is not None
    server.join()
    os._exit(1)
