"""Options of ``lift`` that make no sense are refused before any work."""

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


def test_larger_areas_make_fewer_triangles():
    sizes = [len(lift(SQUARE, max_area=area).faces) for area in (0.01, 0.1, 1.0, float("inf"))]
    assert sizes == sorted(sizes, reverse=True)
    assert sizes[-1] == 2


@pytest.mark.parametrize("height", [1e-3, 1e-5, 1e-6])
def test_needles_do_not_blow_up_the_mesh(height):
    assert len(lift([(0, 0), (1, 0), (0.5, height)]).faces) < 10_000


def test_spikes_that_were_moved_apart_neither():
    surface = lift([(3, 3), (-3, -2), (-2, 0), (-3, -2)], triangles=50)
    assert len(surface.faces) < 1000
    surface.check()
