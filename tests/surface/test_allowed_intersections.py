"""Surfaces whose sheets pass through each other, and only where they say."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from coarse import CURVES
from plyfold.arrangement.arrangement import arrange
from plyfold.arrangement.gauss import GaussCode
from plyfold.certify import check_layered, check_surface
from plyfold.errors import CertificateError, NotEmbeddableError
from plyfold.immersion.solve import immersions
from plyfold.layering.orders.intersections import IntersectingLayering, least_intersecting_layering
from plyfold.layering.orders.search import find_layering
from plyfold.mesh.cells import triangulate_cells
from plyfold.surface.chords import split_chords
from plyfold.surface.lift import lift
from reference.triangles import in_span, intersection, meeting_pairs

SMALLEST = (
    [9, 4, 3, 2, 1, 10, 7, 6, 11, 0, 5, 8, 13, 12, 15, 14],
    [1, 1, 1, 0, 0, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0],
    5,
)


def failing(name):
    """The immersions that do not lift: of the Bennequin-like curve, or of one of the smallest curves that have some."""
    curve = CURVES[name].curve if name in CURVES else GaussCode(*SMALLEST).to_curve()
    return [immersion for immersion in immersions(curve) if not find_layering(immersion)]


DISKS = [*failing("bennequin"), *failing("smallest")]


def worse(immersion, seed):
    """Random orders of the sheets: many intersections, several along one border."""
    rng = np.random.default_rng(seed)
    levels = [1 + rng.permutation(len(sheets)) for sheets in immersion.sheets]
    return IntersectingLayering(immersion, np.concatenate(levels), optimal=False)


def distances(points, polyline):
    """Distance of each point to a polyline in space."""
    start, step = polyline[:-1], np.diff(polyline, axis=0)
    lengths = np.maximum((step**2).sum(axis=1), 1e-300)
    share = np.clip(((points[:, None] - start) * step).sum(axis=2) / lengths, 0, 1)
    return np.linalg.norm(points[:, None] - start - share[..., None] * step, axis=2).min(axis=1)


def meetings(surface):
    """For all triangles that meet in more than common corners: the points that span what they have in common."""
    for pair in meeting_pairs(surface.vertices, surface.faces):
        first, second = ([tuple(map(Fraction, c)) for c in surface.vertices[surface.faces[t]].tolist()] for t in pair)
        corners = [corner for corner in first if corner in second]
        points = [point for point in intersection(first, second) if not in_span(point, corners)]
        over = {corner[:2] for corner in first} == {corner[:2] for corner in second}
        yield over, np.array(points, dtype=np.float64)


@pytest.mark.parametrize("triangles", [1, 300])
@pytest.mark.parametrize("immersion", failing("bennequin"), ids=str)
def test_sheets_meet_exactly_along_the_reported_lines(immersion, triangles):
    """A test that knows nothing of layers finds triangles that meet along the lines, and no others."""
    surface = lift(immersion, allow_intersections=True, triangles=triangles)
    surface.check()
    assert len(surface.layering.intersections) == 1
    assert len(surface.intersections) == 1
    polyline = surface.intersections[0]
    length = 0.0
    for over_each_other, points in meetings(surface):
        assert distances(points, polyline).max() < 1e-9 * np.ptp(surface.vertices)
        if over_each_other:
            length += np.linalg.norm(np.ptp(points, axis=0))
    assert length == pytest.approx(np.linalg.norm(np.diff(polyline, axis=0), axis=1).sum())


@pytest.mark.parametrize("immersion", DISKS, ids=str)
def test_lines_run_near_the_borders(immersion):
    """They begin and end on the outline, and stay in triangles along the border."""
    surface = lift(immersion, allow_intersections=True, triangles=2000)
    border = immersion.arrangement.border_points(int(surface.layering.intersections[0, 0]))
    flat = np.column_stack([border, np.zeros(len(border))])
    polyline = surface.intersections[0].copy()
    polyline[:, 2] = 0
    total = np.linalg.norm(np.diff(flat, axis=0), axis=1).sum()
    assert distances(polyline, flat).max() < 0.25 * total
    outline = np.concatenate([immersion.arrangement.curve.points, immersion.arrangement.curve.points[:1]])
    outline = np.column_stack([outline, np.zeros(len(outline))])
    assert distances(polyline[[0, -1]], outline).max() < 1e-9 * np.ptp(outline)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("triangles", [1, 200])
@pytest.mark.parametrize("name", ["bennequin", "milnor", "stacked-spiral"])
def test_any_orders_of_sheets_make_a_surface(name, triangles, seed):
    """Several sheets pass through each other along one border, and at one crossing."""
    layering = worse(next(immersions(CURVES[name].curve)), seed)
    surface = lift(layering, triangles=triangles)
    surface.check()
    assert (len(surface.intersections) > 0) == (len(layering.intersections) > 0)


def test_random_orders_meet_along_the_lines_too():
    surface = lift(worse(failing("bennequin")[0], 1), triangles=1)
    assert len(surface.intersections) > 5
    for _, points in meetings(surface):
        nearest = np.min([distances(points, polyline) for polyline in surface.intersections], axis=0)
        assert nearest.max() < 1e-9 * np.ptp(surface.vertices)


def test_gap_away_from_intersections():
    """Sheets are a gap apart where they are two gaps and more away from the line; at the line they are not."""
    immersion = failing("bennequin")[0]
    surface = lift(immersion, allow_intersections=True, gap=5.0, triangles=1500)
    with pytest.raises(CertificateError, match="less than 5 apart"):
        check_layered(surface.vertices, surface.faces, surface.gap, surface.passing)
    order = np.lexsort(surface.vertices.T[[2, 1, 0]])
    stacked = (np.diff(surface.vertices[order, :2], axis=0) == 0).all(axis=1)
    lower, upper = surface.vertices[order[:-1][stacked]], surface.vertices[order[1:][stacked]]
    border = immersion.arrangement.border_points(int(surface.layering.intersections[0, 0]))
    away = distances(np.column_stack([lower[:, :2], np.zeros(len(lower))]), np.column_stack([border, [0, 0]])) > 10.0
    assert away.sum() > 100
    assert (upper[away, 2] - lower[away, 2] >= 5.0).all()


def test_embeddable_curves_stay_embedded():
    surface = lift(CURVES["bennequin"].curve, allow_intersections=True, triangles=100)
    assert surface.intersections == ()
    assert np.array_equal(surface.vertices, lift(CURVES["bennequin"].curve, triangles=100).vertices)


def test_not_without_permission():
    with pytest.raises(NotEmbeddableError):
        lift(failing("bennequin")[0])


def test_best_of_several_immersions(monkeypatch):
    candidates = failing("bennequin")
    monkeypatch.setattr("plyfold.surface.lift.watched_immersions", lambda *_: iter(candidates))
    surface = lift(CURVES["bennequin"].curve, allow_intersections=True, triangles=50)
    assert surface.layering.total_length == min(least_intersecting_layering(i).total_length for i in candidates)


def test_out_of_time():
    surface = lift(least_intersecting_layering(failing("bennequin")[0], time_limit=0), triangles=50)
    assert not surface.layering.optimal
    surface.check()


@pytest.fixture(scope="module")
def surface():
    return lift(failing("bennequin")[0], allow_intersections=True, triangles=50)


class TestChecker:
    """Spoiled in any way, the surface is refused."""

    @staticmethod
    def check(surface):
        check_surface(surface.curve.points, surface.vertices, surface.faces, surface.boundary, passing=surface.passing)

    def test_as_it_is(self, surface):
        self.check(surface)

    def test_every_edge_must_be_named(self, surface):
        for i in range(len(surface.passing)):
            with pytest.raises(CertificateError, match="over one another"):
                self.check(replace(surface, passing=np.delete(surface.passing, i, axis=0)))

    def test_named_edges_must_be_edges_over_one_another(self, surface):
        for row in ([0, 1, 0, 1], [0, 1, 2, 3], surface.passing[0][[0, 1, 3, 2]], surface.passing[0][[0, 0, 2, 2]]):
            with pytest.raises(CertificateError, match="row 0"):
                self.check(replace(surface, passing=np.array([row])))

    def test_sheets_exchanged_elsewhere(self, surface):
        """The heights of two vertices over one another that are not named, exchanged."""
        order = np.lexsort(surface.vertices.T[[2, 1, 0]])
        stacked = np.flatnonzero((np.diff(surface.vertices[order, :2], axis=0) == 0).all(axis=1))
        for i in stacked[~np.isin(order[stacked], surface.passing)][:20]:
            vertices = surface.vertices.copy()
            vertices[order[[i, i + 1]], 2] = vertices[order[[i + 1, i]], 2]
            with pytest.raises(CertificateError, match="change their order"):
                self.check(replace(surface, vertices=vertices))

    def test_triangles_with_all_corners_named(self):
        two = [(x, y, z) for z in (0, 1) for x, y in [(0, 0), (1, 0), (0, 1)]]
        with pytest.raises(CertificateError, match="have no order"):
            check_layered(two, [[0, 1, 2], [3, 4, 5]], passing=[(0, 1, 3, 4), (1, 2, 4, 5), (2, 0, 5, 3)])
        check_layered(two, [[0, 1, 2], [3, 4, 5]], passing=[(0, 1, 3, 4)])

    def test_edges_with_both_ends_named(self):
        """Two squares: named are two opposite sides, and so both ends of the diagonal."""
        two = [(x, y, z) for z in (0, 1) for x, y in [(0, 0), (1, 0), (1, 1), (0, 1)]]
        faces = [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]]
        with pytest.raises(CertificateError, match="have no order"):
            check_layered(two, faces, passing=[(0, 1, 4, 5), (2, 3, 6, 7)])


def test_no_chord_is_left():
    """Of every edge inside a cell one end is no point of the borders; area and outline are as they were."""
    arranged = arrange(CURVES["bennequin"].curve)
    borders = np.arange(arranged.n_borders)
    for triangles in (0, 300):
        plain = triangulate_cells(arranged, triangles=triangles)
        split = split_chords(plain, borders)
        start, end = split.triangles.ravel(), np.roll(split.triangles, -1, axis=1).ravel()
        following = np.roll(split.chain, -1)
        pieces = {frozenset(pair) for pair in zip(split.chain.tolist(), following.tolist(), strict=True)}
        on_curve = set(split.chain.tolist())
        for a, b, twin in zip(start.tolist(), end.tolist(), split.twin.tolist(), strict=True):
            assert not {a, b} <= on_curve or frozenset((a, b)) in pieces
            assert twin < 0 or (start[twin], end[twin]) == (b, a)
        assert not (np.isin(split.triangles, split.chain).all(axis=1)).any()
        assert np.array_equal(start[split.left], split.chain)
        assert np.array_equal(end[split.left], following)
        assert split.chain[split.chain < len(plain.points)].tolist() == plain.chain.tolist()
        assert np.bincount(split.chain_border).min() > 1
        for cell in np.unique(plain.cell):
            areas = [
                sum(np.linalg.det(np.column_stack([m.points[t], np.ones(3)])) for t in m.triangles[m.cell == cell])
                for m in (plain, split)
            ]
            assert areas[0] == pytest.approx(areas[1])
