"""Outlines on the command line: several loops, cusps, one of many shapes or each of them."""

import json
from pathlib import Path

import numpy as np
import pytest
import trimesh

import plyfold as pf
from plyfold.cli.commands import main
from reference.random_curves import HANDLE, LIMACON

SQUARE = "M0 0H9V9H0Z"
HOLE = "M2 2V4H4V2Z"
FAR = "M20 0H29V9H20Z"
EIGHT = "M0 20L2 22V20L0 22Z"


def svg(*paths):
    drawn = "".join(f'<path id="{name}" d="{data}"/>' for name, data in paths)
    return f'<svg xmlns="http://www.w3.org/2000/svg">{drawn}</svg>'


def rows(points):
    return "".join(f"{x},{y}\n" for x, y in points)


@pytest.fixture
def file(tmp_path):
    def file(name, content):
        path = tmp_path / name
        path.write_text(content)
        return str(path)

    return file


@pytest.fixture
def ring(file):
    return file("ring.svg", svg(("ring", SQUARE + HOLE)))


@pytest.fixture
def three(file):
    return file("three.svg", svg(("ring", SQUARE + HOLE), ("far", FAR), ("eight", EIGHT)))


@pytest.fixture
def limacon(file):
    return file("limacon.csv", rows(LIMACON))


def lines(capsys):
    return [json.loads(line) for line in capsys.readouterr().out.splitlines()]


# ---- the verdict -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("paths", "surface", "euler"),
    [
        (SQUARE + HOLE, "a ring of cloth", 0),
        (SQUARE + HOLE + "M5 5V7H7V5Z", "a disk of cloth with 2 holes", -1),
        (SQUARE + FAR, "2 pieces of cloth: 2 disks", 2),
        (SQUARE + HOLE + FAR, "2 pieces of cloth: a ring and a disk", 1),
    ],
)
def test_check_names_the_surface(paths, surface, euler, file, capsys):
    drawing = file("drawing.svg", svg(("all", paths)))
    assert main(["check", drawing]) == 0
    said = capsys.readouterr().out
    assert said.startswith(f"Yes. This is the outline of {surface}, which can lie in one way.\n")
    assert f"Euler characteristic     {euler}\n" in said
    assert "layering                 yes, on 1 level(s)\n" in said
    assert main(["check", drawing, "--json"]) == 0
    [found] = lines(capsys)
    assert (found["surface"], found["euler_characteristic"], found["loops"]) == (surface, euler, paths.count("M"))
    assert sum(piece["euler_characteristic"] for piece in found["pieces"]) == euler
    assert sorted(loop for piece in found["pieces"] for loop in piece["loops"]) == list(range(found["loops"]))


def test_check_of_loops_that_bound_nothing(file, capsys):
    drawing = file("drawing.svg", svg(("all", SQUARE + "M20 2V4H40V2Z")))
    assert main(["check", drawing]) == 1
    assert capsys.readouterr().out.startswith("No surface. The curves wind -1 times")


def test_check_of_a_handle(file, capsys):
    drawing = file("handle.csv", rows(HANDLE))
    assert main(["check", drawing, "--json"]) == 0
    [found] = lines(capsys)
    assert found["surface"] == "a disk of cloth with a handle"
    assert found["pieces"] == [{"loops": [0], "euler_characteristic": -1, "genus": 1}]


def test_without_time_nothing_is_known(ring, capsys):
    assert main(["check", ring, "--time-limit", "0"]) == 3
    assert capsys.readouterr().out.startswith("Unknown. ")
    assert main(["check", ring, "--time-limit", "0", "--json"]) == 3
    [found] = lines(capsys)
    assert found["immersible"] is None


def test_help_names_every_key_of_the_json(ring, limacon, three, capsys):
    with pytest.raises(SystemExit):
        main(["check", "--help"])
    described = capsys.readouterr().out.partition("the object")[2]
    for words in ([ring], [limacon, "--cusp", "6"], [limacon], [three, "--each"]):
        main(["check", *words, "--json"])
        assert [key for found in lines(capsys) for key in found if key not in described] == []


