"""Memory is asked for knowingly: large arrays are measured before they are made."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrays import Ints
from plyfold.errors import MemoryLimitError

if TYPE_CHECKING:
    from plyfold.arrangement.arrangement import Arrangement

__all__ = ["available_memory", "number_of_tuples", "require_memory"]

# So little is not worth asking the system how much there is.
_SURELY_THERE = 64 * 2**20


def require_memory(size: int, what: str, arrangement: Arrangement | None, hint: str) -> None:
    """Raise an error if something would not fit into memory.

    Parameters
    ----------
    size : int
        Bytes that it takes, with what is needed to make it.
    what : str
        What it is, with its number.
    arrangement : Arrangement or None
        The place named is in the cell that is covered most.
    hint : str
        Which call does without.

    Raises
    ------
    MemoryLimitError

    Examples
    --------
    >>> require_memory(10**6, "8 pairs of sheets", None, "")
    """
    if size <= _SURELY_THERE:
        return
    available = available_memory()
    if available is not None and size > available:
        raise MemoryLimitError(
            f"{what} would take {_written(size)} of memory, and {_written(available)} can be had",
            where=() if arrangement is None or arrangement.outline is None else [_most_covered(arrangement)],
            hint=hint,
        )


def number_of_tuples(winding: Ints, size: int) -> int:
    """Return how many ordered tuples of sheets there are over cells, w to the power of the size added up, exactly.

    Examples
    --------
    >>> number_of_tuples(np.array([1, 2, 3]), 2)
    14
    """
    return sum(number * w**size for w, number in enumerate(np.bincount(winding).tolist()))


def available_memory() -> int | None:
    """Return how many bytes this process can have without hurting others; None where the system does not say."""
    return min(_limits(), default=None)


def _limits() -> Iterator[int]:
    """Yield what the machine has free, what the container may still take, and what the process may."""
    if sys.platform == "linux":
        yield from _free_on_linux()
        yield from _free_in_container()
    elif hasattr(os, "sysconf") and "SC_PHYS_PAGES" in os.sysconf_names:
        yield os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    elif sys.platform == "win32":
        yield _free_on_windows()
    yield from _free_for_process()


def _free_on_linux() -> Iterator[int]:
    for line in _lines("/proc/meminfo"):
        if line.startswith("MemAvailable:"):
            yield 1024 * int(line.split()[1])


def _free_in_container() -> Iterator[int]:
    folder = "/sys/fs/cgroup/"
    for limit, used in zip(_lines(folder + "memory.max"), _lines(folder + "memory.current"), strict=False):
        if limit.strip() != "max":
            # Files that are kept in memory for later can go.
            kept = sum(
                int(line.split()[1]) for line in _lines(folder + "memory.stat") if line.startswith("inactive_file ")
            )
            yield max(int(limit) - int(used) + kept, 0)


def _free_for_process() -> Iterator[int]:
    try:
        import resource
    except ImportError:  # there is none on Windows
        return
    limit = resource.getrlimit(resource.RLIMIT_AS)[0]
    if limit != resource.RLIM_INFINITY:
        used = sum(int(line.split()[0]) for line in _lines("/proc/self/statm"))
        yield max(limit - used * resource.getpagesize(), 0)


def _free_on_windows() -> int:
    import ctypes

    class MemoryStatus(ctypes.Structure):
        _fields_ = (("length", ctypes.c_ulong), ("load", ctypes.c_ulong), ("sizes", ctypes.c_ulonglong * 7))

    status = MemoryStatus(length=ctypes.sizeof(MemoryStatus))
    ctypes.windll.kernel32.GlobalMemoryStatusEx(ctypes.byref(status))  # type: ignore[attr-defined]
    # Of total and free memory, total and free memory with what lies on disk, …
    return int(status.sizes[1])


def _lines(file: str) -> list[str]:
    try:
        return Path(file).read_text(encoding="ascii").splitlines()
    except OSError:
        return []


def _most_covered(arrangement: Arrangement) -> tuple[float, float]:
    return arrangement.cell_point(int(arrangement.winding.argmax()))


def _written(size: int) -> str:
    return f"{size / 2**30:,.1f} GiB" if size >= 2**30 else f"{size / 2**20:,.1f} MiB"
