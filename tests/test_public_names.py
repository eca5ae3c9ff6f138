"""The names that users may rely on."""

import subprocess
import sys
from types import ModuleType

import numpy as np
import pytest
from mypy import api

import plyfold as pf

RAMP = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]
HEAVY = {"numpy", "scipy", "shapely", "pysat", "matplotlib"}


def test_public_names():
    assert sorted(pf.__all__) == [
        "Arrangement",
        "BlankWord",
        "Covered",
        "Curve",
        "DataTable",
        "GaussCode",
        "Homotopy",
        "Immersion",
        "IntersectingLayering",
        "Layering",
        "Limit",
        "ManyAnswers",
        "Obstruction",
        "Outline",
        "Repaired",
        "SmallChange",
        "SuggestedCusps",
        "Surface",
        "Unknown",
        "UnwoundDisk",
        "arrange",
        "best_immersion",
        "blank_word",
        "bounds_disk",
        "census",
        "certify",
        "changed_borders",
        "count_embeddings",
        "count_immersions",
        "count_layerings",
        "coverage",
        "coverage_mask",
        "decompose",
        "decompose_many",
        "draw",
        "embed_cased",
        "embeddings",
        "errors",
        "fill",
        "find_embedding",
        "find_immersion",
        "find_layering",
        "flip_distance",
        "gallery",
        "hard",
        "immersions",
        "io",
        "irreducible_kernels",
        "layerings",
        "least_homotopy",
        "least_intersecting_layering",
        "lift",
        "limit_of",
        "lobe_turning_numbers",
        "map_disk",
        "nicest_layering",
        "paper",
        "read",
        "repair",
        "ribbon",
        "ribbon_layering",
        "sample_immersion",
        "save",
        "suggest_cusps",
        "triangulate",
        "triangulate_many",
        "unwrap",
        "verdicts",
        "winding_at",
    ]
    assert all(hasattr(pf, name) for name in pf.__all__)


def test_no_function_hides_a_package():
    import plyfold.arrangement as room
    import plyfold.draw.surface_plot

    assert isinstance(room, ModuleType)
    assert pf.arrangement is room
    assert pf.draw.surface_plot is plyfold.draw.surface_plot


def test_every_name_is_there_for_people_and_for_type_checkers():
    for module in (pf, pf.draw, pf.hard, pf.certify, pf.io, pf.paper):
        for name in module.__all__:
            assert getattr(module, name).__doc__
        assert set(module.__all__) <= set(dir(module))


PROGRAM = """
import plyfold as pf

pf.lift(42)
pf.lift([(0, 0), (1, 0), (0, 1)]).vertices.shape
pf.arrange(pf.Curve([(0, 0), (1, 0), (0, 1)])).no_such_thing
"""


def test_a_type_checker_sees_mistakes(tmp_path):
    (tmp_path / "program.py").write_text(PROGRAM)
    found, _, _ = api.run([str(tmp_path / "program.py"), "--strict", "--cache-dir", str(tmp_path / "cache")])
    assert [line.split(": error: ")[0].split(":")[-1] for line in found.splitlines()[:-1]] == ["4", "6"]


def loaded_by(lines):
    """Which of the libraries that take long to load some lines need, in a fresh process."""
    program = f"import sys\nimport plyfold as pf\n{lines}\nprint(*{HEAVY} & sys.modules.keys())"
    done = subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True)
    return set(done.stdout.split())


def test_importing_loads_nothing_heavy():
    assert loaded_by("") == set()


@pytest.mark.parametrize("name", ["arrange", "bounds_disk", "find_immersion", "count_immersions"])
def test_small_answers_load_numpy_alone(name):
    assert loaded_by(f"pf.{name}({RAMP})") == {"numpy"}


def test_values_leave_the_arrays_they_were_given_as_they_were():
    points = np.array([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)])
    level = np.array([1])
    layering = pf.Layering(pf.find_immersion(points), level)
    assert points.flags.writeable
    assert level.flags.writeable
    assert not layering.level.flags.writeable