# ---- cusps -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("cusp", [["--cusp", "7"], ["--cusp", "0:7"], ["--cusp", "0:7x1"], ["--cusp=0:7×1"]])
def test_a_cusp_makes_a_disk_of_the_limacon(cusp, limacon, capsys):
    assert main(["check", limacon]) == 1
    capsys.readouterr()
    assert main(["check", limacon, *cusp]) == 0
    assert "cusps                    0:7 at (1, -1)\n" in capsys.readouterr().out
    assert main(["check", limacon, *cusp, "--json"]) == 0
    [found] = lines(capsys)
    assert found["cusps"] == [{"loop": 0, "point": 7, "index": 1, "where": [1, -1]}]
    assert (found["surface"], found["immersions"], found["levels"]) == ("a disk of cloth", 1, 2)


def test_cusps_are_added_to_those_of_the_file_and_change_their_index(file, tmp_path):
    drawing = file("cusps.json", '{"loops": [[[0, 0], [4, 0], [0, 3]], [[9, 9], [8, 9], [9, 8]]], "cusps": {"0:1": 1}}')
    out = str(tmp_path / "out.json")
    assert main(["convert", drawing, "--cusp", "1:2x3", "--cusp", "0:1x0", "--cusp", "2", "-o", out]) == 0
    assert [index.tolist() for index in pf.read(out).cusps] == [[0, 0, 1], [0, 0, 3]]


@pytest.mark.parametrize(
    ("cusp", "complaint"),
    [("8", "no point 0:8 to be a cusp"), ("1:0", "the outline has 1 loop"), ("0:99", "loop 0 has points 0 to 7")],
)
def test_cusps_that_are_not_there(cusp, complaint, limacon, capsys):
    assert main(["check", limacon, "--cusp", cusp]) == 2
    assert complaint in capsys.readouterr().err


@pytest.mark.parametrize("cusp", ["", "a", "1:2:3", "-1", "1x", "x2", "1.5", "0:1x-1"])
def test_cusps_that_are_none(cusp, limacon, capsys):
    with pytest.raises(SystemExit) as caught:
        main(["check", limacon, f"--cusp={cusp}"])
    assert caught.value.code == 2
    assert "is no cusp: write POINT" in capsys.readouterr().err


def test_cusps_are_offered_and_taken(limacon, tmp_path, capsys):
    assert main(["check", limacon]) == 1
    said = capsys.readouterr().out
    offered = f"with a cusp 0:7 at (1, -1), it is a disk of cloth: plyfold check {limacon} --cusps auto"
    assert f"\n  1 turn is too many: {offered}\n" in said
    main(["check", limacon, "--json"])
    [found] = lines(capsys)
    (offer,) = [offer for offer in found["offers"] if offer["kind"] == "cusps"]
    assert offer["cusps"] == [{"loop": 0, "point": 7, "index": 1, "where": [1, -1]}]
    assert main(["check", limacon, "--cusps", "auto"]) == 0
    assert "note: cusp proposed at (1, -1)\n" in capsys.readouterr().out
    assert main(["convert", limacon, "--cusps", "auto", "-o", str(tmp_path / "out.json")]) == 0
    assert pf.read(tmp_path / "out.json").cusps[0].tolist() == [0, 0, 0, 0, 0, 0, 0, 1]


def test_cusps_of_an_outline_that_needs_none(ring, capsys):
    assert main(["check", ring, "--cusps", "auto"]) == 0
    assert "cusp proposed" not in capsys.readouterr().out


@pytest.mark.parametrize("name", ["linked-rings", "letter-g"])
def test_no_cusps_are_proposed_where_pieces_lie_without(name, capsys):
    main(["check", f"gallery:{name}", "--cusps", "auto"])
    assert "cusp" not in capsys.readouterr().out


