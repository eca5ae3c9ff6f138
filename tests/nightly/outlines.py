"""Fronts of bodies, and random outlines with cusps: ``python -m nightly.outlines`` (in tests/).

Fronts bound a surface that is known, see `nightly.patches`. Of small outlines all immersions and all embeddings are
compared with the references.
"""

import argparse
import math
import sys
import time
import traceback
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial

import numpy as np

import plyfold as pf
from bodies import patches_of_body
from codes import code_of
from nightly.lists import nested, through_the_frame
from nightly.patches import judge_patch
from plyfold.errors import CurveError, GeneralPositionError
from plyfold.layering.levels.equations import level_equations
from reference.crossings import DegenerateError, turning_number
from reference.outline_gluings import key_of, pieces, surfaces
from reference.outline_levels import layerings, level_solutions
from reference.outlines import OutlineCode
from reference.random_curves import FRAME, Polygon, small_loops, without_repeats

MOST_SHEETS = 4
"""Sheets over a cell up to which the references try all gluings."""

MOST_BORDERS = 24
"""Borders up to which they try all orders of sheets."""

LIFTED = 10
"""Of the fronts of every so many bodies those with a small outline are lifted."""

DRAWN = 4
"""For every so many bodies there is a random outline."""

Cusps = list[np.ndarray]


# ---- random outlines -------------------------------------------------------------------------------------------------


def on_a_frame(rng: np.random.Generator) -> list[Polygon]:
    """Up to three loops of few edges in a frame, some of which lie apart or inside others."""
    loops = [FRAME, *small_loops(rng, 7)]
    return [loops[i] for i in rng.permutation(len(loops))]


def random_outline(rng: np.random.Generator) -> tuple[list[Polygon], Cusps]:
    """A few loops, half of the time with cusps."""
    draw = (on_a_frame, nested, through_the_frame)[int(rng.integers(3))]
    loops = [without_repeats(loop) for loop in draw(rng)]
    cusps = [np.zeros(len(loop), dtype=np.int64) for loop in loops]
    for _ in range(turns_too_many(loops) if rng.random() < 0.5 else 0):
        index = cusps[int(rng.integers(len(loops)))]
        index[int(rng.integers(len(index)))] += 1
    return loops, cusps


def turns_too_many(loops: list[Polygon]) -> int:
    """By how much loops turn more often than the outlines of as many disks, or perhaps of disks with handles."""
    with suppress(DegenerateError):
        more = sum(map(turning_number, loops)) - len(loops)
        return more if more > 0 else more % 2
    return 0


def judge_outline(loops: list[Polygon], cusps: Cusps) -> int | None:
    """Everything that must hold for an outline; the number of its immersions, None if the references do not tell."""
    try:
        arranged = pf.arrange(pf.Outline(loops, cusps), general_position="raise")
    except (CurveError, GeneralPositionError):
        return None
    if arranged.winding.min() < 0:
        assert not pf.find_immersion(arranged)
        assert pf.count_immersions(arranged) == pf.count_embeddings(arranged) == 0
        return 0
    if arranged.winding.max() > MOST_SHEETS:
        return None
    judge_embeddings(arranged)
    return judge_immersions(arranged)


def judge_immersions(arranged: pf.Arrangement) -> int:
    """Immersions found, counted and listed are those of the reference; return their number."""
    code = code_of(arranged)
    expected = {key_of(code, *surface) for surface in surfaces(code)}
    listed = list(pf.immersions(arranged))
    for immersion in listed:
        immersion.check()
        judge_pieces(code, immersion)
    keys = [key_of(code, immersion.own_sheet, immersion.gluing) for immersion in listed]
    assert len(keys) == len(set(keys)) == pf.count_immersions(arranged)
    assert set(keys) == expected
    found = pf.find_immersion(arranged)
    assert bool(found) == bool(expected)
    if found:
        assert key_of(code, found.own_sheet, found.gluing) in expected
    else:
        assert found.reason
        assert found.sentence
    in_one_piece = any(len(immersion.pieces) == 1 for immersion in listed)
    assert bool(pf.find_immersion(arranged, connected=True)) == in_one_piece
    return len(expected)


