"""Flat meshes in OBJ and PLY files: the triangles whose boundary is an outline."""

from __future__ import annotations

import re
import struct
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple, Protocol

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.errors import FileFormatError
from plyfold.graphs import components
from plyfold.outline.curve import Curve, Outline
from plyfold.outline.points import Repair, as_points, left_out
from plyfold.predicates import orient

__all__ = ["FlatMesh", "components_of_mesh", "mesh_in_obj", "mesh_in_ply", "outline_of_meshes"]

_HINT = "export it again as a mesh with faces"


class FlatMesh(NamedTuple):
    """A mesh in the plane.

    Parameters
    ----------
    points : (n, 2) float
    triangles : (m, 3) int
    repairs : tuple of Repair
        What was left out of the file.
    """

    points: Floats
    triangles: Ints
    repairs: tuple[Repair, ...] = ()


# ---- OBJ -------------------------------------------------------------------------------------------------------------


def mesh_in_obj(text: str, uv: bool = False) -> FlatMesh:
    r"""Read the vertices and faces of an OBJ file.

    Parameters
    ----------
    text : str
        Lines ``v``, ``vt`` and ``f``, also with negative numbers, which count from the last one backward.
    uv : bool
        Take the chart, ``vt``, instead of x and y of the vertices.

    Returns
    -------
    FlatMesh
        Faces of more than three corners are cut into triangles.

    Raises
    ------
    FileFormatError
        If a line is broken, if there is no face, or no chart where it is asked for; it names the line.

    Notes
    -----
    Linear in the length of the text.

    Examples
    --------
    >>> mesh_in_obj("v 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nf 1 2 3 4").triangles.tolist()
    [[0, 1, 2], [0, 2, 3]]
    """
    kind, place = ("vt", 1) if uv else ("v", 0)
    rows: list[list[float]] = []
    faces: list[list[int]] = []
    for number, word, values in _obj_lines(text):
        if word == kind:
            rows.append(_numbers(values[: 2 if uv else 3], number, fewest=2))
        elif word == "f":
            if len(values) < 3:
                raise FileFormatError(f"line {number}: a face with {len(values)} corners", hint=_HINT)
            faces.append([_corner(value, place, len(rows), number) for value in values])
    return _flat_mesh(rows, faces, "chart" if uv else "mesh")


def _obj_lines(text: str) -> Iterator[tuple[int, str, list[str]]]:
    """Yield the number, the first word and the other words of each line; a backslash joins the next one to it."""
    words: list[str] = []
    for number, line in enumerate(text.splitlines(), start=1):
        content = line.partition("#")[0].rstrip()
        words += content.removesuffix("\\").split()
        if words and not content.endswith("\\"):
            yield number, words[0], words[1:]
            words = []


def _numbers(values: Sequence[str], line: int, fewest: int) -> list[float]:
    try:
        numbers = [float(value) for value in values]
    except ValueError as error:
        raise FileFormatError(f"line {line}: {' '.join(values)[:40]!r} is no place", hint=_HINT) from error
    if len(numbers) < fewest:
        raise FileFormatError(f"line {line}: {len(numbers)} numbers where a place was expected", hint=_HINT)
    return numbers


def _corner(value: str, place: int, known: int, line: int) -> int:
    """Return the number, from 0, of a corner such as ``3``, ``3/1``, ``3//2`` or ``-1/-1/-1``."""
    parts = value.split("/")
    if place >= len(parts) or not parts[place]:
        raise FileFormatError(f"line {line}: the corner {value[:40]!r} has no place in the chart", hint="leave out uv")
    try:
        number = int(parts[place])
    except ValueError as error:
        raise FileFormatError(f"line {line}: {value[:40]!r} is no corner", hint=_HINT) from error
    counted = number - 1 if number > 0 else known + number
    if number == 0 or counted < 0:
        raise FileFormatError(f"line {line}: there is no vertex {number}", hint=_HINT)
    return counted


# ---- PLY -------------------------------------------------------------------------------------------------------------

# The letters of the module struct.
_TYPES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f", "double": "d"}
_TYPES |= {"int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I"}
_TYPES |= {"float32": "f", "float64": "d"}
_BYTE_ORDERS = {"binary_little_endian": "<", "binary_big_endian": ">"}
_CHARTS = (("s", "t"), ("u", "v"), ("texture_u", "texture_v"), ("texture_s", "texture_t"))
_CORNERS = ("vertex_indices", "vertex_index")
_LONGEST_HEADER = 100_000


class _Property(NamedTuple):
    """A column of an element: the type of its values, and that of their number, if there are several."""

    name: str
    kind: str
    length: str = ""


