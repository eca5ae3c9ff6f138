"""Standard output and standard error as they may be: of few characters, full, or gone."""

from __future__ import annotations

import codecs
import errno
import functools
import io
import os
import sys
import unicodedata
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import ParamSpec, TextIO

__all__ = ["BAD_OUTPUT", "BROKEN_PIPE", "complain", "is_of_a_stream", "over_any_streams"]

BAD_OUTPUT, BROKEN_PIPE = 2, 141

_PLAIN = "plyfold.plain"
_DASHES = str.maketrans("−–", "--")

_P = ParamSpec("_P")


def over_any_streams(run: Callable[_P, int]) -> Callable[_P, int]:
    """Let a program end with a code and a sentence, not with a traceback, if its words cannot be written."""

    @functools.wraps(run)
    def guarded(*words: _P.args, **options: _P.kwargs) -> int:
        with _plain_characters():
            try:
                return _flushed(run, *words, **options)
            except BrokenPipeError:  # the reader has gone
                _silence(sys.stdout)
                return BROKEN_PIPE
            except OSError as error:
                complain(f"plyfold: standard output cannot be written ({(error.strerror or str(error)).lower()})")
                _silence(sys.stdout)
                return BAD_OUTPUT

    return guarded


def is_of_a_stream(error: OSError) -> bool:
    """Tell whether writing to a stream failed; if it is a file that cannot be written, the error names it."""
    return error.filename is None and error.errno in (errno.EPIPE, errno.ENOSPC, errno.EFBIG, errno.EIO)


def complain(text: str) -> None:
    """Print to standard error, if anybody is there; the exit code says the rest."""
    if sys.stderr is None:
        return
    try:
        print(text, file=sys.stderr, flush=True)
    except OSError:
        _silence(sys.stderr)


def _flushed(run: Callable[_P, int], *words: _P.args, **options: _P.kwargs) -> int:
    try:
        return run(*words, **options)
    finally:
        print(end="", flush=True)


def _silence(stream: TextIO | None) -> None:
    """Lead a stream nowhere, so that the interpreter can flush it when it ends."""
    if stream is not None:
        with suppress(OSError, ValueError):  # it may be no file
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


@contextmanager
def _plain_characters() -> Iterator[None]:
    """Write characters that a stream does not have in plain ones, instead of giving up."""
    streams = [stream for stream in (sys.stdout, sys.stderr) if isinstance(stream, io.TextIOWrapper)]
    strict = [(stream, stream.errors) for stream in streams if stream.errors in ("strict", "surrogateescape")]
    for stream, _ in strict:
        stream.reconfigure(errors=_PLAIN)
    try:
        yield
    finally:
        for stream, errors in strict:
            stream.reconfigure(errors=errors)


def _plain(error: UnicodeError) -> tuple[str, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    return "".join(map(_plain_character, error.object[error.start : error.end])), error.end


def _plain_character(character: str) -> str:
    r"""Return a character in ASCII.

    Examples
    --------
    >>> [_plain_character(character) for character in "⁺⁻é−☃"]
    ['+', '-', 'e', '-', '\\u2603']
    """
    parts = unicodedata.normalize("NFKD", character).translate(_DASHES)
    plain = "".join(part for part in parts if not unicodedata.combining(part))
    return plain.encode("ascii", "backslashreplace").decode()


codecs.register_error(_PLAIN, _plain)
