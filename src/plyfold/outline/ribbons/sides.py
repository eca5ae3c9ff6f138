"""The two sides of a ribbon, joint by joint, before inner corners are cut off that the ribbon is too wide for."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, NamedTuple, TypeAlias

import numpy as np

from plyfold.arrays import Bools, Floats, Ints
from plyfold.outline.ribbons.line import WideLine
from plyfold.ragged import count_each

__all__ = ["LEFT", "RIGHT", "CapStyle", "JoinStyle", "Side", "Style", "rough_side"]

JoinStyle: TypeAlias = Literal["round", "mitre", "bevel"]
CapStyle: TypeAlias = Literal["flat", "round", "square"]

LEFT, RIGHT = 1, -1

# Below this angle a joint has one point on its outer side: two of them could lie in the wrong order by rounding.
_LEAST_TURN = 1e-3


class Style(NamedTuple):
    """How corners and ends look.

    Parameters
    ----------
    join, cap : str
    quad_segs : int
        Edges of a quarter of a circle.
    mitre_limit : float
        Longest mitre, from the inner to the outer corner, in widths.
    """

    join: JoinStyle = "round"
    cap: CapStyle = "flat"
    quad_segs: int = 8
    mitre_limit: float = 5.0

    @property
    def step(self) -> float:
        """The angle of an edge of an arc."""
        return math.pi / 2 / self.quad_segs


@dataclass(frozen=True, eq=False)
class Side:
    """The points along one side of a ribbon.

    Parameters
    ----------
    points : (m, 2) float
    low, high : (m,) float
        The part of the line that each point is beside: joints are whole numbers, and between them it is by length.
    gap : (m,) bool
        Where there is no edge to the next point, for the segments of the line are too short for an inner corner.
    """

    points: Floats
    low: Floats
    high: Floats
    gap: Bools


class _Joints(NamedTuple):
    """Where a line turns, for one side of the ribbon; one entry for each joint of an open line, its ends left out.

    Parameters
    ----------
    turn : (j,) float
        By which angle the line turns; positive towards this side.
    inset : (j,) float
        How far before and after the joint the two edges of this side meet; negative on the outer side.
    mitre : (j, 2) float
        Where they meet, if nothing is in the way.
    """

    turn: Floats
    inset: Floats
    mitre: Floats


def rough_side(line: WideLine, side: int, style: Style) -> Side:
    """Return one side of an open line, from its start to its end, caps included.

    Parameters
    ----------
    line : WideLine
        Open; it nowhere turns straight back.
    side : int
        ``LEFT`` or ``RIGHT``.
    style : Style
    """
    middle = _points_at_joints(line, side, style)
    return _joined([_cap(line, side, style, 0), middle, _cap(line, side, style, -1)])


def _turned_left(vectors: Floats) -> Floats:
    return np.stack([-vectors[:, 1], vectors[:, 0]], axis=1)


def _joints(line: WideLine, normal: Floats, side: int) -> _Joints:
    ahead, half = line.directions, line.half_widths[1:-1]
    before, after = ahead[:-1], ahead[1:]
    across = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    along = (before * after).sum(axis=1)
    turn = side * np.arctan2(across, along)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        inset = half * np.tan(turn / 2)
        mitre = line.points[1:-1] + (half / (1 + along))[:, None] * (normal[:-1] + normal[1:])
    return _Joints(turn, inset, mitre)


def _steps(turn: Floats, style: Style) -> Ints:
    """Return by how many edges the outer side goes round each joint; 0 where it has one point alone."""
    sharp = np.abs(turn)
    if style.join == "round":
        edges = np.ceil(sharp / style.step).astype(np.int64)
        return np.where(edges > 1, edges, 0)
    bevelled = sharp > _LEAST_TURN
    if style.join == "mitre":
        bevelled &= np.cos(sharp / 2) * style.mitre_limit < 1
    return bevelled.astype(np.int64)


def _too_tight(line: WideLine, joints: _Joints, style: Style) -> Bools:
    """Return the joints whose inner corner does not fit between its neighbours."""
    length = np.hypot(*np.diff(line.points, axis=0).T)
    taken = np.where((joints.turn > 0) | (_steps(joints.turn, style) == 0), joints.inset, 0.0)
    before, after = np.append(taken, 0.0), np.append(0.0, taken)
    reversed_edge = ~(before + after < length)
    return np.asarray((joints.turn > 0) & (reversed_edge[:-1] | reversed_edge[1:]))


def _points_at_joints(line: WideLine, side: int, style: Style) -> Side:
    """Return the points beside each joint: one where the edges meet, several round an outer corner, two at a gap."""
    normal = side * _turned_left(line.directions)
    turn, inset, mitre = joints = _joints(line, normal, side)
    too_tight = _too_tight(line, joints, style)
    edges = np.where(turn > 0, too_tight, _steps(turn, style))
    joint, number = np.repeat(np.arange(len(turn)), edges + 1), count_each(edges + 1)
    share = number / np.maximum(edges, 1)[joint]
    around = _turned(normal[joint], side * turn[joint] * share)
    around[share == 1] = normal[1 + joint[share == 1]]
    points = line.points[1 + joint] + line.half_widths[1 + joint, None] * around
    single = edges[joint] == 0
    points[single] = mitre[joint[single]]
    length = np.hypot(*np.diff(line.points, axis=0).T)
    reach = np.where(single & (turn[joint] > 0), inset[joint], 0.0)
    gap = too_tight[joint] & (number == 0)
    return Side(points, 1 + joint - reach / length[joint], 1 + joint + reach / length[joint + 1], gap)


def _turned(vectors: Floats, angle: Floats) -> Floats:
    """Return vectors turned to the left."""
    return np.asarray(np.cos(angle)[:, None] * vectors + np.sin(angle)[:, None] * _turned_left(vectors))


def _cap(line: WideLine, side: int, style: Style, end: int) -> Side:
    """Return the points of a side from the tip of the first end to its corner, or from the last corner to the tip.

    The tip is the middle of the cap, also where that is flat, so that inner corners may be cut off the cap. The places
    of arcs are counted on beyond the end of the line: the strip goes round first on the left, then on the right.
    """
    half, ahead = line.half_widths[end], line.directions[end]
    edges = style.quad_segs if style.cap == "round" else 1
    angle = math.pi / 2 / edges * np.arange(edges + 1)
    outward = (ahead if end else -ahead) * (style.cap == "round")
    normal = side * _turned_left(ahead[None])
    points = line.points[end] + half * (np.cos(angle)[:, None] * normal + np.sin(angle)[:, None] * outward)
    points[-1] = line.points[end] + half * outward
    beyond = np.where(angle > 0, 1.5 + (0.5 if (side == RIGHT) == bool(end) else -0.5), 0.0)
    place = len(line.points) - 1 + beyond if end else -beyond
    order = np.arange(0 if half > 0 else edges, edges + 1)[:: 1 if end else -1]
    return Side(points[order], place[order], place[order], np.zeros(len(order), dtype=bool))


def _joined(parts: list[Side]) -> Side:
    names = ("points", "low", "high", "gap")
    return Side(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))
