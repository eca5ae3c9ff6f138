"""PLY: double precision, with colours and texture coordinates."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Floats, Ints
from plyfold.colours import rgb
from plyfold.io.mesh.model import Model, split_vertices

__all__ = ["ply"]

_TYPES = {"f8": "double", "i4": "int", "u1": "uchar"}

# Name, type and values of each property.
_Columns: TypeAlias = list[tuple[str, str, npt.NDArray[Any]]]


def ply(model: Model) -> bytes:
    """Return the model as a binary PLY, with colours at the vertices, where readers look for them.

    If each sheet has its colour, vertices between sheets are doubled, one for each sheet with its number as ``sheet``,
    and come sheet by sheet. Texture coordinates are named ``s`` and ``t``.
    """
    vertices, faces = _tables(model)
    header = ["ply", "format binary_little_endian 1.0", "comment plyfold", f"element vertex {len(vertices)}"]
    header += [f"property {_TYPES[vertices.dtype[name].str[1:]]} {name}" for name in vertices.dtype.names or ()]
    header += [f"element face {len(faces)}", "property list uchar int vertex_indices"]
    return "\n".join([*header, "end_header\n"]).encode() + vertices.tobytes() + faces.tobytes()


def _tables(model: Model) -> tuple[npt.NDArray[np.void], npt.NDArray[np.void]]:
    """Return the tables of vertices and of faces."""
    if model.colours is not None:
        return _vertex_table(model, model.colours), _face_table(model.faces)
    source, corners, sheet = split_vertices(model.faces, model.material)
    colours = np.array([rgb(material.colour) for material in model.materials])[sheet]
    doubled = replace(model, vertices=model.vertices[source], uv=None if model.uv is None else model.uv[source])
    return _vertex_table(doubled, colours, [("sheet", "<i4", sheet)]), _face_table(corners)


def _vertex_table(model: Model, colours: Floats, more: _Columns | None = None) -> npt.NDArray[np.void]:
    columns = _columns("xyz", "<f8", model.vertices)
    if model.uv is not None:
        columns += _columns("st", "<f8", model.uv)
    return _table([*columns, *_columns(("red", "green", "blue"), "u1", np.rint(255 * colours)), *(more or [])])


def _face_table(faces: Ints) -> npt.NDArray[np.void]:
    return _table([("count", "u1", np.full(len(faces), 3)), ("corners", "3<i4", faces)])


def _columns(names: Iterable[str], kind: str, values: npt.NDArray[Any]) -> _Columns:
    return [(name, kind, column) for name, column in zip(names, values.T, strict=True)]


def _table(columns: _Columns) -> npt.NDArray[np.void]:
    table = np.zeros(len(columns[0][2]), dtype=[(name, kind) for name, kind, _ in columns])
    for name, _, values in columns:
        table[name] = values
    return table
