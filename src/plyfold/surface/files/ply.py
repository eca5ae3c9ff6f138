"""PLY: double precision, with colours and texture coordinates."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Floats
from plyfold.draw.colours import rgb
from plyfold.surface.files.model import Model

__all__ = ["ply"]

_TYPES = {"<f8": "double", "<i4": "int", "u1": "uchar"}

# Name, type and values of each property.
_Columns: TypeAlias = list[tuple[str, str, npt.NDArray[Any]]]


def ply(model: Model) -> bytes:
    """Return the model as a binary PLY.

    Smooth colours belong to vertices. If each sheet has its colour, triangles have it, and the number of their sheet;
    not all readers understand properties of triangles. Texture coordinates are named ``s`` and ``t``.
    """
    vertices, faces = _vertex_table(model), _face_table(model)
    header = ["ply", "format binary_little_endian 1.0", "comment plyfold", f"element vertex {len(vertices)}"]
    header += [_property(vertices, name) for name in vertices.dtype.names or ()]
    header += [f"element face {len(faces)}", "property list uchar int vertex_indices"]
    header += [_property(faces, name) for name in faces.dtype.names or () if name not in ("count", "corners")]
    return "\n".join([*header, "end_header\n"]).encode() + vertices.tobytes() + faces.tobytes()


def _property(table: npt.NDArray[np.void], name: str) -> str:
    kind = table.dtype[name]
    return f"property {next(word for code, word in _TYPES.items() if np.dtype(code) == kind)} {name}"


def _vertex_table(model: Model) -> npt.NDArray[np.void]:
    columns = _columns("xyz", "<f8", model.vertices)
    if model.uv is not None:
        columns += _columns("st", "<f8", model.uv)
    return _table(columns, model.colours)


def _face_table(model: Model) -> npt.NDArray[np.void]:
    columns: _Columns = [("count", "u1", np.full(len(model.faces), 3)), ("corners", "3<i4", model.faces)]
    if model.colours is not None:
        return _table(columns, None)
    colour = np.array([rgb(material.colour) for material in model.materials])
    return _table([*columns, ("sheet", "<i4", model.material)], colour[model.material])


def _columns(names: Iterable[str], kind: str, values: npt.NDArray[Any]) -> _Columns:
    return [(name, kind, column) for name, column in zip(names, values.T, strict=True)]


def _table(columns: _Columns, colours: Floats | None) -> npt.NDArray[np.void]:
    if colours is not None:
        columns = columns + _columns(("red", "green", "blue"), "u1", np.rint(255 * colours))
    table = np.zeros(len(columns[0][2]), dtype=[(name, kind) for name, kind, _ in columns])
    for name, _, values in columns:
        table[name] = values
    return table
