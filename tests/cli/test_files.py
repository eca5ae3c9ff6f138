"""Files written from the command line: solids, colours, and drawings of over and under."""

from xml.etree import ElementTree

import numpy as np
import pytest
import trimesh

from plyfold.cli.commands import main
from plyfold.gallery import CURVES

RAMP = "gallery:exit-ramp"
QUICK = ["--triangles", "200"]


@pytest.mark.parametrize("suffix", ["3mf", "stl", "glb", "obj", "ply"])
def test_thick_surfaces_are_watertight(suffix, tmp_path, capsys):
    path = tmp_path / f"out.{suffix}"
    assert main(["lift", RAMP, "--thicken", "0.2", *QUICK, "-o", str(path)]) == 0
    assert f"wrote {path}" in capsys.readouterr().out
    body = trimesh.load(path, force="mesh")
    body.merge_vertices(merge_tex=True, merge_norm=True)
    assert body.is_watertight
    x, y = CURVES["exit-ramp"].draw().T
    assert body.volume == pytest.approx(0.1 * abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)), rel=1e-4)


@pytest.mark.parametrize("thickness", ["20", "0", "-1", "nan"])
def test_bad_thickness(thickness, tmp_path, capsys):
    assert main(["lift", RAMP, f"--thicken={thickness}", *QUICK, "-o", str(tmp_path / "out.stl")]) == 2
    assert "thick" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_no_film_of_a_solid(tmp_path, capsys):
    assert main(["lift", RAMP, "--thicken", "0.2", "-o", str(tmp_path / "out.gif")]) == 2
    assert ".3mf" in capsys.readouterr().err


def test_colours_by_sheet_and_no_texture(tmp_path):
    options = ["--colours", "sheets", "--no-unwrap", *QUICK]
    assert main(["lift", RAMP, *options, "-o", str(tmp_path / "out.obj")]) == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["out.mtl", "out.obj"]
    assert "\nvt " not in (tmp_path / "out.obj").read_text()


def test_over_and_under(tmp_path, capsys):
    outputs = [tmp_path / f"out.{suffix}" for suffix in ("svg", "tikz", "tex")]
    assert main(["draw", RAMP, "--what", "over-under", *(f"-o{path}" for path in outputs)]) == 0
    assert capsys.readouterr().out.split() == [word for path in outputs for word in ("wrote", str(path))]
    assert ElementTree.parse(outputs[0]).getroot().tag.endswith("svg")
    assert outputs[1].read_text() in outputs[2].read_text()


def test_hidden_strands_are_dashed_if_asked_for(tmp_path):
    for hidden in ("removed", "dashed"):
        command = ["draw", RAMP, "--what", "over-under", "--hidden", hidden, "-o", str(tmp_path / f"{hidden}.svg")]
        assert main(command) == 0
    assert "dasharray" not in (tmp_path / "removed.svg").read_text()
    assert "dasharray" in (tmp_path / "dashed.svg").read_text()


@pytest.mark.parametrize(("name", "code"), [("limacon", 1), ("circle", 0)])
def test_over_and_under_of_what_is_no_disk(name, code, tmp_path):
    command = ["draw", f"gallery:{name}", "--what", "over-under", "-o", str(tmp_path / "out.svg")]
    assert main(command) == code
    assert (tmp_path / "out.svg").exists() == (code == 0)


def test_over_and_under_is_no_photograph(tmp_path, capsys):
    assert main(["draw", RAMP, "--what", "over-under", "-o", str(tmp_path / "out.png")]) == 2
    assert ".svg .tikz .tex" in capsys.readouterr().err


def test_existing_drawings_stay(tmp_path):
    (tmp_path / "out.svg").write_text("precious")
    command = ["draw", RAMP, "--what", "over-under", "-o", str(tmp_path / "out.svg")]
    assert main(command) == 2
    assert (tmp_path / "out.svg").read_text() == "precious"
    assert main([*command, "--force"]) == 0
    assert (tmp_path / "out.svg").read_text().startswith("<svg")
