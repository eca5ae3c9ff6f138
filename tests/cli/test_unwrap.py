"""``plyfold unwrap``: texture coordinates in real files."""

import numpy as np
import pytest
import trimesh

from plyfold import Curve, unwrap
from plyfold.cli.commands import main
from plyfold.errors import InputError
from plyfold.gallery import CURVES


def read_obj(path):
    """The places, texture coordinates and triangles of an OBJ, by hand, for readers merge and split vertices."""
    lines = [line.split() for line in path.read_text().splitlines()]
    places = np.array([line[1:] for line in lines if line[0] == "v"], dtype=float)
    texture = np.array([line[1:] for line in lines if line[0] == "vt"], dtype=float)
    corners = np.array([[corner.split("/") for corner in line[1:]] for line in lines if line[0] == "f"], dtype=int)
    return places, texture, corners[:, :, 0] - 1, corners[:, :, 1] - 1


def areas(points, faces):
    a, b, c = points[faces].swapaxes(0, 1)
    (ux, uy), (vx, vy) = (b - a)[:, :2].T, (c - a)[:, :2].T
    return (ux * vy - uy * vx) / 2


@pytest.mark.parametrize("immersion", [0, 1])
def test_the_map_is_one_to_one(tmp_path, immersion):
    path = tmp_path / "milnor.obj"
    assert main(["unwrap", "gallery:milnor", "--immersion", str(immersion), "-o", str(path)]) == 0
    places, texture, corners, corners_of_texture = read_obj(path)
    assert (corners == corners_of_texture).all()
    assert (areas(places, corners) > 0).all()
    assert (areas(texture, corners) > 0).all()
    assert np.pi / 4 * 0.99 < areas(texture, corners).sum() < np.pi / 4
    points = np.array(CURVES["milnor"].curve.points)
    (x, y), (u, v) = points.T, np.roll(points, -1, axis=0).T
    assert areas(places, corners).sum() == pytest.approx(((x * v - u * y) / 2).sum())
    assert {tuple(p) for p in points.tolist()} <= {tuple(p) for p in places[:, :2].tolist()}


def test_the_immersions_differ(tmp_path):
    paths = [tmp_path / f"{number}.obj" for number in (0, 1)]
    for number, path in enumerate(paths):
        main(["unwrap", "gallery:milnor", "--immersion", str(number), "-o", str(path)])
    assert paths[0].read_text() != paths[1].read_text()


def test_an_unliftable_disk_can_be_unwrapped_into_every_format(tmp_path):
    paths = [tmp_path / f"flaps{ending}" for ending in (".ply", ".glb", ".obj")]
    words = ["unwrap", "gallery:seven-flaps", *(word for path in paths for word in ("-o", str(path)))]
    assert main(words) == 0
    _, texture, corners, _ = read_obj(paths[2])
    assert (areas(texture, corners) > 0).all()
    assert len(trimesh.load(paths[0]).faces) == len(corners)
    assert sum(len(mesh.faces) for mesh in trimesh.load(paths[1]).geometry.values()) == len(corners)


def test_the_flat_drawing_is_the_glbs_first_shape(tmp_path):
    path = tmp_path / "ramp.glb"
    assert main(["unwrap", "gallery:exit-ramp", "-o", str(path)]) == 0
    scene = trimesh.load(path)
    height = scene.extents[1]  # y points up in a GLB
    assert height == 0


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["gallery:limacon", "-o", "a.obj"], "turns 2 times"),
        (["gallery:milnor", "-o", "a.stl"], ".obj .ply .glb"),
        (["gallery:milnor", "-o", "a.obj", "--immersion", "2"], "there is no immersion 2"),
        (["gallery:milnor", "-o", "a.obj", "--immersion", "-1"], "there is no immersion -1"),
        (["gallery:milnor", "-o", "a.obj", "--triangles", "0"], "triangles"),
    ],
)
def test_what_cannot_be_unwrapped(tmp_path, capsys, monkeypatch, words, said):
    monkeypatch.chdir(tmp_path)
    assert main(["unwrap", *words]) == (1 if "limacon" in words[0] else 2)
    assert said in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_existing_files_are_kept(tmp_path):
    path = tmp_path / "disk.obj"
    path.write_text("mine")
    disk = unwrap(Curve([(0, 0), (2, 0), (0, 2)]), triangles=1)
    with pytest.raises(FileExistsError):
        disk.export(path)
    assert path.read_text() == "mine"
    with pytest.raises(InputError, match="cannot be written so"):
        disk.export(tmp_path / "disk.stl")
