"""The reference code itself, against published counts, hand-known curves, and its own independent second ways."""

import itertools

import numpy as np
import pytest

from reference import crossings, gluings, layerings, planar_maps, random_curves
from reference.planar_maps import CIRCLE, census, gauss_code, may_bound_disk, oriented, oriented_census, windings

FIGURE_EIGHT = [(0, 0), (4, 4), (4, 0), (0, 4)]
LIMACON = [(0, 0), (10, 0), (10, 8), (2, 8), (2, 3), (6, 3), (6, 6), (0, 6)]
RAMP = [(0, 0), (10, 0), (10, 10), (4, 10), (4, -5), (6, -5), (6, 8), (8, 8), (8, 2), (0, 2)]
"""A strip that runs round and crosses over its own beginning: k = 4, one immersion, above or below."""
TWO_DISKS_ONE_LAYERED = gauss_code(
    [9, 4, 3, 2, 1, 10, 7, 6, 11, 0, 5, 8, 13, 12, 15, 14], [1, 1, 1, 0, 0, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0], 5
)
"""Eight crossings; among the smallest curves with an immersed disk that no layering exists for."""


def up_to(crossing_count):
    return range(crossing_count + 1)


def candidates(crossing_count):
    return [code for code in census(crossing_count) if may_bound_disk(code)]


def layering_counts(code):
    groups = layerings.layerings_by_immersion(code, gluings.immersions(*code))
    return tuple(sorted(len(group) for group in groups.values()))


def random_outlines(seed, count):
    rng = np.random.default_rng(seed)
    makers = [
        lambda: random_curves.random_polygon(rng, int(rng.integers(3, 10))),
        lambda: random_curves.smooth_curve(rng, int(rng.integers(1, 6)), 30),
        lambda: random_curves.ribbon_outline(rng, int(rng.integers(1, 20))),
        lambda: random_curves.glued_disk(rng, int(rng.integers(1, 20))),
    ]
    return [makers[i % len(makers)]() for i in range(count)]


class TestCensus:
    def test_published_counts_up_to_reflection_and_reversal(self):
        assert [len(census(k)) for k in range(1, 7)] == [2, 5, 20, 82, 435, 2645]

    def test_published_counts_of_oriented_curves_with_turning_number_one(self):
        assert [len(oriented_census(k)) for k in range(7)] == [1, 0, 3, 0, 57, 0, 2370]

    def test_curves_that_pass_the_cheap_conditions(self):
        assert [len(candidates(k)) for k in range(7)] == [1, 0, 1, 0, 11, 0, 246]

    @pytest.mark.parametrize("k", up_to(5))
    def test_two_formulas_for_the_turning_number_agree(self, k):
        for code in census(k):
            assert planar_maps.turning_number(code) == planar_maps.turning_number_from_windings(code) >= 0

    @pytest.mark.parametrize("k", up_to(4))
    def test_reversal_and_reflection_change_signs(self, k):
        for code in census(k):
            for change in (planar_maps.reversed_code, planar_maps.reflected):
                assert planar_maps.turning_number(change(code)) == -planar_maps.turning_number(code)
                assert sorted(windings(change(code))) == sorted(-w for w in windings(code))
                assert change(change(code)) == planar_maps.with_smallest_outer_dart(code)

    @pytest.mark.parametrize("k", up_to(4))
    def test_every_border_is_on_the_left_of_its_two_darts_once(self, k):
        for code in census(k):
            darts = sorted(dart for cell in planar_maps.cells(code.partner, code.ccw) for dart in cell)
            assert darts == list(range(2 * planar_maps.border_count(code)))


class TestHandKnownCurves:
    def test_circle(self):
        assert planar_maps.turning_number(CIRCLE) == 1
        assert gluings.immersions(*CIRCLE) == [((0,), ())]
        assert layering_counts(CIRCLE) == (1,)

    def test_figure_eight_turns_zero_times(self):
        code = crossings.crossings(FIGURE_EIGHT).code
        assert planar_maps.with_smallest_outer_dart(code) == gauss_code([1, 0], [True, False], 0)
        assert planar_maps.turning_number(code) == crossings.turning_number(FIGURE_EIGHT) == 0
        assert sorted(windings(code)) == [-1, 0, 1]
        assert gluings.immersions(*code) == []

    def test_limacon_is_refused(self):
        code = crossings.crossings(LIMACON).code
        assert (code.partner, code.ccw) == ((1, 0), (False, True))
        assert planar_maps.turning_number(code) == crossings.turning_number(LIMACON) == 2
        assert sorted(windings(code)) == [0, 1, 2]
        assert gluings.immersions(*code) == []

    def test_clockwise_curve_must_be_oriented_first(self):
        with pytest.raises(ValueError, match="orient"):
            gluings.immersions(*planar_maps.reversed_code(CIRCLE))

    def test_ramp_lies_above_or_below_its_beginning(self):
        code = crossings.crossings(RAMP).code
        assert (len(code.partner), crossings.turning_number(RAMP)) == (8, 1)
        assert layering_counts(code) == (2,)

    def test_smallest_disk_without_layering(self):
        assert layering_counts(TWO_DISKS_ONE_LAYERED) == (0, 2)


