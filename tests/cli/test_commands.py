"""The command line, as a person or a program meets it."""

import io
import json
import os
import subprocess
import sys

import numpy as np
import pytest
import shapely
import trimesh
from PIL import Image

import plyfold as pf
from plyfold.cli.commands import main
from plyfold.cli.progress import Stopwatch
from plyfold.gallery import CURVES, OUTLINES
from plyfold.report import words

LOOP = "0,0\n9,0\n9,6\n3,6\n3,-3\n4,-3\n4,5\n8,5\n8,1\n0,1\n"
EIGHT = "0,0\n2,2\n2,0\n0,2\n"


@pytest.fixture
def loop(tmp_path):
    path = tmp_path / "loop.csv"
    path.write_text(LOOP)
    return path


@pytest.fixture
def eight(tmp_path):
    path = tmp_path / "eight.csv"
    path.write_text(EIGHT)
    return path


def test_check_says_yes(loop, capsys):
    assert main(["check", str(loop)]) == 0
    text = capsys.readouterr().out
    assert text.startswith(f"Yes. {words(1).sentence}\n")
    for line in ("crossings                4", "turning number           1", "immersions               1"):
        assert line in text


def test_check_says_no(eight, capsys):
    assert main(["check", str(eight)]) == 1
    text = capsys.readouterr().out
    assert text.startswith("No disk. The curve turns 0 times")


@pytest.mark.parametrize("name", CURVES)
def test_check_json_gives_the_known_answers(name, capsys):
    known = CURVES[name]
    assert main(["check", f"gallery:{name}", "--json"]) == (0 if known.immersions else 1)
    found = json.loads(capsys.readouterr().out)
    assert found["crossings"] == known.crossings
    assert found["turning_number"] == known.turning_number
    assert found["immersions"] == known.immersions
    assert found["immersible"] == bool(known.immersions)
    assert found.get("layerable", False) == bool(known.embeddable)
    assert sum(found["cells"].values()) == known.crossings + 2


@pytest.mark.parametrize(
    ("content", "complaint"),
    [
        ("", "empty"),
        ("0,0\n1,nan\n0,1\n", "nan"),
        ("0,0\n1,1\n", "point"),
        ("0,0\n1,1\n2,2\n", "line"),
        ("0,0\n1,one\n2,0\n", "line 2"),
    ],
)
def test_bad_input_is_one_message(tmp_path, capsys, content, complaint):
    path = tmp_path / "bad.csv"
    path.write_text(content)
    assert main(["check", str(path)]) == 2
    streams = capsys.readouterr()
    assert streams.out == ""
    assert streams.err.startswith("plyfold: ")
    assert complaint in streams.err.lower()
    assert main(["check", str(path), "--json"]) == 2
    assert complaint in json.loads(capsys.readouterr().out)["error"].lower()


def test_missing_files_and_names(capsys):
    assert main(["check", "no-such-file.svg"]) == 2
    assert main(["check", "gallery:nothing"]) == 2
    assert "exit-ramp" in capsys.readouterr().err


def test_touching_strands_can_be_refused(tmp_path, capsys):
    path = tmp_path / "touching.csv"
    path.write_text("0,0\n4,0\n4,4\n2,0\n0,4\n")
    assert main(["check", str(path)]) == 0
    assert "vertex moved at (2, 0)" in capsys.readouterr().out
    assert main(["check", str(path), "--general-position", "raise"]) == 2
    assert "(2, 0)" in capsys.readouterr().err


@pytest.mark.parametrize("ending", ["glb", "obj", "ply", "stl"])
def test_lift_writes_what_others_read(loop, tmp_path, ending):
    path = tmp_path / f"out.{ending}"
    assert main(["lift", str(loop), "-o", str(path), "--triangles", "300"]) == 0
    mesh = trimesh.load(path, force="mesh", process=ending == "stl")
    expected = pf.lift(pf.read(loop), triangles=300)
    assert len(mesh.faces) == len(expected.faces)
    assert len(mesh.vertices) == len(expected.vertices)
    low, high = sorted(mesh.bounds.T.tolist(), key=lambda side: side[1] - side[0])[0]
    assert high - low == pytest.approx(expected.vertices[:, 2].max(), rel=1e-5)


