"""Groupings of a word by trying all choices: the definition, letter by letter.

A word is given by the place of each label's minus letter, the places of its plus letters, and for each plus letter the
first letter of its block. A grouping takes one plus letter for every label such that no two chords cross and no chord
ends in the block of another.
"""

from collections.abc import Iterator, Sequence
from itertools import combinations, product


def crosses(first: tuple[int, int], second: tuple[int, int]) -> bool:
    """Whether exactly one end of the second chord lies between the ends of the first."""
    low, high = min(first), max(first)
    return (low < second[0] < high) != (low < second[1] < high)


def is_grouping(minus: Sequence[int], choice: Sequence[int], block: Sequence[int]) -> bool:
    chords = list(zip(minus, choice, strict=True))
    return not any(
        crosses(first, second) or block[first[1]] <= second[1] <= first[1] or block[second[1]] <= first[1] <= second[1]
        for first, second in combinations(chords, 2)
    )


def groupings(minus: Sequence[int], partners: Sequence[Sequence[int]], block: Sequence[int]) -> Iterator[tuple]:
    """All groupings, each as the plus letters of the labels."""
    for choice in product(*partners):
        if is_grouping(minus, choice, block):
            yield choice
