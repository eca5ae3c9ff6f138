"""Fronts of bodies, with cusps, holes and handles: 300 of those that the nightly check judges by the thousand."""

from itertools import islice

import numpy as np
import pytest

from bodies import KINDS, patches
from nightly import outlines as nightly
from nightly import patches as judge
from nightly.outlines import judge_outline, random_outline
from nightly.patches import judge_patch

FIRST_SEED = 40_000_000
"""Far from the seeds of the nightly run."""


@pytest.mark.parametrize("kind", KINDS)
def test_fronts_of_bodies(kind):
    """Each has its surface; some are lifted."""
    fronts = enumerate(islice(patches(FIRST_SEED, (kind,)), 75))
    assert sum(judge_patch(patch, lift=number % 25 == 1) for number, patch in fronts) >= 73


def test_random_outlines_have_all_verdicts():
    """No surface, one, several; some have cusps."""
    rng, verdicts, cusped = np.random.default_rng(FIRST_SEED), set(), 0
    for _ in range(60):
        loops, cusps = random_outline(rng)
        count = judge_outline(loops, cusps)
        if count is not None:
            verdicts.add(min(count, 2))
            cusped += any(index.any() for index in cusps)
    assert verdicts == {0, 1, 2}
    assert cusped > 1


def test_a_wrong_answer_is_found(monkeypatch, capsys):
    assert nightly.main(["--outlines", "10", "--first", str(FIRST_SEED)]) == 0
    right = judge.depth_levels
    monkeypatch.setattr(judge, "depth_levels", lambda patch, arranged: right(patch, arranged)[::-1])
    assert nightly.main(["--outlines", "30", "--first", str(FIRST_SEED)]) == 1
    assert f"seed {FIRST_SEED + 4}" in capsys.readouterr().out
