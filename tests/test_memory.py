"""What does not fit into memory is refused before it is made: with its size, a place, and a call that does without."""

import tracemalloc

import numpy as np
import pytest

import plyfold as pf
from plyfold import memory
from plyfold.errors import MemoryLimitError
from plyfold.flat import sheets
from plyfold.flat.cells import triangulate_cells
from plyfold.immersion import immersion
from plyfold.immersion.layout import glue_layout
from plyfold.layering import intersections, orders, sheet_pairs
from plyfold.layering.level_clauses import LevelClauses, solve_levels
from plyfold.layering.levels import level_equations


def helix(turns):
    """The outline of a ribbon that is wound into a spiral so tight that it covers itself; no two strands coincide."""
    angle = np.linspace(0, 2 * np.pi * turns, 24 * turns + 1)
    radius = np.linspace(4, 6, len(angle))
    along = np.concatenate([(radius + 0.6) * np.exp(1j * angle), ((radius - 0.6) * np.exp(1j * angle))[::-1]])
    along *= 1 + 1e-4 * np.random.default_rng(0).random(len(along))
    return np.stack([along.real, along.imag], axis=1)


HELIX = pf.arrangement(helix(30))
LAYERING = pf.find_layering(pf.find_immersion(HELIX))
IMMERSION = LAYERING.immersion
GROUPS = [group.borders for group in IMMERSION.disk_layout()]
MESH = triangulate_cells(HELIX, triangles=0)
PROBLEM = orders.independent_orders(IMMERSION)
LEVELS = level_equations(HELIX)
RINGS = [[(0, 0), (9, 0), (0, 9)], [(1, 1), (3, 1), (1, 3)]]

LARGE = {
    "gluing": (lambda: pf.find_immersion(HELIX), "bounds_disk"),
    "gluing by layout": (lambda: glue_layout(HELIX, GROUPS), "bounds_disk"),
    "gluing by casing": (lambda: pf.embed_cased(HELIX, LAYERING.casing), "bounds_disk"),
    "triangles": (lambda: pf.triangulate(HELIX), "bounds_disk"),
    "seams": (lambda: sheets.seams_of(IMMERSION), "bounds_disk"),
    "copies": (lambda: sheets.glue_copies(IMMERSION, MESH), "triangulate"),
    "pairs": (lambda: pf.find_layering(IMMERSION), "embed_cased"),
    "pairs to count": (lambda: pf.count_layerings(IMMERSION), "embed_cased"),
    "triples": (lambda: orders._problem(IMMERSION, PROBLEM.graph, orders.NO_LIMIT), "embed_cased"),
    "glued pairs": (lambda: intersections._glued_pairs(IMMERSION), "find_layering"),
    "wishes": (lambda: intersections._wishes(PROBLEM, orders.NO_LIMIT), "find_layering"),
    "levels": (lambda: solve_levels(LevelClauses(LEVELS), orders.NO_LIMIT), "embed_cased"),
    "levels of several": (lambda: pf.find_embedding(RINGS), "embed_cased"),
}


@pytest.fixture
def little_memory(monkeypatch):
    """Let there be a hundred bytes, and look however little is asked for."""
    monkeypatch.setattr(memory, "available_memory", lambda: 100)
    monkeypatch.setattr(memory, "_SURELY_THERE", 0)


@pytest.mark.parametrize("name", LARGE)
def test_what_does_not_fit_is_refused(name, little_memory):
    make, instead = LARGE[name]
    with pytest.raises(MemoryLimitError, match=r"would take [\d.]+ MiB of memory, and 0.0 MiB can be had") as caught:
        make()
    assert instead in caught.value.hint
    assert isinstance(caught.value, MemoryError)


def test_the_place_is_where_most_sheets_lie(little_memory):
    with pytest.raises(MemoryLimitError) as caught:
        memory.require_memory(101, "it", HELIX, "")
    ((x, y),) = caught.value.where
    assert 3.4 < np.hypot(x, y) < 6.6
    memory.require_memory(100, "it", HELIX, "")


def test_answers_without_sheets_need_little(little_memory):
    assert pf.bounds_disk(HELIX)
    assert pf.count_immersions(HELIX) == 1
    assert len(pf.coverage(HELIX)) == np.count_nonzero(HELIX.winding)
    with pytest.raises(MemoryLimitError):
        pf.lift(HELIX)


@pytest.mark.parametrize("name", ["gluing", "gluing by casing", "seams", "copies", "pairs", "triples", "glued pairs"])
def test_sizes_are_those_that_are_taken(name, monkeypatch):
    """The estimate lies above what Python and numpy allocate, and not far above."""
    sizes = []
    for module in (immersion, intersections, orders, sheet_pairs, sheets):
        monkeypatch.setattr(module, "require_memory", lambda size, *_: sizes.append(size))
    tracemalloc.start()
    before, _ = tracemalloc.get_traced_memory()
    LARGE[name][0]()
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert 0.8 * (peak - before) < max(sizes) < 4 * (peak - before)


def test_memory_of_this_machine():
    """At least what the tests take is free, and no machine has an exabyte."""
    assert 10**7 < memory.available_memory() < 10**18


def test_limits_of_the_process_count(monkeypatch):
    resource = pytest.importorskip("resource")
    monkeypatch.setattr(resource, "getrlimit", lambda _: (1, 1))
    assert memory.available_memory() == 0
    monkeypatch.setattr(memory, "_limits", lambda: iter([]))
    memory.require_memory(10**18, "nobody knows", None, "")


def test_limits_of_a_container_count(monkeypatch):
    monkeypatch.setattr(memory, "_free_for_process", lambda: iter([]))
    files = {"memory.max": "1000", "memory.current": "700", "memory.stat": "anon 5\ninactive_file 50"}
    monkeypatch.setattr(memory, "_lines", lambda file: files.get(file.rsplit("/", 1)[1], "").splitlines())
    assert memory.available_memory() == 350
    files["memory.max"] = "max"
    assert memory.available_memory() is None
