"""Independent parts of words: against the definition, and they keep the work for long chains short."""

import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import plyfold as pf
from coarse import CURVES
from plyfold.gallery import chain
from plyfold.immersion.dual_tree import grow_dual_tree
from plyfold.immersion.propagation import independent_parts, narrow
from plyfold.immersion.word import Word, write_word
from reference import parts as reference
from reference import random_curves


@st.composite
def words_with_blocks(draw):
    """Any labels along the curve; the first letter of each is its minus letter; some blocks are longer than one."""
    label = draw(st.lists(st.integers(0, 7), max_size=24))
    label = [sorted(set(label)).index(name) for name in label]
    places = [[i for i, owner in enumerate(label) if owner == name] for name in range(max(label, default=-1) + 1)]
    minus = [own[0] for own in places]
    longer = draw(st.lists(st.sampled_from([0, 0, 0, 1, 2, 5]), min_size=len(label), max_size=len(label)))
    block = [i if i in minus else max(0, i - length) for i, length in enumerate(longer)]
    return Word(
        list(range(1, len(minus) + 1)), list(range(len(label))), label, minus, [own[1:] for own in places], block
    )


def assert_parts_as_defined(word):
    letters = [{minus, *plus} for minus, plus in zip(word.minus, word.partners, strict=True)]
    found = independent_parts(word, range(len(letters)), word.partners)
    assert all(part == sorted(part) for part in found)
    assert set(map(frozenset, found)) == reference.parts(letters, word.block)
    assert [word.label[min(part, key=word.label.__getitem__)] for part in found] == sorted(
        min(word.label[letter] for letter in part) for part in found
    )


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
    word = Word([1, 2, 3], list(range(7)), [0, 2, 0, 1, 2, 1, 0], [0, 3, 1], [[2, 6], [5], [4]], list(range(7)))
    assert independent_parts(word, [0, 1, 2], word.partners) == [[0, 1, 2, 3, 4, 5, 6]]
    assert independent_parts(word, [0, 1], [[2], [5], [4]]) == [[0, 2], [3, 5]]


@pytest.mark.parametrize("links", [10, 200])
def test_long_chains_are_walked_over_link_by_link(links, monkeypatch):
    """The words of the links lie inside one another, and none is walked over for the sake of another."""
    module = sys.modules["plyfold.immersion.propagation"]
    walk, walked = module._smaller_side, []
    monkeypatch.setattr(module, "_smaller_side", lambda *given: walked.append(walk(*given)) or walked[-1])
    word = write_word(grow_dual_tree(pf.arrange(chain(CURVES["milnor"], links))))
    narrowed = narrow(word)
    assert [len(region) for region in narrowed.regions] == [6] * links
    assert sum(len(side) for side, _ in walked) <= 6 * links
    assert pf.count_immersions(chain(CURVES["milnor"], links)) == 2**links
