"""Files with the layered drawing: SVG, TikZ, and TeX documents."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from plyfold.draw.over_under_svg import over_under_svg
from plyfold.draw.tikz import over_under_tex, over_under_tikz
from plyfold.io.saving import refuse_output, save_bytes
from plyfold.layering.layering import Layering

__all__ = ["OVER_UNDER_WRITERS", "save_over_under"]

OVER_UNDER_WRITERS: Mapping[str, Callable[..., str]] = {
    ".svg": over_under_svg,
    ".tikz": over_under_tikz,
    ".tex": over_under_tex,
}


def save_over_under(layering: Layering, path: str | os.PathLike[str], force: bool = False, **options: Any) -> None:
    """Write the picture of a layered surface from above.

    Parameters
    ----------
    layering : Layering
        Of a drawing.
    path : path
        The ending chooses the format: ``.svg``, ``.tikz`` for a picture to be read into a document, ``.tex`` for a
        document.
    force : bool
        Replace an existing file.
    **options
        ``colours`` and ``hidden``, see :func:`plyfold.draw.over_under.over_under`.

    Raises
    ------
    InputError
        If the ending is none of these, the folder is missing, it is no layering, or an option is unknown.
    FileExistsError
        If the file exists and ``force`` is not set.
    """
    refuse_output(str(path), tuple(OVER_UNDER_WRITERS), force)
    save_bytes(path, OVER_UNDER_WRITERS[Path(path).suffix.lower()](layering, **options).encode(), force)