def test_cusps_are_not_proposed_for_a_moved_outline_if_that_is_refused(file, capsys):
    touching = file("touching.csv", "3,0\n1,3\n-2,0\n1,-3\n3,0.5\n1,1\n0.5,0\n1,-1\n-2,0\n")
    assert main(["check", touching, "--cusps", "auto", "--general-position", "raise"]) == 2
    assert "not in general position" in capsys.readouterr().err


def test_what_was_changed_is_said_beside_other_answers(limacon, tmp_path, capsys):
    main(["lift", str(limacon), "--cusps", "auto", "-o", str(tmp_path / "limacon.glb")])
    assert capsys.readouterr().err.startswith("note: cusp proposed at ")


def test_cusps_that_are_not_found(file, limacon, capsys):
    eights = file("eights.csv", rows([*LIMACON, (0, 9), (-9, 9), (-9, 8), (0, 10)]))
    assert main(["check", eights, "--cusps", "auto"]) == 1
    assert capsys.readouterr().err.startswith("plyfold: ")
    assert main(["check", limacon, "--cusps", "auto", "--time-limit", "0"]) == 3
    assert "name the cusps with --cusp" in capsys.readouterr().err


# ---- which shapes ----------------------------------------------------------------------------------------------------


def test_one_shape_is_chosen(three, capsys):
    for words, loops in ([], 4), (["--id", "ring"], 2), (["--index", "1"], 1):
        main(["check", three, "--json", *words])
        assert [found["loops"] for found in lines(capsys)] == [loops]
    for words, complaint in (["--index", "3"], "no shape 3 in it"), (["--id", "x"], "no shape in it has the id 'x'"):
        assert main(["check", three, *words]) == 2
        assert complaint in capsys.readouterr().err


def test_each_shape_has_a_line_of_json(three, capsys):
    assert main(["check", three, "--each", "--json"]) == 1
    found = lines(capsys)
    assert [(shape["index"], shape["id"], shape["loops"]) for shape in found] == [
        (0, "ring", 2),
        (1, "far", 1),
        (2, "eight", 1),
    ]
    assert [shape["immersible"] for shape in found] == [True, True, False]


def test_each_shape_has_its_text(three, capsys):
    assert main(["check", three, "--each"]) == 1
    said = capsys.readouterr().out.splitlines()
    assert [line for line in said if line.startswith("shape")] == ["shape 0 (ring)", "shape 1 (far)", "shape 2 (eight)"]


@pytest.mark.parametrize(
    ("paths", "code"),
    [
        ([SQUARE, FAR], 0),
        ([SQUARE, EIGHT], 1),
        ([SQUARE, "M0 0L9 9", EIGHT], 2),
        ([SQUARE, "M0 0L4 4L8 8Z", SQUARE], 2),
    ],
)
def test_the_exit_code_of_each_is_the_worst(paths, code, file, capsys):
    drawing = file("several.svg", svg(*((f"s{i}", path) for i, path in enumerate(paths))))
    assert main(["check", drawing, "--each", "--json"]) == code
    found = lines(capsys)
    assert len(found) == len(paths)
    assert [shape["index"] for shape in found] == list(range(len(paths)))
    assert [("error" in shape) for shape in found].count(True) == (code == 2)


def test_each_of_features_and_geometries(file, capsys):
    wkt = file(
        "two.wkt",
        "POLYGON ((0 0, 4 0, 0 3, 0 0))\nPOLYGON ((9 9, 8 9, 9 8, 9 9), (8.9 8.9, 8.8 8.9, 8.9 8.8, 8.9 8.9))",
    )
    assert main(["check", wkt, "--each", "--json"]) == 0
    assert [shape["loops"] for shape in lines(capsys)] == [1, 2]


