"""A command for several drawings, one after the other: ``--each`` shape of a file, and several files."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from plyfold.cli.drawing import read_file
from plyfold.cli.inputs import BAD_INPUT, DISK, NO_DISK, UNKNOWN
from plyfold.cli.standard_output import asks_for_standard_output
from plyfold.errors import InputError
from plyfold_command import INTERRUPTED

if TYPE_CHECKING:
    from plyfold.io.reading import Contents

__all__ = ["each_file", "each_shape"]

# Of several exit codes the first one here is that of all together.
_WORST_FIRST = (BAD_INPUT, UNKNOWN, NO_DISK, DISK)


def each_file(options: argparse.Namespace, answer: Callable[[argparse.Namespace], int]) -> int:
    """Run a command for its file, and for each of several, if there are more; parameters as for :func:`each_shape`.

    Of several, the answer is a line of JSON for each, which names the file.
    """
    if not getattr(options, "more", None):
        return answer(options)
    return _worst(answer, (_of_one_file(options, file) for file in (options.file, *options.more)))


def _of_one_file(options: argparse.Namespace, file: str) -> argparse.Namespace:
    return argparse.Namespace(**vars(options) | {"file": file, "more": [], "json": True, "shape": {"file": file}})


def _worst(answer: Callable[[argparse.Namespace], int], several: Iterable[argparse.Namespace]) -> int:
    """Run a command several times, until it is interrupted, and return the exit code of all together."""
    codes = set()
    for options in several:
        codes.add(code := answer(options))
        if code == INTERRUPTED:
            return code
    return next(code for code in _WORST_FIRST if code in codes)


def each_shape(options: argparse.Namespace, answer: Callable[[argparse.Namespace], int]) -> int:
    """Run a command for each shape of its file.

    Parameters
    ----------
    options : Namespace
    answer : callable
        Runs the command with such options, and returns the exit code.

    Returns
    -------
    int
        2 if one of them was bad input, else 3 if one was undecided, else 1 if one is not what was asked for, else 0.
    """
    found: list[Contents] = []
    code = answer(argparse.Namespace(**vars(options) | {"run": partial(_open, found)}))
    if code != DISK:
        return code
    return _worst(answer, (_of_one_shape(options, found[0], number) for number in range(len(found[0]))))


def _open(found: list[Contents], options: argparse.Namespace) -> int:
    """Read the file, as a command of its own, so that errors are told as always."""
    if options.index is not None:
        raise InputError("--index chooses one shape, and --each takes all", hint="give one of them")
    if options.file.startswith("gallery:"):
        raise InputError("a curve of the gallery is one shape", hint="leave out --each")
    if asks_for_standard_output(options):
        raise InputError("--each writes several files, and standard output is one", hint="name a file")
    found.append(read_file(options))
    return DISK


def _of_one_shape(options: argparse.Namespace, contents: Contents, number: int) -> argparse.Namespace:
    """Return the options for one of the shapes; unless JSON is asked for, say which one it is."""
    name = contents.name(number)
    changed = {
        "read_shape": partial(contents.outline_and_ribbon, number),
        "shape": options.shape | {"index": number, "id": name},
    }
    if getattr(options, "output", None):
        changed["output"] = [_numbered(path, number) for path in options.output]
    if not getattr(options, "json", False):
        print(f"shape {number}" + (f" ({name})" if name else ""))
    return argparse.Namespace(**vars(options) | changed)


def _numbered(path: str, number: int) -> str:
    """Return the path of an output with a number before its ending.

    Examples
    --------
    >>> _numbered("out/loop.glb", 3)
    'out/loop-3.glb'
    """
    return str(Path(path).with_stem(f"{Path(path).stem}-{number}"))
