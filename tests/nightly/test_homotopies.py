"""A slice of the nightly check of least homotopies."""

import numpy as np
import pytest

from nightly import homotopies

FIRST_SEED = 10_000_000
"""Far from the seeds of the nightly run."""


@pytest.mark.parametrize("seed", range(FIRST_SEED, FIRST_SEED + 12))
def test_a_slice_of_curves(seed):
    homotopies.judge(homotopies.random_curve(np.random.default_rng(seed)))


def test_failures_are_counted(monkeypatch, capsys):
    monkeypatch.setattr(homotopies, "judge", lambda points: points[10**6])
    monkeypatch.setattr("sys.argv", ["homotopies", "--curves", "3"])
    assert homotopies.main() == 1
    assert "3 failed" in capsys.readouterr().out
