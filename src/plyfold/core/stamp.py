"""Which sources a compiled core was made from: a number that changes with them. It needs nothing but this file."""

from __future__ import annotations

import os
import zlib

__all__ = ["stamp_of"]


def stamp_of(folder: str) -> str:
    """Return a number for the names and contents of all sources in a folder."""
    number = 0
    for name in sorted(os.listdir(folder)):
        if name.endswith((".py", ".pxd")):
            with open(os.path.join(folder, name), "rb") as source:
                number = zlib.crc32(source.read(), zlib.crc32(name.encode(), number))
    return f"{number:08x}"