def test_lift_writes_a_page_that_needs_no_network(loop, tmp_path):
    path = tmp_path / "out.html"
    assert main(["lift", str(loop), "-o", str(path)]) == 0
    text = path.read_text(encoding="utf-8")
    assert "<title>loop</title>" in text
    assert 'src="http' not in text


def test_lift_refuses_what_is_no_disk(eight, tmp_path, capsys):
    path = tmp_path / "out.glb"
    assert main(["lift", str(eight), "-o", str(path)]) == 1
    assert not path.exists()
    assert "turns 0 times" in capsys.readouterr().err


def test_no_time_means_unknown(loop, tmp_path, capsys):
    assert main(["lift", str(loop), "-o", str(tmp_path / "out.glb"), "--time-limit", "0"]) == 3
    assert "unknown after 0 seconds, which ended while finding the crossings" in capsys.readouterr().err
    assert main(["check", str(loop), "--json", "--time-limit", "0"]) == 0
    assert json.loads(capsys.readouterr().out)["layerable"] is None


@pytest.mark.parametrize("command", [["lift", "LOOP", "-o", "OUT.glb"], ["draw", "LOOP", "-o", "OUT.png"]])
def test_existing_files_are_kept(command, loop, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("plyfold.io.read", pytest.fail)  # refused before anything is read
    out = tmp_path / f"mine.{command[-1][-3:]}"
    out.write_text("precious")
    words = [{"LOOP": str(loop), command[-1]: str(out)}.get(word, word) for word in command]
    assert main(words) == 2
    assert out.read_text() == "precious"
    assert "exists already" in capsys.readouterr().err


def test_force_replaces(loop, tmp_path):
    out = tmp_path / "mine.obj"
    out.write_text("old")
    assert main(["lift", str(loop), "-o", str(out), "--force"]) == 0
    assert out.read_text().startswith("# plyfold")


@pytest.mark.parametrize("what", ["all", "arrangement", "layout", "layers", "surface"])
def test_draw(loop, tmp_path, what):
    out = tmp_path / "picture.svg"
    assert main(["draw", str(loop), "-o", str(out), "--what", what]) == 0
    assert "<svg" in out.read_text(encoding="utf-8")


def test_the_same_output_twice_is_written_once(loop, tmp_path):
    out = str(tmp_path / "twice.obj")
    assert main(["lift", str(loop), "-o", out, "-o", out]) == 0


def test_a_folder_is_no_output(loop, tmp_path, capsys):
    folder = tmp_path / "folder.glb"
    folder.mkdir()
    assert main(["lift", str(loop), "-o", str(folder), "--force"]) == 2
    assert "is a folder" in capsys.readouterr().err
    assert list(tmp_path.glob(".plyfold*")) == []


@pytest.mark.parametrize("option", [["--triangles", "-5"], ["--gap", "1e300"], ["--gap", "nan"]])
def test_absurd_options(option, loop, tmp_path, capsys):
    assert main(["lift", str(loop), "-o", str(tmp_path / "out.glb"), *option]) == 2
    assert capsys.readouterr().err.startswith("plyfold: ")
    assert not (tmp_path / "out.glb").exists()


def test_draw_marks_why_not(eight, tmp_path, capsys):
    out = tmp_path / "picture.png"
    assert main(["draw", str(eight), "-o", str(out)]) == 1
    assert out.read_bytes().startswith(b"\x89PNG")
    assert main(["draw", str(eight), "-o", str(tmp_path / "other.png"), "--what", "surface"]) == 2
    assert "no surface" in capsys.readouterr().err


def test_gallery_lists_and_saves(tmp_path, capsys):
    assert main(["gallery"]) == 0
    listed = capsys.readouterr().out
    assert all(name in listed for name in (*CURVES, *OUTLINES))
    for ending in ("csv", "json", "svg"):
        out = tmp_path / f"ramp.{ending}"
        assert main(["gallery", "exit-ramp", "-o", str(out)]) == 0
        points, expected = pf.read(out).points, CURVES["exit-ramp"].curve.points
        moved = points[0] - expected[0]
        assert ending == "svg" or not moved.any()  # the view box of an SVG moves the drawing into view
        assert points == pytest.approx(expected + moved, abs=1e-9)
        assert main(["gallery", "exit-ramp", "-o", str(out)]) == 2


def test_the_whole_gallery_is_saved_and_read_back_exactly(tmp_path, capsys):
    folder = tmp_path / "new" / "curves"
    assert main(["gallery", "--all", str(folder)]) == 0
    for name, known in (CURVES | OUTLINES).items():
        back = pf.read(folder / f"{name}.csv")
        assert [loop.tolist() for loop in back.loops] == [loop.tolist() for loop in known.outline.loops]
        assert [index.tolist() for index in back.cusps] == [index.tolist() for index in known.outline.cusps]
    assert len(list(folder.iterdir())) == len(CURVES | OUTLINES)
    (folder / "circle.csv").unlink()
    assert main(["gallery", "--all", str(folder)]) == 2
    assert "exists already" in capsys.readouterr().err
    assert not (folder / "circle.csv").exists()  # refused before anything is written
    assert main(["gallery", "--all", str(folder), "--force"]) == 0


@pytest.mark.parametrize("words", [["-o", "OUT"], ["circle", "--all", "DIR"], ["-o", "OUT", "--all", "DIR"]])
def test_gallery_options_that_do_not_go_together(words, tmp_path, capsys):
    assert main(["gallery", *(str(tmp_path / word) if word.isupper() else word for word in words)]) == 2
    assert capsys.readouterr().err.startswith("plyfold: ")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["exit-ramp", "limacon", "bennequin"])
