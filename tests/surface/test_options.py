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
