from itertools import combinations

import numpy as np
import pytest
import shapely

from plyfold import find_immersion, immersions
from plyfold.draw.placement import BorderCircle, geodesic

BENNEQUIN = [
    (-18, -81), (62, -52), (19, 31), (34, 30), (-175, 9), (59, -176), (79, 25), (14, 80), (-36, 1), (-43, 14),
    (80, -156), (124, 139), (-61, 56), (-76, -28), (17, -32), (9, -44), (95, 147), (-182, 37),
]  # fmt: skip


@pytest.mark.parametrize(("start", "end"), [(0.0, 1.0), (2.0, -2.5), (0.3, 0.3 + 3.0), (5.0, 5.2)])
def test_arc_is_a_circle_at_right_angles_to_the_disk(start, end):
    points = geodesic(start, end, points=25)
    # Inversion in a circle orthogonal to the unit circle keeps it: |p|² + 1 = 2 p·c for its centre c.
    system = 2 * points
    centre, *_ = np.linalg.lstsq(system, (points**2).sum(axis=1) + 1, rcond=None)
    assert system @ centre == pytest.approx((points**2).sum(axis=1) + 1)
    assert points[[0, -1]] == pytest.approx(np.array([[np.cos(a), np.sin(a)] for a in (start, end)]))


def test_arc_between_opposite_points_is_a_diameter():
    points = geodesic(0.7, 0.7 + np.pi)
    assert points @ [-np.sin(0.7), np.cos(0.7)] == pytest.approx(np.zeros(len(points)))


def test_arcs_cross_exactly_if_their_ends_interleave():
    ends = np.sort(np.random.default_rng(5).uniform(0, 2 * np.pi, (200, 4)), axis=1)
    for a, b, c, d in ends:
        apart = shapely.LineString(geodesic(a, b)), shapely.LineString(geodesic(c, d))
        interleaved = shapely.LineString(geodesic(a, c)), shapely.LineString(geodesic(b, d))
        assert not apart[0].intersects(apart[1])
        assert interleaved[0].intersects(interleaved[1])


def test_regions_of_different_sheets_never_overlap():
    for immersion in immersions(BENNEQUIN):
        circle = BorderCircle(immersion.arrangement.n_borders)
        regions = [shapely.Polygon(circle.region(group.borders)) for group in immersion.disk_layout()]
        assert all(region.is_valid for region in regions)
        assert not any(a.intersects(b) for a, b in combinations(regions, 2))


def test_one_border_is_the_whole_circle():
    circle = BorderCircle(1)
    (group,) = find_immersion([(0, 0), (1, 0), (0, 1)]).disk_layout()
    assert shapely.Polygon(circle.region(group.borders)).area == pytest.approx(np.pi, rel=1e-3)


def test_borders_run_counter_clockwise():
    circle = BorderCircle(5)
    angles = np.unwrap([circle.angle(border, share) for border in range(5) for share in (0.0, 0.5, 1.0)])
    assert (np.diff(angles) > 0).all()
