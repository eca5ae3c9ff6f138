"""Letters that cancel where the others cost least, against all ways to pair them."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from plyfold.clock import UNWATCHED
from plyfold.homotopy.cancellation import PricedWord, cancelled


def price_of_rare(label, is_plus, weights):
    """What each letter costs that stays alone: twice its weight if its label has fewer of its sign."""
    signs = {each: [plus for one, plus in zip(label, is_plus, strict=True) if one == each] for each in label}
    rare = {each: 2 * sum(plus) < len(plus) for each, plus in signs.items()}
    return [2 * weights[each] if plus == rare[each] else 0 for each, plus in zip(label, is_plus, strict=True)]


def least_price(label, is_plus, price):
    """The least over all ways to pair: the first letter stays alone or cancels one that parts the others."""
    if not label:
        return 0
    found = price[0] + least_price(label[1:], is_plus[1:], price[1:])
    for other in range(1, len(label)):
        if label[other] == label[0] and is_plus[other] != is_plus[0]:
            inside, behind = slice(1, other), slice(other + 1, None)
            parts = [least_price(label[part], is_plus[part], price[part]) for part in (inside, behind)]
            found = min(found, sum(parts))
    return found


def judge(label, is_plus, weights):
    word = PricedWord(np.array(label), np.array(is_plus), np.array(weights, dtype=float), np.zeros(len(weights)))
    mate = cancelled(word, UNWATCHED).tolist()
    price = price_of_rare(label, is_plus, weights)
    alone = sum(cost for cost, other in zip(price, mate, strict=True) if other < 0)
    assert alone == least_price(label, is_plus, price)
    pairs = [(one, other) for one, other in enumerate(mate) if one < other]
    assert all((label[a], is_plus[a]) == (label[b], not is_plus[b]) and mate[b] == a for a, b in pairs)
    assert not any(a < c < b < d for a, b in pairs for c, d in pairs)
    return mate


@given(
    st.lists(st.tuples(st.integers(0, 3), st.booleans()), min_size=1, max_size=12),
    st.lists(st.integers(0, 5), min_size=4, max_size=4),
)
def test_least_of_all_pairings(letters, weights):
    label, is_plus = map(list, zip(*letters, strict=True))
    judge(label, is_plus, weights)


@pytest.mark.parametrize(("weights", "paired"), [([1, 1, 1, 5], 2), ([5, 5, 5, 1], 6)])
def test_labels_that_run_with_others_on_both_sides(weights, paired):
    label, is_plus = [0, 1, 2, 3, 2, 1, 0, 3], [True, True, False, True, True, False, False, False]
    assert sum(other >= 0 for other in judge(label, is_plus, weights)) == paired


def test_labels_that_run_in_circles():
    label = [0, 1, 2] * 2 + [3] + [2, 1, 0] * 2 + [3]
    is_plus = [True] * 7 + [False] * 7
    judge(label, is_plus, [1, 2, 3, 4])