class TestImmersions:
    @pytest.mark.parametrize(("k", "immersible"), [(0, 1), (2, 1), (4, 7), (6, 86)])
    def test_published_numbers_of_immersible_curves(self, k, immersible):
        assert sum(bool(gluings.immersions(*code)) for code in candidates(k)) == immersible

    def test_two_curves_with_six_crossings_have_two_immersions(self):
        counts = [len(gluings.immersions(*code)) for code in candidates(6)]
        assert (counts.count(2), max(counts)) == (2, 2)

    @pytest.mark.parametrize("k", [0, 2, 4, 6])
    def test_every_immersion_satisfies_the_definition_and_has_its_own_key(self, k):
        for code in candidates(k):
            found = gluings.immersions(*code)
            assert not any(gluings.problems(code, *immersion) for immersion in found)
            assert len(gluings.keys(*code)) == len(found)

    def test_all_injections_of_all_borders_give_as_many_classes_as_normal_forms(self):
        for code in [*candidates(2), *candidates(4)]:
            assert len(classes_without_normal_form(code)) == len(gluings.immersions(*code))

    @pytest.mark.parametrize("k", [2, 4])
    def test_key_does_not_depend_on_numbering_of_sheets_or_order_of_rows(self, k):
        rng = np.random.default_rng(k)
        for code in candidates(k):
            for own, rows in gluings.immersions(*code):
                name = rng.permutation(100)
                renamed = [(e, name[right], name[left]) for e, right, left in rows]
                assert gluings.key_of(*code, name[list(own)], rng.permutation(renamed)) == gluings.key_of(
                    *code, own, rows
                )

    def test_key_refuses_what_is_no_immersion(self):
        code = next(code for code in candidates(4) if gluings.immersions(*code))
        own, rows = gluings.immersions(*code)[0]
        for wrong in ((own, rows[1:]), (own[::-1], rows), (own, [*rows, rows[0]])):
            with pytest.raises(ValueError, match="not an immersion"):
                gluings.key_of(*code, *wrong)

    def test_number_of_immersions_does_not_depend_on_start_or_mirror_image(self):
        for code in candidates(4):
            copies = {oriented(copy) for copy in planar_maps.symmetric_copies(code)}
            assert len({len(gluings.immersions(*copy)) for copy in copies}) == 1

    def test_outlines_of_glued_disks_and_ribbons_bound_disks(self):
        rng = np.random.default_rng(7)
        for polygon in [
            *(random_curves.glued_disk(rng, 25) for _ in range(15)),
            *(random_curves.ribbon_outline(rng, 20) for _ in range(15)),
        ]:
            assert gluings.immersions(*crossings.crossings(polygon).code)


def classes_without_normal_form(code):
    """Classes of families under renaming, from all injections over all borders, with no choice of representatives."""
    sides, winding = planar_maps.left_and_right(code), windings(code)
    every = [list(itertools.permutations(range(winding[left]))) for left, _ in sides]
    families = (dict(enumerate(choice)) for choice in itertools.product(*every))
    corners = planar_maps.corners(code)
    good = [phi for phi in families if all(gluings.agree(corner, phi) for corner in corners)]
    return {frozenset(renamings(phi, sides, winding)) for phi in good}


def renamings(phi, sides, winding):
    """The family in all numberings of the sheets of all cells."""
    for names in itertools.product(*(itertools.permutations(range(w)) for w in winding)):
        renamed = []
        for border, (left, right) in enumerate(sides):
            *images, own = phi[border]
            pairs = sorted((names[right][i], names[left][image]) for i, image in enumerate(images))
            renamed.append((*pairs, names[left][own]))
        yield tuple(renamed)


class TestLayerings:
    @pytest.mark.parametrize("k", [0, 2, 4, pytest.param(6, marks=pytest.mark.slow)])
    def test_orders_of_sheets_and_levels_of_borders_agree(self, k):
        for code in candidates(k):
            from_immersions = layerings.layerings_by_immersion(code, gluings.immersions(*code))
            assert layerings.level_solutions_by_immersion(code) == from_immersions
            assert all(from_immersions.values()), "every immersed disk with up to six crossings has a layering"

    def test_layerings_satisfy_the_definition(self):
        for code in candidates(4):
            for own, rows in gluings.immersions(*code):
                for level in layerings.layerings(*code, own, rows):
                    assert layerings.is_layering(code, own, rows, level)
                    upside_down = {sheet: -level[sheet] for sheet in level}
                    assert not layerings.is_layering(code, own, rows, upside_down)


