"""Turns one at a time, against fractions."""

from fractions import Fraction

import numpy as np
import pytest

from plyfold.core.turns import points_for_turns, turn


def cross(a, b, c):
    (ax, ay), (bx, by), (cx, cy) = (map(Fraction, place) for place in (a, b, c))
    return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)


@pytest.mark.parametrize("kind", ["grid", "line", "doubles", "tiny", "huge"])
def test_turns_are_exact(kind):
    rng = np.random.default_rng(3)
    points = {
        "grid": rng.integers(-3, 4, (60, 2)) * 1.0,
        "line": np.linspace(0, 1, 60)[:, None] * [0.1, 0.7] + [0.3, -0.9],
        "doubles": rng.normal(size=(60, 2)),
        "tiny": rng.integers(-3, 4, (60, 2)) * 5e-324,
        "huge": rng.normal(size=(60, 2)) * 1e307,
    }[kind]
    fractions = np.array([list(map(Fraction, row)) for row in points.tolist()])
    places, near = points_for_turns(points), points_for_turns(fractions)
    for a, b, c in rng.integers(0, 60, (400, 3)).tolist():
        exact = cross(*points[[a, b, c]].tolist())
        assert turn(places, a, b, c) == turn(near, a, b, c) == (exact > 0) - (exact < 0)
