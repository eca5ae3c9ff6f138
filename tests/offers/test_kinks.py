"""Lobes to be left out, so that a disk remains: against gluing all sheets of what every other lobe leaves."""

import math

import numpy as np
import pytest

import plyfold as pf
from plyfold.offers.kinks import find_kink
from reference import crossings, gluings
from reference.random_curves import random_polygon


def bounds_disk(points):
    """Whether the polygon bounds an immersed disk, by gluing all sheets in all ways."""
    if abs(crossings.turning_number(points)) != 1:
        return False
    upright = points if crossings.turning_number(points) == 1 else points[::-1]
    return bool(gluings.immersions(*crossings.crossings(upright)[0]))


def lobes_without(points):
    """Each crossing's shorter lobe, shortest first: (its length, the crossing, the rest of the curve)."""
    found = []
    for meeting in crossings.meetings(crossings.exact(points)):
        where = tuple(map(float, meeting.point))
        inner = [where, *points[meeting.first + 1 : meeting.second + 1]]
        outer = [where, *points[meeting.second + 1 :], *points[: meeting.first + 1]]
        lengths = [sum(map(math.dist, lobe, lobe[1:] + lobe[:1])) for lobe in (inner, outer)]
        found.append((min(lengths), where, outer if lengths[0] <= lengths[1] else inner))
    return sorted(found)


@pytest.mark.parametrize("seed", range(60))
def test_the_kink_is_the_shortest_lobe_that_leaves_a_disk(seed):
    points = random_polygon(np.random.default_rng(seed), 7)
    arranged = pf.arrange(points)
    if pf.bounds_disk(arranged):
        return
    expected = next((lobe for lobe in lobes_without(points) if bounds_disk(lobe[2])), None)
    kink = find_kink(arranged)
    if expected is None:
        assert kink is None or len(kink.lobes) == 2
    else:
        assert kink.places == (pytest.approx(expected[1]),)
        assert sorted(map(tuple, kink.rest.tolist())) == [pytest.approx(p) for p in sorted(expected[2])]
    if kink is not None:
        assert bounds_disk(kink.rest.tolist())
