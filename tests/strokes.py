"""Outlines like those that tools make of pen strokes: offsets of a line, with tiny loops at sharp inner corners."""

import numpy as np


def offset(line, half):
    """The points at so much to the left of a line: two at each corner, those of the segments that meet there."""
    steps = np.diff(line, axis=0)
    aside = half * np.stack([-steps[:, 1], steps[:, 0]], axis=1) / np.hypot(*steps.T)[:, None]
    return np.concatenate([np.stack([a + n, b + n]) for a, b, n in zip(line[:-1], line[1:], aside, strict=True)])


def round_corners(line, half, rng):
    """The same with some points on an arc at outer corners."""
    sides = offset(line, half).reshape(-1, 2, 2)
    points = [sides[0]]
    for corner, before, after in zip(line[1:-1], sides[:-1], sides[1:], strict=True):
        u, v = before[1] - corner, after[0] - corner
        turn = np.arctan2(u[0] * v[1] - u[1] * v[0], u @ v)
        if turn < 0:  # the corner is on the other side, and the offset has to go round it
            angles = np.arctan2(u[1], u[0]) + turn * np.linspace(0, 1, int(rng.integers(2, 5)) + 2)[1:-1]
            points.append(corner + half * np.stack([np.cos(angles), np.sin(angles)], axis=1))
        points.append(after)
    return np.concatenate(points)


def stroke(rng, corners):
    """The outline of a random pen stroke, counter-clockwise."""
    turns = rng.uniform(-2, 2, corners) * rng.choice([0.2, 1], corners)
    heading = np.cumsum(turns)
    lengths = rng.uniform(6, 20, corners)
    line = np.cumsum(lengths[:, None] * np.stack([np.cos(heading), np.sin(heading)], axis=1), axis=0)
    half = rng.uniform(0.3, 2.0)
    right = round_corners(line[::-1], half, rng)
    left = round_corners(line, half, rng)
    return np.round(np.concatenate([left, right])[::-1], 6)
