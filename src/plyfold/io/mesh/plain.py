"""OBJ, PLY and STL: files that are plain tables of numbers.

OBJ and PLY keep double precision.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Floats, Ints
from plyfold.colours import rgb
from plyfold.io.mesh.model import Model, single_precision, split_vertices

__all__ = ["material_library", "obj", "ply", "rows_as_text", "stl"]


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


# ---- PLY -------------------------------------------------------------------------------------------------------------

_TYPES = {"f8": "double", "u1": "uchar"}

# Name, type and values of each property.
_Columns: TypeAlias = list[tuple[str, str, npt.NDArray[Any]]]


def ply(model: Model) -> bytes:
    """Return the model as a binary PLY, with colours at the vertices, where readers look for them.

    If each sheet has its colour, vertices between sheets are doubled, one for each sheet, and come sheet by sheet;
    comments in the header tell which are whose. (As a property the number of the sheet would hinder readers that want
    one type for what is left beside places and textures, or nothing but corners in triangles.) Texture coordinates are
    named ``s`` and ``t``.
    """
    vertices, faces, comments = _tables(model)
    header = ["ply", "format binary_little_endian 1.0", "comment plyfold", *comments]
    header.append(f"element vertex {len(vertices)}")
    header += [f"property {_TYPES[vertices.dtype[name].str[1:]]} {name}" for name in vertices.dtype.names or ()]
    header += [f"element face {len(faces)}", "property list uchar int vertex_indices"]
    return "\n".join([*header, "end_header\n"]).encode() + vertices.tobytes() + faces.tobytes()


def _tables(model: Model) -> tuple[npt.NDArray[np.void], npt.NDArray[np.void], Iterable[str]]:
    """Return the tables of vertices and of faces, and what is said of the sheets."""
    if model.colours is not None:
        return _vertex_table(model, model.colours), _face_table(model.faces), ()
    source, corners, sheet = split_vertices(model.faces, model.material)
    colours = np.array([rgb(material.colour) for material in model.materials])[sheet]
    doubled = replace(model, vertices=model.vertices[source], uv=None if model.uv is None else model.uv[source])
    return _vertex_table(doubled, colours), _face_table(corners), _whose(model, sheet)


def _whose(model: Model, sheet: Ints) -> Iterator[str]:
    """Yield which vertices are of which sheet."""
    start = np.searchsorted(sheet, np.arange(len(model.materials) + 1)).tolist()
    for material, first, end in zip(model.materials, start, start[1:], strict=False):
        yield f"comment {material.name}: vertices {first} to {end - 1}"


def _vertex_table(model: Model, colours: Floats) -> npt.NDArray[np.void]:
    columns = _columns("xyz", "<f8", model.vertices)
    if model.uv is not None:
        columns += _columns("st", "<f8", model.uv)
    return _table([*columns, *_columns(("red", "green", "blue"), "u1", np.rint(255 * colours))])


def _face_table(faces: Ints) -> npt.NDArray[np.void]:
    return _table([("count", "u1", np.full(len(faces), 3)), ("corners", "3<i4", faces)])


def _columns(names: Iterable[str], kind: str, values: npt.NDArray[Any]) -> _Columns:
    return [(name, kind, column) for name, column in zip(names, values.T, strict=True)]


def _table(columns: _Columns) -> npt.NDArray[np.void]:
    table = np.zeros(len(columns[0][2]), dtype=[(name, kind) for name, kind, _ in columns])
    for name, _, values in columns:
        table[name] = values
    return table


# ---- STL -------------------------------------------------------------------------------------------------------------


def stl(model: Model) -> bytes:
    """Return the model as a binary STL; coordinates are rounded to 32 bits."""
    facets = np.zeros(len(model.faces), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    corners = model.vertices[model.faces]
    size = np.ptp(model.vertices, axis=0).max()
    normal = np.cross((corners[:, 1] - corners[:, 0]) / size, (corners[:, 2] - corners[:, 0]) / size)
    facets["normal"] = normal / np.linalg.norm(normal, axis=1, keepdims=True)
    facets["corners"] = single_precision(model.vertices, model.detail)[model.faces]
    return b"plyfold".ljust(80) + np.uint32(len(facets)).tobytes() + facets.tobytes()


# ---- long tables of numbers as text ----------------------------------------------------------------------------------

_AT_ONCE = 1 << 16


def rows_as_text(template: str, rows: npt.NDArray[np.generic]) -> str:
    """Return the template filled with each row; ``%r`` gives a number that reads back exactly, ``%d`` an integer.

    Examples
    --------
    >>> rows_as_text("v %r %r;", np.array([(0.1, 2.0), (3.0, 4.0)]))
    'v 0.1 2.0;v 3.0 4.0;'
    """
    parts = (rows[start : start + _AT_ONCE] for start in range(0, len(rows), _AT_ONCE))
    return "".join(template * len(part) % tuple(part.ravel().tolist()) for part in parts)
