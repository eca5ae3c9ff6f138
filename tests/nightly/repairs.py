"""Repairs of random outlines: ``python -m nightly.repairs`` (in tests/).

Outlines of pen strokes with loops at inner corners, polygons, lists of loops, and drawings on small grids, which touch.
Each repair must keep within its caps and leave everything else as it was, and must not depend on where loops begin and
which way they run. Small ones are compared with the search by definition, and with the slow reference of contacts. An
outline that fails is printed.
"""

import argparse
import sys
import traceback

import numpy as np

import plyfold as pf
from plyfold.errors import CurveError, GeneralPositionError
from reference.random_curves import random_polygon, small_loops
from repaired import agree, as_close, check_promises, is_disk_by_reference
from strokes import stroke

CAPS = [(0.01, 0.2), (0.01, 1.0), (0.1, 0.5), (0.5, 2.0)]
Loops = list[np.ndarray]


def random_outline(rng: np.random.Generator) -> Loops:
    """Mostly the outline of a stroke."""
    match int(rng.choice([0, 0, 0, 0, 1, 2, 3])):
        case 0:
            return [stroke(rng, int(rng.integers(2, 20)))]
        case 1:
            return [np.array(random_polygon(rng, int(rng.integers(4, 11))), dtype=float)]
        case 2:
            return [np.array(loop, dtype=float) for loop in small_loops(rng, 6)]
    return [rng.integers(0, 6, (int(rng.integers(4, 10)), 2)).astype(float)]


def judge(loops: Loops, caps: tuple[float, float]) -> None:
    """Raise an error if something is wrong with the repair of an outline."""
    outline = loops[0] if len(loops) == 1 else loops
    try:
        pf.arrange(outline)
    except (CurveError, GeneralPositionError):
        return
    found = pf.repair(outline, *caps)
    if found:
        check_promises(outline, found, caps)
        assert is_disk_by_reference(found.outline) in (True, None)
    if len(loops) == 1:
        as_close(pf.repair(np.roll(loops[0], 2, axis=0), *caps), found)
        as_close(pf.repair(loops[0][::-1], *caps), found)
        agree(outline, caps, 7)


def main() -> int:
    """Judge the outlines of many seeds."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--outlines", type=int, default=100_000, help="how many (default: %(default)s)")
    parser.add_argument("--first", type=int, default=0, help="the first seed (default: %(default)s)")
    options = parser.parse_args()
    failed = 0
    for seed in range(options.first, options.first + options.outlines):
        rng = np.random.default_rng(seed)
        loops, caps = random_outline(rng), CAPS[seed % len(CAPS)]
        try:
            judge(loops, caps)
        except Exception:  # an error of any kind is a finding
            failed += 1
            print(f"seed {seed}: {[loop.tolist() for loop in loops]}\n{traceback.format_exc()}", flush=True)
    print(f"{options.outlines:,} outlines repaired or refused, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
