"""Lists of loops: how they are drawn, and everything that must hold for one."""

from math import prod

import numpy as np
import pytest

import plyfold as pf
from reference.crossings import DegenerateError
from reference.loops import casing, level_solutions, loop_borders
from reference.random_curves import Polygon, glued_disk, left_turn, random_polygon

MOST_LEVELS = 10**6
"""Assignments of levels up to which the reference tries them."""


def triangle(rng: np.random.Generator, size: int) -> Polygon:
    """A triangle that runs counter-clockwise."""
    while True:
        a, b, c = random_polygon(rng, 3, size)
        if left_turn(a, b, c) or left_turn(a, c, b):
            return [a, b, c] if left_turn(a, b, c) else [a, c, b]


def nested(rng: np.random.Generator) -> list[Polygon]:
    """Frames around triangles and small disks, some of which are holes; they cross each other, or lie inside."""
    frames = [[(-r, -r - 1), (r + 2, -r), (r, r + 3), (-r - 3, r)] for r in (300, 200)[: int(rng.integers(1, 3))]]
    loops = []
    for _ in range(int(rng.integers(1, 4))):
        size = int(rng.integers(10, 100))
        loop = triangle(rng, size) if rng.random() < 0.7 else glued_disk(rng, int(rng.integers(2, 5)), size)
        loops.append(loop[::-1] if rng.random() < 0.4 else loop)
    return [*loops, *frames]


def through_the_frame(rng: np.random.Generator) -> list[Polygon]:
    """Loops that hang together, though some of them cross the frame only by way of others."""
    return [*nested(rng), triangle(rng, 900)]


def levels(surface: pf.Layering) -> tuple[int, ...]:
    """The levels behind all visits to crossings, and then those of loops without crossings; marks change nothing."""
    drawn, level = surface.immersion.arrangement, surface.border_level
    crossing = drawn.border_after[drawn.crossing_visits]
    alone = np.setdiff1d(drawn.loop_of_border, drawn.loop_of_border[crossing])
    first_border = np.searchsorted(drawn.loop_of_border, alone)
    marks = np.setdiff1d(np.arange(len(drawn.partner)), drawn.crossing_visits)
    assert (level[drawn.border_before[marks]] == level[drawn.border_after[marks]]).all()
    return (*level[crossing].tolist(), *level[first_border].tolist())


def judge_list(loops: list[Polygon]) -> None:
    """Compare what is found, listed and counted, with and without a casing, with all assignments of levels."""
    try:
        borders = loop_borders(loops)
    except DegenerateError:
        with pytest.raises(pf.errors.GeneralPositionError):
            pf.arrange(loops, general_position="raise")
        return
    if prod(borders.left_winding) > MOST_LEVELS:
        return
    by_casing: dict[tuple[bool, ...], set[tuple[int, ...]]] = {}
    for level in level_solutions(borders):
        by_casing.setdefault(casing(borders, level), set()).add(level)
    every = set().union(*by_casing.values())
    listed = [levels(surface) for surface in pf.embeddings(loops)]
    assert len(listed) == len(set(listed)) == pf.count_embeddings(loops)
    assert set(listed) == every
    found = pf.find_embedding(loops)
    assert levels(found) in every if found else not every
    for over, expected in by_casing.items():
        judge_casing(loops, over, expected)


def judge_casing(loops: list[Polygon], over: tuple[bool, ...], expected: set[tuple[int, ...]]) -> None:
    """The surfaces with a casing are those expected; one alone is the answer, several are refused."""
    listed = [levels(surface) for surface in pf.embeddings(loops, over)]
    assert len(listed) == len(expected)
    assert set(listed) == expected
    if len(expected) == 1:
        assert levels(pf.embed_cased(loops, over)) in expected
        return
    with pytest.raises(pf.errors.InputError, match="several surfaces"):
        pf.embed_cased(loops, over)
