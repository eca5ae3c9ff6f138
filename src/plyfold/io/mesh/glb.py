"""GLB, the binary form of glTF 2.0: materials, texture coordinates, and the way from the lifted surface to the disk.

Numbers are 32 bits wide. Places are therefore stored relative to the middle of the drawing, and the middle in double
precision. In glTF, y points up: (x, y, z) is stored as (x, z, −y).
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Floats, Ints
from plyfold.colours import PAPER, rgb
from plyfold.io.mesh.model import Material, Model, single_precision, split_vertices, vertex_normals

__all__ = ["glb"]

_UNSIGNED, _SINGLE = 5125, 5126
_VERTICES, _INDICES = 34962, 34963
_TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3"}
_SECONDS_PER_SHAPE = 1.5
# Sheets share their vertices in groups of about so many triangles: one set each would make a file of many small sheets
# several times as long, and one for all would be read whole for each sheet.
_TRIANGLES_TOGETHER = 4096
# The animation rests on the surface first, for programs show the file at some moment after its beginning.
_REST = 0.5


def glb(model: Model) -> bytes:
    """Return the model as a GLB, seen from both sides.

    With smooth colours there is one material, and else one for each sheet. Other shapes are morph targets, and an
    animation, *unwind*, goes from the surface through all of them and back.

    Parameters
    ----------
    model : Model

    Returns
    -------
    bytes
        About a second for a million triangles.
    """
    buffer = _Buffer()
    mesh: dict[str, Any] = {"name": "surface", "primitives": _primitives(model, buffer)}
    scene: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": "plyfold"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "surface", "mesh": 0, "translation": _y_up(_middle(model)).tolist()}],
        "meshes": [mesh],
        "materials": [_material(one) for one in _materials(model)],
    }
    if model.shapes:
        mesh |= {"weights": [0.0] * len(model.shapes), "extras": {"targetNames": list(model.shapes)}}
        scene["animations"] = [_animation(len(model.shapes), buffer)]
    return _container(scene | buffer.description(), b"".join(buffer.chunks))


# ---- what the parts of the scene hold ------------------------------------------------------------------------------


def _materials(model: Model) -> tuple[Material, ...]:
    return model.materials if model.colours is None else (Material("cloth", PAPER),)


def _material(material: Material) -> dict[str, Any]:
    colour = [*_linear(np.array(rgb(material.colour))).tolist(), 1.0]
    surface = {"baseColorFactor": colour, "metallicFactor": 0.0, "roughnessFactor": 0.7}
    return {"name": material.name, "doubleSided": True, "pbrMetallicRoughness": surface}


def _primitives(model: Model, buffer: _Buffer) -> list[dict[str, Any]]:
    """Return a primitive for each material; those of a group share their vertices, which are doubled at its border.

    Vertices are doubled where normals jump, too.
    """
    shaded, faces, _ = split_vertices(model.faces, model.smooth)
    material = model.material if model.colours is None else np.zeros(len(faces), dtype=np.int64)
    order = np.argsort(material, kind="stable")
    first_face = np.searchsorted(material[order], np.arange(len(_materials(model)) + 1))
    group = first_face[:-1] // _TRIANGLES_TOGETHER
    source, corners, owner = split_vertices(faces[order], group[material[order]])
    numbers, group = np.unique(group, return_inverse=True)
    first_vertex = np.searchsorted(owner, [*numbers, np.inf])
    corners = corners - np.repeat(first_vertex[group], np.diff(first_face))[:, None]
    attributes = [
        {name: buffer.array(values[source], first_vertex, _VERTICES) for name, values in one.items()}
        for one in _attributes(model, shaded, faces)
    ]
    indices = buffer.array(corners.astype("<u4").reshape(-1, 1), 3 * first_face, _INDICES)
    return [
        _primitive(number, [{name: accessors[shared] for name, accessors in one.items()} for one in attributes], index)
        for number, (shared, index) in enumerate(zip(group.tolist(), indices, strict=True))
    ]


def _primitive(number: int, attributes: list[dict[str, int]], indices: int) -> dict[str, Any]:
    base, *targets = attributes
    primitive = {"attributes": base, "indices": indices, "material": number}
    return primitive | ({"targets": targets} if targets else {})


def _attributes(model: Model, shaded: Ints, faces: Ints) -> Iterator[dict[str, npt.NDArray[np.float32]]]:
    """Yield what is stored for each vertex, first of the surface itself, and then of each shape, as differences."""
    places = model.vertices - _middle(model)
    normals = vertex_normals(model.vertices[shaded], faces)
    own = {"POSITION": _places(model, places)[shaded], "NORMAL": _y_up(normals).astype("<f4")}
    if model.uv is not None:
        own["TEXCOORD_0"] = (model.uv[shaded] * (1, -1) + (0, 1)).astype("<f4")  # v points down
    if model.colours is not None:
        own["COLOR_0"] = _linear(model.colours)[shaded].astype("<f4")
    yield own
    for shape in model.shapes.values():
        turned = _normals(shape[shaded], faces) - normals
        moved = _places(model, shape - model.vertices)[shaded]
        yield {"POSITION": moved, "NORMAL": _y_up(turned).astype("<f4")}


def _normals(shape: Floats, faces: Ints) -> Floats:
    """Return the normals of a shape. What lies on the table faces up, also slivers that turn over on their way."""
    if np.ptp(shape[:, 2]) == 0:
        return np.tile((0.0, 0.0, 1.0), (len(shape), 1))
    return vertex_normals(shape, faces)


def _animation(shapes: int, buffer: _Buffer) -> dict[str, Any]:
    there = np.eye(shapes + 1)[:, 1:]
    weights = np.concatenate([there[:1], there, there[-2::-1]])
    times = np.append(0.0, _REST + _SECONDS_PER_SHAPE * np.arange(len(weights) - 1))
    (time,), (weight,) = (buffer.array(x.astype("<f4").reshape(-1, 1), np.array([0, x.size])) for x in (times, weights))
    channel = {"sampler": 0, "target": {"node": 0, "path": "weights"}}
    sampler = {"input": time, "interpolation": "LINEAR", "output": weight}
    return {"name": "unwind", "channels": [channel], "samplers": [sampler]}


def _middle(model: Model) -> Floats:
    low, high = model.vertices.min(axis=0), model.vertices.max(axis=0)
    return np.asarray(low + (high - low) / 2)


def _places(model: Model, values: Floats) -> npt.NDArray[np.float32]:
    return single_precision(_y_up(values), model.detail)


def _y_up(values: Floats) -> Floats:
    x, y, z = np.moveaxis(values, -1, 0)
    return np.stack([x, z, -y], axis=-1)


def _linear(colour: Floats) -> Floats:
    """Return the amounts of light of a colour as it is on the screen (sRGB)."""
    return np.where(colour <= 0.04045, colour / 12.92, ((colour + 0.055) / 1.055) ** 2.4)


# ---- the container -------------------------------------------------------------------------------------------------


@dataclass
class _Buffer:
    """The binary part of the file while it is filled, and its description."""

    chunks: list[bytes] = field(default_factory=list)
    views: list[dict[str, int]] = field(default_factory=list)
    accessors: list[dict[str, Any]] = field(default_factory=list)
    length: int = 0

    def array(self, values: npt.NDArray[Any], start: Ints, target: int | None = None) -> list[int]:
        """Append an array of shape (n, columns); return an accessor for each part, from one start to the next."""
        view = {"buffer": 0, "byteOffset": self.length, "byteLength": values.nbytes}
        if target is not None:
            view |= {"target": target}
        if target == _VERTICES:
            view |= {"byteStride": values.strides[0]}
        self.views.append(view)
        self.chunks.append(values.tobytes())
        self.length += values.nbytes
        first = len(self.accessors)
        bounds = _bounds(values, start) if target != _INDICES else [{}] * (len(start) - 1)
        for begin, end, bound in zip(start[:-1].tolist(), start[1:].tolist(), bounds, strict=True):
            self.accessors.append(self._accessor(values, begin, end) | bound)
        return list(range(first, len(self.accessors)))

    def _accessor(self, values: npt.NDArray[Any], begin: int, end: int) -> dict[str, Any]:
        return {
            "bufferView": len(self.views) - 1,
            "byteOffset": begin * values.strides[0],
            "componentType": _SINGLE if values.dtype.kind == "f" else _UNSIGNED,
            "count": end - begin,
            "type": _TYPES[values.shape[1]],
        }

    def description(self) -> dict[str, Any]:
        return {"accessors": self.accessors, "bufferViews": self.views, "buffers": [{"byteLength": self.length}]}


def _bounds(values: npt.NDArray[Any], start: Ints) -> list[dict[str, Any]]:
    low, high = (find.reduceat(values, start[:-1], axis=0).tolist() for find in (np.minimum, np.maximum))
    return [{"min": least, "max": most} for least, most in zip(low, high, strict=True)]


def _container(scene: Mapping[str, Any], content: bytes) -> bytes:
    text = json.dumps(scene, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    chunks = _chunk(b"JSON", text) + _chunk(b"BIN\0", content)
    return b"glTF" + np.array([2, 12 + len(chunks)], dtype="<u4").tobytes() + chunks


def _chunk(kind: bytes, content: bytes) -> bytes:
    return np.uint32(len(content)).tobytes() + kind + content