def test_help_names_every_key_of_the_json(name, capsys):
    with pytest.raises(SystemExit):
        main(["check", "--help"])
    described = capsys.readouterr().out.partition("the object")[2]
    main(["check", f"gallery:{name}", "--json"])
    found = json.loads(capsys.readouterr().out)
    assert [key for key in found if key not in described] == []


class Terminal(io.StringIO):
    def isatty(self):
        return True


def shown(text):
    """What a terminal shows of it: each line after its last clearing."""
    return [line.rpartition("\r\x1b[K")[2] for line in text.rstrip("\n").split("\n")]


def test_messages_replace_the_line_of_progress(eight, tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "stderr", Terminal())
    main(["lift", str(eight), "-o", str(tmp_path / "out.glb")])
    assert "\r\x1b[Kfinding the crossings" in sys.stderr.getvalue()
    assert [line.partition(":")[0] for line in shown(sys.stderr.getvalue())] == ["plyfold"]


def test_progress_tells_the_stage_and_the_time_left(monkeypatch):
    now = [0.0]
    monkeypatch.setattr(sys, "stderr", Terminal())
    monkeypatch.setattr("time.perf_counter", lambda: now[0])
    watch = Stopwatch()
    watch("smoothing heights")
    now[0] = 10.0
    watch("smoothing heights", 0.25)
    assert shown(sys.stderr.getvalue()) == ["smoothing heights 25%, about 30 s left"]


def test_a_film_tells_how_far_it_is(loop, tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "stderr", Terminal())
    film = ["--size", "40", "--frames", "3", "-o", str(tmp_path / "film.gif")]
    assert main(["lift", str(loop), "--triangles", "50", *film]) == 0
    assert "drawing the film 67%" in sys.stderr.getvalue()
    with Image.open(tmp_path / "film.gif") as picture:
        assert (picture.size, picture.n_frames) == ((40, 40), 4)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--size", "8", "-o", "film.gif"], "from 16 to 1,600 pixels, not 8"),
        (["--frames", "2", "-o", "film.gif"], "from 3 to 101 frames, not 2"),
        (["--size", "41", "-o", "film.mp4"], "must be even, not 41"),
        (["--frames", "9", "-o", "ramp.glb"], "--frames is for films"),
        (["--size", "90", "-o", "ramp.stl"], "--size is for films"),
    ],
)
def test_films_that_cannot_be_are_refused(loop, tmp_path, capsys, words, said):
    *options, name = words
    assert main(["lift", str(loop), *options, str(tmp_path / name)]) == 2
    assert said in capsys.readouterr().err
    assert not (tmp_path / name).exists()


