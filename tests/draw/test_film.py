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

SMALL = {"size": 80, "frames": 5}


@pytest.fixture(scope="module")
def surface():
    return lift(CURVES["exit-ramp"].curve, triangles=300)


def test_gif_goes_there_and_back(surface, tmp_path):
    """Five stations there and three back; it rests at three of them, and comes back as it went."""
    film.save_film(surface, tmp_path / "ramp.gif", **SMALL)
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
    first = next(film._frames(surface, **SMALL))
    cloth = (first.max(axis=2).astype(int) - first.min(axis=2)) > 40
    rows, columns = np.flatnonzero(cloth.any(axis=1)), np.flatnonzero(cloth.any(axis=0))
    box = (rows[-1] - rows[0] + 1) * (columns[-1] - columns[0] + 1)
    assert cloth.sum() / box == pytest.approx(np.pi / 4, abs=0.06)


needs_ffmpeg = pytest.mark.skipif(shutil.which("ffmpeg") is None, reason="ffmpeg is not installed")


@needs_ffmpeg
def test_mp4_has_every_step_of_the_film(surface, tmp_path):
    """Decoded again, its frames are those that were drawn, each shown as long as it should be."""
    film.save_film(surface, tmp_path / "ramp.mp4", **SMALL)
    decode = ["ffmpeg", "-v", "error", "-i", tmp_path / "ramp.mp4", "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    raw = subprocess.run(decode, capture_output=True, check=True).stdout
    read = np.frombuffer(raw, np.uint8).reshape(-1, 80, 80, 3).astype(int)
    there = list(film._frames(surface, **SMALL))
    order = [0, 0, 1, 2, 2, 3, 4, 4, 3, 2, 2, 1]
    assert len(read) == len(order)
    for shown, number in zip(read, order, strict=True):
        nearest = np.argmin([np.abs(shown - frame).mean() for frame in there])
        assert nearest == number
        assert np.abs(shown - there[number]).mean() < 4


@needs_ffmpeg
def test_mp4_begins_with_its_index_and_plays_anywhere(surface, tmp_path):
    film.save_film(surface, tmp_path / "ramp.mp4", **SMALL)
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
        film.save_film(surface, tmp_path / "ramp.mp4", **SMALL)
    assert not (tmp_path / "ramp.mp4").exists()


def test_mp4_needs_its_writer(surface, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(PlyfoldError, match="not installed"):
        film.save_film(surface, tmp_path / "ramp.mp4", **SMALL)
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
    film.save_film(surface, tmp_path / "ramp.gif", progress=lambda *what: told.append(what), **SMALL)
    assert [done for _, done in told] == pytest.approx([0, 0.2, 0.4, 0.6, 0.8])


def test_export_films_as_it_is_by_default(surface, tmp_path, monkeypatch):
    given = []
    monkeypatch.setattr(
        film, "_frames", lambda *what: given.append(what) or iter([np.zeros((20, 20, 3), np.uint8)] * 3)
    )
    surface.export(tmp_path / "ramp.gif")
    assert given == [(surface, 480, 33)]


@pytest.mark.parametrize("frames", [3, 4, 8, 33])
def test_any_number_of_frames_rests_at_disk_drawing_and_surface(frames):
    times = film._times(frames)
    rests = [showing.number for showing in film._there_and_back(frames) if showing.rests]
    assert times[rests].tolist() == [0, 1, 2, 1]
    assert (np.diff(times) > 0).all()
    assert len(film._there_and_back(frames)) == 2 * frames - 2


@pytest.mark.parametrize("size", [80, 81])
def test_size(surface, tmp_path, size):
    film.save_film(surface, tmp_path / "ramp.gif", size=size, frames=3)
    with Image.open(tmp_path / "ramp.gif") as picture:
        assert picture.size == (size, size)


@pytest.mark.parametrize(
    "wrong",
    [{"size": 15}, {"size": 1601}, {"size": 80.0}, {"size": True}, {"frames": 2}, {"frames": 102}, {"frames": "9"}],
)
def test_wrong_sizes_and_numbers_are_refused(surface, tmp_path, wrong):
    with pytest.raises(InputError, match=next(iter(wrong))):
        film.save_film(surface, tmp_path / "ramp.gif", **wrong)
    assert list(tmp_path.iterdir()) == []


def test_an_odd_mp4_is_refused(surface, tmp_path):
    with pytest.raises(InputError, match="even"):
        film.save_film(surface, tmp_path / "ramp.mp4", size=81)


def test_colours_of_a_film_are_those_drawn(surface, tmp_path):
    """The paper is white, to the last bit, and hardly any pixel's colour is far from the one drawn."""
    drawn = list(film._frames(surface, 160, 3))
    film.save_film(surface, tmp_path / "ramp.gif", size=160, frames=3)
    with Image.open(tmp_path / "ramp.gif") as picture:
        for number, frame in enumerate(drawn):
            picture.seek(number)
            shown = np.asarray(picture.convert("RGB")).astype(int)
            assert (shown[0, 0] == 255).all()
            assert np.quantile(np.abs(shown - frame).max(axis=2), 0.98) <= 8
