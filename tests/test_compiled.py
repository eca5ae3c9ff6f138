"""Loops in plain Python and in machine code: when which is used, and that both give the same."""

import subprocess
import sys
from typing import NamedTuple

import numpy as np
import pytest

import plyfold as pf
from plyfold import compiled
from plyfold.compiled import run_loop
from reference import random_curves


class Numbers(NamedTuple):
    values: np.ndarray


class Sums(NamedTuple):
    total: np.ndarray


def running_sum(given, results):
    (numbers,) = given
    total = 0
    for place in range(len(numbers.values)):
        total += numbers.values[place]
        results.total[place] = total
    return total


@pytest.mark.usefixtures("way")
def test_results_are_arrays():
    given = Numbers(np.array([3, 1, 4]))
    found = run_loop(running_sum, 3, (given,), Sums(np.zeros(3, dtype=np.int64)))
    assert isinstance(found, Sums)
    assert found.total.dtype == np.int64
    assert found.total.tolist() == [3, 4, 8]
    assert given.values.tolist() == [3, 1, 4]


def test_numba_is_loaded_when_there_was_much_to_do(monkeypatch):
    monkeypatch.setattr(compiled, "_steps_so_far", 0)
    monkeypatch.setattr(compiled, "STEPS_BEFORE_NUMBA", 100)
    monkeypatch.setattr(compiled, "_can_be_imported", lambda: True)
    monkeypatch.delitem(sys.modules, "numba", raising=False)
    assert [compiled._machine_code_pays(60) for _ in range(3)] == [False, True, True]
    monkeypatch.setattr(compiled, "_steps_so_far", 0)
    monkeypatch.setitem(sys.modules, "numba", compiled)
    assert compiled._machine_code_pays(1)
    monkeypatch.setattr(compiled, "_can_be_imported", lambda: False)
    assert not compiled._machine_code_pays(60)


def test_numba_that_cannot_be_imported_is_left_alone(monkeypatch):
    """It refuses versions of numpy that are too new for it."""
    monkeypatch.setitem(sys.modules, "numba", None)
    monkeypatch.setattr(compiled, "_steps_so_far", compiled.STEPS_BEFORE_NUMBA)
    compiled._can_be_imported.cache_clear()
    assert not compiled._machine_code_pays(60)
    compiled._can_be_imported.cache_clear()


def test_translations_are_named_after_all_sources():
    """numba itself would run an old translation after a change in a file that the loop only calls into."""
    from plyfold import predicates
    from plyfold.flat import sweep

    parts = compiled._reached(sweep._swept)
    assert predicates.turn in parts
    assert predicates._add_exactly in parts
    names = {compiled._named_after_sources(sweep._swept, some).__qualname__ for some in (parts, parts, set())}
    assert len(names) == 2


def test_small_drawings_do_not_load_numba():
    program = (
        "import sys, plyfold as pf; pf.triangulate(pf.gallery.CURVES['ten-gon'].curve); print('numba' in sys.modules)"
    )
    shown = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert shown.stdout.strip() == "False"


def both_ways(monkeypatch, action):
    pytest.importorskip("numba")
    found = []
    for machine_code in (False, True):
        monkeypatch.setattr(compiled, "_machine_code_pays", lambda steps, yes=machine_code: yes)
        found.append(action())
    return found


@pytest.mark.parametrize("seed", range(20))
def test_triangles_and_gluing_are_the_same_both_ways(monkeypatch, seed):
    rng = np.random.default_rng(seed)
    outline = random_curves.ribbon_outline if seed % 2 else random_curves.glued_disk
    points = np.array(outline(rng, 60), dtype=np.float64)

    def answers():
        immersion = pf.find_immersion(points)
        immersion.check()
        return immersion.gluing.tolist(), immersion.own_sheet.tolist(), pf.triangulate(points, immersion).tolist()

    plain, machine = both_ways(monkeypatch, answers)
    assert plain == machine
