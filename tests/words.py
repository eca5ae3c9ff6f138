"""Words written by hand."""

import numpy as np

from plyfold.immersion.word import Word


def word_of(cells, border, label, minus, partners, block):  # noqa: PLR0913, PLR0917 - these are what a word has
    """Return the word with some letters; ``partners`` has a list of plus letters for each label."""
    starts = np.cumsum([0, *map(len, partners)])
    plus = [letter for letters in partners for letter in letters]
    cells, border, label, minus, plus, block = (
        np.array(numbers, dtype=np.int64) for numbers in (cells, border, label, minus, plus, block)
    )
    return Word(cells, border, label, minus, starts, plus, block)
