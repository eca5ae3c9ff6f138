"""Huge counts, sampling, the best immersion, and what differs between two."""

from collections import Counter
from itertools import combinations
from math import prod

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import plyfold as pf
from plyfold.errors import InputError, NotImmersibleError
from plyfold.gallery import chain
from plyfold.immersion.compare import _partition_distance, changed_borders, flip_distance
from plyfold.immersion.cutting import irreducible_kernels
from plyfold.immersion.solve import nth_immersion
from reference import random_curves
from reference.planar_maps import census, may_bound_disk, oriented
from reference.random_curves import BENNEQUIN_LIKE, MILNOR_LIKE, SEVERAL_IMMERSIONS, TEN_GON

FIGURE_EIGHT = [(0, 0), (2, 2), (2, 0), (0, 2)]


def layout(immersion):
    """The disk layout: the borders of each sheet."""
    return {frozenset(group.borders) for group in immersion.disk_layout()}


@pytest.mark.parametrize(("link", "immersions"), [(MILNOR_LIKE, 2), (TEN_GON, 2), (BENNEQUIN_LIKE, 5)])
@pytest.mark.parametrize("links", [1, 2, 3, 50])
def test_counts_of_chains_are_powers(link, immersions, links):
    assert pf.count_immersions(chain(link, links)) == immersions**links


def test_a_chain_of_hundreds_is_counted_exactly():
    assert pf.count_immersions(chain(MILNOR_LIKE, 400)) == 2**400


def test_huge_families_are_listed_lazily_and_without_repeats():
    listed = pf.immersions(chain(MILNOR_LIKE, 30))
    first = [next(listed).own_sheet.tobytes() for _ in range(40)]
    assert len(set(first)) == 40
    again = pf.immersions(chain(MILNOR_LIKE, 30))
    assert [next(again).own_sheet.tobytes() for _ in range(40)] == first


@pytest.mark.parametrize(
    "curve",
    [MILNOR_LIKE, TEN_GON, BENNEQUIN_LIKE, chain(MILNOR_LIKE, 4), chain(BENNEQUIN_LIKE, 2), [(0, 0), (1, 0), (0, 1)]],
)
def test_immersions_by_number_are_those_in_the_list(curve):
    arranged = pf.arrange(curve)
    listed = list(pf.immersions(arranged))
    for number, immersion in enumerate(listed):
        assert nth_immersion(arranged, number).own_sheet.tolist() == immersion.own_sheet.tolist()
    for number in (-1, len(listed)):
        with pytest.raises(InputError, match=f"no immersion {number}"):
            nth_immersion(arranged, number)


def test_the_last_of_very_many_immersions_is_made_at_once():
    arranged = pf.arrange(chain(MILNOR_LIKE, 60))
    nth_immersion(arranged, 2**60 - 1).check()


@pytest.mark.parametrize(("curve", "count"), [(BENNEQUIN_LIKE, 5), (chain(MILNOR_LIKE, 3), 8)])
def test_samples_are_uniform(curve, count):
    arranged = pf.arrange(curve)
    rng = np.random.default_rng(7)
    draws = 120 * count
    seen = Counter(frozenset(layout(pf.sample_immersion(arranged, rng))) for _ in range(draws))
    assert set(seen) == {frozenset(layout(immersion)) for immersion in pf.immersions(arranged)}
    chi_square = sum((times - draws / count) ** 2 / (draws / count) for times in seen.values())
    # The quantiles of the chi-square distribution at 0.9999, for 4 and 7 degrees of freedom.
    assert chi_square < {5: 23.5, 8: 29.9}[count]


def test_samples_of_a_huge_family_differ():
    arranged = pf.arrange(chain(MILNOR_LIKE, 100))
    rng = np.random.default_rng(1)
    assert len({pf.sample_immersion(arranged, rng).own_sheet.tobytes() for _ in range(10)}) == 10


def test_no_immersion_to_sample_or_to_choose():
    assert pf.sample_immersion(FIGURE_EIGHT, np.random.default_rng(1)).reason == "turning number"
    assert pf.best_immersion(FIGURE_EIGHT, key=id).reason == "turning number"


def test_the_best_immersion_has_the_smallest_key():
    arranged = pf.arrange(BENNEQUIN_LIKE)
    all_of_them = list(pf.immersions(arranged))
    for wanted in all_of_them:
        best = pf.best_immersion(arranged, key=lambda found, wanted=wanted: layout(found) != layout(wanted))
        assert layout(best) == layout(wanted)


