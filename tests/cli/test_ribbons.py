"""Lines with a width on the command line: every command reads them alike."""

import json
import subprocess
import sys

import pytest
import trimesh

from plyfold.cli.commands import main

ROAD = "LINESTRING Z (0 0 0, 9 0 0, 9 6 1, 4 6 1, 4 -5 1)"


@pytest.fixture
def road(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "road.wkt").write_text(ROAD)
    return "road.wkt"


def height_near_the_end(path):
    """The height of the end of the line less that of its start, where it crosses itself."""
    vertices = trimesh.load(path, process=False).vertices
    end = vertices[(abs(vertices[:, :2] - (4, -5)) < 1.1).all(axis=1), 2]
    start = vertices[(abs(vertices[:, :2] - (0, 0)) < 1.1).all(axis=1), 2]
    return end.mean() - start.mean()


def test_heights_decide_what_passes_over(road, tmp_path, capsys):
    words = ["--width", "2", "--triangles", "300", "--force"]
    assert main(["lift", road, "-o", "over.obj", *words]) == 0
    assert "Over and under are those of the heights" in capsys.readouterr().out
    (tmp_path / "under.wkt").write_text(ROAD.replace(" 1", " -1"))
    assert main(["lift", "under.wkt", "-o", "under.obj", *words]) == 0
    assert height_near_the_end("over.obj") > 0 > height_near_the_end("under.obj")


def test_all_commands_read_ribbons(road, capsys):
    for words in (
        ["check", road, "--width", "2"],
        ["draw", road, "--width", "2", "-o", "road.svg"],
        ["triangulate", road, "--width", "2", "--join", "mitre", "-o", "road.obj"],
        ["split", road, "--width", "2", "-o", "road.geojson"],
        ["convert", road, "--width", "2", "--cap", "round", "-o", "road.csv"],
    ):
        assert main(words) == 0, words
    capsys.readouterr()
    assert main(["check", road, "--width", "2", "--each", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert (told["crossings"], told["immersible"], told["repairs"]) == (4, True, [])


def test_heights_that_no_cloth_follows_end_with_a_reason(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "through.csv").write_text(
        "0 0 0\n20 0 0\n25 8 0\n20 12 0\n0 12 0\n-6 4 0\n0 -2 -9\n20 2 9\n",
    )
    assert main(["lift", "through.csv", "--width", "2", "-o", "a.obj"]) == 1
    assert "No cloth follows these heights" in capsys.readouterr().err
    (tmp_path / "level.csv").write_text("0 0 5\n9 0 5\n9 6 5\n4 6 5\n4 -5 5\n")
    assert main(["lift", "level.csv", "--width", "2", "-o", "a.obj"]) == 2
    assert "overlap at the same height" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--width", "40"], "too tight for a ribbon 40 wide"),
        (["--width", "auto"], "no line in it has a width"),
        (["--cap", "round"], "give a width"),
    ],
)
def test_what_goes_wrong_is_said(road, words, told, capsys):
    assert main(["check", road, *words]) == 2
    assert told in capsys.readouterr().err


def test_no_width_and_no_line(road, capsys):
    with pytest.raises(SystemExit):
        main(["check", road, "--width", "wide"])
    assert "wide is no width" in capsys.readouterr().err
    assert main(["check", "gallery:circle", "--width", "1"]) == 2


def test_a_track_from_standard_input(tmp_path):
    points = [(0, 0), (9, 0), (9, 6), (4, 6), (4, -5)]
    marks = "".join(
        f'<trkpt lat="{47 + y / 1e4}" lon="{8 + x / 1e4}"><ele>{i}</ele></trkpt>' for i, (x, y) in enumerate(points)
    )
    track = f"<gpx><trk><trkseg>{marks}</trkseg></trk></gpx>"
    words = [sys.executable, "-m", "plyfold", "lift", "-", "--width", "8", "-o", str(tmp_path / "track.glb")]
    done = subprocess.run(words, input=track, capture_output=True, text=True, check=True)
    assert "2 level(s)" in done.stdout
    assert (tmp_path / "track.glb").stat().st_size > 1000
