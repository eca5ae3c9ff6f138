"""Outlines by the hundred thousand, as people have them: ``python -m nightly.heaps_of_outlines`` (in tests/).

Contours of letters, outlines of strokes, and buildings with touching corners are asked for their verdicts all at once.
No error is expected. What GEOS takes for a valid polygon must be a disk or, with a court, a surface, and not cross
itself; and one in a hundred is compared with a single call. What is wrong is printed, and the exit code is 1 then.
"""

import argparse
import sys
import time
from collections.abc import Iterator
from itertools import chain
from typing import Any

import numpy as np
import shapely

import heaps
import plyfold as pf

KINDS = (heaps.glyphs, heaps.strokes, heaps.buildings)


def drawn(count: int, seed: int) -> list[Any]:
    """Return so many outlines, of each kind a third."""
    return list(chain.from_iterable(draw(count // 3, seed) for draw in KINDS))


def is_valid(outline: Any) -> bool:
    """Tell whether GEOS takes an outline for a valid polygon."""
    return bool(shapely.is_valid(outline if isinstance(outline, shapely.Geometry) else shapely.Polygon(outline)))


def faults(outlines: list[Any], table: pf.DataTable, every: int = 100) -> Iterator[str]:
    """Yield what is wrong with the verdicts on outlines."""
    for number, (outline, row) in enumerate(zip(outlines, table.rows(), strict=True)):
        where = f"outline {number}: {row}"
        if row["error"] is not None or row["verdict"] in (None, "unknown"):
            yield where
        elif is_valid(outline) and (row["verdict"] == "none" or row["crossings"]):
            yield f"{where}, and GEOS takes it for a valid polygon"
        elif number % every == 0 and row["verdict"].startswith("disk") != pf.bounds_disk(outline):
            yield f"{where}, and a single call says otherwise"


def main() -> int:
    """Judge what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--outlines", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    started = time.monotonic()
    outlines = drawn(options.outlines, options.seed)
    table = pf.verdicts(outlines)
    found = list(faults(outlines, table))
    print("\n".join(found[:20]))
    names, counts = np.unique(table["verdict"].astype(str), return_counts=True)
    print(dict(zip(names.tolist(), counts.tolist(), strict=True)))
    print(f"{len(outlines):,} outlines, {len(found)} wrong, {time.monotonic() - started:.0f} s")
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
