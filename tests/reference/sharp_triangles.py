"""Why a triangle of a mesh has a sharp angle: from the definitions, one triangle at a time."""

import numpy as np


def smallest_angles(points, triangles):
    """Of each triangle, in degrees."""
    corner = points[triangles]
    to_next, to_last = np.roll(corner, -1, axis=1) - corner, np.roll(corner, 1, axis=1) - corner
    sine = to_next[..., 0] * to_last[..., 1] - to_next[..., 1] * to_last[..., 0]
    return np.degrees(np.arctan2(sine, (to_next * to_last).sum(axis=2))).min(axis=1)


def edges_of(drawn):
    """Return the curve between points and crossings: rows of two points."""
    points, crossings = drawn.curve.points, drawn.crossings
    chain = []
    visits = iter(zip(drawn.visit_edge.tolist(), drawn.crossing_of_visit.tolist(), strict=True))
    visit = next(visits, None)
    for edge, point in enumerate(points):
        chain.append(point)
        while visit and visit[0] == edge:
            chain.append(crossings[visit[1]])
            visit = next(visits, None)
    return np.stack([chain, np.roll(chain, -1, axis=0)], axis=1)


def runs_through(edges, point, close):
    """Return the edges that a point lies on."""
    a, b = edges[:, 0], edges[:, 1]
    along = b - a
    share = np.clip(((point - a) * along).sum(axis=1) / (along**2).sum(axis=1), 0, 1)
    return np.flatnonzero(np.hypot(*(a + share[:, None] * along - point).T) <= close)


def is_thin(edges, one, other, p, q):
    """Two edges go side by side from points p and q on them, for four times the distance of q from the first."""
    for end in edges[one]:
        for far in edges[other]:
            length = min(np.hypot(*(end - p)), np.hypot(*(far - q)))
            if not length:
                continue
            u, v = (end - p) / np.hypot(*(end - p)), (far - q) / np.hypot(*(far - q))
            width = abs(u[0] * (q - p)[1] - u[1] * (q - p)[0])
            gap = np.array(q + 4 * width * v - p)
            long = length >= max(4 * width, np.hypot(*(q - p))) * (1 - 1e-9)
            if long and u @ v > 0 and abs(u[0] * gap[1] - u[1] * gap[0]) <= 2 * width * (1 + 1e-9):
                return True
    return False


def is_sharp(edges, one, other):
    """Two edges meet with less than 60°."""
    for i in range(2):
        for j in range(2):
            if (edges[one, i] == edges[other, j]).all():
                u, v = edges[one, 1 - i] - edges[one, i], edges[other, 1 - j] - edges[other, j]
                return bool(u @ v > (0.5 - 1e-9) * np.hypot(*u) * np.hypot(*v))
    return False


def reason(edges, corners, close):
    """Return "corner" if the sharp angle is that of a sharp corner, or the side opposite goes across one.

    "strip" if that side goes across a thin strip, or None.
    """
    sides = np.hypot(*(np.roll(corners, -1, axis=0) - corners).T)
    first = int(sides.argmin())
    p, q, apex = np.roll(corners, -first, axis=0)
    at_p, at_q, at_apex = (set(runs_through(edges, point, close).tolist()) for point in (p, q, apex))
    if any(is_sharp(edges, one, other) for one in at_p & at_apex for other in at_q & at_apex if one != other):
        return "corner"
    if at_p & at_q:
        return None
    if any(is_sharp(edges, one, other) for one in at_p for other in at_q):
        return "corner"
    thin = any(is_thin(edges, one, other, p, q) or is_thin(edges, other, one, q, p) for one in at_p for other in at_q)
    return "strip" if thin else None