class _Element(NamedTuple):
    name: str
    rows: int
    properties: list[_Property]


class _Numbers(Protocol):
    def take(self, count: int, kind: str) -> Sequence[float]:
        """Return the next numbers, so many of one type; raise ValueError or struct.error if they are not there."""


class _BinaryNumbers:
    """The numbers of a binary file, one after the other."""

    def __init__(self, data: bytes, order: str) -> None:
        self._data, self._order, self._next = data, order, 0

    def take(self, count: int, kind: str) -> Sequence[float]:
        layout = f"{self._order}{count}{kind}"
        values = struct.unpack_from(layout, self._data, self._next)
        self._next += struct.calcsize(layout)
        return values


class _WrittenNumbers:
    """The numbers of a text, one after the other."""

    def __init__(self, data: bytes) -> None:
        self._words, self._next = data.split(), 0

    def take(self, count: int, kind: str) -> Sequence[float]:
        words = self._words[self._next : self._next + count]
        if len(words) != count:
            raise ValueError
        self._next += count
        return [float(word) for word in words]


def mesh_in_ply(data: bytes, uv: bool = False) -> FlatMesh:
    r"""Read the vertices and faces of a PLY file, as text or binary.

    Parameters
    ----------
    data : bytes
    uv : bool
        Take the chart, ``s t``, ``u v`` or ``texture_u texture_v`` of the vertices, instead of their x and y.

    Returns
    -------
    FlatMesh
        Faces of more than three corners are cut into triangles.

    Raises
    ------
    FileFormatError
        If the file is broken, has no face, or no chart where it is asked for.

    Notes
    -----
    Linear in the size of the file.

    Examples
    --------
    >>> head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nelement face 1\n"
    >>> body = "property list uchar int vertex_indices\nend_header\n0 0\n4 0\n0 3\n3 0 1 2\n"
    >>> mesh_in_ply((head + body).encode()).triangles.tolist()
    [[0, 1, 2]]
    """
    numbers, elements = _ply_header(data)
    tables = {element.name: _ply_table(element, numbers) for element in elements}
    faces = tables.get("face", {})
    corners = next((faces[name] for name in _CORNERS if name in faces), [])
    whole = [_ply_face(number, face) for number, face in enumerate(corners)]
    return _flat_mesh(_ply_places(tables.get("vertex", {}), uv), whole, "chart" if uv else "mesh")


def _ply_header(data: bytes) -> tuple[_Numbers, list[_Element]]:
    """Return what follows the header, and the elements that it is made of."""
    end = re.search(rb"^end_header[ \t]*\r?\n?", data[:_LONGEST_HEADER], re.MULTILINE)
    if not data.startswith(b"ply") or end is None:
        raise FileFormatError("it is no PLY file, or its header does not end", hint=_HINT)
    kind, elements = "", list[_Element]()
    for number, line in enumerate(data[: end.start()].decode("latin-1").splitlines(), start=1):
        match line.split():
            case ["format", "ascii" | "binary_little_endian" | "binary_big_endian" as kind, *_]:
                pass
            case ["element", name, count] if count.isdecimal():
                elements.append(_Element(name, int(count), []))
            case ["property", *words] if elements and (known := _property(words)):
                elements[-1].properties.append(known)
            case [] | ["ply"] | ["comment" | "obj_info", *_]:
                pass
            case _:
                raise FileFormatError(f"line {number}: {line[:40]!r} is not understood", hint=_HINT)
    if not kind:
        raise FileFormatError("it does not say in which format its numbers are", hint=_HINT)
    rest = data[end.end() :]
    return _WrittenNumbers(rest) if kind == "ascii" else _BinaryNumbers(rest, _BYTE_ORDERS[kind]), elements


def _property(words: list[str]) -> _Property | None:
    match words:
        case ["list", length, kind, name] if {length, kind} <= _TYPES.keys():
            return _Property(name, _TYPES[kind], _TYPES[length])
        case [kind, name] if kind in _TYPES:
            return _Property(name, _TYPES[kind])
    return None


def _ply_table(element: _Element, numbers: _Numbers) -> dict[str, list[Sequence[float]]]:
    """Return for each property what each row has of it."""
    columns: dict[str, list[Sequence[float]]] = {known.name: [] for known in element.properties}
    for row in range(element.rows if columns else 0):
        try:
            for known in element.properties:
                count = int(numbers.take(1, known.length)[0]) if known.length else 1
                columns[known.name].append(numbers.take(count, known.kind))
        except (ValueError, OverflowError, struct.error) as error:
            raise FileFormatError(f"{element.name} {row} is broken, or missing", hint=_HINT) from error
    return columns


