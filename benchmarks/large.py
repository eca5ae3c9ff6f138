"""Large drawings, before and after: ``python benchmarks/large.py --before ANOTHER_CHECKOUT``, some minutes.

Every row runs in a process of its own, in turn with the plyfold of this checkout and with that of another one, which
must be compiled too. Processor seconds without drawing and imports, the peak of memory, and a digest of the answer:
equal answers are equal to the last bit.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
ROWS = [
    ("bounds_disk", "ribbon", 100_000),
    ("bounds_disk", "dense-disk", 4_000),
    ("bounds_disk", "piled-disk", 4_000),
    ("find_immersion", "ribbon", 100_000),
    ("find_immersion", "dense-disk", 2_000),
    ("find_immersion", "dense-disk", 4_000),
    ("find_immersion", "dense-disk", 6_000),
    ("find_immersion", "dense-disk", 8_000),
    ("find_layering", "dense-disk", 2_000),
    ("count_layerings", "ribbon", 100_000),
]
# The program reads a function, a file with points and a limit of memory.
PROGRAM = """
import hashlib, json, resource, sys, time
import numpy as np, plyfold as pf
name, points, gibibytes = sys.argv[1], np.load(sys.argv[2]), int(sys.argv[3])
resource.setrlimit(resource.RLIMIT_AS, (gibibytes << 30, gibibytes << 30))
pf.find_layering(pf.find_immersion([(0, 0), (1, 0), (0, 1)]))
given = points if name in ("bounds_disk", "find_immersion") else pf.find_immersion(points)
start = time.process_time()
try:
    answer = getattr(pf, name)(given)
    said = str(answer)
except Exception as error:
    answer, said = None, type(error).__name__
seconds, peak = time.process_time() - start, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
parts = [getattr(answer, part, None) for part in ("own_sheet", "level")]
digest = hashlib.sha256(said.encode() + b"".join(part.tobytes() for part in parts if part is not None))
print(json.dumps({"seconds": seconds, "megabytes": peak, "said": said[:24], "digest": digest.hexdigest()}))
"""


def run(checkout: Path, row: tuple[str, str, int], points: Path, options: argparse.Namespace) -> dict[str, Any]:
    """Return what a row says in a checkout, or why it was stopped."""
    words = [sys.executable, "-c", PROGRAM, row[0], str(points), str(options.gibibytes)]
    environment = os.environ | {"PYTHONPATH": str(checkout / "src"), "PYTHONSAFEPATH": "1"}
    try:
        done = subprocess.run(
            words, capture_output=True, text=True, check=False, env=environment, timeout=options.seconds
        )
    except subprocess.TimeoutExpired:
        return {"said": f"stopped after {options.seconds:.0f} s"}
    return json.loads(done.stdout) if done.returncode == 0 else {"said": done.stderr.strip().splitlines()[-1][:60]}


def lines(options: argparse.Namespace) -> Iterator[str]:
    """Yield the table, line by line."""
    checkouts = [path.resolve() for path in (options.before, HERE.parent) if path]
    points = Path(options.folder, "points.npy")
    yield "| function | family | n | " + " | ".join(["s | MB | answer"] * len(checkouts)) + " | equal |"
    yield "|---|---|--:" + "|--:|--:|---" * len(checkouts) + "|---|"
    for row in ROWS:
        subprocess.run([sys.executable, str(HERE / "families.py"), row[1], str(row[2]), "0", str(points)], check=True)
        found = [run(checkout, row, points, options) for checkout in checkouts]
        cells = [f"{f.get('seconds', 0):.3g} | {f.get('megabytes', 0):.0f} | {f['said']}" for f in found]
        is_equal = len({f.get("digest", id(f)) for f in found}) == 1
        yield f"| {row[0]} | {row[1]} | {row[2]:,} | " + " | ".join(cells) + f" | {'yes' if is_equal else 'no'} |"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--before", type=Path, help="another checkout of plyfold, with its core compiled")
    parser.add_argument("--seconds", type=float, default=120, help="for each row (default: %(default)s)")
    parser.add_argument("--gibibytes", type=int, default=4, help="memory for each row (default: %(default)s)")
    parser.add_argument("--folder", default="/tmp", help="for the points (default: %(default)s)")
    for line in lines(parser.parse_args()):
        print(line, flush=True)


if __name__ == "__main__":
    main()
