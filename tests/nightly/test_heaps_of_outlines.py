"""A slice of the nightly check of outlines by the hundred thousand."""

import numpy as np
import pytest

import plyfold as pf
from nightly import heaps_of_outlines
from nightly.heaps_of_outlines import drawn, faults, main

ANOTHER_SEED = 10_000_000
"""Far from that of the nightly run."""


def test_a_slice():
    outlines = drawn(150, ANOTHER_SEED)
    assert not list(faults(outlines, pf.verdicts(outlines), every=3))


def test_faults_are_told(monkeypatch, capsys):
    monkeypatch.setattr(heaps_of_outlines, "drawn", lambda *_: [*drawn(30, ANOTHER_SEED), [(0, 0), (1, 1)]])
    monkeypatch.setattr("sys.argv", ["heaps", "--outlines", "30"])
    assert main() == 1
    assert "31 outlines, 1 wrong" in capsys.readouterr().out


@pytest.mark.parametrize(
    "wrong", [{"verdict": ["none"]}, {"crossings": [1]}, {"verdict": [None]}, {"error": ["no outline"]}]
)
def test_wrong_verdicts_are_seen(wrong):
    triangle = [[(0, 0), (1, 0), (0, 1)]]
    right = pf.verdicts(triangle).to_numpy()
    assert not list(faults(triangle, pf.DataTable(right)))
    assert list(faults(triangle, pf.DataTable(right | {name: np.array(row) for name, row in wrong.items()})))


def test_single_calls_are_compared():
    eight = [[(0, 0), (2, 2), (2, 0), (0, 2)]]
    table = pf.verdicts(eight).to_numpy() | {"verdict": np.array(["disk"])}
    assert list(faults(eight, pf.DataTable(table)))
