"""Words: propagation and the interval program against trying all choices, on words of curves and on any words."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import plyfold as pf
from plyfold.immersion.dual_tree import grow_dual_tree
from plyfold.immersion.grouping import count_groupings, find_groupings, list_groupings, nth_grouping
from plyfold.immersion.propagation import narrow
from plyfold.immersion.word import write_word
from reference import groupings as reference
from reference import random_curves
from reference.planar_maps import census, may_bound_disk, oriented
from words import word_of


@st.composite
def words(draw):
    """Any words without blocks: one minus letter per label, plus letters anywhere."""
    labels = draw(st.integers(1, 6))
    spare = draw(st.lists(st.integers(0, labels - 1), max_size=12))
    letters = draw(st.permutations([(label, -1) for label in range(labels)] + [(label, 1) for label in spare]))
    n = len(letters)
    return word_of(
        cells=list(range(1, labels + 1)),
        border=list(range(n)),
        label=[label for label, _ in letters],
        minus=[letters.index((label, -1)) for label in range(labels)],
        partners=[[i for i in range(n) if letters[i] == (label, 1)] for label in range(labels)],
        block=list(range(n)),
    )


def assert_all_groupings_found(word):
    minus, block = word.minus.tolist(), word.block.tolist()
    partners = [word.partners_of(label).tolist() for label in range(len(minus))]
    expected = set(reference.groupings(minus, partners, block))
    narrowed = narrow(word)
    assert narrowed or not expected
    if narrowed:
        assert_none_lost(narrowed, expected)
    found = find_groupings(word)
    assert bool(found) == bool(expected)
    if not found:
        few = [(minus[label], partners[label]) for label in found.labels]
        assert not list(reference.groupings([minus for minus, _ in few], [plus for _, plus in few], block))
    if found:
        listed = [tuple(grouping.tolist()) for grouping in list_groupings(found)]
        assert len(listed) == len(expected) == count_groupings(found)
        assert set(listed) == expected
        assert {tuple(nth_grouping(found, i).tolist()) for i in range(len(expected))} == expected


def assert_none_lost(narrowed, expected):
    open_letters = set(np.concatenate([[], *narrowed.regions]).astype(int).tolist())
    for grouping in expected:
        for label, plus in enumerate(grouping):
            assert narrowed.chosen[label] == plus or (narrowed.chosen[label] < 0 and plus in open_letters)
            assert narrowed.removed_by[plus] < 0


@settings(max_examples=400, deadline=None)
@given(words())
def test_any_word(word):
    assert_all_groupings_found(word)


@pytest.mark.parametrize("crossings", [2, 4])
def test_words_of_all_curves(crossings):
    for code in map(oriented, census(crossings)):
        if may_bound_disk(code):
            assert_all_groupings_found(write_word(grow_dual_tree(pf.Arrangement.from_gauss(*code))))


@pytest.mark.parametrize("seed", range(30))
def test_words_of_dense_disks_have_blocks(seed):
    """Dense disks, where arcs run one behind the other; as many labels as all choices can be tried for."""
    arranged = pf.arrange(random_curves.glued_disk(np.random.default_rng(seed), 60))
    tree = grow_dual_tree(arranged)
    cells, choices = [], 1
    for label, cell in enumerate((word := write_word(tree)).cells.tolist()):
        choices *= len(word.partners_of(label))
        cells += [cell] if choices <= 3000 else []
    assert_all_groupings_found(write_word(tree, cells))


def test_a_label_without_partner_is_a_conflict():
    word = word_of(cells=[1], border=[0], label=[0], minus=[0], partners=[[]], block=[0])
    assert narrow(word).labels == (0,)
    assert find_groupings(word).labels == (0,)


def test_the_empty_word_has_one_grouping():
    found = find_groupings(word_of([], [], [], [], [], []))
    assert count_groupings(found) == 1
    assert [grouping.tolist() for grouping in list_groupings(found)] == [[]]
