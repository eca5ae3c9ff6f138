"""Pins: sheets and points whose heights are given, and the room that they leave to everything else."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from plyfold.arrays import Bools, Floats, Ints
from plyfold.errors import InputError
from plyfold.surface.glue import LiftedMesh

__all__ = ["PinKey", "Pins", "Room", "pins_of", "room_between", "rows_upward"]

# A sheet; a point (x, y); or a point and a sheet, (x, y, sheet).
PinKey: TypeAlias = int | tuple[float, float] | tuple[float, float, int]

# How far outside of a triangle a point may be, in barycentric coordinates, and how far off a height, in gaps.
_ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class Pins:
    """Heights that are given, in units of the drawing.

    Parameters
    ----------
    held : (v,) bool
        The vertices of pinned sheets.
    height : (v,) float
        Their heights; 0 for all others.
    faces : (p,) int
        The triangles that pinned points lie in.
    weights : (p, 3) float
        Of their corners.
    heights : (p,) float
        Of the pinned points.
    """

    held: Bools
    height: Floats
    faces: Ints
    weights: Floats
    heights: Floats

    def rows(self, mesh: LiftedMesh) -> Any:
        """Return the matrix that takes heights of vertices to those of the pinned points; (p, v) sparse."""
        from scipy.sparse import csr_array

        start = 3 * np.arange(len(self.faces) + 1)
        content = (self.weights.ravel(), mesh.faces[self.faces].ravel(), start)
        return csr_array(content, shape=(len(self.faces), len(mesh.level)))


def pins_of(pins: Mapping[PinKey, float], points: Floats, mesh: LiftedMesh, highest: float) -> Pins:
    """Find the vertices and triangles that pins name.

    Parameters
    ----------
    pins : mapping
        From sheets, points (x, y) or points and sheets (x, y, sheet) to heights.
    points : (p, 2) float
        The points of the planar triangulation.
    mesh : LiftedMesh
    highest : float
        Heights beyond this, up or down, are refused.

    Returns
    -------
    Pins

    Raises
    ------
    InputError
        If a pin names no sheet or place of the surface, or if pins contradict each other.
    """
    values = {key: _height(key, value, highest) for key, value in pins.items()}
    places = [(_place(key, points, mesh), value) for key, value in values.items() if isinstance(key, tuple)]
    held, height = _held_sheets({k: v for k, v in values.items() if not isinstance(k, tuple)}, points, mesh)
    faces = np.array([face for (face, _), _ in places], dtype=np.int64)
    weights = np.array([shares for (_, shares), _ in places]).reshape(-1, 3)
    found = Pins(held, height, faces, weights, np.array([value for _, value in places], dtype=np.float64))
    _refuse_dependent(found, points, mesh)
    return found


def _height(key: PinKey, value: float, highest: float) -> float:
    if not isinstance(value, int | float | np.number) or not abs(value) <= highest:
        raise InputError(f"the height of the pin {key} must be a number of at most {highest:g}, not {value!r}")
    return float(value)


def _held_sheets(heights: Mapping[int, float], points: Floats, mesh: LiftedMesh) -> tuple[Bools, Floats]:
    """Return the vertices of pinned sheets, and their heights."""
    held, height = np.zeros(len(mesh.level), dtype=bool), np.zeros(len(mesh.level))
    sheets = int(mesh.sheet.max()) + 1
    for sheet, value in heights.items():
        if not isinstance(sheet, int | np.integer) or not 0 <= sheet < sheets:
            raise InputError(f"there is no sheet {sheet!r} to pin", hint=f"sheets are numbered from 0 to {sheets - 1}")
        members = np.unique(mesh.faces[mesh.sheet == sheet])
        if len(clash := members[held[members] & (height[members] != value)]):
            raise InputError(
                f"sheet {sheet} is pinned at {value:g}, and a sheet that it meets at {height[clash[0]]:g}",
                where=points[mesh.planar_vertex[clash[:1]]],
                hint="pin sheets that meet at the same height",
            )
        held[members], height[members] = True, value
    return held, height


def _place(key: tuple[float, ...], points: Floats, mesh: LiftedMesh) -> tuple[int, Floats]:
    """Return the triangle that a point lies in, and its barycentric coordinates there."""
    real = all(isinstance(part, int | float | np.number) for part in key)
    if len(key) not in (2, 3) or not real or not np.isfinite(np.array(key[:2], dtype=float)).all():
        raise InputError(f"a pin is a sheet, a point (x, y) or a point and a sheet (x, y, sheet), not {key!r}")
    where = np.array(key[:2], dtype=np.float64)
    candidates = np.arange(len(mesh.faces)) if len(key) == 2 else np.flatnonzero(mesh.sheet == key[2])
    weights = _barycentric(points[mesh.planar_vertex[mesh.faces[candidates]]], where)
    inside = weights.min(axis=1) >= -_ROUNDING
    sheets = np.unique(mesh.sheet[candidates[inside]])
    if len(sheets) != 1:
        there = "no sheet lies" if len(sheets) == 0 else f"sheets {', '.join(map(str, sheets.tolist()))} lie"
        hint = "name one of them: (x, y, sheet)" if len(sheets) else "pin a point inside of the sheet"
        raise InputError(f"a pin names no place of the surface: {there} over the point", where=[where], hint=hint)
    best = int(np.argmax(weights.min(axis=1)))
    shares = weights[best].clip(0, 1)
    return int(candidates[best]), shares / shares.sum()


def _barycentric(corners: Floats, where: Floats) -> Floats:
    opposite = np.stack([_area(corners[:, (i + 1) % 3], corners[:, (i + 2) % 3], where) for i in range(3)], axis=1)
    whole = _area(corners[:, 0], corners[:, 1], corners[:, 2])
    return np.asarray(opposite / np.maximum(whole, np.finfo(float).tiny)[:, None])


def _area(a: Floats, b: Floats, c: Floats) -> Floats:
    u, v = b - a, c - a
    return np.asarray(u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0])


def _refuse_dependent(pins: Pins, points: Floats, mesh: LiftedMesh) -> None:
    """Raise InputError for points that are pinned twice, or lie on pinned sheets."""
    rows = pins.rows(mesh)
    for number, face in enumerate(pins.faces):
        free = rows[: number + 1].toarray() * ~pins.held
        if np.linalg.matrix_rank(free, tol=_ROUNDING) <= number:
            where = pins.weights[number] @ points[mesh.planar_vertex[mesh.faces[face]]]
            raise InputError("the height at a pinned point is given by other pins already", where=[where])


@dataclass(frozen=True, eq=False)
class Room:
    """How low and high each vertex can be, between what is pinned below and above it.

    Parameters
    ----------
    lowest, highest : (v,) float
        Infinite where nothing is pinned below or above.
    """

    lowest: Floats
    highest: Floats


def room_between(pins: Pins, points: Floats, mesh: LiftedMesh, distance: Floats) -> Room:
    """Return the room that pins leave.

    Parameters
    ----------
    pins : Pins
    points : (p, 2) float
    mesh : LiftedMesh
    distance : (c,) float
        Least distance of each row of ``mesh.stacked``.

    Raises
    ------
    InputError
        If there is none somewhere: pinned sheets would be closer than their distance.
    """
    lowest, highest = np.where(pins.held, pins.height, -np.inf), np.where(pins.held, pins.height, np.inf)
    for rows in rows_upward(mesh):
        lower, upper = mesh.stacked[rows].T
        np.maximum.at(lowest, upper, lowest[lower] + distance[rows])
    for rows in reversed(list(rows_upward(mesh))):
        lower, upper = mesh.stacked[rows].T
        np.minimum.at(highest, lower, highest[upper] - distance[rows])
    over = np.where(pins.held, lowest - pins.height, -np.inf)
    if (over > 0).any():
        worst = int(np.argmax(over))
        _refuse_meeting_itself(worst, pins, points, mesh)
        raise _too_close(points[mesh.planar_vertex[worst]], lowest[worst], pins.height[worst])
    _refuse_points_without_room(pins, points, mesh, Room(lowest, highest), distance)
    return Room(lowest, highest)


def _refuse_points_without_room(pins: Pins, points: Floats, mesh: LiftedMesh, room: Room, distance: Floats) -> None:
    slack = _ROUNDING * distance.max(initial=0.0)
    for face, weight, height in zip(pins.faces, pins.weights, pins.heights, strict=True):
        corners = mesh.faces[face]
        used = weight > 0
        low, high = (float(weight[used] @ bound[corners][used]) for bound in (room.lowest, room.highest))
        if not low - slack <= height <= high + slack:
            bound = low if height < low else high
            raise _too_close(weight @ points[mesh.planar_vertex[corners]], bound, float(height))


def _refuse_meeting_itself(worst: int, pins: Pins, points: Floats, mesh: LiftedMesh) -> None:
    """Raise InputError if all that is pinned over a vertex's point belongs to a single sheet."""
    there = np.flatnonzero((mesh.planar_vertex == mesh.planar_vertex[worst]) & pins.held)
    loose = set(mesh.sheet[~pins.held[mesh.faces].all(axis=1)].tolist())
    sheets = [set(mesh.sheet[(mesh.faces == vertex).any(axis=1)].tolist()) - loose for vertex in there]
    if set.intersection(*sheets):
        raise InputError(
            "a pinned sheet comes to lie over itself at a crossing, so it cannot be level",
            where=points[mesh.planar_vertex[[worst]]],
            hint="pin a point of it: (x, y, sheet)",
        )


def _too_close(where: Floats, bound: float, height: float) -> InputError:
    side = "lower" if height < bound else "higher"
    return InputError(
        f"pins are closer than the gap: a sheet pinned at {height:g} may be no {side} than {bound:g} there",
        where=[where],
        hint="move the pinned heights apart, or choose a smaller gap",
    )


def rows_upward(mesh: LiftedMesh) -> Iterator[Ints]:
    """Yield the rows of stacked vertices, by the level of the lower one."""
    level = mesh.level[mesh.stacked[:, 0]]
    return (np.flatnonzero(level == number) for number in range(mesh.level.max()))
