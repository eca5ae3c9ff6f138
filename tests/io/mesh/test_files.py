"""Mesh files, read back by other libraries."""

import dataclasses
import re
import zipfile
from xml.etree import ElementTree

import meshio
import numpy as np
import pytest
import trimesh

from coarse import CURVES
from plyfold import find_layering, immersions
from plyfold.colours import rgb, sheet_colour
from plyfold.errors import InputError, PrecisionError
from plyfold.io.mesh.model import single_precision
from plyfold.io.mesh.plain import obj
from plyfold.surface.files import model_of_surface
from plyfold.surface.lift import lift

ENDINGS = [".glb", ".obj", ".ply", ".stl", ".3mf"]
CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
MATERIALS = "{http://schemas.microsoft.com/3dmanufacturing/material/2015/02}"


@pytest.fixture(scope="module")
def surface():
    return lift(CURVES["stacked-spiral"].curve, triangles=300)


@pytest.fixture(scope="module")
def far_away():
    return lift(CURVES["exit-ramp"].draw() + np.array([3e7, -2e7]), triangles=300)


def triangles_read(path):
    """Corners of all triangles, shape (m, 3, 3), as the reader places them in the world."""
    return np.asarray(trimesh.load_scene(path, process=False).to_mesh().triangles)


def model_of_3mf(path):
    """The XML of the model inside."""
    with zipfile.ZipFile(path) as package:
        return ElementTree.fromstring(package.read("3D/3dmodel.model"))


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


def test_html_page(surface, tmp_path):
    surface.export(tmp_path / "out.html", title="A <spiral>")
    page = (tmp_path / "out.html").read_text(encoding="utf-8")
    assert page.lower().startswith("<!doctype html>")
    assert "A &lt;spiral&gt;" in page


@pytest.mark.parametrize("suffix", [*ENDINGS, ".html"])
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


# ---- textures, names and colours -----------------------------------------------------------------------------------


@pytest.mark.parametrize("suffix", [".obj", ".ply", ".stl"])
def test_meshio(surface, suffix, tmp_path):
    surface.export(tmp_path / f"out{suffix}")
    read = meshio.read(tmp_path / f"out{suffix}")
    triangles = np.concatenate([block.data for block in read.cells if block.type == "triangle"])
    expected = surface.vertices[surface.faces]
    if suffix == ".obj":
        expected = expected[np.argsort(surface.sheet, kind="stable")]
    if suffix == ".stl":
        assert np.allclose(read.points[triangles], expected, rtol=1e-6, atol=1e-5)
    else:
        assert np.array_equal(read.points[triangles], expected)


def test_texture_coordinates_of_obj_and_ply(surface, tmp_path):
    uv = surface.unwrap().uv
    surface.export(tmp_path / "out.ply")
    read = meshio.read(tmp_path / "out.ply").point_data
    assert np.array_equal(np.column_stack([read["s"], read["t"]]), uv)
    surface.export(tmp_path / "out.obj")
    rows = [line.split() for line in (tmp_path / "out.obj").read_text().splitlines()]
    assert np.array_equal(np.array([row[1:] for row in rows if row[0] == "vt"], dtype=float), uv)
    corners = [corner.split("/") for row in rows if row[0] == "f" for corner in row[1:]]
    assert all(place == texture for place, texture in corners)
    surface.export(tmp_path / "bare.obj", unwrapped=False)
    assert "vt" not in (tmp_path / "bare.obj").read_text()


def test_ply_with_a_colour_for_each_sheet(surface, tmp_path):
    """Readers find colours at vertices, and the corners of a triangle are of its sheet alone."""
    surface.export(tmp_path / "out.ply", colours="sheets")
    read = meshio.read(tmp_path / "out.ply")
    (block,) = read.cells
    assert np.array_equal(read.points[block.data], surface.vertices[surface.faces])
    assert np.array_equal(sheets_said(tmp_path / "out.ply")[block.data], np.repeat(surface.sheet, 3).reshape(-1, 3))
    expected = np.rint(255 * np.array([rgb(sheet_colour(sheet)) for sheet in surface.sheet]))
    colour = np.stack([read.point_data[name] for name in ("red", "green", "blue")], axis=1)
    assert (colour[block.data].astype(np.uint8) == expected[:, None]).all()  # meshio takes bytes for signed
    other = trimesh.load(tmp_path / "out.ply", process=False)
    assert (other.vertex_attributes["color"][other.faces][..., :3] == expected[:, None]).all()
    surface.export(tmp_path / "bare.ply", colours="sheets", unwrapped=False)
    bare = trimesh.load(tmp_path / "bare.ply", process=False)
    assert (bare.visual.vertex_colors[bare.faces][..., :3] == expected[:, None]).all()


