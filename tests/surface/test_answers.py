"""Answers to forces, and entries of inverses along the paths of elimination trees: against dense matrices."""

import importlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import csr_array

from cloths import cloth_over
from coarse import CURVES
from plyfold import find_layering, immersions
from plyfold.core.buffers import all_flat
from plyfold.core.elimination import elimination_tree
from plyfold.matrices import dissected_order, factorised
from plyfold.mesh.cells import triangulate_cells
from plyfold.surface import answers
from plyfold.surface.answers import Answers, InverseEntries
from plyfold.surface.glue import stack_sheets


@st.composite
def definite_matrices(draw):
    """Sparse positive definite matrices of random graphs, and orders of elimination."""
    n = draw(st.integers(1, 14))
    rng = np.random.default_rng(draw(st.integers(0, 10**6)))
    graph = np.triu(rng.random((n, n)) < draw(st.floats(0, 0.6)), 1) * rng.uniform(-1, 1, (n, n))
    matrix = graph + graph.T
    return matrix + np.diag(np.abs(matrix).sum(axis=1) + rng.uniform(0.1, 1, n)), rng.permutation(n)


def parents_by_definition(matrix, order):
    """The first row below the diagonal in each column of the triangle, filled in one elimination after the other."""
    filled = matrix[np.ix_(order, order)] != 0
    for time in range(len(filled)):
        later = np.flatnonzero(filled[time + 1 :, time]) + time + 1
        filled[np.ix_(later, later)] = True
    below = [np.flatnonzero(filled[time + 1 :, time]) + time + 1 for time in range(len(filled))]
    return [int(rows[0]) if len(rows) else -1 for rows in below]


@settings(deadline=None)
@given(definite_matrices())
def test_elimination_tree(case):
    matrix, order = case
    columns = csr_array(matrix).tocsc()
    at = order.astype(np.int32)
    parent, above = np.empty_like(at), np.full_like(at, -1)
    time = np.argsort(order).astype(np.int32)
    elimination_tree(*all_flat(columns.indptr, columns.indices, time, at, parent, above))
    assert parent.tolist() == parents_by_definition(matrix, order)


@settings(deadline=None)
@given(definite_matrices(), st.booleans())
def test_entries_of_inverses(case, in_order):
    matrix, order = case
    sparse = csr_array(matrix)
    entries = InverseEntries(sparse, factorised(sparse, order=order if in_order else None))
    rows, inverse = order[: len(order) // 2 + 1], np.linalg.inv(matrix)
    entries.join(np.append(rows[::2], -1))
    entries.join(rows[1::2])
    expected = np.zeros((len(rows) + 1, len(rows) + 1))
    joined = np.concatenate([rows[::2], [-1], rows[1::2]])
    real = joined >= 0
    expected[np.ix_(real, real)] = inverse[np.ix_(joined[real], joined[real])]
    every = np.arange(len(joined))
    assert entries.between(every, every) == pytest.approx(expected, abs=1e-12 * np.abs(inverse).max())
    assert entries.between(every[:1], every[-1:]) == pytest.approx(expected[:1, -1:], abs=1e-12 * np.abs(inverse).max())


def glued(name, triangles=300):
    layering = next(filter(None, map(find_layering, immersions(CURVES[name].curve))))
    planar = triangulate_cells(layering.immersion.arrangement, triangles=triangles)
    return planar.points, stack_sheets(layering, planar)


def differences(mesh):
    rows = np.zeros((len(mesh.stacked), len(mesh.level)))
    rows[np.arange(len(rows)), mesh.stacked[:, 0]] = -1
    rows[np.arange(len(rows)), mesh.stacked[:, 1]] = 1
    return rows


@pytest.mark.parametrize("dissected", [False, True])
@pytest.mark.parametrize("held", [False, True])
@pytest.mark.parametrize(("stiffness", "precision"), [(0.5, 1e-10), (10.0, 5e-8), (1000.0, 1e-5)])
def test_answers_of_cloth(held, stiffness, precision, dissected, monkeypatch):
    """Against the dense inverse, or the pseudo-inverse, of the cloth's whole matrix."""
    if dissected:
        pytest.importorskip("pymetis")
        monkeypatch.setattr(answers, "_FEW", 0)
    points, mesh = glued("milnor")
    cloth = cloth_over(points, mesh, stiffness)
    rows = np.pad(differences(mesh), [(0, 0), (0, len(cloth.area) - len(mesh.level))])
    fixed = np.isin(np.arange(len(cloth.area)), mesh.faces[:5]) & held
    inverse, free = np.zeros((len(fixed), len(fixed))), np.flatnonzero(~fixed)
    matrix = cloth.stiffness.toarray()[np.ix_(free, free)]
    inverse[np.ix_(free, free)] = np.linalg.pinv(matrix, hermitian=True, rtol=1e-15 * len(fixed))
    expected, found = rows @ inverse @ rows.T, Answers(cloth, fixed)
    sparse, half = csr_array(rows), len(rows) // 2
    assert found.between(sparse[:half], sparse[half:]) == pytest.approx(
        expected[:half, half:], abs=precision * np.abs(expected).max()
    )
    assert found.between(sparse, sparse[:9]) == pytest.approx(expected[:, :9], abs=precision * np.abs(expected).max())
    assert rows @ found.heights(rows.T[:, 0]) == pytest.approx(expected[:, 0], abs=1e-6 * np.abs(expected).max())


def test_orders_by_dissection(monkeypatch):
    """A permutation; and none without the library."""
    points, mesh = glued("pretzel", 2000)
    laplacian = cloth_over(points, mesh).laplacian
    if importlib.util.find_spec("pymetis"):
        order = dissected_order(laplacian)
        assert sorted(order.tolist()) == list(range(laplacian.shape[0]))
    monkeypatch.setitem(__import__("sys").modules, "pymetis", None)
    assert dissected_order(laplacian) is None
