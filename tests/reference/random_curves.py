"""Random closed polygons, some of which bound an immersed disk by construction; and polygons with known answers.

All generators take a numpy Generator and return vertices with integer coordinates, as lists of (x, y).
"""

import cmath
import math

import numpy as np

Polygon = list[tuple[int, int]]

# Curves with several immersions: polygon, immersions, how many layerings each immersion has.
MILNOR_LIKE: Polygon = [
    (88, 39), (62, 102), (-17, -15), (-17, -13), (44, -7), (-75, 180),
    (-88, -39), (-62, -102), (17, 15), (17, 13), (-44, 7), (75, -180),
]  # fmt: skip
TEN_GON: Polygon = [
    (-12, 53), (3, 21), (-134, -108), (149, -92), (-78, 180),
    (12, -53), (-3, -21), (134, 108), (-149, 92), (78, -180),
]  # fmt: skip
BENNEQUIN_LIKE: Polygon = [
    (-18, -81), (62, -52), (19, 31), (34, 30), (-175, 9), (59, -176), (79, 25), (14, 80), (-36, 1),
    (-43, 14), (80, -156), (124, 139), (-61, 56), (-76, -28), (17, -32), (9, -44), (95, 147), (-182, 37),
]  # fmt: skip
SEVERAL_IMMERSIONS = (
    (MILNOR_LIKE, 6, (2, 2)),
    (TEN_GON, 10, (2, 2)),
    (BENNEQUIN_LIKE, 12, (0, 0, 2, 2, 2)),
)
"""(polygon, number of crossings, sorted numbers of layerings of its immersions)"""


# It turns twice: with a cusp on its inner lobe, points 5 to 7, it bounds a disk.
LIMACON = [(3, 0), (1, 3), (-2, 0), (1, -3), (3, 0.5), (1, 1), (0.5, 0), (1, -1)]
# It turns -1 times and bounds a disk with a handle, in one way.
HANDLE: Polygon = [
    (73, 90), (-75, 89), (115, -54), (115, 45), (-10, 54), (47, 67), (49, 8), (15, 32), (94, 29), (91, -28),
]  # fmt: skip

FRAME: Polygon = [(-40, -41), (42, -40), (40, 43), (-43, 40)]
"""Round `small_loops`, most of which lie inside."""


def rounded(points: list[complex], scale: float = 1.0) -> Polygon:
    """Points of the complex plane on the integer grid."""
    return [(round(scale * z.real), round(scale * z.imag)) for z in points]


def without_repeats(polygon: Polygon) -> Polygon:
    """The polygon without vertices that equal the one before."""
    return [p for i, p in enumerate(polygon) if p != polygon[i - 1]]


def random_polygon(rng: np.random.Generator, vertices: int, size: int = 1000) -> Polygon:
    """Vertices anywhere in a square."""
    return [(int(x), int(y)) for x, y in rng.integers(-size, size + 1, (vertices, 2))]


def smooth_curve(rng: np.random.Generator, degree: int, samples: int = 100, size: int = 100_000) -> Polygon:
    """A trigonometric polynomial with random coefficients, sampled; higher waves are weaker."""
    waves = {m: complex(*rng.normal(size=2)) / abs(m) for m in range(-degree, degree + 1) if m}
    points = [sum(c * cmath.exp(2j * math.pi * m * i / samples) for m, c in waves.items()) for i in range(samples)]
    return without_repeats(rounded(points, size))


def star_polygon(points: int, step: int, size: int = 100_000) -> Polygon:
    """The regular star {points/step}: winds `step` times round its middle, points * (step - 1) crossings."""
    return rounded([cmath.exp(2j * math.pi * step * i / points) for i in range(points)], size)


def left_turn(p: tuple[int, int], q: tuple[int, int], r: tuple[int, int]) -> bool:
    """Whether the triangle p, q, r is positively oriented, exactly."""
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]) > 0


def ribbon_outline(rng: np.random.Generator, steps: int, wildness: float = 0.3, size: int = 1000) -> Polygon:
    """The outline of a ribbon of constant width along a wandering line: bounds an immersed disk.

    The ribbon is a strip of convex quadrilaterals, all positively oriented; all their vertices are on the boundary.
    """
    place, heading, bend = 0j, 0.0, 0.0
    right, left = [], []
    for _ in range(steps + 1):
        right.append(place - 0.4j * cmath.exp(1j * heading))
        left.append(place + 0.4j * cmath.exp(1j * heading))
        bend = max(-0.8, min(0.8, 0.97 * bend + wildness * rng.normal()))
        place += cmath.exp(1j * (heading + bend / 2))
        heading += bend
    right, left = rounded(right, size), rounded(left, size)
    for i in range(steps):
        quadrilateral = [right[i], right[i + 1], left[i + 1], left[i]]
        assert all(left_turn(quadrilateral[j - 2], quadrilateral[j - 1], quadrilateral[j]) for j in range(4))
    return right + left[::-1]


def angle(p: tuple[int, int], q: tuple[int, int], r: tuple[int, int]) -> float:
    """The angle of the triangle p, q, r at q."""
    return abs(cmath.phase(complex(p[0] - q[0], p[1] - q[1]) / complex(r[0] - q[0], r[1] - q[1])))


def glued_disk(rng: np.random.Generator, triangles: int, size: int = 1000) -> Polygon:
    """The outline of a disk glued from random triangles: bounds an immersed disk.

    Each new triangle, positively oriented, is attached to a boundary edge (u, v) with its apex to the right of it. All
    vertices stay on the boundary; the triangles round each of them never add up to a full turn, so the disk is
    immersed at its boundary too.
    """
    boundary: Polygon = [(0, 0), (size, 0), (size // 2, size)]
    angles = [angle(boundary[i - 1], boundary[i], boundary[(i + 1) % 3]) for i in range(3)]
    while len(boundary) < triangles + 2:
        i = int(rng.integers(len(boundary)))
        j = (i + 1) % len(boundary)
        u, v = boundary[i], boundary[j]
        step_x, step_y = (int(step) for step in rng.integers(-size, size + 1, 2))
        apex = ((u[0] + v[0]) // 2 + step_x, (u[1] + v[1]) // 2 + step_y)
        at_u, at_v = (angle(apex, u, v), angle(u, v, apex)) if apex not in (u, v) else (0.0, 0.0)
        if left_turn(u, apex, v) and angles[i] + at_u < 1.99 * math.pi and angles[j] + at_v < 1.99 * math.pi:
            angles[i] += at_u
            angles[j] += at_v
            boundary.insert(i + 1, apex)
            angles.insert(i + 1, angle(u, apex, v))
    return boundary


def small_loops(rng: np.random.Generator, most: int) -> list[Polygon]:
    """One to three polygons of three to so many vertices, some of which lie apart or inside others."""
    loops = []
    for _ in range(int(rng.integers(1, 4))):
        size, (x, y) = int(rng.choice([4, 9, 20])), rng.integers(-20, 21, 2).tolist()
        polygon = without_repeats(random_polygon(rng, int(rng.integers(3, most + 1)), size))
        loops.append([(x + a, y + b) for a, b in polygon])
    return loops
