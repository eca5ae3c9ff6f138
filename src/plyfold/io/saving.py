"""Saving a file whole or not at all, and never over another one by accident."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

__all__ = ["refuse_existing", "save_bytes"]


def refuse_existing(path: str | os.PathLike[str], force: bool = False) -> None:
    """Raise FileExistsError if a file exists and is not to be replaced.

    Examples
    --------
    >>> refuse_existing(os.devnull)
    Traceback (most recent call last):
    FileExistsError: /dev/null exists already; it was not overwritten
    """
    if Path(path).exists() and not force:
        raise FileExistsError(f"{path} exists already; it was not overwritten")


def save_bytes(path: str | os.PathLike[str], content: bytes, force: bool = False) -> None:
    """Write a file so that it appears complete or not at all, even if the program is killed.

    Parameters
    ----------
    path : path
    content : bytes
    force : bool
        Replace an existing file.

    Raises
    ------
    FileExistsError
        If the file exists and ``force`` is not set.
    """
    refuse_existing(path, force)
    target = Path(path)
    with tempfile.TemporaryDirectory(dir=target.parent, prefix=".plyfold-") as folder:
        draft = Path(folder) / target.name
        draft.write_bytes(content)
        draft.replace(target)
