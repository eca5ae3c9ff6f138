"""Hot loops: ordinary Python over flat buffers, compiled ahead of time.

A module with a ``.pxd`` file beside it, which holds the C types of its functions, is compiled when plyfold is
installed (``tools/build_core.py``), into the folder ``machine``. Where that folder is missing, was made from other
sources than those here, or cannot be loaded, and where the environment variable PLYFOLD_PURE is set, the very same
modules run as plain Python: their answers are the same, but large drawings take some fifty times as long.
"""

from __future__ import annotations

import os
import warnings
from importlib import import_module

from plyfold.core.stamp import stamp_of

__all__ = ["WHY_PLAIN"]

_FOLDER = __path__[0]
_MACHINE = os.path.join(_FOLDER, "machine")


def _stamp() -> str | None:
    """Return from which sources the compiled modules were made; None if there are none."""
    try:
        with open(os.path.join(_MACHINE, "stamp")) as file:
            return file.read()
    except OSError:
        return None


def _why_plain() -> str:
    """Choose the compiled modules if they can be used; else return why not."""
    if os.environ.get("PLYFOLD_PURE"):
        return "PLYFOLD_PURE is set"
    stamp = _stamp()
    if stamp is None:
        return "it was not compiled at its installation"
    if stamp != stamp_of(_FOLDER):
        why = "its sources have changed since it was compiled"
        warnings.warn(
            f"plyfold.core is plain Python, and slow: {why}; `make` compiles it", RuntimeWarning, stacklevel=2
        )
        return why
    __path__.insert(0, _MACHINE)
    try:
        import_module("plyfold.core.signs")
    except ImportError as error:
        __path__.remove(_MACHINE)
        return f"it was compiled for another machine: {error}"
    return ""


WHY_PLAIN = _why_plain()
"""Why the modules of this room are plain Python; empty where they are compiled."""
