"""Least homotopies of many random curves: ``python -m nightly.homotopies`` (in tests/).

Each is checked, compared with all ways to cut the curve where it has few crossings, and with that of the curve from
another start and in the other direction. A curve that fails is printed.
"""

import argparse
import math
import sys
import traceback

import numpy as np

import plyfold as pf
from plyfold.errors import CurveError
from reference.homotopies import least_area
from reference.planar_maps import cell_of_dart, gauss_code
from reference.random_curves import Polygon, random_polygon, smooth_curve

FEW_CROSSINGS = 6


def random_curve(rng: np.random.Generator) -> Polygon:
    """A polygon, a smooth curve, or points on a small grid, which touch."""
    kind = rng.integers(3)
    if kind == 0:
        return random_polygon(rng, int(rng.integers(3, 14)))
    if kind == 1:
        return smooth_curve(rng, int(rng.integers(2, 5)), 40)
    return random_polygon(rng, int(rng.integers(4, 10)), 4)


def judge(points: Polygon) -> None:
    """Raise an error if something is wrong with the least homotopy of a curve."""
    try:
        drawn = pf.arrange(points)
    except CurveError:  # spikes alone, or all on one line
        return
    found = pf.least_homotopy(drawn)
    found.check()
    assert found.optimal
    assert found.area >= found.winding_area
    arranged = found.arrangement
    if arranged.n_crossings <= FEW_CROSSINGS:
        code = gauss_code(*arranged.gauss_code())
        weights = dict(zip(cell_of_dart(code), found.weights[arranged.cell_of_dart], strict=True))
        expected = least_area(code, [weights[cell] for cell in sorted(weights)])
        assert math.isclose(found.area, expected, rel_tol=1e-9, abs_tol=1e-9), (found.area, expected)
    for same in (points[len(points) // 2 :] + points[: len(points) // 2], points[::-1]):
        # Points in contact have moved apart, elsewhere in another direction.
        same_area = 1e-3 if len(arranged.contacts) else 1e-9
        assert math.isclose(pf.least_homotopy(same).area, found.area, rel_tol=same_area)


def main() -> int:
    """Judge the curves of many seeds."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--curves", type=int, default=100_000, help="how many (default: %(default)s)")
    parser.add_argument("--first", type=int, default=0, help="the first seed (default: %(default)s)")
    options = parser.parse_args()
    failed = 0
    for seed in range(options.first, options.first + options.curves):
        points = random_curve(np.random.default_rng(seed))
        try:
            judge(points)
        except Exception:  # an error of any kind is a finding
            failed += 1
            print(f"seed {seed}: {points}\n{traceback.format_exc()}", flush=True)
    print(f"least homotopies of {options.curves:,} curves, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
