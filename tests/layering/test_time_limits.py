"""Time limits cover setting up, and an interrupt ends every question to a solver.

No test looks at a clock: either the time is over from the start, or solvers are made to ask for ever.
"""

import signal
import subprocess
import sys

import pytest

import plyfold as pf
from plyfold.hard.formulas import formula_disk
from plyfold.layering.orders import intersections, search
from reference.random_curves import BENNEQUIN_LIKE

# Two immersions that pose problems, and cores are minimised by asking the solver for ever.
ENDLESS = """
import plyfold as pf
from pysat.examples.rc2 import RC2
from reference.random_curves import BENNEQUIN_LIKE

def minimise_for_ever(solver):
    print("minimising", flush=True)
    while True:
        solver.oracle.conf_budget(1000)
        solver._call_oracle(assumptions=solver.core)

RC2.minimize_core = minimise_for_ever
pretzel = pf.find_immersion(pf.gallery.CURVES["pretzel"].curve)
unliftable = next(i for i in pf.immersions(BENNEQUIN_LIKE) if not pf.find_layering(i))
"""

A_LONG_TIME = 200


@pytest.fixture
def endless(pytestconfig):
    """Start a process that runs lines after those of ENDLESS."""
    started = []

    def start(*lines):
        process = subprocess.Popen(
            [sys.executable, "-c", "\n".join([ENDLESS, *lines])],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            cwd=pytestconfig.rootpath / "tests",
        )
        started.append(process)
        return process

    yield start
    for process in started:
        process.kill()
        process.communicate()


@pytest.mark.parametrize(
    "call",
    [
        "pf.least_intersecting_layering(unliftable, time_limit=3).optimal",
        "bool(pf.nicest_layering(pretzel, time_limit=3))",
    ],
)
def test_the_limit_ends_core_minimisation(call, endless):
    out, _ = endless(f"print({call})").communicate(timeout=A_LONG_TIME)
    assert out.splitlines()[-1] == "False"


def test_an_interrupt_ends_core_minimisation(endless):
    process = endless("pf.least_intersecting_layering(unliftable)")
    assert process.stdout.readline() == "minimising\n"
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=A_LONG_TIME)
    assert errors.splitlines()[-1] == "KeyboardInterrupt"


def test_the_limit_covers_setting_up(monkeypatch):
    """Looks at the clock are counted instead of seconds: it is looked at while the problem is set up, too."""
    immersion = formula_disk([(1, 2, 3), (1, 4, 5)]).disk.immersion
    seconds = iter(range(10**9))
    monkeypatch.setattr("plyfold.clock.time.monotonic", lambda: float(next(seconds)))
    monkeypatch.setattr(search, "solve", None)
    for ask in (pf.find_layering, pf.count_layerings, pf.nicest_layering):
        assert ask(immersion, time_limit=4).reason == "time limit"
    monkeypatch.setattr(intersections, "_greedy", None)
    found = pf.least_intersecting_layering(immersion, time_limit=4)
    assert not found.optimal
    found.check()


def test_setting_up_is_done_once_in_time():
    """With time enough the answers are the same as without a limit."""
    for immersion in pf.immersions(BENNEQUIN_LIKE):
        limited, free = (pf.find_layering(immersion, time_limit=limit) for limit in (1000, None))
        assert bool(limited) == bool(free)
        assert not free or limited.level.tolist() == free.level.tolist()


@pytest.mark.parametrize("limit", [True, -1, "5", float("nan")])
def test_limits_that_are_no_seconds(limit):
    with pytest.raises(pf.errors.InputError, match="a number of seconds"):
        pf.find_embedding([(0, 0), (1, 0), (0, 1)], time_limit=limit)