def judge_pieces(code: OutlineCode, immersion: pf.Immersion) -> None:
    """The pieces of an immersion are those of its gluing."""
    parts = pieces(code, immersion.own_sheet.tolist(), immersion.gluing.tolist())
    assert [(piece.loops, piece.euler_characteristic) for piece in immersion.pieces] == parts
    assert immersion.euler_characteristic == sum(euler for _, euler in parts)
    assert immersion.genus == sum((2 - len(loops) - euler) // 2 for loops, euler in parts)


def judge_embeddings(arranged: pf.Arrangement) -> int:
    """Embeddings found, counted and listed have the levels of the reference; return their number."""
    code = code_of(arranged)
    expected = set(level_solutions(code))
    judge_equations(arranged, expected)
    listed = list(pf.embeddings(arranged))
    levels = [tuple(surface.border_level.tolist()) for surface in listed]
    assert len(levels) == len(set(levels)) == pf.count_embeddings(arranged)
    assert set(levels) == expected
    found = pf.find_embedding(arranged)
    assert bool(found) == bool(expected)
    assert not found or tuple(found.border_level.tolist()) in expected
    if arranged.n_borders <= MOST_BORDERS:
        judge_layerings(code, listed)
    return len(expected)


def judge_equations(arranged: pf.Arrangement, expected: set[tuple[int, ...]]) -> None:
    """The equations hold for the right levels, and for none of some others."""
    equations, highest = level_equations(arranged), arranged.winding[arranged.left_cell]
    assert all(equations.hold(np.array(level)) for level in expected)
    rng = np.random.default_rng(1)
    for level in (rng.integers(1, highest + 1) for _ in range(20)):
        assert equations.hold(level) == (tuple(level.tolist()) in expected)


def judge_layerings(code: OutlineCode, listed: list[pf.Layering]) -> None:
    """Over each immersion that has any, the embeddings are all its layerings."""
    over: dict[object, list[pf.Layering]] = {}
    for surface in listed:
        over.setdefault(key_of(code, surface.immersion.own_sheet, surface.immersion.gluing), []).append(surface)
    for alike in over.values():
        immersion = alike[0].immersion
        levels = {tuple(surface.border_level.tolist()) for surface in alike}
        assert levels == set(layerings(code, immersion.own_sheet.tolist(), immersion.gluing.tolist()))
        assert pf.count_layerings(immersion) == len(levels)


# ---- many of them ----------------------------------------------------------------------------------------------------


def tasks(seed: int) -> Iterator[Callable[[], object]]:
    """What is judged for a seed: the fronts of a body, and now and then an outline."""
    for patch in patches_of_body(np.random.default_rng(seed)):
        yield partial(judge_patch, patch, lift=seed % LIFTED == 0)
    if seed % DRAWN == 0:
        yield partial(judge_outline, *random_outline(np.random.default_rng(seed)))


def judged(first_seed: int, count: int, seconds: float) -> Iterator[tuple[int, str | None]]:
    """The seeds of so many outlines, and what is wrong with the answers about them."""
    end, done, seed = time.monotonic() + seconds, 0, first_seed
    while done < count and time.monotonic() < end:
        for task in tasks(seed):
            problem = None
            try:
                task()
            except Exception:  # an error of any kind is a finding
                problem = traceback.format_exc()
            yield seed, problem
            done += 1
        seed += 1


def main(words: list[str] | None = None) -> int:
    """Return 0 if all is well, 1 if anything failed."""
    parser = argparse.ArgumentParser(prog="nightly.outlines", description=__doc__)
    parser.add_argument("--outlines", type=int, default=13_000)
    parser.add_argument("--seconds", type=float, default=math.inf, help="stop after so long; default: never")
    parser.add_argument("--first", type=int, default=0, metavar="SEED", help="the first seed; default 0")
    options = parser.parse_args(words)
    done, failed, seed = 0, 0, options.first - 1
    for seed, problem in judged(options.first, options.outlines, options.seconds):
        done, failed = done + 1, failed + (problem is not None)
        if problem:
            print(f"\nseed {seed}:\n{problem}")
    print(f"{done:,} outlines judged, {failed} failed; go on with --first {seed + 1}")
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