class TestSeveralImmersions:
    @pytest.mark.parametrize(("polygon", "k", "expected"), random_curves.SEVERAL_IMMERSIONS)
    def test_known_polygons(self, polygon, k, expected):
        code = oriented(crossings.crossings(polygon).code)
        assert len(code.partner) == 2 * k
        assert layering_counts(code) == expected
        direct = layerings.level_solutions_by_immersion(code)
        assert tuple(sorted(len(group) for group in direct.values())) == tuple(n for n in expected if n)


class TestCrossings:
    def test_random_polygons_are_planar_and_turn_as_whitney_says(self):
        for polygon in random_outlines(3, 60):
            code = crossings.crossings(polygon).code
            assert len(planar_maps.cells(code.partner, code.ccw)) == len(code.partner) // 2 + 2
            assert planar_maps.turning_number(code) == crossings.turning_number(polygon)

    def test_windings_of_cells_are_windings_of_points_beside_the_borders(self):
        for polygon in random_outlines(4, 30):
            found = crossings.crossings(polygon)
            sides, winding = planar_maps.left_and_right(found.code), windings(found.code)
            for (border, left), right in points_beside(polygon, found):
                assert crossings.winding_number(polygon, left) == winding[sides[border][0]]
                assert crossings.winding_number(polygon, right) == winding[sides[border][1]]

    @pytest.mark.parametrize(("points", "step"), [(5, 2), (7, 2), (7, 3), (9, 4)])
    def test_stars(self, points, step):
        star = random_curves.star_polygon(points, step)
        code = crossings.crossings(star).code
        assert len(code.partner) == 2 * points * (step - 1)
        assert (crossings.turning_number(star), max(windings(code))) == (step, step)

    def test_signs_and_order_of_a_bow_tie(self):
        found = crossings.crossings([(0, 0), (4, 4), (4, 0), (0, 4)])
        assert found.code.partner == (1, 0)
        assert found.code.ccw == (True, False)
        assert found.points == ((2, 2), (2, 2))
        assert found.edges == (0, 2)

    @pytest.mark.parametrize(
        ("polygon", "kind"),
        [
            ([(0, 0), (4, 0), (4, 4), (2, 0)], "vertex on edge"),
            ([(0, 0), (4, 0), (4, 4), (0, 0), (-4, 4)], "vertex on edge"),
            ([(0, 0), (4, 0), (2, 0), (2, 3)], "vertex on edge"),
            ([(0, 0), (0, 0), (4, 0), (4, 4)], "repeated vertex"),
            ([(-2, 0), (2, 0), (2, 2), (-2, -2), (0, -3), (0, 3)], "more than two edges"),
        ],
    )
    def test_degenerate_polygons_are_reported(self, polygon, kind):
        with pytest.raises(crossings.DegenerateError) as caught:
            crossings.crossings(polygon)
        assert kind in {found for found, _ in caught.value.places}

    def test_turning_straight_back_is_reported(self):
        with pytest.raises(crossings.DegenerateError, match="straight back"):
            crossings.turning_number([(0, 0), (4, 0), (2, 0), (2, 3)])

    def test_point_on_the_polygon_has_no_winding_number(self):
        with pytest.raises(ValueError, match="on the polygon"):
            crossings.winding_number([(0, 0), (4, 0), (0, 4)], (2, 2))


def points_beside(polygon, found):
    """((border, point just left of it), point just right of it) in the middle of a piece of every border, exactly."""
    vertices = crossings.exact(polygon)
    visits = list(zip(found.edges, found.points, strict=True))
    for border, (edge, start) in enumerate(visits):
        next_edge, next_point = visits[(border + 1) % len(visits)]
        p, q = crossings.edges(vertices)[edge]
        direct = next_edge == edge and crossings.dot(crossings.minus(next_point, start), crossings.minus(q, p)) > 0
        end = next_point if direct else q
        along = crossings.minus(end, start)
        middle = (start[0] + along[0] / 2, start[1] + along[1] / 2)
        shift = nearest_shift(vertices, middle, along)
        left = (middle[0] - shift * along[1], middle[1] + shift * along[0])
        right = (middle[0] + shift * along[1], middle[1] - shift * along[0])
        yield (border, left), right


def nearest_shift(vertices, middle, along):
    """Half the smallest factor at which the normal through `middle` meets another edge on either side."""
    normal = (-along[1], along[0])
    factors = [crossings.Fraction(1)]
    for p, q in crossings.edges(vertices):
        direction = crossings.minus(q, p)
        denominator = crossings.cross(normal, direction)
        if denominator != 0:
            factors.append(abs(crossings.cross(crossings.minus(p, middle), direction) / denominator))
    return min(factor for factor in factors if factor > 0) / 2
