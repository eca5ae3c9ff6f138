"""Mesh files: GLB, OBJ, PLY and STL.

They are written here, in a few lines each, because the general libraries round everything to 32 bits and leave the
back of a surface invisible. OBJ and PLY keep double precision. GLB and STL have 32-bit floats only; GLB therefore
stores coordinates relative to the middle of the drawing, and the way back in double precision.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Floats

if TYPE_CHECKING:
    from plyfold.surface.surface import Surface

__all__ = ["WRITERS", "vertex_normals"]


def vertex_normals(surface: Surface) -> Floats:
    """Return the unit normal at each vertex, shape (n, 3): that of the triangles around it, weighted by area."""
    a, b, c = surface.vertices[surface.faces].swapaxes(0, 1)
    normals = np.zeros_like(surface.vertices)
    for corner in range(3):
        np.add.at(normals, surface.faces[:, corner], np.cross(b - a, c - a))
    return np.asarray(normals / np.linalg.norm(normals, axis=1, keepdims=True))


def obj(surface: Surface) -> bytes:
    """Return the surface as a Wavefront OBJ, one group per sheet."""
    lines = ["# plyfold", "o surface", *(f"v {x!r} {y!r} {z!r}" for x, y, z in surface.vertices.tolist())]
    order = np.argsort(surface.sheet, kind="stable")
    last = -1
    for (a, b, c), sheet in zip(surface.faces[order].tolist(), surface.sheet[order].tolist(), strict=True):
        if sheet != last:
            lines.append(f"g sheet_{sheet}")
            last = sheet
        lines.append(f"f {a + 1} {b + 1} {c + 1}")
    return ("\n".join(lines) + "\n").encode()


def ply(surface: Surface) -> bytes:
    """Return the surface as a binary PLY with double-precision vertices and the sheet of each face."""
    header = (
        "ply\nformat binary_little_endian 1.0\ncomment plyfold\n"
        f"element vertex {len(surface.vertices)}\nproperty double x\nproperty double y\nproperty double z\n"
        f"element face {len(surface.faces)}\nproperty list uchar int vertex_indices\nproperty int sheet\nend_header\n"
    )
    faces = np.zeros(len(surface.faces), dtype=[("count", "u1"), ("corners", "<i4", 3), ("sheet", "<i4")])
    faces["count"], faces["corners"], faces["sheet"] = 3, surface.faces, surface.sheet
    return header.encode() + surface.vertices.astype("<f8").tobytes() + faces.tobytes()


def stl(surface: Surface) -> bytes:
    """Return the surface as a binary STL; coordinates are rounded to 32 bits."""
    facets = np.zeros(
        len(surface.faces), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")]
    )
    corners = surface.vertices[surface.faces]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    facets["normal"] = normal / np.linalg.norm(normal, axis=1, keepdims=True)
    facets["corners"] = corners
    return b"plyfold".ljust(80) + np.uint32(len(facets)).tobytes() + facets.tobytes()


def glb(surface: Surface) -> bytes:
    """Return the surface as a GLB (glTF 2.0): normals, a colour per sheet, visible from both sides, y up."""
    centre = (surface.vertices.min(axis=0) + surface.vertices.max(axis=0)) / 2
    arrays = {
        "POSITION": (surface.vertices - centre).astype("<f4"),
        "NORMAL": vertex_normals(surface).astype("<f4"),
        "COLOR_0": _vertex_colours(surface).astype("<f4"),
        "indices": surface.faces.astype("<u4").reshape(-1, 1),
    }
    content = b"".join(array.tobytes() for array in arrays.values())
    return _glb_container(_scene(arrays, centre), content)


def _vertex_colours(surface: Surface) -> Floats:
    """Return linear red, green, blue for each vertex: the mean over the sheets that meet there."""
    from plyfold.draw.colours import layer_colour, rgb

    level = surface.layering.level
    shades = np.array([rgb(layer_colour(number + 1, int(level.max()))) for number in range(level.max())])
    of_face = shades[level[surface.sheet] - 1] ** 2.2
    total = np.zeros((len(surface.vertices), 3))
    for corner in range(3):
        np.add.at(total, surface.faces[:, corner], of_face)
    return np.asarray(total / np.bincount(surface.faces.ravel(), minlength=len(total))[:, None])


def _scene(arrays: Mapping[str, npt.NDArray[Any]], centre: Floats) -> dict[str, Any]:
    sizes = [array.nbytes for array in arrays.values()]
    starts = np.cumsum([0, *sizes[:-1]]).tolist()
    accessors = [_accessor(view, name, array) for view, (name, array) in enumerate(arrays.items())]
    quarter_turn = [-(0.5**0.5), 0.0, 0.0, 0.5**0.5]
    attributes = {name: number for number, name in enumerate(arrays) if name != "indices"}
    return {
        "asset": {"version": "2.0", "generator": "plyfold"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [
            {"name": "plyfold (z up)", "rotation": quarter_turn, "children": [1]},
            {"name": "surface", "mesh": 0, "translation": centre.tolist()},
        ],
        "meshes": [
            {"primitives": [{"attributes": attributes, "indices": len(arrays) - 1, "material": 0}], "name": "surface"}
        ],
        "materials": [
            {
                "name": "cloth",
                "doubleSided": True,
                "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.7},
            }
        ],
        "accessors": accessors,
        "bufferViews": [
            {"buffer": 0, "byteOffset": start, "byteLength": size} for start, size in zip(starts, sizes, strict=True)
        ],
        "buffers": [{"byteLength": sum(sizes)}],
    }


def _accessor(view: int, name: str, array: npt.NDArray[Any]) -> dict[str, Any]:
    unsigned, single = 5125, 5126
    if name == "indices":
        return {"bufferView": view, "componentType": unsigned, "count": array.size, "type": "SCALAR"}
    accessor = {"bufferView": view, "componentType": single, "count": len(array), "type": "VEC3"}
    if name == "POSITION":
        accessor |= {"min": array.min(axis=0).tolist(), "max": array.max(axis=0).tolist()}
    return accessor


def _glb_container(scene: Mapping[str, Any], content: bytes) -> bytes:
    text = json.dumps(scene).encode()
    text += b" " * (-len(text) % 4)
    chunks = _chunk(b"JSON", text) + _chunk(b"BIN\0", content)
    return b"glTF" + np.array([2, 12 + len(chunks)], dtype="<u4").tobytes() + chunks


def _chunk(kind: bytes, content: bytes) -> bytes:
    return np.uint32(len(content)).tobytes() + kind + content


WRITERS: Mapping[str, Callable[[Surface], bytes]] = {".glb": glb, ".obj": obj, ".ply": ply, ".stl": stl}
