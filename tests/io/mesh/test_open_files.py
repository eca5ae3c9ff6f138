"""Meshes into open files, and to the library trimesh without any."""

import io
import sys

import numpy as np
import pytest

from coarse import CURVES
from plyfold.colours import rgb, sheet_colour
from plyfold.errors import InputError, PlyfoldError
from plyfold.surface.lift import lift


@pytest.fixture(scope="module")
def surface():
    return lift(CURVES["exit-ramp"].curve, triangles=200)


@pytest.mark.parametrize("ending", [".glb", "obj", "PLY", "stl", ".3mf"])
def test_an_open_file_gets_what_a_path_gets(surface, ending, tmp_path):
    for thing in (surface, surface.thicken(surface.gap / 3)):
        path = tmp_path / f"out.{ending.removeprefix('.')}"
        thing.export(path, force=True)
        thing.export(file := io.BytesIO(), ending=ending)
        assert file.getvalue() == path.read_bytes()


def test_a_page_goes_into_an_open_file(surface):
    surface.export(file := io.BytesIO(), title="A ramp", ending="html")
    assert b"A ramp" in file.getvalue()


@pytest.mark.parametrize("ending", [None, "gif", "fbx"])
def test_an_open_file_needs_the_name_of_a_format_of_one_file(surface, ending):
    with pytest.raises(InputError, match="an open file: a mesh cannot be written"):
        surface.export(io.BytesIO(), ending=ending)


def test_the_ending_may_differ_from_that_of_the_path(surface, tmp_path):
    surface.export(tmp_path / "out.part", ending="ply")
    assert (tmp_path / "out.part").read_bytes().startswith(b"ply")


@pytest.mark.parametrize("colours", ["layers", "sheets"])
def test_trimesh_has_the_same_vertices_and_faces(surface, colours):
    mesh = surface.to_trimesh(colours)
    assert np.array_equal(mesh.vertices, surface.vertices)
    assert np.array_equal(mesh.faces, surface.faces)
    assert np.array_equal(mesh.face_attributes["sheet"], surface.sheet)
    assert mesh.visual.kind == {"layers": "vertex", "sheets": "face"}[colours]
    if colours == "sheets":
        expected = np.rint(255 * np.array([rgb(sheet_colour(sheet)) for sheet in surface.sheet]))
        assert np.array_equal(mesh.visual.face_colors[:, :3], expected)


def test_trimesh_of_a_solid_is_watertight(surface):
    solid = surface.thicken(surface.gap / 2)
    mesh = solid.to_trimesh()
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert mesh.volume > 0


def test_without_trimesh_there_is_a_sentence(surface, monkeypatch):
    monkeypatch.setitem(sys.modules, "trimesh", None)
    with pytest.raises(PlyfoldError, match="pip install trimesh"):
        surface.to_trimesh()
