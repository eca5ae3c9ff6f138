"""``plyfold lift`` with pins, stiffness and flat parts."""

import numpy as np
import pytest
import trimesh

from plyfold.cli.commands import main


def lifted(tmp_path, *words):
    out = tmp_path / "ramp.obj"
    assert main(["lift", "gallery:exit-ramp", "-o", str(out), "--force", "--triangles", "300", *words]) == 0
    return trimesh.load(out, process=False).vertices


def test_a_pinned_sheet_has_its_height(tmp_path):
    z = lifted(tmp_path, "--pin", "0=-3")[:, 2]
    assert (z == -3).sum() > 5


def test_a_pinned_point(tmp_path, capsys):
    loose = lifted(tmp_path)[:, 2]
    pinned = lifted(tmp_path, "--pin=-0.57,6.28,0=2")[:, 2]
    assert pinned.min() != loose.min()
    assert np.ptp(pinned) == pytest.approx(np.ptp(loose), rel=1e-4)


@pytest.mark.parametrize("words", [["--flat"], ["--flat", "30"], ["--stiffness", "2"]])
def test_other_shapes(tmp_path, words):
    assert np.abs(lifted(tmp_path, *words) - lifted(tmp_path))[:, 2].max() > 1e-2


@pytest.mark.parametrize("pin", ["x=1", "1", "1,2,0.5=1", "0="])
def test_what_is_no_pin(tmp_path, pin, capsys):
    with pytest.raises(SystemExit):
        main(["lift", "gallery:exit-ramp", "-o", str(tmp_path / "ramp.obj"), f"--pin={pin}"])
    assert "is no pin" in capsys.readouterr().err


def test_pins_without_room(tmp_path, capsys):
    words = ["lift", "gallery:exit-ramp", "-o", str(tmp_path / "ramp.obj"), "--pin", "0=0", "--pin", "1=0.01"]
    assert main(words) == 2
    assert "pins are closer than the gap" in capsys.readouterr().err
