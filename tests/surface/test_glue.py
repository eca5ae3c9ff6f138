"""Glued copies of the cells: a disk over the curve, whichever immersion it comes from."""

from collections import Counter

import numpy as np
import pytest

from coarse import CURVES
from plyfold import find_layering, immersions
from plyfold.arrangement.arrangement import arrange
from plyfold.certify import check_disk_mesh, check_immersed_disk, check_layered
from plyfold.errors import CertificateError
from plyfold.layering.layering import Layering
from plyfold.mesh.cells import triangulate_cells
from plyfold.surface.glue import stack_sheets
from reference import random_curves


def layerings():
    """One layering of every immersion that has one, over triangulations as coarse as can be and finer ones."""
    named = [(name, named.curve) for name, named in CURVES.items() if named.embeddable]
    rng = np.random.default_rng(1)
    random = [(f"glued disk {i}", random_curves.glued_disk(rng, 14)) for i in range(6)]
    ribbons = [(f"ribbon {i}", random_curves.ribbon_outline(rng, 60)) for i in range(3)]
    for name, curve in named + random + ribbons:
        for number, immersion in enumerate(immersions(curve)):
            layering = find_layering(immersion)
            if layering:
                yield pytest.param(layering, id=f"{name} {number}")


@pytest.fixture(params=layerings(), scope="module")
def layering(request):
    return request.param


@pytest.fixture(params=[10, 500], scope="module")
def planar(request, layering):
    return triangulate_cells(layering.immersion.arrangement, triangles=request.param)


@pytest.fixture(scope="module")
def lifted(layering, planar):
    return stack_sheets(layering, planar)


def test_immersed_disk_over_the_curve(layering, planar, lifted):
    places = planar.points[lifted.planar_vertex]
    check_immersed_disk(layering.immersion.arrangement.curve.points, places, lifted.faces, lifted.boundary)


def test_levels_are_layers(planar, lifted):
    """With its level for a height, the disk is embedded."""
    vertices = np.column_stack([planar.points[lifted.planar_vertex], lifted.level])
    check_layered(vertices, lifted.faces, gap=1.0)


def test_stacks(lifted):
    """Over each point the levels count from 0, and rows lead from each to the next."""
    for point in np.unique(lifted.planar_vertex):
        assert sorted(lifted.level[lifted.planar_vertex == point]) == list(range((lifted.planar_vertex == point).sum()))
    lower, upper = lifted.stacked.T
    assert (lifted.planar_vertex[lower] == lifted.planar_vertex[upper]).all()
    assert (lifted.level[lower] + 1 == lifted.level[upper]).all()
    points = len(np.unique(lifted.planar_vertex))
    assert len({*map(tuple, lifted.stacked.tolist())}) == len(lifted.stacked) == len(lifted.level) - points


def test_one_copy_per_sheet(layering, planar, lifted):
    """The triangles of each sheet are those of its cell."""
    immersion = layering.immersion
    copies = Counter(zip(lifted.sheet.tolist(), map(tuple, lifted.planar_vertex[lifted.faces].tolist()), strict=True))
    expected = Counter(
        (sheet, tuple(triangle))
        for triangle, cell in zip(planar.triangles.tolist(), planar.cell.tolist(), strict=True)
        for sheet in np.flatnonzero(immersion.sheet_cell == cell).tolist()
    )
    assert copies == expected


def test_levels_are_those_of_the_sheets(layering, lifted):
    """A vertex that belongs to one sheet has as many others below as its sheet has sheets below."""
    sheets_at = [set() for _ in lifted.level]
    for sheet, face in zip(lifted.sheet.tolist(), lifted.faces.tolist(), strict=True):
        for vertex in face:
            sheets_at[vertex].add(sheet)
    for level, sheets in zip(lifted.level.tolist(), sheets_at, strict=True):
        assert len(sheets) > 1 or level + 1 == layering.level[min(sheets)]


def test_immersion_without_layering():
    """The disk is immersed all the same; but no order of its sheets is one of layers."""
    failing = [immersion for immersion in immersions(CURVES["bennequin"].curve) if not find_layering(immersion)]
    assert len(failing) == 2
    for immersion in failing:
        planar = triangulate_cells(immersion.arrangement, triangles=100)
        any_order = np.arange(immersion.n_sheets) - immersion.first_sheet[immersion.sheet_cell] + 1
        lifted = stack_sheets(Layering(immersion, any_order), planar)
        places = planar.points[lifted.planar_vertex]
        check_disk_mesh(lifted.faces, len(places))
        check_immersed_disk(immersion.arrangement.curve.points, places, lifted.faces, lifted.boundary)
        with pytest.raises(CertificateError, match="change their order"):
            check_layered(np.column_stack([places, lifted.level]), lifted.faces)


def test_wrong_levels_are_noticed():
    """Two sheets of one cell exchanged: the checker must see it where the cell borders on others of two sheets."""
    layering = find_layering(next(immersions(arrange(CURVES["stacked-spiral"].curve))))
    immersion = layering.immersion
    cell = int(np.argmax(immersion.arrangement.winding))
    a, b = np.flatnonzero(immersion.sheet_cell == cell)[:2]
    level = layering.level.copy()
    level[[a, b]] = level[[b, a]]
    planar = triangulate_cells(immersion.arrangement, triangles=100)
    lifted = stack_sheets(Layering(immersion, level), planar)
    with pytest.raises(CertificateError, match="change their order"):
        check_layered(np.column_stack([planar.points[lifted.planar_vertex], lifted.level]), lifted.faces)
