"""Compiled and plain, core gives the same; and what was compiled from other sources is not used."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import plyfold as pf
import plyfold.core
from plyfold.core.buffers import flat
from plyfold.core.meetings import Meetings
from plyfold.core.numbers import Numbers

CORE = Path(plyfold.core.__file__).parent
is_plain = bool(os.environ.get("PLYFOLD_PURE"))
only_compiled = pytest.mark.skipif(is_plain, reason="plain Python is asked for")

DIGEST = """
import hashlib, sys, warnings
import numpy as np, plyfold as pf, plyfold.core
from plyfold.mesh.cells import triangulate_cells
from reference.random_curves import ribbon_outline, random_polygon, star_polygon
digest = hashlib.sha256()
rng = np.random.default_rng(18)
lattice = [rng.integers(-6, 7, (30, 2)).astype(float) for _ in range(20)]
ring = [[(0, 0), (9, 0), (9, 9), (0, 9)], [(1, 1), (2, 5), (7, 3)], [(-3, 2), (12, 2), (12, 4), (-3, 4)]]
curves = [random_polygon(rng, 60), ribbon_outline(rng, 200), star_polygon(41, 20), *lattice]
for curve in [ring, *(np.asarray(curve, dtype=float) for curve in curves)]:
    drawn = pf.arrange(curve)
    immersion = pf.find_immersion(drawn)
    mesh = triangulate_cells(drawn)
    faces = {"faces": pf.triangulate(drawn), "rounder": pf.triangulate(drawn, refine=1e9)[1]} if immersion else {}
    values = *vars(drawn).items(), *vars(immersion).items(), *vars(mesh).items(), *faces.items()
    for name, value in sorted(values, key=lambda item: item[0]):
        if isinstance(value, np.ndarray):  # the bytes of fractions are where they lie in memory
            digest.update(str(value.tolist()).encode() if value.dtype == object else value.tobytes())
from scipy.sparse import csr_array
from plyfold.matrices import factorised
from plyfold.surface.answers import InverseEntries
graph = np.triu(rng.random((60, 60)) * (rng.random((60, 60)) < 0.08), 1)
matrix = csr_array(np.diag(2 + (graph + graph.T).sum(axis=1)) - graph - graph.T)
entries = InverseEntries(matrix, factorised(matrix))
entries.join(np.arange(60))
digest.update(entries.between(np.arange(60), np.arange(60)).tobytes())
print(plyfold.core.WHY_PLAIN or "compiled")
print(digest.hexdigest())
"""


def printed(program, **environment):
    paths = {"PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run(
        [sys.executable, "-c", program],
        capture_output=True,
        text=True,
        check=False,
        env=os.environ | paths | environment,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


@only_compiled
def test_core_is_compiled():
    assert plyfold.core.WHY_PLAIN == ""
    assert Meetings.__init__.__class__.__name__ != "function"


@only_compiled
def test_compiled_and_plain_are_equal_to_the_last_bit():
    compiled, plain = printed(DIGEST), printed(DIGEST, PLYFOLD_PURE="1")
    assert (compiled[0], plain[0]) == ("compiled", "PLYFOLD_PURE is set")
    assert compiled[1] == plain[1]


@only_compiled
@pytest.mark.parametrize(
    ("change", "why"),
    [
        (lambda core: (core / "signs.py").write_text((core / "signs.py").read_text() + "\n# changed\n"), "its sources"),
        (lambda core: shutil.rmtree(core / "machine"), "it was not compiled"),
        (lambda core: (core / "machine" / next_library(core)).write_bytes(b"of another machine"), "it was compiled"),
    ],
)
def test_what_was_compiled_otherwise_is_left_alone(tmp_path, change, why):
    package = shutil.copytree(CORE.parent, tmp_path / "plyfold")
    change(package / "core")
    program = (
        f"import sys, warnings; sys.path.insert(0, {str(tmp_path)!r}); warnings.simplefilter('ignore')\n"
        "import plyfold.core, plyfold.core.signs as signs\n"
        "print(plyfold.core.WHY_PLAIN)\n"
        "print(signs.__file__)"
    )
    said, loaded = printed(program)
    assert said.startswith(why)
    assert Path(loaded) == package / "core" / "signs.py"


def next_library(core):
    return next(path.name for path in (core / "machine").iterdir() if path.name.startswith("signs."))


def test_a_change_of_sources_is_said(tmp_path):
    if is_plain:
        pytest.skip("plain Python is asked for")
    package = shutil.copytree(CORE.parent, tmp_path / "plyfold")
    (package / "core" / "machine" / "stamp").write_text("another")
    program = f"import sys; sys.path.insert(0, {str(tmp_path)!r}); import plyfold.core"
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True, env=environment)
    assert "RuntimeWarning: plyfold.core is plain Python, and slow" in done.stderr


def test_places_that_do_not_exist_are_errors():
    points = flat(np.array([[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]]))
    with pytest.raises(IndexError):
        Meetings(points, flat(np.array([1, 2, 9, 0])), lambda: None)


def test_an_error_in_a_step_ends_the_search():
    points = np.random.default_rng(0).random((2000, 2))

    def step():
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        Meetings(flat(points), flat(np.roll(np.arange(2000), -1)), step)


def test_numbers_grow():
    numbers = Numbers(1)
    for number in range(1000):
        numbers.append(number * number)
    assert numbers.size == 1000
    assert numbers.as_array().tolist() == [number * number for number in range(1000)]


def test_the_command_line_says_which(capsys):
    from plyfold.cli.commands import main

    with pytest.raises(SystemExit) as left:
        main(["--version"])
    assert left.value.code == 0
    expected = "plain: PLYFOLD_PURE is set" if is_plain else "compiled"
    assert capsys.readouterr().out == f"plyfold {pf.__version__} ({expected})\n"
