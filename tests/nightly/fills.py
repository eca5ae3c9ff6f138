"""Random drawings on small grids, which touch: ``python -m nightly.fills`` (in tests/).

Cells, fills and winding numbers are compared with slabs and rays in fractions. A drawing that fails is printed.
"""

import argparse
import sys
import traceback
from collections import Counter

import numpy as np

import plyfold as pf
from plyfold.errors import CurveError
from plyfold.flat.coverage import directed_coverage
from reference.fills import cells_by_slabs, winding_by_ray

Loops = list[np.ndarray]


def random_drawing(rng: np.random.Generator) -> Loops:
    """One to three loops on a grid; every fourth is scaled by what is no power of two, so that contacts break."""
    size, count = int(rng.integers(2, 7)), int(rng.choice([1, 1, 2, 3]))
    scale = float(rng.choice([1, 1, 1, 0.1]))
    return [rng.integers(0, size, (int(rng.integers(3, 13)), 2)) * scale for _ in range(count)]


def judge(loops: Loops) -> None:
    """Raise an error if something is wrong with the answers about a drawing."""
    try:
        outline = pf.Outline(loops)
    except CurveError:
        return
    expected = cells_by_slabs(outline.loops)
    cells, turned = directed_coverage(outline)
    left = Counter()
    for winding, size in expected:
        left[-winding if turned else winding] += float(size)
    for cell in cells:
        assert cell.polygon.is_valid
        left[cell.winding] -= cell.polygon.area
    assert max(map(abs, left.values()), default=0) < 1e-9, left
    on_grid = all((loop == np.rint(loop)).all() for loop in loops)
    assert not on_grid or len(cells) == len(expected)
    painted = pf.fill(outline)
    assert painted.is_valid
    assert abs(painted.area - float(sum(size for _, size in expected))) < 1e-9
    places = np.random.default_rng(0).integers(0, 13, (20, 2)) / 2
    rays = [winding_by_ray(outline.loops, *place) for place in places.tolist()]
    assert pf.winding_at(outline, places, on_outline="right").tolist() == rays


def main() -> int:
    """Judge the drawings of many seeds."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--drawings", type=int, default=100_000, help="how many (default: %(default)s)")
    parser.add_argument("--first", type=int, default=0, help="the first seed (default: %(default)s)")
    options = parser.parse_args()
    failed = 0
    for seed in range(options.first, options.first + options.drawings):
        loops = random_drawing(np.random.default_rng(seed))
        try:
            judge(loops)
        except Exception:  # an error of any kind is a finding
            failed += 1
            print(f"seed {seed}: {[loop.tolist() for loop in loops]}\n{traceback.format_exc()}", flush=True)
    print(f"{options.drawings:,} drawings that touch, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
