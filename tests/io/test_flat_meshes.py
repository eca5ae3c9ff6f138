"""Flat meshes as OBJ and PLY: their boundary is read as an outline, with its cusps."""

import struct

import numpy as np
import pytest
import trimesh

import plyfold as pf
from plyfold.errors import CurveError, FileFormatError

RING = [(0, 0), (9, 0), (9, 9), (0, 9), (3, 3), (6, 3), (6, 6), (3, 6)]
QUADS = [(0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
OUTER, INNER = RING[:4], [RING[4], RING[7], RING[6], RING[5]]


def obj(corner="{}", rows=RING):
    lines = [f"v {x} {y} 0" for x, y in rows] + [f"vt {y} {x}" for x, y in rows] + ["vn 0 0 1"]
    lines += ["f " + " ".join(corner.format(i + 1) for i in quad) for quad in QUADS]
    return "\n".join(["# a ring", "o ring", *lines]) + "\n"


def places(outline):
    return [[tuple(map(int, place)) for place in loop] for loop in outline.loops]


@pytest.mark.parametrize("corner", ["{}", "{0}/{0}", "{0}//1", "{0}/{0}/1"])
@pytest.mark.parametrize("name", ["ring.obj", "ring.txt", "ring"])
def test_a_ring_as_obj(read, corner, name):
    outline = read(name, obj(corner))
    assert places(outline) == [OUTER, INNER]
    assert outline.repairs == ()
    assert not outline.has_cusps


def test_negative_corners_count_backward(read):
    content = "v 0 0 0\nv 4 0 0\nv 0 3 0\nf -3 -2 -1\nv 4 3 0\nf -1 -2 -3\n"
    assert places(read("back.obj", content)) == [[(0, 0), (4, 0), (4, 3), (0, 3)]]


def test_the_chart_of_an_obj(read):
    content = "v 0 0 0\nv 4 0 7\nv 0 3 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1 0\nf 1/1 2/2 3/3\nf 1/1 3/3 2/4\n"
    assert places(read("chart.obj", content, uv=True)) == [[(0, 0), (1, 0), (1, 1), (0, 1)]]
    with pytest.raises(CurveError, match=r"chart\.obj: the mesh is closed"):
        read("chart.obj", content)
    with pytest.raises(FileFormatError, match="line 20: the corner '1' has no place in the chart"):
        read("none.obj", obj(), uv=True)


def test_heights_are_left_out_with_a_word(read):
    content = obj().replace("v 9 0 0", "v 9 0 5")
    assert [str(repair) for repair in read("bent.obj", content).repairs] == ["z left out at (0, 0)"]


def test_faces_of_many_corners_are_cut_from_a_corner_that_sees_all(read):
    """From its first corner the arrowhead cannot be cut."""
    rows = [(0, 0), (4, 4), (0, 2), (-4, 4)]
    lines = [f"v {x} {y}" for x, y in rows]
    for start in range(4):
        corners = " ".join(str((start + i) % 4 + 1) for i in range(4))
        outline = read("arrow.obj", "\n".join([*lines, f"f {corners}"]))
        assert sorted(places(outline)[0]) == sorted(rows)
    comb = [(0, 0), (9, 0), (9, 9), (8, 9), (8, 1), (5, 1), (5, 9), (4, 9), (4, 1), (1, 1), (1, 9), (0, 9)]
    content = "\n".join([*(f"v {x} {y}" for x, y in comb), "f " + " ".join(map(str, range(1, 13)))])
    with pytest.raises(FileFormatError, match="face 0 is cut into triangles from none of its 12 corners"):
        read("comb.obj", content)


def test_lines_may_be_folded(read):
    assert places(read("folded.obj", "v 0 0\nv 4 \\\n0\nv 0 3\nf 1 \\\n 2 \\\n 3\n")) == [[(0, 0), (4, 0), (0, 3)]]


@pytest.mark.parametrize(
    ("content", "complaint"),
    [
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\n", "no face"),
        ("v 0 0 0\nv one 0 0\n", "line 2: 'one 0 0' is no place"),
        ("v 0\n", "line 1: 1 numbers"),
        ("v 0 0\nf 1 2\n", "line 2: a face with 2 corners"),
        ("v 0 0\nv 1 0\nv 0 1\nf 1 2 4\n", "face 0 has the vertex 3, counted from 0, and the mesh has 3"),
        ("v 0 0\nv 1 0\nv 0 1\nf 1 2 0\n", "line 4: there is no vertex 0"),
        ("v 0 0\nv 1 0\nv 0 1\nf 1 2 -4\n", "line 4: there is no vertex -4"),
        ("v 0 0\nv 1 0\nv 0 1\nf 1 2 b\n", "line 4: 'b' is no corner"),
    ],
)
def test_broken_obj(refused, content, complaint):
    refused("broken.obj", content, complaint)


def test_triangles_that_lie_wrong_are_named(read):
    with pytest.raises(CurveError, match="triangle 0 is flat"):
        read("flat.obj", "v 0 0\nv 1 1\nv 2 2\nf 1 2 3\n")


# ---- PLY -------------------------------------------------------------------------------------------------------------


def ply(order, faces=QUADS, vertices=RING, more=""):
    head = ["ply", f"format {order} 1.0", "comment made up", f"element vertex {len(vertices)}"]
    head += ["property double x", "property float y", "property uchar red", f"element face {len(faces)}"]
    head += ["property list uchar int vertex_indices", "property short group"]
    text = "\n".join([*head, "end_header"]) + "\n"
    if order == "ascii":
        rows = [f"{x} {y} 200" for x, y in vertices] + [f"{len(f)} {' '.join(map(str, f))} 7" for f in faces]
        return (text + "\n".join(rows) + more).encode()
    way = "<" if order == "binary_little_endian" else ">"
    body = b"".join(struct.pack(f"{way}dfB", x, y, 200) for x, y in vertices)
    return text.encode() + body + b"".join(struct.pack(f"{way}B{len(f)}ih", len(f), *f, 7) for f in faces)


@pytest.mark.parametrize("order", ["ascii", "binary_little_endian", "binary_big_endian"])
@pytest.mark.parametrize("name", ["ring.ply", "ring"])
def test_a_ring_as_ply(read, order, name):
    assert places(read(name, ply(order))) == [OUTER, INNER]


def test_the_chart_of_a_ply(read):
    content = ply("ascii").replace(b"double x", b"double s").replace(b"float y", b"float t")
    assert places(read("chart.ply", content, uv=True)) == [OUTER, INNER]
    with pytest.raises(FileFormatError, match="no x and y"):
        read("chart.ply", content)
    with pytest.raises(FileFormatError, match="no texture coordinates"):
        read("ring.ply", ply("ascii"), uv=True)


@pytest.mark.parametrize(
    ("content", "complaint"),
    [
        (b"ply\nformat ascii 1.0\n", "its header does not end"),
        (b"hello", "no PLY file"),
        (b"ply\nelement vertex 0\nend_header\n", "does not say in which format"),
        (b"ply\nformat ascii 1.0\nelement vertex many\nend_header\n", "line 3: 'element vertex many'"),
        (b"ply\nformat ascii 1.0\nproperty double x\nend_header\n", "line 3: 'property double x'"),
        (b"ply\nformat klingon 1.0\nend_header\n", "line 2: 'format klingon 1.0'"),
        (ply("binary_big_endian")[:-1], "face 3 is broken, or missing"),
        (ply("binary_little_endian")[:-40], "face 1 is broken, or missing"),
        (ply("ascii")[:-10], "face 3 is broken, or missing"),
        (ply("ascii").replace(b"9 0 200", b"9 zero 200"), "vertex 1 is broken, or missing"),
        (ply("ascii", [(0, 1, 8)]), "face 0 has the vertex 8, counted from 0, and the mesh has 8"),
        (ply("ascii", [(0, 1, -1)]), "face 0 has the vertex -1"),
        (ply("ascii", []), "no face"),
        (ply("ascii", [(0, 1)]), "face 0 has 2 corners"),
        (ply("ascii", [(0, "nan", 1)]), "face 0 has a corner that is no number"),
        (ply("ascii", [(0, "inf", 1)]), "face 0 has a corner that is no number"),
        (ply("ascii", [(0, 1, 2)]).replace(b"\n3 0 1 2", b"\ninf 0 1 2"), "face 0 is broken, or missing"),
        (ply("ascii", [(0, 1, 2)]).replace(b"\n3 0 1 2", b"\n-1 0 1 2"), "face 0 is broken, or missing"),
        (
            ply("ascii", [(0, 1, 2)], [("2 4 4", 0), ("1 4", 0), ("1 0", 3)]).replace(b"double x", b"list uchar int x"),
            "lists as coordinates",
        ),
        (b"ply\nformat ascii 1.0\nelement vertex 9999999999\nproperty double x\nend_header\n1\n", "vertex 1 is broken"),
    ],
)
def test_broken_ply(refused, content, complaint):
    refused("broken.ply", content, complaint)


# ---- what others write, and what plyfold writes ----------------------------------------------------------------------


@pytest.mark.parametrize("encoding", ["ascii", "binary"])
def test_what_trimesh_writes(read, encoding):
    mesh = trimesh.Trimesh([(*place, 0) for place in RING], [t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))])
    assert places(read("ring.ply", mesh.export(file_type="ply", encoding=encoding))) == [OUTER, INNER]
    assert places(read("ring.obj", mesh.export(file_type="obj"))) == [OUTER, INNER]


