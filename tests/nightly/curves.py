"""The curves of the nightly check, and lists of them: a seed says which kind it is, and draws it."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from nightly.lists import nested, through_the_frame
from nightly.meshes import drawn_anywhere, thin_spike
from reference.random_curves import (
    SEVERAL_IMMERSIONS,
    Polygon,
    glued_disk,
    random_polygon,
    ribbon_outline,
    smooth_curve,
    without_repeats,
)

Draw = Callable[[np.random.Generator], Polygon]


def half_turn_polygon(rng: np.random.Generator, half: int) -> Polygon:
    """A polygon that half a turn maps to itself: curves with several immersions are often like that."""
    points = random_polygon(rng, half)
    return points + [(-x, -y) for x, y in points]


def spoiled_disk(rng: np.random.Generator, triangles: int) -> Polygon:
    """A glued disk with one vertex moved: often it only just is none any more."""
    points = glued_disk(rng, triangles)
    i = int(rng.integers(len(points)))
    (x, y), (dx, dy) = points[i], *random_polygon(rng, 1)
    return [*points[:i], (x + dx, y + dy), *points[i + 1 :]]


def jittered(rng: np.random.Generator, size: int) -> Polygon:
    """A curve known to have several immersions, with its vertices moved a little: most keep several, some lose them."""
    polygon, _, _ = SEVERAL_IMMERSIONS[int(rng.integers(len(SEVERAL_IMMERSIONS)))]
    steps = random_polygon(rng, len(polygon), size)
    return [(100 * x + dx, 100 * y + dy) for (x, y), (dx, dy) in zip(polygon, steps, strict=True)]


KINDS: dict[str, Draw] = {
    "polygon": lambda rng: random_polygon(rng, int(rng.integers(5, 15))),
    "half-turn polygon": lambda rng: half_turn_polygon(rng, int(rng.integers(3, 8))),
    "crowded polygon": lambda rng: random_polygon(rng, int(rng.integers(5, 12)), 40),
    "jittered": lambda rng: jittered(rng, int(rng.integers(1, 2000))),
    "smooth": lambda rng: smooth_curve(rng, int(rng.integers(2, 7)), int(rng.integers(12, 41))),
    "disk": lambda rng: glued_disk(rng, int(rng.integers(4, 41))),
    "spoiled disk": lambda rng: spoiled_disk(rng, int(rng.integers(4, 41))),
    "ribbon": lambda rng: ribbon_outline(rng, int(rng.integers(4, 25))),
    "large disk": lambda rng: glued_disk(rng, int(rng.integers(60, 200))),
    "large ribbon": lambda rng: ribbon_outline(rng, int(rng.integers(40, 200))),
    "thin spike": thin_spike,
    "certificate": drawn_anywhere,
}

LISTS: dict[str, Callable[[np.random.Generator], list[Polygon]]] = {
    "list of loops": nested,
    "list of loops through the frame": through_the_frame,
}

SHARES = {
    "polygon": 5,
    "half-turn polygon": 4,
    "crowded polygon": 1,
    "jittered": 2,
    "smooth": 2,
    "disk": 3,
    "spoiled disk": 3,
    "ribbon": 2,
    "large disk": 1,
    "large ribbon": 1,
    "list of loops": 1,
    "list of loops through the frame": 1,
    "thin spike": 1,
    "certificate": 2,
}
MIX = [kind for kind, share in SHARES.items() for _ in range(share)]
"""Seeds go round this list."""

DISKS = frozenset({"disk", "ribbon", "large disk", "large ribbon"})
"""Kinds that bound a disk by construction."""


class Drawn(NamedTuple):
    """A curve of the nightly check, or a list of curves."""

    seed: int
    kind: str
    points: Polygon | list[Polygon]


def draw(seed: int) -> Drawn:
    """The curve of a seed. Equal vertices in a row are dropped: the library does so too, the reference refuses them."""
    kind, rng = MIX[seed % len(MIX)], np.random.default_rng(seed)
    if kind in LISTS:
        return Drawn(seed, kind, [without_repeats(loop) for loop in LISTS[kind](rng)])
    return Drawn(seed, kind, without_repeats(KINDS[kind](rng)))
