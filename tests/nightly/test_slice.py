"""A slice of the nightly check, and the machinery around it."""

import json
import time
from collections import Counter
from itertools import count

import numpy as np
import pytest

import plyfold as pf
from nightly import __main__ as nightly
from nightly.curves import KINDS, MIX, draw
from nightly.judge import judge
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
    assert {curve.kind for curve in drawn} == set(KINDS)
    assert drawn == [draw(seed) for seed in range(len(MIX))]


def test_kinds_have_all_verdicts():
    """No disk, one immersion, and several are all among the first curves."""
    curves = [draw(seed).points for seed in range(4 * len(MIX))]
    counts = Counter(min(2, pf.count_immersions(points)) for points in curves)
    assert all(counts[number] >= 3 for number in (0, 1, 2)), counts


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