@pytest.mark.parametrize("polygon", [polygon for polygon, _, _ in SEVERAL_IMMERSIONS])
def test_changed_borders_are_those_with_another_group(polygon):
    for first, second in combinations(pf.immersions(polygon), 2):
        groups = [{border: group for group in layout(found) for border in group} for found in (first, second)]
        expected = tuple(border for border in sorted(groups[0]) if groups[0][border] != groups[1][border])
        assert changed_borders(first, second) == changed_borders(second, first) == expected
        assert expected


def test_flip_distance():
    for polygon, _, _ in SEVERAL_IMMERSIONS:
        for first, second in combinations(pf.immersions(polygon), 2):
            assert flip_distance(first, first) == 0
            assert flip_distance(first, second) == flip_distance(second, first) > 0


@settings(deadline=None, max_examples=40)
@given(st.lists(st.tuples(st.integers(0, 3), st.integers(0, 3)), min_size=1, max_size=5))
def test_partition_distance_is_the_shortest_way(groups):
    first, second = np.array(groups).T
    assert _partition_distance(first, second) == shortest_way(as_partition(first), as_partition(second))


def as_partition(group_of):
    return frozenset(frozenset(np.flatnonzero(group_of == group).tolist()) for group in set(group_of.tolist()))


def shortest_way(start, goal):
    """Breadth first: join any two groups, or split any group in two."""
    distance, layer, seen = 0, {start}, {start}
    while goal not in layer:
        layer = {new for partition in layer for new in neighbours(partition)} - seen
        seen |= layer
        distance += 1
    return distance


def neighbours(partition):
    for a, b in combinations(partition, 2):
        yield (partition - {a, b}) | {a | b}
    for group in partition:
        for size in range(1, len(group)):
            for part in map(frozenset, combinations(group, size)):
                yield (partition - {group}) | {part, group - part}


def test_immersions_of_different_curves_are_not_compared():
    with pytest.raises(InputError, match="different curves"):
        changed_borders(pf.find_immersion(MILNOR_LIKE), pf.find_immersion(TEN_GON))


@pytest.mark.parametrize("crossings", [2, 4])
def test_kernels_of_all_curves(crossings):
    for code in map(oriented, census(crossings)):
        if may_bound_disk(code):
            assert_kernels(pf.Arrangement.from_gauss(*code))


@pytest.mark.parametrize("seed", range(40))
def test_kernels_of_dense_disks(seed):
    assert_kernels(pf.arrange(random_curves.glued_disk(np.random.default_rng(seed), 70)))


def assert_kernels(arranged):
    """Kernels are disks that cannot be cut any further, and their immersions multiply to those of the curve."""
    if not pf.bounds_disk(arranged):
        with pytest.raises(NotImmersibleError):
            irreducible_kernels(arranged)
        return
    kernels = irreducible_kernels(arranged)
    assert prod(map(pf.count_immersions, kernels)) == pf.count_immersions(arranged)
    assert sum(kernel.n_crossings for kernel in kernels) <= arranged.n_crossings
    for kernel in kernels:
        for cell in np.flatnonzero(kernel.winding == 1):
            assert sum(dart % 2 == 0 for dart in kernel.cells[cell]) <= 1


def test_curves_with_several_immersions_have_a_kernel():
    for polygon, crossings, layerings in SEVERAL_IMMERSIONS:
        kernels = irreducible_kernels(polygon)
        assert [kernel.n_crossings for kernel in kernels] == [crossings]
        assert pf.count_immersions(kernels[0]) == len(layerings)
    assert len(irreducible_kernels(chain(MILNOR_LIKE, 4))) == 4


def test_blank_words_print_and_list_their_groupings():
    word = pf.blank_word(BENNEQUIN_LIKE)
    assert str(word).split("\n")[0].split() == [str(letter) for letter in word.letters]
    groupings = list(word.groupings())
    assert len(groupings) == 5
    assert all(
        word.letters[minus].sign == -1 and word.letters[plus].sign == 1 for pairs in groupings for minus, plus in pairs
    )
    assert len({word.bracketed(pairs) for pairs in groupings}) == 5
    assert str(pf.blank_word([(0, 0), (1, 0), (0, 1)])) == "(empty)"
    for name in ("figure-eight", "limacon", "doubled-circle", "kinked-circle"):
        assert not list(pf.blank_word(pf.gallery.CURVES[name].curve).groupings())


@pytest.mark.parametrize("rng", [-1, 1.5, "dice"])
def test_source_of_randomness_is_checked(rng):
    with pytest.raises(InputError, match="source of randomness"):
        pf.sample_immersion([(0, 0), (1, 0), (0, 1)], rng)
