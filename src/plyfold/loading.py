"""Libraries that take longer to import than small drawings take to answer.

They are imported when they are needed. Whoever shows the seconds of his stages calls this first, so that importing is a
stage of its own, and no part of the first one that happens to need them.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib import import_module

__all__ = ["FOR_CROSSINGS", "FOR_LAYERINGS", "FOR_MESHES", "load_libraries"]

FOR_CROSSINGS = ("shapely",)
FOR_MESHES = ("scipy.sparse.csgraph", "scipy.sparse.linalg")
FOR_LAYERINGS = ("pysat.solvers", *FOR_MESHES)


def load_libraries(names: tuple[str, ...], progress: Callable[[str, float], None] | None = None) -> None:
    """Import some libraries, and report a stage of its own if that is still to be done.

    Parameters
    ----------
    names : tuple of str
    progress : callable, optional
        Called with ``"loading libraries"`` and 0.
    """
    missing = [name for name in names if name not in sys.modules]
    if missing and progress is not None:
        progress("loading libraries", 0.0)
    for name in missing:
        import_module(name)
