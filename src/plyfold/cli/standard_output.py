"""``-o -``: what a command writes goes to standard output, and what it says to standard error."""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Callable
from contextlib import redirect_stdout
from pathlib import Path

from plyfold.errors import InputError

__all__ = ["asks_for_standard_output", "name_of_output", "say_written", "through_standard_output"]

_NAME = "standard-output"


def asks_for_standard_output(options: argparse.Namespace) -> bool:
    """Tell whether one of the outputs is ``-``."""
    output = getattr(options, "output", None)
    return output == "-" or (isinstance(output, list) and "-" in output)


def through_standard_output(options: argparse.Namespace, run: Callable[[argparse.Namespace], int]) -> int:
    """Run a command; what goes to ``-`` is written to a file of its own first, and then to standard output, whole.

    Raises
    ------
    InputError
        If no format was named, or the output is more than one file.
    """
    if not asks_for_standard_output(options):
        return run(options)
    if options.format is None:
        raise InputError("standard output has no ending that chooses a format", hint="name one: -o - --format glb")
    with tempfile.TemporaryDirectory(prefix="plyfold-") as folder:
        path = Path(folder, f"{_NAME}.{options.format.removeprefix('.')}")
        outputs = [options.output] if isinstance(options.output, str) else options.output
        named = [str(path) if output == "-" else output for output in outputs]
        changed = {"output": named[0] if isinstance(options.output, str) else named}
        with redirect_stdout(sys.stderr):
            code = run(argparse.Namespace(**vars(options) | changed))
        _send(Path(folder), path)
    return code


def _send(folder: Path, path: Path) -> None:
    """Write to standard output what was written to the folder."""
    if len(list(folder.iterdir())) > 1:
        raise InputError("an OBJ with materials is two files", hint="write it to a path, or with --colours layers")
    if path.exists():
        sys.stdout.buffer.write(path.read_bytes())


def name_of_output(path: str) -> str:
    """Return what an output is called: its path, or standard output.

    Examples
    --------
    >>> name_of_output("loop.glb"), name_of_output("/tmp/plyfold-1/standard-output.glb")
    ('loop.glb', 'standard output')
    """
    return "standard output" if Path(path).stem == _NAME else path


def say_written(path: str) -> None:
    """Say that an output has been written."""
    print(f"  wrote {name_of_output(path)}")
