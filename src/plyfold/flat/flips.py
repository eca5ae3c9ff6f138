"""Better triangles on the same points: edges are flipped where the other diagonal leaves larger angles.

The disk may overlap itself. That does not matter to a flip, which looks at two triangles on either side of an edge.
"""

from __future__ import annotations

from math import hypot

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.compiled import called_from_loops
from plyfold.turns import Places, as_places, turn

__all__ = ["flip_edges", "wants_flip"]

# Two opposite angles must add up to more than half a turn by this much, or rounding could flip an edge for ever.
_CLEARLY = 1e-9


def flip_edges(points: Floats, faces: Ints) -> Ints:
    """Flip inner edges until, as a rule, no circle around a triangle contains the corner beyond one of its edges.

    Parameters
    ----------
    points : (n, 2) float
    faces : (m, 3) int
        Counter-clockwise triangles that make a disk.

    Returns
    -------
    (m, 3) int
        Triangles of the same disk, counter-clockwise, exactly. Cost: O(m) if they are round already, O(m²) at worst.
    """
    places = Places(*(numbers.tolist() for numbers in as_places(points)))
    # No two edges join the same points: between them would lie a disk of two straight sides, without angles.
    apex = {(u, v): w for a, b, c in faces.tolist() for u, v, w in ((a, b, c), (b, c, a), (c, a, b))}
    waiting = [edge for edge in apex if edge[0] < edge[1]]
    while waiting:
        u, v = waiting.pop()
        a, b = apex.get((u, v)), apex.get((v, u))
        if a is None or b is None or not wants_flip(places, (u, b, v, a)):
            continue
        del apex[u, v], apex[v, u]
        for p, q, r in ((u, b, a), (b, v, a)):
            apex[p, q], apex[q, r], apex[r, p] = r, p, q
        waiting += [(u, b), (b, v), (v, a), (a, u)]
    rows = [(u, v, w) for (u, v), w in apex.items() if u < v and u < w]
    return np.array(rows, dtype=np.int64).reshape(-1, 3)


@called_from_loops
def wants_flip(places: Places, corners: tuple[int, int, int, int]) -> bool:
    """Tell whether a quadrilateral u, b, v, a is convex, and its angles at a and b are more than half a turn."""
    u, b, v, a = corners
    sine_a, cosine_a = _angle(places, u, a, v)
    sine_b, cosine_b = _angle(places, v, b, u)
    if sine_a * cosine_b + cosine_a * sine_b > -_CLEARLY:
        return False
    return turn(places, u, b, a) > 0 and turn(places, b, v, a) > 0


@called_from_loops
def _angle(places: Places, before: int, corner: int, after: int) -> tuple[float, float]:
    """Return sine and cosine of the angle at the corner of a counter-clockwise triangle."""
    x, y, _ = places
    px, py = x[after] - x[corner], y[after] - y[corner]
    qx, qy = x[before] - x[corner], y[before] - y[corner]
    size = hypot(px, py) * hypot(qx, qy) or 1.0
    return abs(px * qy - py * qx) / size, (px * qx + py * qy) / size
