"""A slice of the nightly check of repairs."""

import numpy as np
import pytest

from nightly import repairs

FIRST_SEED = 10_000_000
"""Far from the seeds of the nightly run."""


# Of seed 140 moves that are taken back had undone what others did: without them more would be changed than may be.
@pytest.mark.parametrize("seed", [66, 83, 140, 153, 193, 228, *range(FIRST_SEED, FIRST_SEED + 30)])
def test_a_slice_of_outlines(seed):
    loops = repairs.random_outline(np.random.default_rng(seed))
    repairs.judge(loops, repairs.CAPS[seed % len(repairs.CAPS)])


def test_outlines_have_one_loop_or_several():
    drawn = [repairs.random_outline(np.random.default_rng(seed)) for seed in range(60)]
    assert {len(loops) > 1 for loops in drawn} == {True, False}


def test_failures_are_counted(monkeypatch, capsys):
    monkeypatch.setattr(repairs, "judge", lambda loops, caps: 1 / (len(loops) - 1))
    monkeypatch.setattr("sys.argv", ["repairs", "--outlines", "9"])
    assert repairs.main() == 1
    assert "ZeroDivisionError" in capsys.readouterr().out
