"""Triangles and polygons of many outlines are those of single calls."""

import re

import numpy as np
import pytest

import heaps
import plyfold as pf
from plyfold.errors import NotImmersibleError, PlyfoldError

CALLS = [(pf.triangulate_many, pf.triangulate), (pf.decompose_many, pf.decompose)]


@pytest.mark.parametrize(("call", "single"), CALLS)
def test_each_is_as_alone(call, single):
    outlines = [
        *heaps.glyphs(4, 1),
        *heaps.strokes(4, 1),
        *heaps.buildings(6, 1),
        *heaps.others(1)[:5],
        [(0, 0), (2, 2), (2, 0), (0, 2)],
        [(0, 0), (1, 1)],
    ]
    found = call(outlines)
    assert len(found) == len(outlines)
    for row, outline in enumerate(outlines):
        try:
            expected = single(outline)
        except PlyfoldError as error:
            with pytest.raises(type(error), match=re.escape(str(error))):
                found[row]
            assert found.first[row] == found.first[row + 1]
        else:
            assert len(found[row]) == len(expected)
            assert np.array_equal(found[row], expected)
    assert isinstance(found.errors[len(outlines) - 2], NotImmersibleError)
    assert found.first[-1] == len(found.values)


@pytest.mark.parametrize(("call", "_"), CALLS)
def test_none_at_all(call, _):
    found = call([])
    assert (len(found), len(found.values), found.first.tolist()) == (0, 0, [0])
    with pytest.raises(IndexError):
        found[0]
    assert len(call([[(0, 0), (1, 0), (0, 1)]])[-1]) == 1
