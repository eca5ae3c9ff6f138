"""Outlines by the thousand, as people have them: contours of letters, outlines of strokes, buildings that touch."""

import numpy as np
import shapely

import plyfold as pf


def glyphs(count, seed):
    """Closed contours of Bézier curves, drawn as polylines; most of them simple, some with a loop at a stroke's end."""
    rng = np.random.default_rng(seed)
    t = np.linspace(0, 1, 6, endpoint=False)[:, None]
    for _ in range(count):
        n = int(rng.integers(3, 7))
        angle = np.sort(rng.uniform(0, 2 * np.pi, n))
        knots = rng.uniform(250, 500, (n, 1)) * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        handles = rng.normal(0, 50, (n, 2))
        following = np.roll(knots, -1, axis=0)
        out, back = knots + handles, following - np.roll(handles, -1, axis=0)
        curves = [
            (1 - t) ** 3 * a + 3 * (1 - t) ** 2 * t * b + 3 * (1 - t) * t**2 * c + t**3 * d
            for a, b, c, d in zip(knots, out, back, following, strict=True)
        ]
        # Font units are whole numbers.
        yield np.round(np.concatenate(curves)).astype(np.int64)


def strokes(count, seed):
    """Outlines of lines with a width, which pass over themselves and have small loops at inner corners."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        heading = np.cumsum(rng.normal(0, 0.5, int(rng.integers(6, 20))))
        line = np.cumsum(np.stack([np.cos(heading), np.sin(heading)], axis=1), axis=0)
        normal = np.gradient(line, axis=0)[:, ::-1] * (-1, 1)
        side = rng.uniform(0.2, 1.2) * normal / np.hypot(*normal.T)[:, None]
        yield np.concatenate([line - side, (line + side)[::-1]])


def buildings(count, seed):
    """Polygons on a grid that touch themselves in corners, some with a court, some ring by ring with errors of maps."""
    rng = np.random.default_rng(seed)
    steps = np.array([(0, 0), (4, 0), (4, 4), (0, 4)])
    for _ in range(count):
        x, y = rng.integers(0, 1000, 2)
        kind = rng.integers(5)
        first = steps + np.array((x, y))
        second = first + 4
        if kind == 0:  # two blocks that meet in a corner, as one ring
            yield np.concatenate([first[:3], second[1:], second[:1], first[3:]])
        elif kind == 1:  # a court that touches the wall in a corner
            yield shapely.Polygon(first, [[first[0], first[0] + np.array((1, 2)), first[0] + np.array((2, 1))]])
        elif kind == 2:  # a court
            yield shapely.Polygon(first, [first[::-1] * 0.5 + (x + 1, y + 1) - np.array((x, y)) * 0.5])
        elif kind == 3:  # a wall that is run along there and back, and a corner twice
            yield np.concatenate([first, first[3:], [(x, y + 2), (x - 3, y + 2), (x, y + 2)]])
        else:  # two blocks of a multipolygon, side by side
            yield shapely.MultiPolygon([shapely.Polygon(first), shapely.Polygon(first + np.array((5, 0)))])


def bad(seed):
    """What is no outline, each in another way."""
    rng = np.random.default_rng(seed)
    return [
        [(0, 0), (1, 1)],
        [(0, 0), (1, 1), (2, 2)],
        [(0, 0), (1, float("nan")), (2, 0)],
        [(0, 0), (1e200, 0), (0, 1e200)],
        np.zeros((0, 2)),
        rng.random(4),
        None,
        "outline",
        b"no WKB",
        shapely.Point(1, 2),
        shapely.Polygon(),
        shapely.LineString([(0, 0), (5, 0), (5, 5)]),
        {"loops": [[(0, 0), (1, 0), (0, 1)]]},
    ]


def others(seed):
    """Whatever else stands for an outline."""
    square = shapely.box(0, 0, 4, 4)
    return [
        pf.gallery.named_curve("exit-ramp").outline,
        pf.gallery.named_curve("milnor").outline,
        pf.Curve([(3, 0), (1, 3), (-2, 0), (1, -3), (3, 0.5), (1, 1), (0.5, 0), (1, -1)], cusps={6: 1}),
        pf.Outline([[(0, 0), (9, 0), (0, 9)], [(1, 1), (1, 3), (3, 1)]]),
        square,
        square.wkb,
        bytearray(shapely.Polygon([(0, 0, 7), (4, 0, 7), (0, 4, 7)]).wkb),
        square.exterior,
        shapely.LineString([(0, 0), (5, 0), (5, 5), (0, 0)]),
        shapely.GeometryCollection([shapely.MultiPolygon([square])]),
        shapely.MultiPolygon([square]),
        np.random.default_rng(seed).random((12, 2)).astype(np.float32),
        np.array([(0, 0, 1), (4, 0, 1), (0, 4, 1)]),
    ]
