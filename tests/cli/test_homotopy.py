"""``plyfold homotopy``, and branched disks in ``plyfold check``."""

import json

import pytest

import plyfold as pf
from plyfold.cli.commands import main

LIMACON = [(3, 0), (1, 3), (-2, 0), (1, -3), (3, 0.5), (1, 1), (0.5, 0), (1, -1)]


@pytest.fixture
def drawings(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    pf.save(pf.Curve(LIMACON), "limacon.csv")
    (tmp_path / "eight.csv").write_text("0,0\n2,2\n2,0\n0,2\n")


@pytest.mark.usefixtures("drawings")
def test_in_words(capsys):
    assert main(["homotopy", "eight.csv"]) == 0
    said = capsys.readouterr().out.splitlines()
    assert said[0] == "The curve contracts and sweeps 2; winding numbers alone ask for 2."
    assert said[1:3] == ["  loop 0: disk on its left, 1", "  loop 1: disk on its right, 1, cut off loop 0 at (1, 1)"]


@pytest.mark.usefixtures("drawings")
def test_as_json(capsys):
    assert main(["homotopy", "limacon.csv", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    found = pf.least_homotopy(LIMACON)
    assert told["area"] == told["lower"] == found.area
    assert (told["optimal"], told["branch_points"], len(told["cuts"])) == (True, 1, 1)
    assert [loop["points"] for loop in told["loops"]] == [loop.curve.points.tolist() for loop in found.loops]


@pytest.mark.usefixtures("drawings")
def test_pictures_and_films(capsys, tmp_path):
    assert main(["homotopy", "eight.csv", "-o", "eight.svg"]) == 0
    assert "wrote eight.svg" in capsys.readouterr().out
    assert (tmp_path / "eight.svg").read_bytes().startswith(b"<?xml")
    assert main(["homotopy", "eight.csv", "-o", "eight.obj"]) == 2


@pytest.mark.usefixtures("drawings")
def test_branched_disks_are_named(capsys):
    assert main(["check", "limacon.csv"]) == 1
    assert "It bounds a disk of cloth with a branch point." in capsys.readouterr().out
    main(["check", "limacon.csv", "--json"])
    assert json.loads(capsys.readouterr().out)["branch_points"] == 1
    main(["check", "eight.csv", "--json"])
    assert "branch_points" not in json.loads(capsys.readouterr().out)
