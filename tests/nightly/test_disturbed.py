"""A slice of the interrupts and threads, and faults that they find."""

import os

import pytest

import plyfold as pf
from nightly import disturbed

pytestmark = pytest.mark.skipif(os.name == "nt", reason="signals")

FIRST_SEED = 30_000_000


def test_answers_after_interrupts_and_among_threads(capsys):
    assert disturbed.main(["--rounds", "3", "--first", str(FIRST_SEED)]) == 0
    assert "3 drawings disturbed, 0 answered wrongly" in capsys.readouterr().out


def test_interrupts_happen():
    arranged = pf.arrange(pf.gallery.CURVES["exit-ramp"].curve)
    assert disturbed.is_broken_off(lambda: disturbed.answers(arranged), 100)
    assert not disturbed.is_broken_off(lambda: disturbed.answers(arranged), 10**9)


def wrong_after_an_interrupt(monkeypatch):
    """It forgets to tidy up."""
    right, broken = disturbed.answers, []

    def answers(arranged):
        try:
            return None if broken else right(arranged)
        except KeyboardInterrupt:
            broken.append(True)
            raise

    monkeypatch.setattr(disturbed, "answers", answers)


def wrong_in_threads(monkeypatch):
    monkeypatch.setattr(disturbed, "at_once", lambda work: [None] * disturbed.THREADS)


def wrong_command(monkeypatch):
    """An interrupt is an error like any other."""
    monkeypatch.setattr(disturbed, "COMMAND", "raise KeyboardInterrupt")


@pytest.mark.parametrize("fault", [wrong_after_an_interrupt, wrong_in_threads, wrong_command])
def test_faults_are_found(fault, monkeypatch, capsys):
    monkeypatch.setattr(disturbed, "judge_new_process", lambda seed: None)
    fault(monkeypatch)
    assert disturbed.main(["--rounds", "1", "--first", str(FIRST_SEED)]) == 1
    assert f"seed {FIRST_SEED}" in capsys.readouterr().out
