"""``plyfold repair``, what ``plyfold check`` offers where there is no disk, and ``--repair``."""

import io
import json
import shlex
from operator import itemgetter
from pathlib import Path

import pytest

import plyfold as pf
from plyfold.cli.commands import main

CORNER = "0,0\n60,0\n60,41\n61,41\n61,40\n0,40\n"
EIGHT = "0,0\n2,2\n2,0\n0,2\n"


COMMANDS = [
    ["check"],
    ["lift", "-o", "out.obj"],
    ["draw", "-o", "out.svg"],
    ["split", "-o", "out.wkt"],
    ["triangulate", "-o", "out.csv"],
]


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


@pytest.mark.parametrize("part", ["-1%", "abc", "nan", "", "%", "1%%"])
def test_caps_are_parts(corner, capsys, part):
    with pytest.raises(SystemExit):
        main(["repair", corner, "-o", "mended.csv", f"--allow={part}"])
    assert f"{part} is no part of a whole, such as 1% or 0.01" in capsys.readouterr().err


def test_time_limits_are_seconds(corner, capsys):
    with pytest.raises(SystemExit):
        main(["repair", corner, "-o", "mended.csv", "--time-limit=soon"])
    assert "soon is not a number of seconds from 0 on" in capsys.readouterr().err


def test_no_time(corner, capsys):
    assert main(["repair", corner, "-o", "mended.csv", "--time-limit", "0"]) == 3
    assert "unknown after" in capsys.readouterr().err


def test_check_offers(corner, capsys):
    assert main(["check", corner]) == 1
    said = capsys.readouterr().out
    command = "plyfold repair corner.csv -o OUT"
    assert f"\n  leaving out 1 loop, 0.0416% of the region, makes it a disk of cloth: {command}\n" in said
    assert "\n  what it paints can be cut into polygons: plyfold split corner.csv --fill nonzero -o OUT\n" in said


def offered_commands(capsys):
    """The commands that plyfold check printed, as the words that a shell makes of them."""
    said = capsys.readouterr().out.splitlines()
    return [shlex.split(line.rpartition(": plyfold ")[2]) for line in said if ": plyfold " in line]


@pytest.mark.parametrize(
    ("name", "options", "named"),
    [
        ('it\'s a "corner" {0} $HOME.csv', [], ['it\'s a "corner" {0} $HOME.csv']),
        ("-corner.csv", [], ["./-corner.csv"]),
        ("corner.csv", ["--index", "0", "--tolerance", "0.5"], ["corner.csv", "--index", "0", "--tolerance", "0.5"]),
        ("corner.csv", ["--each"], ["corner.csv", "--index", "0"]),
    ],
)
def test_what_is_offered_can_be_run(corner, capsys, name, options, named):
    Path(corner).rename(name)
    assert main(["check", *options, "--", name]) == 1
    repair, split = offered_commands(capsys)
    assert repair == ["repair", *named, "-o", "OUT"]
    assert split == ["split", *named, "--fill", "nonzero", "-o", "OUT"]
    assert main([*repair[:-1], "mended.csv"]) == 0
    assert main([*split[:-1], "pieces.wkt"]) == 0


def test_standard_input_is_named_as_it_was(corner, capsys, monkeypatch):
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(CORNER.encode())))
    assert main(["check", "-"]) == 1
    assert offered_commands(capsys)[0] == ["repair", "-", "-o", "OUT"]


def test_check_offers_as_json(corner, capsys):
    assert main(["check", corner, "--json"]) == 1
    offers = {offer["kind"]: offer for offer in json.loads(capsys.readouterr().out)["offers"]}
    assert list(offers) == ["repair", "fill"]
    (change,) = offers["repair"]["changes"]
    assert change["where"] == [60, 40]
    assert change["region"] == pytest.approx(1 / 2401) == offers["repair"]["region_change"]
    assert main(["check", "eight.csv", "--json"]) == 1
    assert [offer["kind"] for offer in json.loads(capsys.readouterr().out)["offers"]] == ["fill"]


@pytest.mark.parametrize("cap", ["--allow", "--allow-layers"])
@pytest.mark.parametrize("command", COMMANDS, ids=itemgetter(0))
def test_caps_of_no_repair_are_refused(corner, capsys, command, cap):
    assert main([command[0], corner, *command[1:], cap, "5%"]) == 2
    said = capsys.readouterr().err
    assert "--allow and --allow-layers say what --repair may change" in said
    assert "add --repair" in said


def test_caps_with_repair(corner, capsys):
    assert main(["check", corner, "--repair", "--allow", "0.04%"]) == 1
    assert main(["check", corner, "--repair", "--allow", "0.05%", "--allow-layers", "0"]) == 1
    assert main(["check", corner, "--repair", "--allow", "0.05%", "--allow-layers", "0.05%"]) == 0


@pytest.mark.parametrize("command", COMMANDS, ids=itemgetter(0))
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
