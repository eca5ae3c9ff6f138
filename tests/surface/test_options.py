"""Options of ``lift`` that make no sense are refused before any work."""

import numpy as np
import pytest

from plyfold import lift
from plyfold.errors import InputError

SQUARE = [(0, 0), (4, 0), (4, 3), (0, 3)]


@pytest.mark.parametrize(
    "option",
    [
        {"gap": 0},
        {"gap": -1},
        {"gap": float("nan")},
        {"gap": float("inf")},
        {"triangles": 0},
        {"triangles": -5},
        {"triangles": 10**9},
        {"max_area": 0},
        {"max_area": -1},
        {"max_area": float("nan")},
        {"max_area": 1e-9},
    ],
)
def test_refused(option):
    with pytest.raises(InputError):
        lift(SQUARE, **option)


WRONG = ["x", [1], {}, b"1", 1 + 2j, np.array([1, 2])]


@pytest.mark.parametrize("wrong", WRONG, ids=repr)
@pytest.mark.parametrize("name", ["gap", "triangles", "max_area", "size", "stiffness", "flat", "allow_intersections"])
def test_options_of_the_wrong_kind_are_named(name, wrong):
    with pytest.raises(InputError, match=f"^{name} must be"):
        lift(SQUARE, **{name: wrong})


@pytest.mark.parametrize("name", ["triangles", "stiffness", "flat", "allow_intersections"])
def test_options_without_a_nothing(name):
    with pytest.raises(InputError, match=f"^{name} must be"):
        lift(SQUARE, **{name: None})


@pytest.mark.parametrize("pins", ["x", [1], 3.0, {0: "high"}, {0: None}, {"a": 1.0}, {(1, "b"): 1.0}, {0: [1]}])
def test_pins_of_the_wrong_kind(pins):
    with pytest.raises(InputError, match="pin"):
        lift(SQUARE, pins=pins)


@pytest.mark.parametrize("wrong", [*WRONG, None], ids=repr)
def test_thickness_is_a_number(wrong):
    with pytest.raises(InputError, match="thickness must be"):
        lift(SQUARE, triangles=10).thicken(wrong)


@pytest.mark.parametrize("wrong", ["x", 1, [], float("nan")])
def test_export_options_of_the_wrong_kind(tmp_path, wrong):
    surface = lift(SQUARE, triangles=10)
    for option in ({"unwrapped": wrong}, {"force": wrong}, {"colours": np.array([1, 2])}):
        with pytest.raises(InputError):
            surface.export(tmp_path / "out.glb", **option)
    with pytest.raises(InputError, match="title"):
        surface.export(tmp_path / "out.html", title=7)
    assert list(tmp_path.iterdir()) == []


def test_numbers_of_numpy_are_numbers():
    surface = lift(SQUARE, gap=np.float32(0.5), triangles=np.int64(10), stiffness=np.float64(0.5), flat=np.float64(2))
    assert surface.gap == 0.5


def test_larger_areas_make_fewer_triangles():
    sizes = [len(lift(SQUARE, max_area=area).faces) for area in (0.01, 0.1, 1.0, float("inf"))]
    assert sizes == sorted(sizes, reverse=True)
    assert sizes[-1] == 2


@pytest.mark.parametrize("height", [1e-3, 1e-5, 1e-6])
def test_needles_do_not_blow_up_the_mesh(height):
    assert len(lift([(0, 0), (1, 0), (0.5, height)]).faces) < 10_000


def test_edges_that_were_moved_apart_neither():
    surface = lift(
        [(0, 0), (6, 0), (6, 6), (0, 6), (0, 2), (2, 2), (2, 4), (4, 4), (4, 2), (2, 2), (0, 2)], triangles=50
    )
    assert len(surface.faces) < 1000
    surface.check()
