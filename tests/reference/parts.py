"""Parts of a word by merging any two that touch until none do: the definition.

A part is a set of labels. Two parts touch if a letter of one lies in the block of a letter of the other, or if four
letters of the two alternate along the curve.
"""

from collections.abc import Sequence
from itertools import combinations


def alternate(first: set[int], second: set[int]) -> bool:
    """Whether two sets of places on a circle cannot be separated by a cut through it."""
    owners = [place in first for place in sorted(first | second)]
    return sum(a != b for a, b in zip(owners, owners[1:] + owners[:1], strict=True)) > 2


def parts(letters: Sequence[set[int]], block: Sequence[int]) -> set[frozenset[int]]:
    """The letters of each part; ``letters`` are those of each label."""

    def touch(first: set[int], second: set[int]) -> bool:
        return alternate(first, second) or any(block[p] <= q <= p or block[q] <= p <= q for p in first for q in second)

    found = [set(own) for own in letters]
    while pair := next((pair for pair in combinations(found, 2) if touch(*pair)), None):
        found = [part for part in found if part not in pair] + [pair[0] | pair[1]]
    return set(map(frozenset, found))
