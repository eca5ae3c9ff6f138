"""A slice of the nightly check of outlines that touch themselves."""

import numpy as np
import pytest

from nightly import contacts
from reference.contacts import random_touching

FIRST_SEED = 10_000_000
"""Far from the seeds of the nightly run."""


@pytest.mark.parametrize("seed", range(FIRST_SEED, FIRST_SEED + 12))
def test_a_slice_of_outlines(seed):
    rng = np.random.default_rng(seed)
    contacts.judge(random_touching(rng), rng, places=8, tries=10)


@pytest.mark.slow
@pytest.mark.parametrize("part", range(8))
def test_many_moves_in_all_positions(part):
    for seed in range(FIRST_SEED + 1_000 + part, FIRST_SEED + 2_000, 8):
        rng = np.random.default_rng(seed)
        contacts.judge(random_touching(rng, most=9 + seed % 4), rng, places=8, tries=100)


def test_failures_are_counted(monkeypatch, capsys):
    monkeypatch.setattr(contacts, "judge", lambda polygon, rng, places, tries: 1 / (rng.random() < 0.5))
    monkeypatch.setattr("sys.argv", ["contacts", "--outlines", "12"])
    assert contacts.main() == 1
    assert "ZeroDivisionError" in capsys.readouterr().out