def test_each_writes_numbered_files(three, tmp_path, capsys):
    out = tmp_path / "out.json"
    assert main(["convert", three, "--each", "-o", str(out)]) == 0
    assert sorted(path.name for path in tmp_path.glob("out*")) == ["out-0.json", "out-1.json", "out-2.json"]
    assert pf.read(tmp_path / "out-0.json").n_loops == 2
    assert main(["convert", three, "--each", "-o", str(out)]) == 2
    assert capsys.readouterr().err.count("exists already") == 3


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["--each", "--index", "0"], "give one of them"),
        (["--each", "--id", "x"], "no shape in it has the id"),
    ],
)
def test_each_with_what_does_not_go_with_it(words, complaint, three, capsys):
    assert main(["check", three, *words]) == 2
    assert complaint in capsys.readouterr().err


def test_a_curve_of_the_gallery_is_one_shape(capsys):
    assert main(["check", "gallery:milnor", "--each"]) == 2
    assert "one shape" in capsys.readouterr().err


def test_each_of_standard_input(three, monkeypatch, capsys):
    with Path(three).open("rb") as stream:
        monkeypatch.setattr("sys.stdin", type("Input", (), {"buffer": stream}))
        assert main(["check", "-", "--each", "--json"]) == 1
    assert len(lines(capsys)) == 3


# ---- the other commands ----------------------------------------------------------------------------------------------


def test_an_outline_is_lifted(ring, tmp_path):
    out = tmp_path / "ring.obj"
    assert main(["lift", ring, "--triangles", "200", "--no-unwrap", "-o", str(out)]) == 0
    mesh = trimesh.load(out, force="mesh", process=False)
    assert mesh.euler_number == 0
    assert mesh.area == pytest.approx(77)


def test_a_lifted_cusp(limacon, tmp_path):
    out = tmp_path / "limacon.ply"
    assert main(["lift", limacon, "--cusp", "7", "--triangles", "200", "--no-unwrap", "-o", str(out)]) == 0
    assert trimesh.load(out, force="mesh", process=False).euler_number == 1


def test_outlines_are_converted(ring, tmp_path, capsys):
    outputs = [tmp_path / f"out.{ending}" for ending in ("json", "geojson", "wkt", "svg", "csv")]
    assert main(["convert", ring, *(f"-o{path}" for path in outputs)]) == 0
    assert capsys.readouterr().out.splitlines()[0] == "2 loops, 8 points"
    for path in outputs:
        assert [loop.tolist() for loop in pf.read(path).loops] == [loop.tolist() for loop in pf.read(ring).loops]


def test_converting_says_what_was_changed(file, tmp_path, capsys):
    drawing = file("open.svg", svg(("a", SQUARE), ("b", "M0 0L30 40")))
    assert main(["convert", drawing, "-o", str(tmp_path / "out.csv")]) == 0
    assert "note: open line left out at (0, 0) by 50\n" in capsys.readouterr().out


def test_nothing_is_converted_if_one_format_refuses(limacon, tmp_path, capsys):
    outputs = [tmp_path / "a.svg", tmp_path / "b.wkt"]
    words = ["convert", str(limacon), "--cusps", "auto", *(word for path in outputs for word in ("-o", str(path)))]
    assert main(words) == 2
    assert "cusp" in capsys.readouterr().err
    assert not any(path.exists() for path in outputs)


def test_what_cannot_be_converted(limacon, tmp_path, capsys):
    assert main(["convert", limacon, "--cusp", "7", "-o", str(tmp_path / "out.wkt")]) == 2
    assert "no place for the cusps" in capsys.readouterr().err
    assert main(["convert", limacon, "-o", str(tmp_path / "out.glb")]) == 2
    assert ".json .geojson .wkt .svg .csv" in capsys.readouterr().err
    assert sorted(path.name for path in tmp_path.iterdir()) == ["limacon.csv"]


def test_the_chart_of_a_mesh(file, capsys):
    mesh = file("chart.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 9 0\nvt 0 9\nf 1/1 2/2 3/3\n")
    for words, width in ([], 1), (["--uv"], 9):
        assert main(["convert", mesh, *words, "--force", "-o", mesh.replace("obj", "json")]) == 0
        assert np.ptp(pf.read(mesh.replace("obj", "json")).points) == width
