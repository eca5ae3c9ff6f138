"""A slice of the nightly check, and the machinery around it."""

import json
import time
from collections import Counter
from contextlib import suppress
from itertools import count, islice

import numpy as np
import pytest

import plyfold as pf
from nightly import __main__ as nightly
from nightly.curves import KINDS, LISTS, MIX, draw
from nightly.judge import judge
from nightly.lists import judge_list
from nightly.meshes import drawn_anywhere, judge_certificate

FIRST_SEED = 10_000_000
"""Far from the seeds of the nightly run."""


def test_two_seconds_of_random_curves():
    end = time.monotonic() + 2
    for seed in count(FIRST_SEED):
        judge(draw(seed))
        if time.monotonic() > end and seed >= FIRST_SEED + len(MIX):
            break


def test_spoiled_certificates_at_every_scale():
    """Right and wrong ones are both among them."""
    answers = Counter()
    for seed in range(60):
        rng = np.random.default_rng(seed)
        answers[judge_certificate(drawn_anywhere(rng), rng)] += 1
    assert answers[True] >= 5
    assert answers[False] >= 5


def test_every_kind_comes_up_and_seeds_repeat():
    drawn = [draw(seed) for seed in range(len(MIX))]
    assert {curve.kind for curve in drawn} == set(KINDS) | set(LISTS)
    assert drawn == [draw(seed) for seed in range(len(MIX))]


def test_kinds_have_all_verdicts():
    """No disk, one immersion, and several are all among the first curves."""
    counts = Counter()
    for drawn in map(draw, range(20 * len(MIX))):
        if drawn.kind in KINDS:
            counts[min(2, pf.count_immersions(drawn.points))] += 1
        if all(counts[number] >= 3 for number in (0, 1, 2)):
            return
    pytest.fail(f"seldom some verdict: {counts}")


@pytest.mark.parametrize("wrong", ["count_immersions", "find_immersion"])
def test_a_wrong_answer_is_found_saved_and_replayed(wrong, tmp_path, monkeypatch, capsys):
    options = ["--curves", str(len(MIX)), "--processes", "1", "--out", str(tmp_path)]
    assert nightly.main(options) == 0
    right = getattr(pf, wrong)
    monkeypatch.setattr(pf, wrong, lambda curve: not right(curve))
    assert nightly.main(options) == 1
    file = sorted(tmp_path.iterdir())[0]
    assert str(file) in capsys.readouterr().out
    saved = json.loads(file.read_text())
    assert draw(saved["seed"]).points == [tuple(point) for point in saved["points"]]
    assert nightly.main(["--replay", str(file)]) == 1
    monkeypatch.undo()
    assert nightly.main(["--replay", str(file)]) == 0


def test_seeds_go_on_where_they_stopped(capsys):
    assert nightly.main(["--curves", "7", "--first", "93", "--processes", "1"]) == 0
    assert "go on with --first 100" in capsys.readouterr().out


def test_a_list_of_loops_that_misses_a_surface_is_found_and_replayed(tmp_path, monkeypatch):
    seed = next(seed for seed in range(len(MIX)) if MIX[seed] in LISTS and pf.count_embeddings(draw(seed).points) > 1)
    options = ["--curves", "1", "--first", str(seed), "--processes", "1", "--out", str(tmp_path)]
    assert nightly.main(options) == 0
    listed = pf.embeddings
    monkeypatch.setattr(pf, "embeddings", lambda loops: list(listed(loops))[1:])
    assert nightly.main(options) == 1
    (file,) = tmp_path.iterdir()
    assert nightly.main(["--replay", str(file)]) == 1
    monkeypatch.undo()
    assert nightly.main(["--replay", str(file)]) == 0


@pytest.mark.parametrize("kind", LISTS)
def test_some_lists_of_loops(kind):
    rng = np.random.default_rng(5)
    for _ in range(15):
        judge_list(LISTS[kind](rng))


def test_lists_have_all_verdicts():
    """No surface, one, several; and casings of one and of several surfaces: all are among the first lists."""
    rng, verdicts = np.random.default_rng(5), Counter()
    for loops in (draw_list(rng) for _ in range(60) for draw_list in LISTS.values()):
        with suppress(pf.errors.GeneralPositionError):
            verdicts[min(2, pf.count_embeddings(loops))] += 1
            verdicts.update(fate(loops, surface.casing) for surface in islice(pf.embeddings(loops), 2))
    assert all(verdicts[verdict] >= 3 for verdict in (0, 1, 2, "refused", "given back")), verdicts


def fate(loops, casing):
    """What becomes of the casing of a surface."""
    try:
        return "given back" if pf.embed_cased(loops, casing) else "lost"
    except pf.errors.InputError:
        return "refused"
