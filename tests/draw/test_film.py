"""Films: the files that viewers get, and what can be seen in them."""

import shutil
import subprocess

import numpy as np
import pytest
from PIL import Image

from coarse import CURVES
from plyfold import lift
from plyfold.draw import film
from plyfold.errors import InputError, PlyfoldError


@pytest.fixture
def surface(monkeypatch):
    monkeypatch.setattr(film, "_STEPS", 2)
    monkeypatch.setattr(film, "_PIXELS", 80)
    return lift(CURVES["exit-ramp"].curve, triangles=300)


def test_gif_goes_there_and_back(surface, tmp_path):
    """Five stations there and three back; it rests at three of them, and comes back as it went."""
    surface.export(tmp_path / "ramp.gif")
    with Image.open(tmp_path / "ramp.gif") as picture:
        assert (picture.format, picture.size, picture.n_frames) == ("GIF", (80, 80), 8)
        assert picture.info["loop"] == 0
        shown, durations = [], []
        for number in range(8):
            picture.seek(number)
            shown.append(np.asarray(picture.convert("RGB"), dtype=int))
            durations.append(picture.info["duration"])
    assert [duration > 500 for duration in durations] == [True, False, True, False, True, False, True, False]
    for there, back in ((1, 7), (2, 6), (3, 5)):
        assert np.abs(shown[there] - shown[back]).max() < 40
    for one, other in ((0, 1), (1, 2), (2, 4)):
        assert np.abs(shown[one] - shown[other]).mean() > 2


def test_the_disk_comes_first(surface):
    """An ellipse as it is seen: it fills π/4 of its box."""
    first = film._frames(surface, None)[0]
    cloth = (first.max(axis=2).astype(int) - first.min(axis=2)) > 40
    rows, columns = np.flatnonzero(cloth.any(axis=1)), np.flatnonzero(cloth.any(axis=0))
    box = (rows[-1] - rows[0] + 1) * (columns[-1] - columns[0] + 1)
    assert cloth.sum() / box == pytest.approx(np.pi / 4, abs=0.06)


needs_ffmpeg = pytest.mark.skipif(shutil.which("ffmpeg") is None, reason="ffmpeg is not installed")


@needs_ffmpeg
def test_mp4_has_every_step_of_the_film(surface, tmp_path):
    """Decoded again, its frames are those that were drawn, each shown as long as it should be."""
    surface.export(tmp_path / "ramp.mp4")
    decode = ["ffmpeg", "-v", "error", "-i", tmp_path / "ramp.mp4", "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    raw = subprocess.run(decode, capture_output=True, check=True).stdout
    read = np.frombuffer(raw, np.uint8).reshape(-1, 80, 80, 3).astype(int)
    there = film._frames(surface, None)
    order = [0] * 12 + [1] + [2] * 12 + [3] + [4] * 12 + [3] + [2] * 12 + [1]
    assert len(read) == len(order)
    for shown, number in zip(read, order, strict=True):
        nearest = np.argmin([np.abs(shown - frame).mean() for frame in there])
        assert nearest == number
        assert np.abs(shown - there[number]).mean() < 4


@needs_ffmpeg
def test_mp4_begins_with_its_index_and_plays_anywhere(surface, tmp_path):
    surface.export(tmp_path / "ramp.mp4")
    content = (tmp_path / "ramp.mp4").read_bytes()
    assert content.index(b"moov") < content.index(b"mdat")
    assert b"avc1" in content


def fake_ffmpeg(folder, monkeypatch):
    program = folder / "bin" / "ffmpeg"
    program.parent.mkdir()
    program.write_text("#!/bin/sh\necho 'Unknown encoder' >&2\nexit 1\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{program.parent}:/usr/bin:/bin")


def test_a_failing_ffmpeg_is_an_error_of_ours(surface, tmp_path, monkeypatch):
    fake_ffmpeg(tmp_path, monkeypatch)
    with pytest.raises(PlyfoldError, match="Unknown encoder"):
        surface.export(tmp_path / "ramp.mp4")
    assert not (tmp_path / "ramp.mp4").exists()


def test_mp4_needs_its_writer(surface, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(PlyfoldError, match="not installed"):
        surface.export(tmp_path / "ramp.mp4")
    assert list(tmp_path.iterdir()) == []


def test_existing_files_and_other_endings(surface, tmp_path):
    (tmp_path / "ramp.gif").write_bytes(b"mine")
    with pytest.raises(FileExistsError):
        surface.export(tmp_path / "ramp.gif")
    assert (tmp_path / "ramp.gif").read_bytes() == b"mine"
    with pytest.raises(InputError):
        film.save_film(surface, tmp_path / "ramp.avi")


def test_progress(surface, tmp_path):
    told = []
    film.save_film(surface, tmp_path / "ramp.gif", progress=lambda *what: told.append(what))
    assert [done for _, done in told] == pytest.approx([0, 0.2, 0.4, 0.6, 0.8])
