import numpy as np
import pytest
from matplotlib.figure import Figure

from plyfold import arrange, find_immersion, find_layering, lift
from plyfold.draw import plot_collapsed_graphs, plot_immersions
from plyfold.draw.figures import overview, save, summary
from plyfold.draw.viewer import frame
from plyfold.errors import InputError

RAMP = np.array([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)], float)
EIGHT = [(0, 0), (2, 2), (2, 0), (0, 2)]


def titles(figure):
    return [ax.get_title() for ax in figure.axes]


def test_overview_shows_every_stage_so_far():
    immersion = find_immersion(RAMP)
    assert len(titles(overview(arrange(RAMP)))) == 1
    assert titles(overview(immersion))[1:] == ["The disk layout"]
    assert titles(overview(find_layering(immersion)))[1:] == ["The disk layout", "The layers"]
    assert len(titles(overview(lift(RAMP)))) == 5


def test_overview_of_a_refused_curve_says_why():
    why = find_immersion(EIGHT)
    (ax,) = overview(arrange(EIGHT), why).axes
    assert str(why) in [" ".join(text.get_text().split()) for text in ax.texts]


@pytest.mark.parametrize(("ending", "start"), [("png", b"\x89PNG"), ("svg", b"<?xml"), ("pdf", b"%PDF")])
def test_ending_chooses_the_format(tmp_path, ending, start):
    save(Figure(figsize=(1, 1)), tmp_path / f"empty.{ending}")
    assert (tmp_path / f"empty.{ending}").read_bytes().startswith(start)


def test_existing_files_are_kept_unless_forced(tmp_path):
    target = tmp_path / "picture.png"
    target.write_text("precious")
    with pytest.raises(FileExistsError, match="exists already"):
        save(Figure(figsize=(1, 1)), target)
    assert target.read_text() == "precious"
    save(Figure(figsize=(1, 1)), target, force=True)
    assert target.read_bytes().startswith(b"\x89PNG")


def test_failed_picture_leaves_nothing_behind(tmp_path):
    with pytest.raises(InputError, match=r"picture\.xyz"):
        save(Figure(), tmp_path / "picture.xyz")
    assert list(tmp_path.iterdir()) == []


def test_summary_writes_one_picture(tmp_path):
    from PIL import Image

    summary(lift(RAMP), tmp_path / "ramp.png")
    assert [path.name for path in tmp_path.iterdir()] == ["ramp.png"]
    with Image.open(tmp_path / "ramp.png") as picture:
        assert min(picture.size) > 1000


@pytest.mark.parametrize("wrong", ["x", None, 0, -1, 2.5, True, float("nan")])
def test_numbers_of_panels_and_pixels_are_whole(wrong):
    for draw in (
        lambda: plot_immersions(RAMP, most=wrong),
        lambda: plot_collapsed_graphs(find_immersion(RAMP), most=wrong),
        lambda: frame(lift(RAMP[:3], triangles=2), height=wrong),
    ):
        with pytest.raises(InputError, match="whole number"):
            draw()
