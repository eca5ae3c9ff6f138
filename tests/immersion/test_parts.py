"""Independent parts of words: against the definition, and they keep the work for long chains short."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import plyfold as pf
from coarse import CURVES
from plyfold.gallery import chain
from plyfold.immersion.dual_tree import grow_dual_tree
from plyfold.immersion.propagation import begin_propagation, independent_parts, narrow
from plyfold.immersion.word import write_word
from reference import parts as reference
from reference import random_curves
from words import word_of


@st.composite
def words_with_blocks(draw):
    """Any labels along the curve; the first letter of each is its minus letter; some blocks are longer than one."""
    label = draw(st.lists(st.integers(0, 7), max_size=24))
    label = [sorted(set(label)).index(name) for name in label]
    places = [[i for i, owner in enumerate(label) if owner == name] for name in range(max(label, default=-1) + 1)]
    minus = [own[0] for own in places]
    longer = draw(st.lists(st.sampled_from([0, 0, 0, 1, 2, 5]), min_size=len(label), max_size=len(label)))
    block = [i if i in minus else max(0, i - length) for i, length in enumerate(longer)]
    return word_of(
        list(range(1, len(minus) + 1)), list(range(len(label))), label, minus, [own[1:] for own in places], block
    )


def assert_parts_as_defined(word):
    letters = [{minus, *word.partners_of(label).tolist()} for label, minus in enumerate(word.minus.tolist())]
    found = [part.tolist() for part in independent_parts(word, np.arange(len(word)))]
    assert all(part == sorted(part) for part in found)
    assert set(map(frozenset, found)) == reference.parts(letters, word.block.tolist())
    firsts = [min(word.label[part].tolist()) for part in found]
    assert firsts == sorted(firsts)


@settings(max_examples=400, deadline=None)
@given(words_with_blocks())
def test_any_word(word):
    assert_parts_as_defined(word)


@pytest.mark.parametrize("seed", range(10))
def test_words_of_curves(seed):
    points = random_curves.glued_disk(np.random.default_rng(seed), 40)
    assert_parts_as_defined(write_word(grow_dual_tree(pf.arrange(points))))


def test_some_labels_alone():
    """The third label, which would join the first two, is left out; so is a partner of the first."""
    word = word_of([1, 2, 3], list(range(7)), [0, 2, 0, 1, 2, 1, 0], [0, 3, 1], [[2, 6], [5], [4]], list(range(7)))
    assert [part.tolist() for part in independent_parts(word, np.arange(7))] == [[0, 1, 2, 3, 4, 5, 6]]
    assert [part.tolist() for part in independent_parts(word, np.array([0, 2, 3, 5]))] == [[0, 2], [3, 5]]


@pytest.mark.parametrize("links", [10, 200])
def test_long_chains_are_walked_over_link_by_link(links):
    """The words of the links lie inside one another, and none is walked over for the sake of another."""
    word = write_word(grow_dual_tree(pf.arrange(chain(CURVES["milnor"], links))))
    assert [len(region) for region in narrow(word).regions] == [6] * links
    propagation = begin_propagation(word)
    assert propagation.narrow() < 0
    assert propagation.walked <= 6 * links
    assert pf.count_immersions(chain(CURVES["milnor"], links)) == 2**links
