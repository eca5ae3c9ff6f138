"""Mesh files, read back by another library."""

import json
import struct

import numpy as np
import pytest
import trimesh

from plyfold.errors import InputError
from plyfold.gallery import CURVES
from plyfold.surface import lift


@pytest.fixture(scope="module")
def surface():
    return lift(CURVES["stacked-spiral"].curve, triangles=300)


@pytest.fixture(scope="module")
def far_away():
    return lift(CURVES["exit-ramp"].draw() + np.array([3e7, -2e7]), triangles=300)


def triangles_read(path):
    """Corners of all triangles, shape (m, 3, 3), as the reader places them in the world."""
    return np.asarray(trimesh.load_scene(path, process=False).to_mesh().triangles)


def z_up(triangles):
    """Undo the turn from z up to glTF's y up: (x, y, z) is stored as (x, z, −y)."""
    x, y, z = np.moveaxis(triangles, -1, 0)
    return np.stack([x, -z, y], axis=-1)


@pytest.mark.parametrize("suffix", [".obj", ".ply"])
@pytest.mark.parametrize("which", ["surface", "far_away"])
def test_double_precision(suffix, which, request, tmp_path):
    """Every coordinate comes back bit for bit. (Sheets are groups in an OBJ, so its triangles come sheet by sheet.)"""
    surface = request.getfixturevalue(which)
    surface.export(tmp_path / f"out{suffix}")
    order = np.argsort(surface.sheet, kind="stable") if suffix == ".obj" else slice(None)
    scene = trimesh.load_scene(tmp_path / f"out{suffix}", process=False, maintain_order=True)
    corners = np.concatenate([mesh.triangles for mesh in scene.geometry.values()])
    assert np.array_equal(corners, surface.vertices[surface.faces[order]])


def test_stl(surface, tmp_path):
    surface.export(tmp_path / "out.stl")
    expected = surface.vertices[surface.faces].astype(np.float32)
    assert np.array_equal(triangles_read(tmp_path / "out.stl").astype(np.float32), expected)


@pytest.mark.parametrize("which", ["surface", "far_away"])
def test_glb(which, request, tmp_path):
    """Single precision, but of the distance from the middle of the drawing: far-away drawings lose nothing more."""
    surface = request.getfixturevalue(which)
    surface.export(tmp_path / "out.glb")
    read = z_up(triangles_read(tmp_path / "out.glb"))
    size = np.ptp(surface.vertices, axis=0).max()
    rounding = 2e-7 * size + 1e-15 * np.abs(surface.vertices).max()
    assert np.abs(read - surface.vertices[surface.faces]).max() < rounding


def test_glb_shows_both_sides_and_stands_upright(surface, tmp_path):
    """By the letter of the format: the material is double-sided, and heights are along glTF's y axis."""
    surface.export(tmp_path / "out.glb")
    content = (tmp_path / "out.glb").read_bytes()
    magic, version, length, json_length, kind = struct.unpack("<4sIII4s", content[:20])
    assert (magic, version, length, kind) == (b"glTF", 2, len(content), b"JSON")
    scene = json.loads(content[20 : 20 + json_length])
    assert all(material["doubleSided"] for material in scene["materials"])
    heights = triangles_read(tmp_path / "out.glb")[..., 1]
    assert np.ptp(heights) == pytest.approx(np.ptp(surface.vertices[:, 2]), rel=1e-6)


def test_glb_has_a_colour_for_each_layer(surface, tmp_path):
    surface.export(tmp_path / "out.glb")
    (mesh,) = trimesh.load(tmp_path / "out.glb", process=False).geometry.values()
    level = surface.layering.level[surface.sheet]
    inside = [set(surface.faces[level == one].ravel()) - set(surface.faces[level != one].ravel()) for one in (1, 2, 3)]
    colour = mesh.visual.vertex_attributes["color"]
    colours = [{tuple(row) for row in colour[list(vertices), :3].tolist()} for vertices in inside]
    assert all(len(of_layer) == 1 for of_layer in colours)
    assert len(set.union(*colours)) == 3


def test_html_page(surface, tmp_path):
    surface.export(tmp_path / "out.html", title="A <spiral>")
    page = (tmp_path / "out.html").read_text(encoding="utf-8")
    assert page.lower().startswith("<!doctype html>")
    assert "A &lt;spiral&gt;" in page


@pytest.mark.parametrize("suffix", [".glb", ".obj", ".ply", ".stl", ".html"])
def test_existing_files_stay(surface, suffix, tmp_path):
    path = tmp_path / f"out{suffix}"
    path.write_text("precious")
    with pytest.raises(FileExistsError, match="not overwritten"):
        surface.export(path)
    assert path.read_text() == "precious"
    surface.export(path, force=True)
    assert path.stat().st_size > 1000
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("name", ["out.fbx", "out", "out.glb.txt"])
def test_unknown_ending(surface, name, tmp_path):
    with pytest.raises(InputError, match="glb"):
        surface.export(tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_upper_case_ending(surface, tmp_path):
    surface.export(tmp_path / "OUT.PLY")
    assert triangles_read(tmp_path / "OUT.PLY").shape == (len(surface.faces), 3, 3)


def test_notebook_frame(surface):
    assert "<iframe" in surface._repr_html_()
    assert "srcdoc=" in surface._repr_html_()