def test_flat_meshes_of_plyfold_give_the_outline_back(tmp_path):
    """And the chart of the lifted surface is the round disk."""
    curve = pf.gallery.named_curve("exit-ramp").curve
    pf.unwrap(curve, triangles=50).export(tmp_path / "flat.obj")
    pf.lift(curve, triangles=50).export(tmp_path / "surface.ply")
    for name, repairs in (("flat.obj", 0), ("surface.ply", 1)):
        boundary = pf.read(tmp_path / name)
        assert {*map(tuple, curve.points.tolist())} <= {*map(tuple, boundary.points.tolist())}
        assert pf.arrange(boundary).n_crossings == pf.arrange(curve).n_crossings
        assert len(boundary.repairs) == repairs
        disk = pf.read(tmp_path / name, uv=True)
        assert np.hypot(*(2 * disk.points - 1).T) == pytest.approx(1)


def test_a_spiral_stair_has_a_cusp(read, tmp_path):
    angle = np.radians(50 * np.arange(9))
    rows = [(0.0, 0.0), *zip(np.cos(angle), np.sin(angle), strict=True), (5.0, 5.0), (6.0, 5.0), (5.0, 6.0)]
    faces = [f"f 1 {i} {i + 1}" for i in range(2, 10)] + ["f 11 12 13"]
    outline = read("stair.obj", "\n".join([*(f"v {x} {y} 0" for x, y in rows), *faces]))
    assert [np.flatnonzero(index).tolist() for index in outline.cusps] == [[0], []]
    stair, triangle = pf.io.read_each(tmp_path / "stair.obj")
    assert (len(stair), stair.has_cusps, len(triangle)) == (10, True, 3)
    assert stair.repairs == triangle.repairs == ()
    assert len(pf.read(tmp_path / "stair.obj", index=1)) == 3


@pytest.mark.parametrize("options", [{"id": "a"}, {"index": 1}])
def test_parts_of_a_mesh_are_chosen_by_index(read, options):
    with pytest.raises(FileFormatError, match=r"have no id|no shape 1") as caught:
        read("ring.obj", obj(), **options)
    assert caught.value.hint


def test_only_meshes_have_a_chart(read):
    with pytest.raises(FileFormatError, match="only a mesh has texture coordinates"):
        read("loop.csv", "0,0\n4,0\n0,3\n", uv=True)
