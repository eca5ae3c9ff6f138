"""Random outlines on small grids, which touch themselves: ``python -m nightly.contacts`` (in tests/).

Whether they bound disks, strictly or as limits, and how many: compared with gluings in fractions, in all positions of
the page. An outline that fails is printed.
"""

import argparse
import sys
import traceback
from collections.abc import Sequence

import numpy as np
import pytest

import plyfold as pf
from plyfold.certify import check_limit, check_pieces
from plyfold.errors import CurveError
from plyfold.mesh.cells import triangulate_cells
from plyfold.mesh.sheets import glue_copies
from plyfold.ragged import next_in_rows
from reference.contacts import (
    Answer,
    answer,
    count_moved,
    exact,
    minus,
    moves_that_bound,
    positions,
    random_touching,
    starts,
    without_spikes,
)

Points = Sequence[Sequence[float]]


def judge(polygon: Points, rng: np.random.Generator, places: int = 8, tries: int = 0) -> Answer | None:
    """Compare the answers in so many positions of the page with the reference; each time from another start.

    So many moves are tried besides; where one of them makes a disk, the answer must be yes.
    """
    expected = answer(polygon)
    for placed in rng.permutation(list(positions(polygon)))[:places].tolist():
        changed = list(starts(placed))
        judge_as_placed(changed[int(rng.integers(len(changed)))], expected)
    if expected and expected.outward:
        judge_move(polygon, expected.outward)
        certified(pf.Outline([polygon]))
    elif expected:
        assert not any(moves_that_bound(rng, [without_spikes(exact(polygon))], tries))
    return expected


def judge_as_placed(polygon: Points, expected: Answer | None) -> None:
    """Compare the three answers and the count."""
    if expected is None:
        with pytest.raises(CurveError):
            pf.arrange(polygon)
        return
    arranged = pf.arrange(polygon)
    assert pf.bounds_disk(arranged) == (expected.outward > 0)
    assert pf.bounds_disk(polygon, touching=False) == (expected.strict > 0)
    if expected.outward or abs(arranged.turning_number) == 1:
        assert pf.count_immersions(arranged) == expected.outward
        assert without_touches(arranged) == expected.strict


def without_touches(arranged: pf.Arrangement) -> int:
    """The number of immersions that touch themselves nowhere."""
    return sum(not immersion.touches for immersion in pf.immersions(arranged))


def judge_move(polygon: Points, count: int) -> None:
    """The move that is handed over makes as many disks when it is infinitely small."""
    drawn = pf.arrange(polygon)
    (given,), (goal,) = ([exact(loop) for loop in outline.loops] for outline in (drawn.given, drawn.outline))
    move = [minus(there, here) for here, there in zip(given, goal, strict=True)]
    assert count_moved([given], [move]) == count


def certified(outline: pf.Outline) -> bool:
    """Whether an outline bounds anything; if it does, the certificates must be right."""
    drawn = pf.arrange(outline)
    immersion = pf.find_immersion(drawn)
    if not immersion:
        return False
    loops, cusps = list(drawn.given.loops), list(drawn.given.cusps)
    check_limit(*pf.limit_of(immersion))
    faces, twins = pf.triangulate(outline, twins=True)
    check_pieces(loops, outline.points, faces, cusps, twins=twins)
    certify_sheets(immersion, loops, cusps)
    return True


def certify_sheets(immersion: pf.Immersion, loops: list[np.ndarray], cusps: list[np.ndarray]) -> None:
    """The flat mesh of the sheets is what the outline bounds; its boundary runs along pieces of the outline."""
    mesh = triangulate_cells(immersion.arrangement)
    if mesh.strips is None:  # nothing touches
        return
    sheets, first = glue_copies(immersion, mesh), mesh.strips.strands.first
    edge_of_border = np.searchsorted(first, np.arange(first[-1]), side="right") - 1
    pieces = zip(mesh.chain.tolist(), mesh.chain_end.tolist(), strict=True)
    edge = dict(zip(pieces, edge_of_border[mesh.chain_border].tolist(), strict=True))
    start = sheets.planar_vertex[sheets.boundary]
    end = start[next_in_rows(sheets.first_boundary)]
    along = [edge[ends] for ends in zip(start.tolist(), end.tolist(), strict=True)]
    check_pieces(loops, mesh.points[sheets.planar_vertex], sheets.faces, cusps, sheets.boundary, along)


def main() -> int:
    """Judge the outlines of many seeds."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--outlines", type=int, default=100_000, help="how many (default: %(default)s)")
    parser.add_argument("--first", type=int, default=0, help="the first seed (default: %(default)s)")
    options = parser.parse_args()
    failed = 0
    for seed in range(options.first, options.first + options.outlines):
        rng = np.random.default_rng(seed)
        polygon = random_touching(rng)
        try:
            judge(polygon, rng, places=2, tries=1)
        except Exception:  # an error of any kind is a finding
            failed += 1
            print(f"seed {seed}: {polygon}\n{traceback.format_exc()}", flush=True)
    print(f"{options.outlines:,} outlines that touch themselves, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
