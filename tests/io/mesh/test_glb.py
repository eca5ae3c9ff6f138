"""GLB files by the letter of the format, read by a few lines of their own."""

import json
import struct

import numpy as np
import pytest
import trimesh

from coarse import CURVES
from plyfold.surface.lift import lift

COMPONENT = {5125: "<u4", 5126: "<f4"}
COLUMNS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}


@pytest.fixture(scope="module")
def surface():
    return lift(CURVES["stacked-spiral"].curve, triangles=300)


@pytest.fixture(scope="module")
def solid(surface):
    return surface.thicken(0.5 * surface.gap)


class Glb:
    """The JSON of a GLB, and its accessors as arrays."""

    def __init__(self, content):
        magic, version, length, json_length, kind = struct.unpack("<4sIII4s", content[:20])
        assert (magic, version, length, kind) == (b"glTF", 2, len(content), b"JSON")
        self.json = json.loads(content[20 : 20 + json_length])
        binary_length, kind = struct.unpack("<I4s", content[20 + json_length : 28 + json_length])
        self.binary = content[28 + json_length :]
        assert (kind, len(self.binary)) == (b"BIN\0", binary_length)

    def array(self, number):
        accessor = self.json["accessors"][number]
        view = self.json["bufferViews"][accessor["bufferView"]]
        columns, start = COLUMNS[accessor["type"]], view["byteOffset"] + accessor["byteOffset"]
        assert accessor["byteOffset"] + 4 * columns * accessor["count"] <= view["byteLength"]
        assert view.get("byteStride", 4 * columns) == 4 * columns
        kind = COMPONENT[accessor["componentType"]]
        values = np.frombuffer(self.binary, kind, columns * accessor["count"], start).reshape(-1, columns)
        for name, find in (("min", np.min), ("max", np.max)):
            assert accessor.get(name) in (None, find(values, axis=0).tolist())
        return values

    @property
    def primitives(self):
        (mesh,) = self.json["meshes"]
        return mesh["primitives"]

    def places(self, primitive, shape=None):
        """Positions in the world, z up, at the corners of the triangles; of the surface or of a shape by name."""
        places = self.array(primitive["attributes"]["POSITION"]).astype(float)
        if shape is not None:
            target = self.json["meshes"][0]["extras"]["targetNames"].index(shape)
            places = places + self.array(primitive["targets"][target]["POSITION"])
        x, y, z = (places + self.json["nodes"][0]["translation"]).T
        return np.stack([x, -z, y], axis=1)[self.array(primitive["indices"]).reshape(-1, 3)]

    def corners(self, shape=None):
        return np.concatenate([self.places(primitive, shape) for primitive in self.primitives])


def written(thing, tmp_path, **options):
    thing.export(tmp_path / "out.glb", **options)
    return Glb((tmp_path / "out.glb").read_bytes())


def by_sheet(surface):
    return surface.faces[np.argsort(surface.sheet, kind="stable")]


def test_one_material_per_sheet(surface, tmp_path):
    glb = written(surface, tmp_path, colours="sheets")
    names = [f"sheet_{sheet}_level_{level}" for sheet, level in enumerate(surface.layering.level.tolist())]
    assert [material["name"] for material in glb.json["materials"]] == names
    colours = {tuple(m["pbrMetallicRoughness"]["baseColorFactor"]) for m in glb.json["materials"]}
    assert len(colours) == len(names)
    assert [primitive["material"] for primitive in glb.primitives] == list(range(len(names)))
    sizes = [len(glb.places(primitive)) for primitive in glb.primitives]
    assert sizes == np.bincount(surface.sheet).tolist()
    assert np.allclose(glb.corners(), surface.vertices[by_sheet(surface)], atol=1e-5)