def sheets_said(path):
    """The sheet of each vertex, by the comments in the header."""
    header = path.read_bytes().split(b"end_header")[0].decode().splitlines()
    said = [re.match(r"comment sheet_(\d+)_level_\d+: vertices (\d+) to (\d+)", line) for line in header]
    return np.concatenate([np.repeat(int(one[1]), 1 + int(one[3]) - int(one[2])) for one in said if one])


@pytest.mark.parametrize("colours", ["layers", "sheets"])
def test_ply_for_readers_that_want_one_type(surface, colours, tmp_path):
    """libigl reads places, normals and textures, and all that is left as one table; of two types, it aborts."""
    surface.export(tmp_path / "out.ply", colours=colours)
    header = (tmp_path / "out.ply").read_bytes().split(b"end_header")[0].decode().splitlines()
    properties = [line.split()[1:] for line in header if line.startswith("property")]
    assert len({kind for kind, *name in properties if name[-1] not in {*"xyzst", "vertex_indices"}}) == 1


def test_a_glb_with_sheets_is_hardly_longer(tmp_path):
    surface = lift(CURVES["milnor"].curve, triangles=1000)
    for colours in ("layers", "sheets"):
        surface.export(tmp_path / f"{colours}.glb", colours=colours)
    layers, sheets = ((tmp_path / f"{name}.glb").stat().st_size for name in ("layers", "sheets"))
    assert sheets < 1.2 * layers


def test_ply_with_smooth_colours(surface, tmp_path):
    surface.export(tmp_path / "out.ply")
    read = meshio.read(tmp_path / "out.ply").point_data
    colour = np.stack([read[name] for name in ("red", "green", "blue")], axis=1)
    level = surface.layering.level[surface.sheet]
    inside = [set(surface.faces[level == one].ravel()) - set(surface.faces[level != one].ravel()) for one in (1, 2, 3)]
    assert [len(np.unique(colour[list(vertices)], axis=0)) for vertices in inside] == [1, 1, 1]


def test_obj_with_materials(surface, tmp_path):
    """The library lies beside the file, and a reader finds a colour for each sheet there."""
    surface.export(tmp_path / "out.obj", colours="sheets")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["out.mtl", "out.obj"]
    scene = trimesh.load_scene(tmp_path / "out.obj", process=False)
    materials = {mesh.visual.material.name: tuple(mesh.visual.material.diffuse) for mesh in scene.geometry.values()}
    assert sorted(materials) == sorted(names(surface))
    assert len(set(materials.values())) == len(materials)


def names(surface):
    return [f"sheet_{sheet}_level_{level}" for sheet, level in enumerate(surface.layering.level.tolist())]


def test_existing_materials_stay(surface, tmp_path):
    (tmp_path / "out.mtl").write_text("precious")
    with pytest.raises(FileExistsError, match=r"out\.mtl"):
        surface.export(tmp_path / "out.obj", colours="sheets")
    assert [path.name for path in tmp_path.iterdir()] == ["out.mtl"]
    assert (tmp_path / "out.mtl").read_text() == "precious"


@pytest.mark.parametrize("which", ["surface", "far_away"])
def test_3mf_by_the_letter(which, request, tmp_path):
    """Bit for bit; an open surface is of type surface; the build puts its lowest corner at the origin."""
    surface = request.getfixturevalue(which)
    surface.export(tmp_path / "out.3mf", colours="sheets")
    root = model_of_3mf(tmp_path / "out.3mf")
    assert root.get("unit") == "millimeter"
    vertices = [[float(vertex.get(axis)) for axis in "xyz"] for vertex in root.iter(f"{CORE}vertex")]
    assert np.array_equal(vertices, surface.vertices)
    triangles = [[int(one.get(key)) for key in ("v1", "v2", "v3", "p1")] for one in root.iter(f"{CORE}triangle")]
    assert np.array_equal(triangles, np.column_stack([surface.faces, surface.sheet]))
    assert [base.get("name") for base in root.iter(f"{CORE}base")] == names(surface)
    assert len({base.get("displaycolor") for base in root.iter(f"{CORE}base")}) == len(names(surface))
    assert root.find(f".//{CORE}object").get("type") == "surface"
    place = [float(x) for x in root.find(f".//{CORE}item").get("transform").split()]
    assert np.array_equal(place, [*np.eye(3).ravel(), *-surface.vertices.min(axis=0)])


