"""Saving a file whole or not at all, and never over another one by accident."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO, TypeAlias

from plyfold.errors import InputError
from plyfold.options import refuse_unless_flag

__all__ = ["Target", "draft_in", "refuse_existing", "refuse_output", "save_bytes", "unfinished"]

# Where something is written to: a path, or a file that is open for bytes.
Target: TypeAlias = str | os.PathLike[str] | BinaryIO

# Drafts that are to be removed when the program is ended at this moment.
unfinished: set[Path] = set()


def refuse_existing(path: Target, force: bool = False) -> None:
    """Raise FileExistsError if a file exists and is not to be replaced.

    Examples
    --------
    >>> refuse_existing(os.devnull)
    Traceback (most recent call last):
    FileExistsError: /dev/null exists already and was not overwritten; force (--force) replaces it
    """
    refuse_unless_flag("force", force)
    if not isinstance(path, str | os.PathLike):
        return
    if Path(path).is_dir():
        raise IsADirectoryError(f"{path} is a folder")
    if Path(path).exists() and not force:
        raise FileExistsError(f"{path} exists already and was not overwritten; force (--force) replaces it")


def save_bytes(path: Target, content: bytes, force: bool = False) -> None:
    """Write a file so that it appears complete or not at all, even if the program is killed.

    A symbolic link stays, and the file that it leads to is written. A file that is replaced keeps its permissions.
    What is no file on a disk, such as a pipe or a terminal, is written to as it is, and so is an open file.

    Parameters
    ----------
    path : path or binary file
    content : bytes
    force : bool
        Replace an existing file.

    Raises
    ------
    FileExistsError
        If the file exists and ``force`` is not set.
    OSError
        If the folder is missing, cannot be written to, or is full.
    """
    if not isinstance(path, str | os.PathLike):
        path.write(content)
        return
    refuse_existing(path, force)
    target = Path(os.path.realpath(path))
    try:
        if target.exists() and not target.is_file():
            target.write_bytes(content)
        else:
            _replace(target, content)
    except OSError as error:  # it would name the draft
        raise OSError(error.errno, error.strerror, str(path)) from error


def _replace(target: Path, content: bytes) -> None:
    with draft_in(target.parent) as draft:
        with draft.open("xb") as file:
            file.write(content)
        if target.exists():
            shutil.copymode(target, draft)
        draft.replace(target)


@contextmanager
def draft_in(folder: Path, suffix: str = "") -> Iterator[Path]:
    """Give the path of a file that is not there yet, and is gone in the end: removed, or renamed."""
    draft = folder / f".plyfold-{os.urandom(8).hex()}{suffix}"
    unfinished.add(draft)
    try:
        yield draft
    finally:
        draft.unlink(missing_ok=True)
        unfinished.discard(draft)


def refuse_output(path: str, endings: tuple[str, ...], force: bool) -> None:
    """Refuse before any work is done what could not be written after it."""
    if Path(path).suffix.lower() not in endings:
        raise InputError(f"{path} cannot be written: its ending is none of {' '.join(endings)}")
    if not Path(path).absolute().parent.is_dir():
        raise InputError(f"{path} cannot be written: there is no folder {Path(path).parent}")
    refuse_existing(path, force)
