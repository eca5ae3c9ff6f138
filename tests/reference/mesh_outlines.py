"""The boundary of a flat mesh by walking round it, one triangle after the other, in fractions.

A fan is walked from the boundary edge that leaves its vertex, counter-clockwise. Each step turns by less than half a
turn, and a full turn is made whenever the direction arrives at, or passes, the one in which the walk began.
"""

from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from reference.crossings import Point, cross, dot, exact, minus


class Fan(NamedTuple):
    """The neighbours of a vertex along a fan, counter-clockwise; the first comes back as last where it closes."""

    vertex: int
    rim: tuple[int, ...]


def fans_of(faces: Sequence[Sequence[int]]) -> list[Fan]:
    """All fans: neighbours before and after each other at a vertex, put together in chains."""
    step = {(tuple(face)[i], tuple(face)[(i + 1) % 3]): tuple(face)[i - 1] for face in faces for i in range(3)}
    arrived = {(vertex, after) for (vertex, _), after in step.items()}
    fans = []
    for vertex, first in sorted(step, key=lambda key: key in arrived):  # open ones begin where nothing arrives
        rim = [first]
        while (vertex, rim[-1]) in step:
            rim.append(step.pop((vertex, rim[-1])))
        fans += [Fan(vertex, tuple(rim))] if len(rim) > 1 else []
    return fans


def same_direction(u: Point, v: Point) -> bool:
    return cross(u, v) == 0 and dot(u, v) > 0


def sweeps_over(u: Point, v: Point, goal: Point) -> bool:
    """Whether turning from u counter-clockwise to v, by less than half a turn, arrives at the goal or passes it."""
    return same_direction(v, goal) or (cross(u, goal) > 0 and cross(goal, v) > 0)


def turns(places: Sequence[Point], fan: Fan) -> int:
    """How many full turns too many a fan makes: those before the last, which is whole if it ends where it began."""
    directions = [minus(places[end], places[fan.vertex]) for end in fan.rim]
    arrivals = sum(sweeps_over(u, v, directions[0]) for u, v in pairwise(directions))
    return arrivals - same_direction(directions[0], directions[-1])


def mesh_outline(points: Sequence[Sequence[float]], faces: Sequence[Sequence[int]]) -> set[tuple[tuple[int, int], ...]]:
    """The loops of the boundary as rows of (vertex, index), each turned so that the least of its turns comes first."""
    places = exact(points)
    open_fans = [fan for fan in fans_of(faces) if fan.rim[0] != fan.rim[-1]]
    fan_from = {(fan.rim[-1], fan.vertex): fan for fan in open_fans}
    loops = set()
    while fan_from:
        edge = next(iter(fan_from))
        loop = []
        while edge in fan_from:
            fan = fan_from.pop(edge)
            loop.append((fan.vertex, turns(places, fan)))
            edge = fan.vertex, fan.rim[0]
        loops.add(least_turned(loop))
    return loops


def marked(loops: Iterable[np.ndarray], cusps: Iterable[np.ndarray]) -> set[tuple[tuple[int, int], ...]]:
    """Loops of vertices and their indices, in the form of `mesh_outline`."""
    return {
        least_turned(list(zip(loop.tolist(), index.tolist(), strict=True)))
        for loop, index in zip(loops, cusps, strict=True)
    }


def least_turned(loop: Sequence[tuple[int, int]]) -> tuple[tuple[int, int], ...]:
    return min(tuple(loop[i:]) + tuple(loop[:i]) for i in range(len(loop)))
