"""Masks of winding numbers out: as pictures with one pixel for each entry, and as numbers."""

from __future__ import annotations

import io
import struct
import zlib

import numpy as np
import numpy.typing as npt

from plyfold.colours import rgb, winding_colour

__all__ = ["MASK_WRITERS", "PNG_START", "png_chunk"]

PNG_START = b"\x89PNG\r\n\x1a\n"
"""The first bytes of every PNG."""


def as_png(mask: npt.NDArray[np.int32]) -> bytes:
    """Return a picture in the colours of winding numbers, row 0 on top.

    Examples
    --------
    >>> as_png(np.zeros((2, 3), dtype=np.int32))[1:4]
    b'PNG'
    """
    numbers, which = np.unique(mask, return_inverse=True)
    colours = np.array([[round(255 * part) for part in rgb(winding_colour(number))] for number in numbers.tolist()])
    pixels = colours.reshape(-1, 3)[which.reshape(mask.shape)].astype(np.uint8)
    rows, columns = mask.shape
    # Each line of a PNG begins with the number of its filter: 0 for none.
    lines = np.concatenate([np.zeros((rows, 1), dtype=np.uint8), pixels.reshape(rows, -1)], axis=1)
    header = struct.pack(">IIBBBBB", columns, rows, 8, 2, 0, 0, 0)
    chunks = (b"IHDR", header), (b"IDAT", zlib.compress(lines.tobytes())), (b"IEND", b"")
    return PNG_START + b"".join(png_chunk(kind, data) for kind, data in chunks)


def png_chunk(kind: bytes, data: bytes) -> bytes:
    """Return a part of a PNG: how long its data are, its kind, of four letters, the data, and their check sum."""
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def as_npy(mask: npt.NDArray[np.int32]) -> bytes:
    """Return the numbers as a file of numpy."""
    file = io.BytesIO()
    np.save(file, mask)
    return file.getvalue()


def as_number_rows(mask: npt.NDArray[np.int32]) -> bytes:
    """Return the numbers as text, one row on a line."""
    return "".join(",".join(map(str, row)) + "\n" for row in mask.tolist()).encode()


MASK_WRITERS = {".png": as_png, ".npy": as_npy, ".csv": as_number_rows}
