"""Closed meshes in space, and the patches of them that face a viewer: outlines whose surface is known.

Tubes round random closed curves; bumpy balls that are twisted; sheets with bands on them, made thick, whose fronts have
handles; stairs that wind round a point several times. Each is seen from a random direction, along z from above. All
coordinates are whole numbers, so every sign below is exact.
"""

from collections.abc import Callable, Iterator
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import shapely
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

GRID = 2**18
"""Coordinates are at most this large; products of three differences stay below 2**63."""


class Body(NamedTuple):
    """A closed mesh; triangles run counter-clockwise when seen from outside."""

    vertices: np.ndarray
    faces: np.ndarray


class Patch(NamedTuple):
    """A connected part of a body's front. It lies on the left of its loops, which are rows of vertices.

    `cusps` says for each of them how many full turns too many the triangles at it make; `chi` is the Euler
    characteristic, counted on the triangles; `cuts_itself` tells whether two of them meet in space.
    """

    kind: str
    vertices: np.ndarray
    faces: np.ndarray
    loops: tuple[np.ndarray, ...]
    cusps: tuple[np.ndarray, ...]
    chi: int
    cuts_itself: bool

    @property
    def outline(self) -> list[np.ndarray]:
        """The points of the loops, seen from above."""
        return [self.vertices[loop, :2].astype(float) for loop in self.loops]


# ---- bodies ----------------------------------------------------------------------------------------------------------


def waves(rng: np.random.Generator, points: np.ndarray, size: float, count: int = 4) -> np.ndarray:
    """A smooth random function of places in space, about as large as `size`."""
    ways, phases = rng.normal(0, 1.5, (count, 3)), rng.uniform(0, 2 * np.pi, count)
    return size * np.sin(points @ ways.T + phases).sum(axis=1) / count**0.5


