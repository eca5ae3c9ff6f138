"""What does not fit into memory is refused before it is made: with its size, a place, and a call that does without."""

import tracemalloc
from functools import cache, partial

import numpy as np
import pytest

import plyfold as pf
from plyfold import memory
from plyfold.clock import NO_LIMIT
from plyfold.errors import MemoryLimitError
from plyfold.immersion import immersion
from plyfold.layering.levels.equations import LevelClauses, level_equations, solve_levels
from plyfold.layering.orders import intersections
from plyfold.layering.orders import search as orders
from plyfold.mesh import sheets
from plyfold.mesh.cells import triangulate_cells
from plyfold.paper.gluing import glue_layout
from plyfold.sketch import answers


def helix(turns):
    """The outline of a ribbon that is wound into a spiral so tight that it covers itself; no two strands coincide."""
    angle = np.linspace(0, 2 * np.pi * turns, 24 * turns + 1)
    radius = np.linspace(4, 6, len(angle))
    along = np.concatenate([(radius + 0.6) * np.exp(1j * angle), ((radius - 0.6) * np.exp(1j * angle))[::-1]])
    along *= 1 + 1e-4 * np.random.default_rng(0).random(len(along))
    return np.stack([along.real, along.imag], axis=1)


@cache
def drawn():
    return pf.arrange(helix(30))


@cache
def layering():
    return pf.find_layering(pf.find_immersion(drawn()))


@cache
def mesh():
    return triangulate_cells(drawn(), triangles=0)


@cache
def problem():
    return orders.independent_orders(layering().immersion)


def groups():
    return [group.borders for group in layering().immersion.disk_layout()]


RING = [[(0, 0), (9, 0), (0, 9)], [(1, 1), (1, 3), (3, 1)]]

# What is large, made from what is there already; and which call is to be recommended.
LARGE = {
    "gluing": (pf.find_immersion, (drawn,), "bounds_disk"),
    "gluing by layout": (glue_layout, (drawn, groups), "bounds_disk"),
    "gluing by casing": (pf.embed_cased, (drawn, lambda: layering().casing), "bounds_disk"),
    "triangles": (pf.triangulate, (drawn,), "bounds_disk"),
    "seams": (sheets.seams_of, (lambda: layering().immersion,), "bounds_disk"),
    "copies": (sheets.glue_copies, (lambda: layering().immersion, mesh), "triangulate"),
    "pairs": (pf.find_layering, (lambda: layering().immersion,), "embed_cased"),
    "pairs to count": (pf.count_layerings, (lambda: layering().immersion,), "embed_cased"),
    "triples": (
        orders._problem,
        (lambda: layering().immersion, lambda: problem().graph, lambda: NO_LIMIT),
        "embed_cased",
    ),
    "glued pairs": (intersections._glued_pairs, (lambda: layering().immersion,), "find_layering"),
    "wishes": (intersections._wishes, (problem, lambda: NO_LIMIT), "find_layering"),
    "levels": (solve_levels, (lambda: LevelClauses(level_equations(drawn())), lambda: NO_LIMIT), "embed_cased"),
    "levels of several": (partial(pf.find_embedding, connected=True), (lambda: RING,), "embed_cased"),
}


@pytest.fixture
def spend_memory(monkeypatch):
    """Return a function after which there are a hundred bytes, and which has it looked up however little is needed."""

    def spend():
        monkeypatch.setattr(memory, "available_memory", lambda: 100)
        monkeypatch.setattr(memory, "_SURELY_THERE", 0)

    return spend


@pytest.mark.parametrize("name", LARGE)
def test_what_does_not_fit_is_refused(name, spend_memory):
    make, given, instead = LARGE[name]
    arguments = [argument() for argument in given]
    spend_memory()
    with pytest.raises(MemoryLimitError, match=r"would take [\d.]+ MiB of memory, and 0.0 MiB can be had") as caught:
        make(*arguments)
    assert instead in caught.value.hint
    assert isinstance(caught.value, MemoryError)


def test_the_place_is_where_most_sheets_lie(spend_memory):
    spend_memory()
    with pytest.raises(MemoryLimitError) as caught:
        memory.require_memory(101, "it", drawn(), "")
    ((x, y),) = caught.value.where
    assert 3.4 < np.hypot(x, y) < 6.6
    memory.require_memory(100, "it", drawn(), "")


def test_answers_without_sheets_need_little(spend_memory):
    spend_memory()
    assert pf.bounds_disk(drawn())
    assert pf.count_immersions(drawn()) == 1
    assert len(pf.coverage(drawn())) == np.count_nonzero(drawn().winding)
    with pytest.raises(MemoryLimitError):
        pf.lift(drawn())


@pytest.mark.parametrize("name", ["gluing", "gluing by casing", "seams", "copies", "pairs", "triples", "glued pairs"])
def test_sizes_are_those_that_are_taken(name, monkeypatch):
    """The estimate lies above what Python and numpy allocate, and not far above."""
    make, given, _ = LARGE[name]
    arguments, sizes = [argument() for argument in given], []
    for module in (immersion, intersections, orders, sheets):
        monkeypatch.setattr(module, "require_memory", lambda size, *_: sizes.append(size))
    tracemalloc.start()
    before, _ = tracemalloc.get_traced_memory()
    make(*arguments)
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


def test_the_page_hears_of_it():
    error = answers.error_reply(answers._kind(MemoryLimitError("it would not fit")), "it would not fit")
    assert error.status == 413