def test_an_interruption_replaces_the_line_of_progress(loop, monkeypatch):
    def interrupt(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(sys, "stderr", Terminal())
    monkeypatch.setattr("plyfold.report.verdict", interrupt)
    assert main(["check", str(loop)]) == 130
    assert shown(sys.stderr.getvalue()) == ["plyfold: interrupted; nothing was left half-written"]


@pytest.mark.parametrize("stream", ["stdout", "stderr"])
def test_closed_streams_are_no_error(loop, monkeypatch, stream):
    monkeypatch.setattr(sys, stream, None)
    assert main(["check", str(loop)]) == 0


def run(*words, **options):
    return subprocess.run([sys.executable, "-m", "plyfold", *words], capture_output=True, check=False, **options)


def test_standard_input():
    done = run("check", "-", "--json", input=LOOP.encode())
    assert done.returncode == 0
    assert json.loads(done.stdout)["crossings"] == 4


def test_help_imports_nothing_heavy():
    heavy = {"scipy", "shapely", "matplotlib", "pysat", "svgelements", "pythoncdt", "trimesh"}
    code = f"import sys, plyfold.cli; print(sorted({heavy!r} & set(sys.modules)))"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, check=True).stdout.strip() == b"[]"
    assert b"examples:" in run("--help").stdout


def test_standard_input_that_is_closed():
    done = subprocess.run(
        "exec 0<&-; exec $PYTHON -m plyfold check -",
        shell=True,
        capture_output=True,
        check=False,
        env={**os.environ, "PYTHON": sys.executable},
    )
    assert done.returncode == 2
    assert b"Traceback" not in done.stderr