def grid_faces(rows: int, columns: int) -> np.ndarray:
    """The triangles of a grid that closes in both directions; vertex i · columns + j lies in row i."""
    i, j = (index.ravel() for index in np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij"))
    here, right = i * columns + j, i * columns + (j + 1) % columns
    up, both = (i + 1) % rows * columns + j, (i + 1) % rows * columns + (j + 1) % columns
    return np.concatenate([np.stack([here, right, both], axis=1), np.stack([here, both, up], axis=1)])


def tube(rng: np.random.Generator) -> Body:
    """A tube round a random closed curve: a torus, which often cuts itself."""
    rings, sides, waves_of_curve = int(rng.integers(30, 70)), int(rng.integers(5, 10)), int(rng.integers(1, 4))
    angle = np.arange(rings) * 2 * np.pi / rings
    wave = np.arange(1, waves_of_curve + 1)
    turns = np.concatenate([np.cos(np.outer(angle, wave)), np.sin(np.outer(angle, wave))], axis=1)
    curve = turns @ (rng.normal(size=(2 * waves_of_curve, 3)) / np.tile(wave, 2)[:, None])
    tangent = np.roll(curve, -1, axis=0) - np.roll(curve, 1, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]
    normal = carried_along(tangent)
    binormal = np.cross(tangent, normal)
    radius = rng.uniform(0.1, 0.5) * (1 + waves(rng, curve, 0.1))
    around = np.arange(sides) * 2 * np.pi / sides
    ring = np.cos(around)[:, None] * normal[:, None] + np.sin(around)[:, None] * binormal[:, None]
    return Body((curve[:, None] + radius[:, None, None] * ring).reshape(-1, 3), grid_faces(rings, sides))


def carried_along(tangent: np.ndarray) -> np.ndarray:
    """Normals along a closed curve that turn about it as little as they can, and close."""
    normal = np.empty_like(tangent)
    carried = np.cross(tangent[0], np.eye(3)[np.abs(tangent[0]).argmin()])
    for i in range(len(tangent)):
        carried = carried - (carried @ tangent[i]) * tangent[i]
        carried = normal[i] = carried / np.linalg.norm(carried)
    last = carried - (carried @ tangent[0]) * tangent[0]
    left = np.arctan2(np.cross(last, normal[0]) @ tangent[0], last @ normal[0])
    turn = left * np.arange(len(tangent))[:, None] / len(tangent)
    return np.cos(turn) * normal + np.sin(turn) * np.cross(tangent, normal)


@lru_cache
def sphere(times: int) -> Body:
    """An octahedron, its triangles divided in four that many times."""
    vertices = [*np.eye(3), *-np.eye(3)]
    faces = [(0, 1, 2), (1, 3, 2), (3, 4, 2), (4, 0, 2), (1, 0, 5), (3, 1, 5), (4, 3, 5), (0, 4, 5)]
    for _ in range(times):
        middle: dict[tuple[int, int], int] = {}

        def between(a: int, b: int, middle: dict[tuple[int, int], int] = middle) -> int:
            key = min(a, b), max(a, b)
            if key not in middle:
                middle[key] = len(vertices)
                vertices.append(vertices[a] + vertices[b])
            return middle[key]

        halves = [(a, b, c, between(a, b), between(b, c), between(c, a)) for a, b, c in faces]
        faces = [three for a, b, c, p, q, r in halves for three in ((a, p, r), (p, b, q), (r, q, c), (p, q, r))]
    points = np.array(vertices)
    return Body(points / np.linalg.norm(points, axis=1)[:, None], np.array(faces))


def ball(rng: np.random.Generator) -> Body:
    """A bumpy ball, twisted about an axis."""
    directions, faces = sphere(int(rng.integers(2, 4)))
    points = directions * np.exp(waves(rng, 2 * directions, rng.uniform(0.1, 0.6)))[:, None]
    twist = rng.uniform(-1.5, 1.5) * points[:, 2]
    x, y = points[:, 0], points[:, 1]
    return Body(
        np.stack([np.cos(twist) * x - np.sin(twist) * y, np.sin(twist) * x + np.cos(twist) * y, points[:, 2]], axis=1),
        faces,
    )


def banded(rng: np.random.Generator) -> Body:
    """A rectangle with two or three bands on one side that join random feet, made thick and bent a little.

    Seen from above its front has handles, or several loops, or both.
    """
    feet = rng.permutation(2 * int(rng.integers(2, 4))).tolist()
    bands = [(min(pair), max(pair)) for pair in zip(feet[::2], feet[1::2], strict=True)]
    sheet = sheet_with_bands(len(feet), bands, rng.permutation(len(bands)) + 1.0)
    thick = rng.uniform(0.02, 0.1)
    body = thickened(sheet, thick)
    bent = np.stack([waves(rng, 0.3 * body.vertices, 0.3) for _ in range(3)], axis=1)
    return Body(body.vertices + bent, body.faces)


def sheet_with_bands(feet: int, bands: list[tuple[int, int]], height: np.ndarray) -> Body:
    """The rectangle lies below the x axis, foot i of a band at (i + ½, 0); the bands are half rings in the air."""
    number: dict[tuple[float, ...], int] = {}
    places: list[tuple[float, float, float]] = []

    def vertex(x: float, y: float, z: float) -> int:
        key = (round(x, 6), round(y, 6), round(z, 6))
        if key not in number:
            number[key] = len(places)
            places.append((x, y, z))
        return number[key]

    across = [0.2, 0.5, 0.8]
    xs = [0.0, *(i + x for i in range(feet) for x in across), float(feet)]
    grids = [[[(x, y, 0.0) for x in xs] for y in (-1.0, -0.5, 0.0)]]
    steps = 14
    for (left, right), z in zip(bands, height.tolist(), strict=True):
        middle, far = (left + right + 1) / 2, (right - left) / 2
        angles = [np.pi * step / steps for step in range(steps + 1)]
        grids.append(
            [
                [(middle + (far + d) * np.cos(a), (far + d) * np.sin(a), 0.5 * z * np.sin(a)) for a in angles]
                for d in (0.3, 0.0, -0.3)
            ]
        )
    faces = []
    for grid in grids:
        rows = [[vertex(*place) for place in row] for row in grid]
        for low, high in pairwise(rows):
            for a, b, c, d in zip(low, low[1:], high[1:], high, strict=False):
                faces += [(a, b, c), (a, c, d)]
    return Body(np.array(places), np.array(faces))


def thickened(sheet: Body, thick: float) -> Body:
    """The sheet twice, the lower copy turned over, and a wall along its boundary."""
    count, up = len(sheet.vertices), np.array([0, 0, thick])
    start, end, _ = sides_of(sheet.faces)
    alone = boundary_sides(start, end)
    a, b = start[alone], end[alone]
    walls = [np.stack([b, a, a + count], axis=1), np.stack([b, a + count, b + count], axis=1)]
    return Body(
        np.concatenate([sheet.vertices + up, sheet.vertices - up]),
        np.concatenate([sheet.faces, sheet.faces[:, ::-1] + count, *walls]),
    )


def stair(rng: np.random.Generator) -> Body:
    """A thick stair that winds round a point and thins out towards it: its front has a cusp of a high index there."""
    steps = int(rng.integers(8, 40))
    angle = np.linspace(0, steps * rng.uniform(0.4, 0.9), steps + 1)
    radius = 1 + rng.uniform(0, 0.5, steps + 1)
    rise = rng.uniform(0.05, 0.2) * angle
    top = np.stack([radius * np.cos(angle), radius * np.sin(angle), rise], axis=1)
    low = top - [0, 0, rng.uniform(0.05, 0.3)]
    a, b = 1 + np.arange(steps), 2 + np.arange(steps)
    c, d, eye, last = a + steps + 1, b + steps + 1, np.zeros_like(a), steps + 1
    faces = [np.stack(three, axis=1) for three in ((eye, a, b), (eye, d, c), (a, c, d), (a, d, b))]
    ends = [(0, last + 1, 1), (0, last, last + last)]
    return Body(np.concatenate([[(0.0, 0.0, 0.0)], top, low]), np.concatenate([*faces, ends]))


KINDS: dict[str, Callable[[np.random.Generator], Body]] = {"tube": tube, "ball": ball, "banded": banded, "stair": stair}
MOST_TILTED = {"banded": 0.6, "stair": 0.3}
"""Radians by which the direction may differ from the vertical; others are seen from anywhere."""


def random_view(rng: np.random.Generator, most: float | None) -> np.ndarray:
    """A rotation; one that tilts by at most an angle if it is given."""
    if most is None:
        turned, upper = np.linalg.qr(rng.normal(size=(3, 3)))
        turned *= np.sign(np.diag(upper))
        return turned * np.linalg.det(turned)
    spin, tilt = rng.uniform(0, 2 * np.pi), rng.uniform(0, most)
    about_z = [[np.cos(spin), -np.sin(spin), 0], [np.sin(spin), np.cos(spin), 0], [0, 0, 1]]
    about_x = [[1, 0, 0], [0, np.cos(tilt), -np.sin(tilt)], [0, np.sin(tilt), np.cos(tilt)]]
    return np.array(about_x) @ np.array(about_z)


def seen(rng: np.random.Generator, kind: str) -> Body:
    """A random body of a kind from a random direction, on whole numbers."""
    body = KINDS[kind](rng)
    turned = body.vertices @ random_view(rng, MOST_TILTED.get(kind)).T
    return Body(np.rint(turned * (GRID / np.abs(turned).max())).astype(np.int64), body.faces)


# ---- patches ---------------------------------------------------------------------------------------------------------


def patches(seed: int, kinds: tuple[str, ...] = tuple(KINDS), least: int = 8) -> Iterator[Patch]:
    """The patches of one body after the other, for ever; the same for the same seed."""
    rng = np.random.default_rng(seed)
    while True:
        yield from patches_of_body(rng, kinds, least)


def patches_of_body(rng: np.random.Generator, kinds: tuple[str, ...] = tuple(KINDS), least: int = 8) -> Iterator[Patch]:
    """The patches of a random body that have at least so many triangles.

    Left out are those whose boundary passes a vertex twice, and those that wind round an inner vertex twice: seldom,
    where a coarse body cuts itself.
    """
    kind = kinds[int(rng.integers(len(kinds)))]
    body = seen(rng, kind)
    for faces in fronts(body):
        if len(faces) >= least and (found := patch(kind, body.vertices, faces)):
            yield found


def fronts(body: Body) -> list[np.ndarray]:
    """The triangles that face the viewer, by connected components."""
    a, b, c = body.vertices[body.faces, :2].swapaxes(0, 1)
    faces = body.faces[turn(a, b, c) > 0]
    start, end, face = sides_of(faces)
    first, second = joined_sides(start, end)
    graph = coo_array((np.ones(len(first)), (face[first], face[second])), shape=(len(faces), len(faces)))
    component = connected_components(graph, directed=False)[1]
    return [faces[component == number] for number in range(component.max(initial=-1) + 1)]


def turn(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
    """Twice the area of triangles in the plane."""
    return (b[..., 0] - a[..., 0]) * (c[..., 1] - a[..., 1]) - (b[..., 1] - a[..., 1]) * (c[..., 0] - a[..., 0])


def sides_of(faces: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Where the sides of triangles start and end, and their triangles."""
    return faces.ravel(), np.roll(faces, -1, axis=1).ravel(), np.repeat(np.arange(len(faces)), 3)


def joined_sides(start: np.ndarray, end: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Pairs of sides that run along the same edge."""
    count = 1 + max(start.max(initial=0), end.max(initial=0))
    there, back = start * count + end, end * count + start
    order = np.argsort(there)
    at = np.minimum(np.searchsorted(there, back, sorter=order), len(there) - 1)
    found = there[order[at]] == back
    return np.flatnonzero(found), order[at[found]]


def boundary_sides(start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """The sides with no other triangle along them."""
    return np.setdiff1d(np.arange(len(start)), joined_sides(start, end)[0])


def patch(kind: str, vertices: np.ndarray, faces: np.ndarray) -> Patch | None:
    """The patch of these triangles, its vertices numbered anew; None if it is to be left out."""
    used, numbers = np.unique(faces, return_inverse=True)
    faces, vertices = numbers.reshape(-1, 3), vertices[used]
    start, end, _ = sides_of(faces)
    alone = boundary_sides(start, end)
    if len(np.unique(start[alone])) < len(alone):
        return None
    loops = loops_along(dict(zip(start[alone].tolist(), end[alone].tolist(), strict=True)))
    passages = passages_by_vertex(vertices, faces)
    if (np.delete(passages, start[alone]) > 1).any():
        return None
    cusps = tuple(passages[loop] - plain_passages(vertices, loop) for loop in loops)
    edges = (len(start) + len(alone)) // 2
    return Patch(kind, vertices, faces, loops, cusps, len(used) - edges + len(faces), cuts_itself(vertices, faces))


def loops_along(following: dict[int, int]) -> tuple[np.ndarray, ...]:
    """The cycles of a permutation."""
    loops = []
    while following:
        loop = [min(following)]
        while (vertex := following.pop(loop[-1])) != loop[0]:
            loop.append(vertex)
        loops.append(np.array(loop))
    return tuple(loops)


def is_up(step: np.ndarray) -> np.ndarray:
    """Whether directions have an angle in [0, π)."""
    return (step[..., 1] > 0) | ((step[..., 1] == 0) & (step[..., 0] > 0))


def passages_by_vertex(vertices: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """How often the triangles at each vertex, one after the other counter-clockwise, arrive at or pass the east."""
    corner = vertices[faces, :2]
    from_up = is_up(np.roll(corner, -1, axis=1) - corner)
    to_up = is_up(np.roll(corner, 1, axis=1) - corner)
    return np.bincount(faces[~from_up & to_up], minlength=len(vertices))


def plain_passages(vertices: np.ndarray, loop: np.ndarray) -> np.ndarray:
    """The same for the angle that one sees at each vertex of a loop, from its way out to its way in; at most a turn."""
    here = vertices[loop, :2]
    out, back = np.roll(here, -1, axis=0) - here, np.roll(here, 1, axis=0) - here
    to_left = out[:, 0] * back[:, 1] - out[:, 1] * back[:, 0] > 0
    return np.where(is_up(out) == is_up(back), ~to_left, is_up(back)).astype(int)


# ---- in space --------------------------------------------------------------------------------------------------------


def volume(a: np.ndarray, b: np.ndarray, c: np.ndarray, d: np.ndarray) -> np.ndarray:
    """Six times the volume of tetrahedra: its sign tells on which side of a, b, c the point d lies."""
    return (np.cross(b - a, c - a) * (d - a)).sum(axis=-1)


def boxes(vertices: np.ndarray, groups: np.ndarray) -> np.ndarray:
    """The boxes in the plane of groups of vertices."""
    low, high = vertices[groups, :2].min(axis=1), vertices[groups, :2].max(axis=1)
    return shapely.box(*low.T, *high.T)


def cuts_itself(vertices: np.ndarray, faces: np.ndarray) -> bool:
    """Whether an edge of the mesh meets a triangle that has neither of its ends."""
    start, end, _ = sides_of(faces)
    edges = np.unique(np.sort(np.stack([start, end], axis=1), axis=1), axis=0)
    edge, face = shapely.STRtree(boxes(vertices, faces)).query(boxes(vertices, edges))
    z, z_face = vertices[edges[edge], 2], vertices[faces[face], 2]
    near = (z.min(axis=1) <= z_face.max(axis=1)) & (z.max(axis=1) >= z_face.min(axis=1))
    near &= (edges[edge][:, :, None] != faces[face][:, None, :]).all(axis=(1, 2))
    p, q = vertices[edges[edge[near]]].swapaxes(0, 1)
    a, b, c = vertices[faces[face[near]]].swapaxes(0, 1)
    sides = np.sign([volume(p, q, a, b), volume(p, q, b, c), volume(p, q, c, a)])
    through = np.sign(volume(a, b, c, p)) * np.sign(volume(a, b, c, q)) <= 0
    return bool((through & (sides.min(axis=0) * sides.max(axis=0) >= 0)).any())


def levels_beside(found: Patch, edge: np.ndarray, place: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """At places on edges of the outline: the level of the surface that ends there, and the winding number on its left.

    Edges are numbered loop after loop; places must lie well inside them and apart from other edges. The levels count
    the triangles of the patch that lie below, by their depths there.
    """
    a = np.concatenate(found.loops)[edge]
    b = np.concatenate([np.roll(loop, -1) for loop in found.loops])[edge]
    axis = np.abs(found.vertices[b, :2] - found.vertices[a, :2]).argmax(axis=1)
    rows = np.arange(len(edge))
    along = (place[rows, axis] - found.vertices[a, axis]) / (found.vertices[b, axis] - found.vertices[a, axis])
    depth = found.vertices[a, 2] + along * (found.vertices[b, 2] - found.vertices[a, 2])
    at, face = shapely.STRtree(boxes(found.vertices, found.faces)).query(shapely.points(place))
    corners = found.faces[face]
    own = (corners == a[at, None]).any(axis=1) & (corners == b[at, None]).any(axis=1)
    keep = ~own & covers(found.vertices, corners, place[at])
    at, corners = at[keep], corners[keep]
    below = depth_of(found.vertices[corners], place[at]) < depth[at]
    return 1 + np.bincount(at[below], minlength=len(edge)), 1 + np.bincount(at, minlength=len(edge))


def covers(vertices: np.ndarray, corners: np.ndarray, place: np.ndarray) -> np.ndarray:
    """Whether triangles cover places; of two at an edge, one covers what lies on it."""
    inside = np.ones(len(corners), dtype=bool)
    for i in range(3):
        first, second = corners[:, i], corners[:, (i + 1) % 3]
        low, high = np.minimum(first, second), np.maximum(first, second)
        inside &= (turn(vertices[low], vertices[high], place) >= 0) == (first < second)
    return inside


def depth_of(corner: np.ndarray, place: np.ndarray) -> np.ndarray:
    """The depths of triangles over places."""
    a, b, c = corner.swapaxes(0, 1)
    shares = np.stack([turn(b, c, place), turn(c, a, place), turn(a, b, place)])
    return (shares * np.stack([a, b, c])[..., 2]).sum(axis=0) / shares.sum(axis=0)