def test_one_material_with_colours_of_layers(surface, tmp_path):
    """Inside a layer its colour, light as the eye sees it; between layers something between."""
    glb = written(surface, tmp_path)
    (primitive,) = glb.primitives
    assert [material["name"] for material in glb.json["materials"]] == ["cloth"]
    colour = glb.array(primitive["attributes"]["COLOR_0"])
    level = surface.layering.level[surface.sheet]
    inside = [set(surface.faces[level == one].ravel()) - set(surface.faces[level != one].ravel()) for one in (1, 2, 3)]
    colours = [{tuple(row) for row in colour[list(vertices)].tolist()} for vertices in inside]
    assert all(len(of_layer) == 1 for of_layer in colours)
    low, middle, high = (next(iter(of_layer)) for of_layer in colours)
    assert low < middle < high
    assert low == pytest.approx((0.010960, 0.078187, 0.313989), abs=1e-6)  # 27, 79, 152 of 255 in sRGB
    assert np.allclose(glb.corners(), surface.vertices[surface.faces], atol=1e-5)


@pytest.mark.parametrize("colours", ["layers", "sheets"])
def test_both_sides_are_shown(surface, colours, tmp_path):
    assert all(material["doubleSided"] for material in written(surface, tmp_path, colours=colours).json["materials"])


@pytest.mark.parametrize("colours", ["layers", "sheets"])
def test_normals(surface, colours, tmp_path):
    """Those that another library finds, weighted by area; across sheets they are smooth."""
    glb = written(surface, tmp_path, colours=colours)
    faces = surface.faces if colours == "layers" else by_sheet(surface)
    read = np.concatenate([glb.array(p["attributes"]["NORMAL"])[glb.array(p["indices"])[:, 0]] for p in glb.primitives])
    summed = np.zeros_like(surface.vertices)
    a, b, c = surface.vertices[surface.faces].swapaxes(0, 1)
    for corner in range(3):
        np.add.at(summed, surface.faces[:, corner], np.cross(b - a, c - a))
    x, y, z = (summed / np.linalg.norm(summed, axis=1, keepdims=True))[faces.ravel()].T
    assert np.allclose(read, np.stack([x, z, -y], axis=1), atol=1e-6)


@pytest.mark.parametrize("colours", ["layers", "sheets"])
def test_texture_coordinates(surface, colours, tmp_path):
    """Those of the unwound disk, counted from the top as the format wants."""
    glb = written(surface, tmp_path, colours=colours)
    faces = surface.faces if colours == "layers" else by_sheet(surface)
    read = np.concatenate(
        [glb.array(p["attributes"]["TEXCOORD_0"])[glb.array(p["indices"])[:, 0]] for p in glb.primitives]
    )
    assert np.allclose(read * (1, -1) + (0, 1), surface.unwrap().uv[faces.ravel()], atol=1e-6)


@pytest.mark.parametrize("colours", ["layers", "sheets"])
def test_morph_targets(surface, colours, tmp_path):
    """Flat, the surface is the drawing; as a disk, its boundary is a circle as wide as the drawing."""
    glb = written(surface, tmp_path, colours=colours)
    faces = surface.faces if colours == "layers" else by_sheet(surface)
    flat, disk = glb.corners("flat"), glb.corners("disk")
    assert np.allclose(flat, surface.vertices[faces] * (1, 1, 0), atol=1e-5)
    assert np.allclose(disk[..., 2], 0, atol=1e-5)
    for primitive in glb.primitives:
        normal = glb.array(primitive["attributes"]["NORMAL"])
        assert all(np.allclose(normal + glb.array(target["NORMAL"]), (0, 1, 0)) for target in primitive["targets"])
    plane = surface.vertices[:, :2]
    radius = np.hypot(*np.moveaxis(disk[..., :2] - (plane.min(axis=0) + plane.max(axis=0)) / 2, -1, 0))
    rim = faces < len(surface.boundary)
    assert np.allclose(radius[rim], np.ptp(plane, axis=0).max() / 2, atol=1e-4)
    assert (radius[~rim] < np.ptp(plane, axis=0).max() / 2).all()
    a, b, c = np.moveaxis(disk[..., :2], 1, 0)
    assert (area(a, b, c) > 0).all()


def area(a, b, c):
    (ux, uy), (vx, vy) = (b - a).T, (c - a).T
    return ux * vy - uy * vx