def test_a_reader_that_goes_away_is_no_error():
    words = [sys.executable, "-m", "plyfold", "gallery", "pentagram"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        process.stdout.close()
        assert b"Traceback" not in process.stderr.read()


def test_split_writes_polygons_that_cover_the_disk_once(loop, tmp_path, capsys):
    paths = [tmp_path / f"pieces.{ending}" for ending in ("geojson", "wkt", "svg")]
    assert main(["split", str(loop), *(word for path in paths for word in ("-o", str(path)))]) == 0
    assert "2 simple polygon(s)" in capsys.readouterr().out
    shapes = [shapely.geometry.shape(f["geometry"]) for f in json.loads(paths[0].read_text())["features"]]
    assert shapes == [shapely.from_wkt(line) for line in paths[1].read_text().splitlines()]
    # The shoelace formula counts overlaps twice, as the two polygons together do.
    x, y = np.loadtxt(loop, delimiter=",").T
    assert sum(shape.area for shape in shapes) == pytest.approx(abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2)
    assert paths[2].read_text().count("<path") == 2


@pytest.mark.parametrize("clockwise", [False, True])
def test_split_cells_says_in_which_direction_they_wind(loop, tmp_path, capsys, clockwise):
    if clockwise:
        loop.write_text("".join(reversed(LOOP.splitlines(keepends=True))))
    paths = [tmp_path / "cells.geojson", tmp_path / "cells.svg"]
    assert main(["split", str(loop), "--cells", *(word for path in paths for word in ("-o", str(path)))]) == 0
    told = [feature["properties"] for feature in json.loads(paths[0].read_text())["features"]]
    assert sorted(properties["winding"] for properties in told) == [1, 1, 1, 2]
    assert {properties["reversed"] for properties in told} == {clockwise}
    direction = "turned round, for the drawing turns clockwise" if clockwise else "the direction of the drawing"
    assert direction in capsys.readouterr().out
    assert f"reversed {'true' if clockwise else 'false'}" in paths[1].read_text()


def test_split_cells_of_a_curve_that_is_no_disk(eight, tmp_path):
    path = tmp_path / "cells.geojson"
    assert main(["split", str(eight), "--cells", "-o", str(path)]) == 0
    assert [f["properties"]["winding"] for f in json.loads(path.read_text())["features"]] == [-1, 1]
    assert main(["split", str(eight), "-o", str(tmp_path / "pieces.wkt")]) == 1
    assert not (tmp_path / "pieces.wkt").exists()


@pytest.fixture
def touching(tmp_path):
    """A square with a hole on a cut that is walked twice, and that touches itself in a point."""
    points = [(0, 0), (9, 0), (9, 9), (4, 9), (4, 6), (6, 3), (3, 3), (4, 6), (4, 9), (0, 9)]
    path = tmp_path / "touching.csv"
    path.write_text("".join(f"{x},{y}\n" for x, y in points))
    return path


def test_split_cells_of_a_curve_that_touches_itself(touching, tmp_path, capsys):
    path = tmp_path / "cells.wkt"
    assert main(["split", str(touching), "--cells", "-o", str(path)]) == 0
    cell = shapely.from_wkt(path.read_text())
    assert (cell.area, len(cell.interiors)) == (81 - 4.5, 1)
    refused = ["split", str(touching), "--cells", "--general-position", "raise", "-o", str(tmp_path / "none.wkt")]
    assert main(refused) == 2
    assert "not in general position" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "area"), [(["--fill", "nonzero"], 76.5), (["--fill", "negative"], 0), (["--at-least", "1"], 76.5)]
)
def test_split_fills(touching, tmp_path, capsys, words, area):
    paths = [tmp_path / f"fill.{ending}" for ending in ("geojson", "wkt", "svg")]
    assert main(["split", str(touching), *words, *(word for path in paths for word in ("-o", str(path)))]) == 0
    features = json.loads(paths[0].read_text())["features"]
    assert sum(shapely.geometry.shape(feature["geometry"]).area for feature in features) == area
    assert f"{len(features)} polygon(s)" in capsys.readouterr().out


def test_split_refuses_a_layer_below_the_first(touching, tmp_path, capsys):
    assert main(["split", str(touching), "--at-least", "0", "-o", str(tmp_path / "fill.wkt")]) == 2
    assert "at_least" in capsys.readouterr().err


def test_draw_mask(touching, tmp_path, capsys):
    paths = [tmp_path / f"mask.{ending}" for ending in ("png", "npy", "csv")]
    assert main(["draw", str(touching), "--mask", "9", *(word for path in paths for word in ("-o", str(path)))]) == 0
    assert "9 rows of 9 pixels, transform 1 0 0 0 -1 9" in capsys.readouterr().out
    mask = np.load(paths[1])
    assert (mask == np.loadtxt(paths[2], delimiter=",")).all()
    # Row 0 is on top; the hole's centre has the pixel of its place.
    assert mask[8 - 4, 4] == 0
    assert mask.sum() == (mask == 1).sum() > 70
    from matplotlib.image import imread

    white = (imread(paths[0])[..., :3] == 1).all(axis=2)
    assert (white == (mask == 0)).all()
    with pytest.raises(SystemExit):
        main(["draw", str(touching), "--mask", "0", "-o", str(tmp_path / "none.png")])


def test_a_mask_is_of_the_points_as_given_and_says_what_was_left_out(touching, tmp_path, capsys):
    (tmp_path / "flat.wkt").write_text("POLYGON ((0 0, 4 0, 0 3, 0 0), (1 1, 2 1, 1 1))")
    main(["draw", str(tmp_path / "flat.wkt"), "--mask", "9", "-o", str(tmp_path / "flat.npy")])
    assert "note: loop without area left out at (1, 1)" in capsys.readouterr().err
    refused = ["draw", str(touching), "--mask", "9", "--general-position", "raise", "-o", str(tmp_path / "none.npy")]
    assert main(refused) == 2
    assert not (tmp_path / "none.npy").exists()


