"""Pictures and films of least homotopies."""

import re

import numpy as np
import pytest
from PIL import Image

import plyfold as pf
from plyfold.errors import InputError
from reference.random_curves import random_polygon

EIGHT = [(0, 0), (2, 2), (2, 0), (0, 2)]
LIMACON = [(3, 0), (1, 3), (-2, 0), (1, -3), (3, 0.5), (1, 1), (0.5, 0), (1, -1)]


def test_cells_say_how_often_they_are_swept():
    found = pf.least_homotopy(LIMACON)
    ax = pf.draw.plot_homotopy(found)
    assert sorted(int(text.get_text()) for text in ax.texts) == [1, 1, 1, 2]
    assert len(ax.lines) == 2


def test_loops_with_the_disk_on_their_right_are_dashed():
    styles = {line.get_linestyle() for line in pf.draw.plot_homotopy(EIGHT).lines}
    assert styles == {"-", "--"}


def test_bounds_are_written_below():
    found = pf.least_homotopy(pf.arrange(random_polygon(np.random.default_rng(1), 30)), time_limit=0)
    assert pf.draw.plot_homotopy(found).texts[-1].get_text().startswith("at most")


def test_a_page_has_the_film_and_the_area(tmp_path):
    pf.draw.save_contraction(EIGHT, tmp_path / "eight.html", size=60, frames=4, title="<8>")
    text = (tmp_path / "eight.html").read_text()
    assert "<title>&lt;8&gt;</title>" in text
    swept = re.search(r"swept = \[(.*)\];", text)[1].replace("'", "").split(", ")
    assert (swept[0], swept[-1]) == ("0", "2")
    assert text.count("iVBOR") == 4


def test_a_gif_goes_there_and_back(tmp_path):
    pf.draw.save_contraction(EIGHT, tmp_path / "eight.gif", size=60, frames=4)
    with Image.open(tmp_path / "eight.gif") as film:
        assert (film.size, film.n_frames) == ((60, 60), 6)


def test_other_endings_and_sizes_are_refused(tmp_path):
    with pytest.raises(InputError, match=r"cannot be written as \.txt"):
        pf.draw.save_contraction(EIGHT, tmp_path / "eight.txt")
    with pytest.raises(InputError, match="size"):
        pf.draw.save_contraction(EIGHT, tmp_path / "eight.gif", size=0)
    (tmp_path / "eight.gif").touch()
    with pytest.raises(FileExistsError):
        pf.draw.save_contraction(EIGHT, tmp_path / "eight.gif")
