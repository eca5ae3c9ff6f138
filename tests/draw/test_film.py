"""Films: the files that viewers get, and what can be seen in them."""

import shutil

import numpy as np
import pytest
from PIL import Image

from plyfold import lift
from plyfold.draw import film
from plyfold.errors import InputError, PlyfoldError
from plyfold.gallery import CURVES


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


def test_mp4_needs_its_writer(surface, tmp_path):
    if shutil.which("ffmpeg"):
        surface.export(tmp_path / "ramp.mp4")
        assert b"ftyp" in (tmp_path / "ramp.mp4").read_bytes()[:16]
        return
    with pytest.raises(PlyfoldError, match="ffmpeg"):
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
