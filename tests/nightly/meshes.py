"""Certificates spoiled at every scale, and outlines with spikes as thin as rounding errors."""

import numpy as np

import plyfold as pf
from plyfold.certify import check_immersed_disk
from plyfold.errors import CertificateError
from reference.certificates import is_immersed_disk
from reference.random_curves import Polygon, glued_disk

FloatPolygon = list[tuple[float, float]]


def thin_spike(rng: np.random.Generator) -> Polygon:
    """A star-shaped polygon with one vertex drawn out to a spike: it goes back to one to three roundings beside."""
    n = int(rng.integers(4, 8))
    angle = 2 * np.pi * np.sort(rng.random(n))
    points = np.stack([np.cos(angle), np.sin(angle)], axis=1) * (0.5 + rng.random((n, 1)))
    points += rng.normal(size=2) * rng.choice([0, 1, 100])
    i = int(rng.integers(n))
    tip = points[i] + (rng.random(2) - 0.5) * rng.choice([0.3, 1.0, 3.0])
    beside = points[i].copy()
    axis, away = int(rng.integers(2)), (np.inf if rng.random() < 0.7 else -np.inf)
    for _ in range(int(rng.integers(1, 4))):
        beside[axis] = np.nextafter(beside[axis], away)
    scale = 2.0 ** int(rng.choice([0, 0, -60, 40]))
    return [(x, y) for x, y in (scale * np.insert(points, i + 1, [tip, beside], axis=0)).tolist()]


def judge_spike(points: Polygon, rng: np.random.Generator) -> str:
    """What is returned passes its own check, or an error names the place; return which it was."""
    triangles = int(rng.integers(10, 300))
    try:
        surface = pf.lift(points, triangles=triangles)
    except (pf.errors.NotImmersibleError, pf.errors.NotEmbeddableError):
        return "no surface"
    except pf.errors.PrecisionError as error:
        refused = error
    else:
        surface.check()
        pf.unwrap(points, triangles=triangles).check()
        return "lifted"
    assert refused.where, "no place is named"
    return "refused"


def drawn_anywhere(rng: np.random.Generator) -> Polygon:
    """A glued disk on integers, as doubles of any size, or where they are sparse, or with one point far away."""
    points = np.array(glued_disk(rng, int(rng.integers(3, 12)), 40), dtype=float)
    frame = rng.choice(["scaled", "sparse", "far"])
    if frame == "scaled":
        points *= 2.0 ** int(rng.choice([-1074, -1060, -600, -60, 0, 60, 400]))
    elif frame == "sparse":
        points += 2.0 ** int(rng.integers(44, 53))
    else:
        points[rng.integers(len(points))] *= 2.0 ** int(rng.integers(40, 70))
    return [(x, y) for x, y in points.tolist()]


def mesh_with_points_on_edges(
    points: Polygon, rng: np.random.Generator
) -> tuple[FloatPolygon, list[list[int]], list[int]]:
    """The curve's own triangles, some of them split by vertices beside the edges, a little or far."""
    faces = [list(face) for face in pf.triangulate(points).tolist()]
    places: list[tuple[float, float]] = list(points)
    loop = list(range(len(points)))
    for _ in range(int(rng.integers(1, 6))):
        at = int(rng.integers(len(loop)))
        a, b = loop[at], loop[(at + 1) % len(loop)]
        start, end = np.array(places[a]), np.array(places[b])
        off = rng.normal(size=2) * np.abs(end - start).max() * 2.0 ** -float(rng.integers(0, 70)) * rng.integers(0, 2)
        new = len(places)
        places.append(tuple((start + (end - start) * rng.random() + off).tolist()))
        face = next(face for face in faces if (a, b) in zip(face, face[1:] + face[:1], strict=True))
        i = face.index(a)
        faces.append([new, b, face[(i + 2) % 3]])
        face[(i + 1) % 3] = new
        loop.insert(at + 1, new)
    return places, faces, loop


def passes(points: Polygon, mesh: tuple[FloatPolygon, list[list[int]], list[int]]) -> bool:
    """Whether the checker lets a mesh pass."""
    try:
        check_immersed_disk(points, *mesh)
    except CertificateError:
        return False
    return True


def judge_certificate(points: Polygon, rng: np.random.Generator) -> bool | None:
    """The checker agrees with rational numbers; return what they say, or None for a curve that bounds no disk."""
    try:
        drawn = pf.arrange(points, general_position="raise")
    except pf.errors.PlyfoldError:
        return None
    if not pf.count_immersions(drawn):
        return None
    forward = [points[0], *points[:0:-1]] if drawn.reversed else points
    mesh = mesh_with_points_on_edges(forward, rng)
    right = is_immersed_disk(forward, *mesh)
    assert passes(forward, mesh) == right, f"the checker should {'pass' if right else 'refuse'} this: {mesh}"
    return right
