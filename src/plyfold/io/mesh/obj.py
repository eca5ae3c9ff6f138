"""Wavefront OBJ: double precision, one group per sheet, and a library of materials beside it."""

from __future__ import annotations

import numpy as np

from plyfold.colours import rgb
from plyfold.io.mesh.model import Model
from plyfold.io.mesh.text import rows_as_text

__all__ = ["material_library", "obj"]


def obj(model: Model, library: str | None = None) -> bytes:
    """Return the model as an OBJ, one group per sheet.

    Parameters
    ----------
    model : Model
    library : str, optional
        The name of the file with the materials, see :func:`material_library`; without it, no materials are named.

    Returns
    -------
    bytes
        About three seconds for a million triangles.
    """
    parts = ["# plyfold\n", f"mtllib {library}\n" if library else "", "o surface\n"]
    parts.append(rows_as_text("v %r %r %r\n", model.vertices))
    template, repeat = "f %d %d %d\n", 1
    if model.uv is not None:
        parts.append(rows_as_text("vt %r %r\n", model.uv))
        template, repeat = "f %d/%d %d/%d %d/%d\n", 2
    parts.append("s 1\n" if not model.closed else "s off\n")
    order = np.argsort(model.material, kind="stable")
    corners = np.repeat(model.faces[order] + 1, repeat, axis=1)
    ends = np.searchsorted(model.material[order], np.arange(len(model.materials)), side="right").tolist()
    for material, start, end in zip(model.materials, [0, *ends], ends, strict=False):
        parts.append(f"g {material.name}\n" + (f"usemtl {material.name}\n" if library else ""))
        parts.append(rows_as_text(template, corners[start:end]))
    return "".join(parts).encode()


def material_library(model: Model) -> bytes:
    """Return the MTL file with the colour of each sheet."""
    entries = (
        f"newmtl {material.name}\nKd {red:.6f} {green:.6f} {blue:.6f}\nd 1\nillum 1\n"
        for material in model.materials
        for red, green, blue in [rgb(material.colour)]
    )
    return ("# plyfold\n" + "\n".join(entries)).encode()
