"""What Blender makes of the files; where its Python module is installed (``bpy``, for one version of Python each)."""

import numpy as np
import pytest

from coarse import CURVES
from plyfold.colours import rgb, sheet_colour
from plyfold.surface.lift import lift

bpy = pytest.importorskip("bpy", exc_type=ImportError)


@pytest.fixture(scope="module")
def surface():
    return lift(CURVES["exit-ramp"].curve, triangles=300)


@pytest.fixture(scope="module")
def solid(surface):
    return surface.thicken(0.5 * surface.gap)


def read(path):
    """The only object of a file, as Blender imports it; of an OBJ it has to be told that z points up."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    importer = {
        ".glb": bpy.ops.import_scene.gltf,
        ".obj": bpy.ops.wm.obj_import,
        ".ply": bpy.ops.wm.ply_import,
        ".stl": bpy.ops.wm.stl_import,
    }
    upright = {"up_axis": "Z", "forward_axis": "Y"} if path.suffix == ".obj" else {}
    importer[path.suffix](filepath=str(path), **upright)
    (found,) = bpy.data.objects
    return found


def corners(found, shape=None):
    """Corners of all triangles in the world, shape (m, 3, 3); of a shape key by name."""
    points = found.data.vertices if shape is None else found.data.shape_keys.key_blocks[shape].data
    places = np.array([tuple(found.matrix_world @ point.co) for point in points])
    return places[[tuple(polygon.vertices) for polygon in found.data.polygons]]


def sorted_triangles(triangles):
    """Triangles by their middles, so that the order in which they come does not matter."""
    middle = triangles.mean(axis=1).round(3)
    return triangles.mean(axis=1)[np.lexsort(middle.T)]


def assert_same(read_triangles, expected):
    assert read_triangles.shape == expected.shape
    assert np.allclose(sorted_triangles(read_triangles), sorted_triangles(expected), atol=2e-3)


@pytest.mark.parametrize("colours", ["layers", "sheets"])
def test_glb(surface, colours, tmp_path):
    surface.export(tmp_path / "out.glb", colours=colours)
    found = read(tmp_path / "out.glb")
    assert_same(corners(found), surface.vertices[surface.faces])
    names = [f"sheet_{sheet}_level_{level}" for sheet, level in enumerate(surface.layering.level.tolist())]
    assert [material.name for material in found.data.materials] == (names if colours == "sheets" else ["cloth"])
    assert [layer.name for layer in found.data.uv_layers] == ["UVMap"]
    assert len(found.data.color_attributes) == (colours == "layers")


def test_shape_keys_of_a_glb(surface, tmp_path):
    surface.export(tmp_path / "out.glb")
    found = read(tmp_path / "out.glb")
    assert [key.name for key in found.data.shape_keys.key_blocks] == [
        "Basis",
        "flat",
        "unwinding 1",
        "unwinding 2",
        "unwinding 3",
        "disk",
    ]
    bpy.context.scene.frame_set(1)
    assert [key.value for key in found.data.shape_keys.key_blocks[1:]] == [0] * 5
    assert [action.name for action in bpy.data.actions] == ["unwind"]
    assert_same(corners(found, "flat"), surface.vertices[surface.faces] * (1, 1, 0))
    disk = corners(found, "disk")[..., :2].reshape(-1, 2)
    plane = surface.vertices[:, :2]
    radius = np.hypot(*(disk - (plane.min(axis=0) + plane.max(axis=0)) / 2).T)
    assert radius.max() == pytest.approx(np.ptp(plane, axis=0).max() / 2, rel=1e-4)


def test_texture_coordinates(surface, tmp_path):
    """At every corner, those of the unwound disk, whatever the format counts from."""
    for suffix in (".glb", ".obj", ".ply"):
        surface.export(tmp_path / f"out{suffix}")
        found = read(tmp_path / f"out{suffix}")
        uv = np.array([tuple(loop.uv) for loop in found.data.uv_layers[0].data])
        places = corners(found).reshape(-1, 3)
        expected = surface.unwrap().uv[surface.faces].reshape(-1, 2)
        at = surface.vertices[surface.faces].reshape(-1, 3)
        for place, texture in list(zip(places, uv, strict=True))[::17]:
            nearest = np.argmin(np.abs(at - place).sum(axis=1))
            assert np.allclose(texture, expected[nearest], atol=1e-4)


def test_ply_with_a_colour_for_each_sheet(surface, tmp_path):
    surface.export(tmp_path / "out.ply", colours="sheets")
    found = read(tmp_path / "out.ply")
    (layer,) = found.data.color_attributes
    shown = {tuple(round(255 * part) for part in point.color_srgb)[:3] for point in layer.data}
    assert shown == {tuple(round(255 * part) for part in rgb(sheet_colour(sheet))) for sheet in surface.sheet.tolist()}


@pytest.mark.parametrize("suffix", [".glb", ".obj", ".ply", ".stl"])
def test_solid(solid, suffix, tmp_path):
    solid.export(tmp_path / f"out{suffix}", colours="sheets")
    found = read(tmp_path / f"out{suffix}")
    assert_same(corners(found), solid.vertices[solid.faces])
    named = {".glb": len(solid.surface.layering.level), ".obj": len(solid.surface.layering.level)}
    assert len(found.data.materials) == named.get(suffix, 0)
