"""``python -m nightly.solids`` (in tests/): random outlines made into solids, and everything that must hold for them.

Ribbons, disks with thin cells and sharp corners, loops that cross, fronts of bodies with cusps, holes and handles, and
loops on a small grid, which touch themselves. A solid that fails is printed with its seed.
"""

import argparse
import sys
import traceback
from collections.abc import Iterator

import numpy as np

import plyfold as pf
from bodies import patches
from plyfold.errors import CurveError, InputError, PlyfoldError
from plyfold.surface.left import may_touch
from plyfold.surface.thicken import Solid
from reference import random_curves
from reference.triangles import meeting_pairs

KINDS = ("ribbon", "glued disk", "loops", "front", "touching")
PROFILES = ("round", "flat", np.square)
FEW = 400
"""Triangles of a solid up to which all pairs of them are tested for meeting, in fractions."""


def outlines(rng: np.random.Generator, kind: str) -> Iterator[object]:
    """Yield random outlines of a kind without end, some of which bound no layered surface."""
    while True:
        if kind == "ribbon":
            yield random_curves.ribbon_outline(rng, int(rng.integers(5, 40)))
        elif kind == "glued disk":
            yield random_curves.glued_disk(rng, int(rng.integers(3, 20)))
        elif kind == "loops":
            yield random_curves.small_loops(rng, 3)
        elif kind == "front":
            yield from (pf.Outline(patch.outline, patch.cusps) for patch in patches(int(rng.integers(2**32))))
        else:
            yield [rng.integers(0, 5, (int(rng.integers(3, 8)), 2)).tolist() for _ in range(int(rng.integers(1, 3)))]


def layered(seed: int) -> pf.Layering:
    """Return the layering of the first liftable outline of a seed."""
    rng = np.random.default_rng(seed)
    for outline in outlines(rng, KINDS[seed % len(KINDS)]):
        try:
            found = pf.find_embedding(outline, time_limit=10)
        except CurveError:
            continue
        if isinstance(found, pf.Layering):
            return found
    raise AssertionError("outlines do not end")


def judge_solids(seed: int) -> pf.Surface | None:
    """Everything that must hold for the body and the slab of a seed; None where the outline has no width."""
    rng = np.random.default_rng([seed, 1])
    try:
        surface = pf.lift(layered(seed), triangles=int(rng.choice([1, 60, 300])))
    except InputError as error:
        if "no width" in str(error):
            return None
        raise
    height = None if rng.random() < 0.5 else float(rng.uniform(0.1, 5)) * surface.gap
    judge_body(surface.inflate(height, PROFILES[seed % len(PROFILES)]), height)
    slab = surface.thicken(0.6 * surface.gap)
    slab.check()
    return surface


def judge_body(body: Solid, height: float | None) -> None:
    """It does not meet itself, has its outline and its height, and keeps the gap to itself."""
    body.check()
    surface = body.surface
    surface.check()
    assert height is None or body.height <= height * (1 + 1e-12)
    assert body.tips.tolist() == surface.boundary.tolist()
    assert_gap(body)
    if len(body.faces) <= FEW and not may_touch(surface):
        assert not meeting_pairs(body.vertices, body.faces)


def assert_gap(body: Solid) -> None:
    """Over every vertex of the drawing, surfaces are half of both thicknesses and the gap apart."""
    x, y, z = body.surface.vertices.T
    order = np.lexsort((z, y, x))
    lower, upper = order[:-1], order[1:]
    over = (x[lower] == x[upper]) & (y[lower] == y[upper])
    free = z[upper] - z[lower] - (body.thickness[lower] + body.thickness[upper]) / 2
    near = over & (free < body.surface.gap * (1 - 1e-9) - 1e-12 * np.abs(z).max())
    touching = np.isin(lower, body.surface.boundary) & np.isin(upper, body.surface.boundary)
    assert not (near & ~touching).any()


def main(words: list[str] | None = None) -> int:
    """Return 0 if all is well, 1 if anything failed."""
    parser = argparse.ArgumentParser(prog="nightly.solids", description=__doc__)
    parser.add_argument("--solids", type=int, default=1000)
    parser.add_argument("--first", type=int, default=0, metavar="SEED")
    options = parser.parse_args(words)
    failed, refused = 0, 0
    for seed in range(options.first, options.first + options.solids):
        try:
            refused += judge_solids(seed) is None
        except PlyfoldError as error:
            print(f"seed {seed}, {KINDS[seed % len(KINDS)]}: {type(error).__name__}: {error}", flush=True)
            failed += 1
        except AssertionError:
            print(f"seed {seed}, {KINDS[seed % len(KINDS)]}:\n{traceback.format_exc(limit=-3)}", flush=True)
            failed += 1
    print(f"{options.solids} outlines, {refused} without width, {failed} failed")
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