def animation_of(glb):
    """The times of the animation and the weight of each shape then."""
    (animation,) = glb.json["animations"]
    (sampler,) = animation["samplers"]
    assert sampler["interpolation"] == "LINEAR"
    assert animation["channels"] == [{"sampler": 0, "target": {"node": 0, "path": "weights"}}]
    times = glb.array(sampler["input"]).ravel()
    return times, glb.array(sampler["output"]).reshape(len(times), -1)


def test_animation_goes_there_and_back(surface, tmp_path):
    """It rests on the surface for a moment: at frame 1 of 24 in a second, nothing has moved yet."""
    glb = written(surface, tmp_path)
    names = glb.json["meshes"][0]["extras"]["targetNames"]
    count = len(names)
    times, weights = animation_of(glb)
    assert times[0] == 0
    assert times[1] > 1 / 24
    assert (np.diff(times) > 0).all()
    there = [[0] * count, *np.eye(count).tolist()]
    assert weights.tolist() == [[0] * count, *there, *there[-2::-1]]
    assert glb.json["meshes"][0]["weights"] == [0] * count
    assert names == ["flat", *(f"unwinding {number + 1}" for number in range(count - 2)), "disk"]
    assert count >= 5


@pytest.mark.parametrize("name", ["stacked-spiral", "two-loops", "milnor"])
def test_nothing_folds_over_in_the_animation(name, tmp_path):
    """As a player shows it, seen from above, by 32-bit numbers: each triangle keeps its side up at all times."""
    glb = written(lift(CURVES[name].curve, triangles=1000), tmp_path)
    names = glb.json["meshes"][0]["extras"]["targetNames"]
    base = glb.corners()
    moves = [glb.corners(shape) - base for shape in names]
    times, weights = animation_of(glb)
    for time in np.linspace(0, times[-1], 150):
        weight = [np.interp(time, times, column) for column in weights.T]
        corners = base + sum(share * move for share, move in zip(weight, moves, strict=True) if share)
        assert (area(*np.moveaxis(corners[..., :2], 1, 0)) > 0).all()


def test_without_the_disk(surface, tmp_path):
    glb = written(surface, tmp_path, unwrapped=False)
    assert sorted(glb.primitives[0]["attributes"]) == ["COLOR_0", "NORMAL", "POSITION"]
    assert "targets" not in glb.primitives[0]
    assert "animations" not in glb.json


@pytest.mark.parametrize("colours", ["layers", "sheets"])
def test_solid(solid, colours, tmp_path):
    """The walls are not smoothed, so vertices are doubled there; as a body it is still closed."""
    glb = written(solid, tmp_path, colours=colours)
    corners = glb.corners()
    order = np.argsort(solid.sheet, kind="stable") if colours == "sheets" else slice(None)
    assert np.allclose(corners, solid.vertices[solid.faces[order]], atol=1e-5)
    for primitive in glb.primitives:
        normal = glb.array(primitive["attributes"]["NORMAL"])[glb.array(primitive["indices"]).reshape(-1, 3)]
        normal = np.stack([normal[..., 0], -normal[..., 2], normal[..., 1]], axis=-1)
        a, b, c = np.moveaxis(glb.places(primitive), 1, 0)
        outside = np.cross(b - a, c - a)
        assert (normal * outside[:, None]).sum(axis=2).min() > 0
        wall = np.abs(outside[:, 2]) < 1e-4 * np.linalg.norm(outside, axis=1)
        across = outside[wall] / np.linalg.norm(outside[wall], axis=1, keepdims=True)
        assert np.allclose(normal[wall], across[:, None], atol=1e-3)
    flat = solid.vertices * (1, 1, 0)
    flat[:, 2] = np.repeat([0.5, -0.5], len(flat) // 2) * solid.height
    assert np.allclose(glb.corners("flat"), flat[solid.faces[order]], atol=1e-5)
    body = trimesh.load(tmp_path / "out.glb", force="mesh")
    body.merge_vertices(merge_tex=True, merge_norm=True)
    assert body.is_watertight