def test_triangulate_numbers_the_points_of_the_file(loop, tmp_path):
    turned = tmp_path / "turned.csv"
    turned.write_text("".join(reversed(loop.read_text().splitlines(keepends=True))))
    for name, file in (("a", loop), ("b", turned)):
        obj = tmp_path / f"{name}.obj"
        assert main(["triangulate", str(file), "-o", str(obj), "-o", str(tmp_path / f"{name}-faces.csv")]) == 0
        points = np.array([line.split()[1:3] for line in obj.read_text().splitlines() if line[0] == "v"], dtype=float)
        assert points.tolist() == np.loadtxt(file, delimiter=",").tolist()
        faces = np.loadtxt(tmp_path / f"{name}-faces.csv", delimiter=",", skiprows=1, dtype=int)
        assert faces.shape == (8, 3)
        a, b, c = points[faces].swapaxes(0, 1)
        assert (((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) > 0).all()


def test_triangles_and_pieces_of_an_outline_that_touches_itself(tmp_path, capsys):
    """Two triangles that meet in a point."""
    file, mesh, pieces = tmp_path / "pinch.csv", tmp_path / "pinch.obj", tmp_path / "pinch.wkt"
    file.write_text("0,0\n1,1\n2,0\n2,2\n1,1\n0,2\n")
    assert main(["triangulate", str(file), "-o", str(mesh)]) == 0
    assert "2 triangles" in capsys.readouterr().out
    points = [line.split()[1:3] for line in mesh.read_text().splitlines() if line[0] == "v"]
    assert np.array(points, dtype=float).tolist() == np.loadtxt(file, delimiter=",").tolist()
    assert main(["split", str(file), "-o", str(pieces)]) == 0
    assert "2 simple polygon(s)" in capsys.readouterr().out
    assert [shapely.from_wkt(line).area for line in pieces.read_text().splitlines()] == [1, 1]


def test_pieces_of_a_flat_mesh_have_no_vertex_in_common(tmp_path):
    """A point on an edge is a corner of the pieces on both sides, and two vertices; faces as numbers name it twice."""
    points = [(0, 0), (4, 0), (4, 2), (3, 2), (2, 0), (1, 2), (0, 2)]
    file, mesh, faces = (tmp_path / f"pinch{ending}" for ending in (".csv", ".obj", "-faces.csv"))
    file.write_text("".join(f"{x},{y}\n" for x, y in points))
    assert main(["triangulate", str(file), "-o", str(mesh), "-o", str(faces)]) == 0
    vertices = [line.split()[1:3] for line in mesh.read_text().splitlines() if line[0] == "v"]
    assert np.array(vertices, dtype=float).tolist() == [*map(list, points), [2, 0]]
    pieces = pf.read(mesh).loops
    assert sorted(shapely.Polygon(loop).area for loop in pieces) == [3, 3]
    numbers = np.loadtxt(faces, delimiter=",", skiprows=1, dtype=int)
    assert numbers.max() == 6
    assert (numbers == 4).sum() > 1


def test_word_prints_the_groupings(capsys):
    assert main(["word", "gallery:milnor"]) == 0
    assert "2 grouping(s)" in capsys.readouterr().out
    assert main(["word", "gallery:bennequin", "--most", "3"]) == 0
    assert "3 or more grouping(s)" in capsys.readouterr().out
    assert main(["word", "gallery:figure-eight"]) == 1


def test_lift_passes_through_itself_only_when_allowed(tmp_path, capsys):
    out = tmp_path / "flaps.glb"
    assert main(["lift", "gallery:seven-flaps", "-o", str(out)]) == 1
    assert not out.exists()
    assert "always lie above each other in a circle" in capsys.readouterr().err
    assert main(["lift", "gallery:seven-flaps", "-o", str(out), "--allow-intersections"]) == 0
    assert "it passes through itself along 1 curve(s)" in capsys.readouterr().out
    assert out.exists()