def _ply_face(number: int, corners: Sequence[float]) -> list[int]:
    try:
        return [int(corner) for corner in corners]
    except (ValueError, OverflowError) as error:  # of a text, which may have anything there
        raise FileFormatError(f"face {number} has a corner that is no number of a vertex", hint=_HINT) from error


def _ply_places(vertices: dict[str, list[Sequence[float]]], uv: bool) -> list[list[float]]:
    names = next((chart for chart in _CHARTS if vertices.keys() >= {*chart}), ()) if uv else ("x", "y")
    if not names:
        raise FileFormatError("its vertices have no texture coordinates", hint="leave out uv")
    if not vertices.keys() >= {*names}:
        raise FileFormatError("its vertices have no x and y", hint=_HINT)
    columns = [vertices[name] for name in (*names, "z") if name in vertices and not (uv and name == "z")]
    rows = list(zip(*columns, strict=True))
    if any(len(values) != 1 for row in rows for values in row):
        raise FileFormatError("its vertices have lists as coordinates", hint=_HINT)
    return [[value for (value,) in row] for row in rows]


# ---- triangles -------------------------------------------------------------------------------------------------------


def _flat_mesh(rows: list[list[float]], faces: list[list[int]], what: str) -> FlatMesh:
    """Return places and faces as a mesh of triangles; refuse corners that are not there."""
    if not faces:
        raise FileFormatError("it has no face", hint=_HINT)
    for number, face in enumerate(faces):
        if len(face) < 3:
            raise FileFormatError(f"face {number} has {len(face)} corners", hint=_HINT)
        if wrong := [corner for corner in face if not 0 <= corner < len(rows)]:
            raise FileFormatError(
                f"face {number} has the vertex {wrong[0]}, counted from 0, and the {what} has {len(rows)}", hint=_HINT
            )
    points = as_points([row[:2] for row in rows])
    triangles = [triangle for number, face in enumerate(faces) for triangle in _triangles(points, face, number)]
    heights = {row[2] for row in rows if len(row) > 2}
    repairs = left_out("z", points) if len(heights) > 1 else ()
    return FlatMesh(points, np.array(triangles, dtype=np.int64), repairs)


def _triangles(points: Floats, face: list[int], number: int) -> list[list[int]]:
    """Cut a face into triangles from one of its corners, so that all of them run the same way round."""
    if len(face) == 3:
        return [face]
    for start in range(len(face)):
        corners = face[start:] + face[:start]
        fan = [[corners[0], *pair] for pair in pairwise(corners[1:])]
        if abs(int(orient(*points[fan].swapaxes(0, 1)).sum())) == len(fan):
            return fan
    raise FileFormatError(
        f"face {number} is cut into triangles from none of its {len(face)} corners",
        where=[points[face].mean(axis=0)],
        hint="have faces cut into triangles where the file is exported",
    )


def components_of_mesh(mesh: FlatMesh) -> list[FlatMesh]:
    """Return the parts of a mesh that hang together by vertices, in the order of their first vertices.

    Examples
    --------
    >>> mesh = FlatMesh(np.array([(0.0, 0), (9, 9), (1, 0), (8, 9), (0, 1), (9, 8)]), np.array([(0, 2, 4), (1, 3, 5)]))
    >>> [part.points[0].tolist() for part in components_of_mesh(mesh)]
    [[0.0, 0.0], [9.0, 9.0]]
    """
    a, b, c = mesh.triangles.T
    part = components(len(mesh.points), np.append(a, b), np.append(b, c))[a]
    numbers = np.unique(part)
    return [mesh] if len(numbers) == 1 else [_part(mesh, mesh.triangles[part == number]) for number in numbers]


def _part(mesh: FlatMesh, triangles: Ints) -> FlatMesh:
    used = np.unique(triangles)
    return FlatMesh(mesh.points[used], np.searchsorted(used, triangles), mesh.repairs)


def outline_of_meshes(meshes: Sequence[FlatMesh]) -> Outline:
    """Return the boundaries of parts of a mesh as one outline."""
    outlines = [Outline.from_mesh(mesh.points, mesh.triangles) for mesh in meshes]
    loops = [curve for outline in outlines for curve in outline.curves]
    repairs = (*meshes[0].repairs, *(repair for outline in outlines for repair in outline.repairs))
    return Curve(loops[0].points, repairs, loops[0].cusps[0]) if len(loops) == 1 else Outline(loops, None, repairs)