def test_3mf_read_by_trimesh(surface, tmp_path):
    surface.export(tmp_path / "out.3mf")
    read = triangles_read(tmp_path / "out.3mf")
    assert np.allclose(read, (surface.vertices - surface.vertices.min(axis=0))[surface.faces], rtol=0, atol=1e-12)


def test_3mf_with_smooth_colours(surface, tmp_path):
    """Where all triangles around a vertex are of one level, it has that level's colour in all of them."""
    surface.export(tmp_path / "out.3mf")
    root = model_of_3mf(tmp_path / "out.3mf")
    colours = [colour.get("color") for colour in root.iter(f"{MATERIALS}color")]
    assert len(set(colours)) == len(colours)
    level = surface.layering.level[surface.sheet]
    seen = {}
    for face, one, at in zip(surface.faces.tolist(), root.iter(f"{CORE}triangle"), level.tolist(), strict=True):
        for vertex, key in zip(face, ("p1", "p2", "p3"), strict=True):
            seen.setdefault(vertex, []).append((at, colours[int(one.get(key))]))
    assert all(len({colour for _, colour in here}) == 1 for here in seen.values())
    inside = {here[0] for here in seen.values() if len({at for at, _ in here}) == 1}
    assert sorted(at for at, _ in inside) == [1, 2, 3]


def test_the_same_surface_gives_the_same_files(surface, tmp_path):
    for suffix in ENDINGS:
        surface.export(tmp_path / f"one{suffix}")
        surface.export(tmp_path / f"two{suffix}")
        assert (tmp_path / f"one{suffix}").read_bytes() == (tmp_path / f"two{suffix}").read_bytes()


@pytest.mark.parametrize("suffix", ENDINGS)
def test_surfaces_that_pass_through_themselves(suffix, tmp_path):
    immersion = next(immersion for immersion in immersions(CURVES["bennequin"].curve) if not find_layering(immersion))
    surface = lift(immersion, allow_intersections=True, triangles=100)
    assert surface.intersections
    surface.export(tmp_path / f"out{suffix}")
    assert triangles_read(tmp_path / f"out{suffix}").shape == (len(surface.faces), 3, 3)


def test_unknown_colouring(surface, tmp_path):
    with pytest.raises(InputError, match="rainbow"):
        surface.export(tmp_path / "out.glb", colours="rainbow")
    assert list(tmp_path.iterdir()) == []


# ---- numbers of 32 bits --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("scale", [1e-60, 1e60])
@pytest.mark.parametrize("suffix", [".glb", ".stl"])
def test_what_32_bits_cannot_hold_is_refused(scale, suffix, tmp_path):
    surface = lift(scale * CURVES["horseshoe"].draw(), triangles=100)
    with pytest.raises(PrecisionError, match="32-bit"):
        surface.export(tmp_path / f"out{suffix}")
    surface.export(tmp_path / "out.ply")


def test_stl_has_no_place_for_far_away_drawings(far_away, tmp_path):
    with pytest.raises(PrecisionError, match="32-bit"):
        far_away.export(tmp_path / "out.stl")


def test_single_precision_keeps_detail():
    assert single_precision(np.array([[1000.0]]), detail=1.0).dtype == np.float32
    with pytest.raises(PrecisionError):
        single_precision(np.array([[1000.0]]), detail=1e-4)


def test_obj_of_numbers_that_need_all_digits(surface):
    third = dataclasses.replace(model_of_surface(surface, unwrapped=False), vertices=surface.vertices / 3)
    read = [line.split()[1:] for line in obj(third).decode().splitlines() if line.startswith("v ")]
    assert np.array_equal(np.array(read, dtype=float), third.vertices)


def test_3mf_refuses_what_its_readers_refuse(tmp_path):
    surface = lift(1e9 * CURVES["horseshoe"].draw(), triangles=50)
    with pytest.raises(PrecisionError, match="3MF"):
        surface.export(tmp_path / "out.3mf")


def test_a_disk_that_doubles_cannot_hold_is_left_out_unless_asked_for(surface, tmp_path, monkeypatch):
    def refuse(_self):
        raise PrecisionError("too thin")

    monkeypatch.setattr(type(surface), "unwrap", refuse)
    surface.export(tmp_path / "out.obj")
    assert "\nvt " not in (tmp_path / "out.obj").read_text()
    with pytest.raises(PrecisionError, match="too thin"):
        surface.export(tmp_path / "other.obj", unwrapped=True)
    assert [path.name for path in tmp_path.iterdir()] == ["out.obj"]
