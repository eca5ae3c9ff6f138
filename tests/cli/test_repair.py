"""``plyfold repair``, what ``plyfold check`` offers where there is no disk, and ``--repair``."""

import json

import pytest

import plyfold as pf
from plyfold.cli.commands import main

CORNER = "0,0\n60,0\n60,41\n61,41\n61,40\n0,40\n"
EIGHT = "0,0\n2,2\n2,0\n0,2\n"


@pytest.fixture
def corner(tmp_path, monkeypatch):
    """The rectangle with a tiny loop at a corner."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "corner.csv").write_text(CORNER)
    (tmp_path / "eight.csv").write_text(EIGHT)
    return "corner.csv"


def test_repair(corner, capsys):
    assert main(["repair", corner, "-o", "mended.csv"]) == 0
    said = capsys.readouterr().out
    assert said.startswith("1 loop left out: 0.0416% of the region and 0.0416% of the layers\n")
    assert "note: loop left out at (60, 40) by 1.41" in said
    assert pf.read("mended.csv").points.tolist() == [[0, 0], [60, 0], [60, 40], [0, 40]]


def test_caps(corner, capsys):
    assert main(["repair", corner, "-o", "mended.csv", "--allow", "0.04%"]) == 1
    assert "--allow and --allow-layers allow more" in capsys.readouterr().err
    assert main(["repair", corner, "-o", "mended.csv", "--allow", "0.05%", "--allow-layers", "0.0005"]) == 0
    assert main(["repair", "eight.csv", "-o", "half.csv", "--allow", "50%", "--allow-layers", "50%"]) == 0


def test_caps_are_parts(corner, capsys):
    with pytest.raises(SystemExit):
        main(["repair", corner, "-o", "mended.csv", "--allow=-1%"])
    assert "is no part of a whole" in capsys.readouterr().err


def test_no_time(corner, capsys):
    assert main(["repair", corner, "-o", "mended.csv", "--time-limit", "0"]) == 3
    assert "unknown after" in capsys.readouterr().err


def test_check_offers(corner, capsys):
    assert main(["check", corner]) == 1
    said = capsys.readouterr().out
    assert (
        "\n  leaving out 1 loop, 0.0416% of the region, makes it a disk of cloth: plyfold repair FILE -o OUT\n" in said
    )
    assert "\n  what it paints can be cut into polygons: plyfold split FILE --fill nonzero -o OUT\n" in said


def test_check_offers_as_json(corner, capsys):
    assert main(["check", corner, "--json"]) == 1
    offers = {offer["kind"]: offer for offer in json.loads(capsys.readouterr().out)["offers"]}
    assert list(offers) == ["repair", "fill"]
    (change,) = offers["repair"]["changes"]
    assert change["where"] == [60, 40]
    assert change["region"] == pytest.approx(1 / 2401) == offers["repair"]["region_change"]
    assert main(["check", "eight.csv", "--json"]) == 1
    assert [offer["kind"] for offer in json.loads(capsys.readouterr().out)["offers"]] == ["fill"]


@pytest.mark.parametrize(
    "command",
    [
        ["check"],
        ["lift", "-o", "out.obj"],
        ["draw", "-o", "out.svg"],
        ["split", "-o", "out.wkt"],
        ["triangulate", "-o", "out.csv"],
    ],
)
def test_repair_first(corner, capsys, command):
    assert main([command[0], corner, *command[1:]]) == 1
    capsys.readouterr()
    force = ["--force"] if command[1:] else []
    assert main([command[0], corner, *command[1:], *force, "--repair"]) == 0
    assert "repaired: 1 loop left out" in capsys.readouterr().err


def test_repair_first_of_what_cannot_be(corner, capsys):
    assert main(["check", "eight.csv", "--repair"]) == 1
    assert "50% of the region" in capsys.readouterr().err
    assert main(["check", "eight.csv", "--repair", "--json"]) == 1
    assert "50% of the region" in json.loads(capsys.readouterr().out)["error"]


def test_what_is_a_disk_stays_as_it_is(capsys):
    assert main(["check", "gallery:exit-ramp", "--repair"]) == 0
    assert "nothing changed" in capsys.readouterr().err
