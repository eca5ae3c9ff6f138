"""Letters of a word that cancel each other, in hot loops. See `homotopy.cancellation`."""

from __future__ import annotations

from collections.abc import Callable

from plyfold.core.buffers import RealBuffer, WholeBuffer, real_room, whole_room
from plyfold.core.lowering import copy_row, lower_row

__all__ = ["Costs", "cancel_neighbours", "find_faces"]

_NONE = -1
# After so many steps it is asked whether there is time left.
_STEPS = 20_000_000


def cancel_neighbours(code: WholeBuffer, place: WholeBuffer, mate: WholeBuffer) -> int:
    """Let letters cancel that are next to each other round a cyclic word, and those that come to be, to the last.

    Parameters
    ----------
    code : buffer of int
        The letters: 2 a and 2 a + 1 cancel each other. Those that are left are moved to the front.
    place : buffer of int
        A number for each letter, moved along with it.
    mate : buffer of int
        Gets, for each of these numbers, that of the letter that it cancels.

    Returns
    -------
    int
        How many letters are left.

    Examples
    --------
    >>> from array import array
    >>> code, mate = array("q", [4, 0, 2, 3, 1, 6, 5]), array("q", [-1] * 7)
    >>> cancel_neighbours(code, array("q", range(7)), mate), code[0], list(mate)
    (1, 6, [6, 4, 3, 2, 1, -1, 0])
    """
    size = 0
    for letter in range(len(code)):
        if size > 0 and code[size - 1] == code[letter] ^ 1:
            size -= 1
            mate[place[size]], mate[place[letter]] = place[letter], place[size]
        else:
            code[size], place[size] = code[letter], place[letter]
            size += 1
    low = 0
    while size - low > 1 and code[low] == code[size - 1] ^ 1:
        mate[place[low]], mate[place[size - 1]] = place[size - 1], place[low]
        low, size = low + 1, size - 1
    for letter in range(low, size):
        code[letter - low], place[letter - low] = code[letter], place[letter]
    return size - low


def find_faces(mate: WholeBuffer, face: WholeBuffer) -> None:
    """Find the faces into which chords between letters cut a disk.

    Parameters
    ----------
    mate : buffer of int
        The letter that each one is joined to; −1 for none. No two chords cross.
    face : buffer of int
        Gets the face at the gap before each letter, and last at the one behind all: face 0 has the ends of the word,
        every other one the number of the first letter in it, plus 1.

    Examples
    --------
    >>> from array import array
    >>> face = array("q", [0] * 6)
    >>> find_faces(array("q", [2, -1, 0, 4, 3]), face) or list(face)
    [0, 1, 1, 0, 4, 0]
    """
    here = 0
    outside = whole_room(len(face))
    face[0] = 0
    for letter in range(len(mate)):
        if mate[letter] > letter:
            outside[letter], here = here, letter + 1
        elif mate[letter] >= 0:
            here = outside[mate[letter]]
        face[letter + 1] = here


class Costs:
    """The least cost of each stretch of a word: what letters in it cost that cancel none in it.

    Parameters
    ----------
    step : callable
        Called now and then; it may raise.
    ask : callable
        Called with a number of bytes before they are asked for; it may raise.
    code : buffer of int
        The letters: 2 a and 2 a + 1 may cancel each other.
    price : buffer of float
        What each letter costs that cancels none: a whole number from 0 on. All together are less than 2⁵³.

    Notes
    -----
    O(L² m) time for L letters of which each may cancel m others, and 4 L² bytes, less where letters have nothing
    behind them that they could cancel. Row i has the costs of the stretches from letter i on. If letter i can cancel
    nothing behind it, its row is the one after it with its price added, and is not kept.

    Examples
    --------
    >>> from array import array
    >>> costs = Costs(lambda: None, lambda size: None, array("q", [0, 2, 1, 3]), array("d", [5, 1, 5, 1]))
    >>> costs.of(0, 4), costs.of(0, 3), costs.of(1, 3)
    (2.0, 1.0, 6.0)
    >>> mate = array("q", [-1] * 4)
    >>> costs.find_mates(mate) or list(mate)
    [2, -1, 0, -1]
    """

    def __init__(
        self, step: Callable[[], None], ask: Callable[[int], None], code: WholeBuffer, price: RealBuffer
    ) -> None:
        self.step, self.ask, self.code, self.price = step, ask, code, price
        self.letters, self.done = len(code), 0
        # The row that is kept for each letter begins at a letter, has a place, and the prices before it are added.
        self.begin, self.place = whole_room(self.letters + 1), whole_room(self.letters + 1)
        self.extra = real_room(self.letters + 1)
        self.head, self.later = whole_room(self._alphabet()), whole_room(self.letters)
        self._make_room()
        self._fill()

    def _alphabet(self) -> int:
        size = 2
        for letter in range(self.letters):
            size = max(size, self.code[letter] + 2)
        return size

    def _make_room(self) -> None:
        """Make room for the rows: of letters that may cancel one behind them."""
        for code in range(len(self.head)):
            self.head[code] = _NONE
        size = 1
        for letter in range(self.letters - 1, -1, -1):
            if self.head[self.code[letter] ^ 1] >= 0:
                size += self.letters + 1 - letter
            self.head[self.code[letter]] = letter
        for code in range(len(self.head)):
            self.head[code] = _NONE
        self.ask(8 * size)
        self.rows, self.used = real_room(size), 0

    def _fill(self) -> None:
        self._keep_row(self.letters)
        self.rows[0] = 0.0
        for letter in range(self.letters - 1, -1, -1):
            if self.head[self.code[letter] ^ 1] < 0:
                self.begin[letter], self.place[letter] = self.begin[letter + 1], self.place[letter + 1]
                self.extra[letter] = self.extra[letter + 1] + self.price[letter]
            else:
                self._fill_row(letter)
            self.later[letter] = self.head[self.code[letter]]
            self.head[self.code[letter]] = letter

    def _keep_row(self, letter: int) -> None:
        self.begin[letter], self.place[letter], self.extra[letter] = letter, self.used, 0.0
        self.used += self.letters + 1 - letter

    def _fill_row(self, letter: int) -> None:
        """Fill the row of a letter, which costs its price or cancels one behind it.

        Where it does not pay even for the stretch that ends with the mate, no longer one need be looked at: the rest of
        it costs the same, whatever the stretch before it does.
        """
        self._keep_row(letter)
        place, begin = self.place[letter], self.begin[letter + 1]
        self.rows[place] = 0.0
        for end in range(letter + 1, begin):
            self.rows[place + end - letter] = self.price[letter] + self.extra[letter + 1] - self.extra[end]
        size = self.letters + 1 - begin
        self._count(size)
        more = self.extra[letter + 1] + self.price[letter]
        copy_row(self.rows, place + begin - letter, self.place[letter + 1], size, more)
        mate = self.head[self.code[letter] ^ 1]
        while mate >= 0:
            cost = self.of(letter + 1, mate)
            if cost < self.rows[place + mate + 1 - letter]:
                self._lower(letter, mate + 1, cost)
            mate = self.later[mate]

    def _lower(self, letter: int, middle: int, cost: float) -> None:
        """Lower the row of a letter to what stretches cost that are parted in a middle; the first costs so much."""
        place, begin = self.place[letter], self.begin[middle]
        for end in range(middle, begin):
            here = place + end - letter
            self.rows[here] = min(self.rows[here], cost + self.extra[middle] - self.extra[end])
        size = self.letters + 1 - begin
        self._count(size)
        lower_row(self.rows, place + begin - letter, self.place[middle], size, cost + self.extra[middle])

    def _count(self, steps: int) -> None:
        self.done += steps
        if self.done > _STEPS:
            self.done = 0
            self.step()

    def of(self, start: int, end: int) -> float:
        """Return the cost of the stretch from a letter up to another, which is not in it."""
        if end < self.begin[start]:
            return self.extra[start] - self.extra[end]
        return self.rows[self.place[start] + end - self.begin[start]] + self.extra[start]

    def find_mates(self, mate: WholeBuffer) -> None:
        """Find for each letter the one that it cancels where the whole word costs least; −1 is there already."""
        stack = whole_room(2 * self.letters + 2)
        stack[0], stack[1], size = 0, self.letters, 2
        while size > 0:
            size -= 2
            start, end = stack[size], stack[size + 1]
            while start < end and self.of(start, end) == self.price[start] + self.of(start + 1, end):
                start += 1
            if start < end:
                other = self._mate_of(start, end)
                mate[start], mate[other] = other, start
                stack[size], stack[size + 1] = start + 1, other
                stack[size + 2], stack[size + 3] = other + 1, end
                size += 4

    def _mate_of(self, start: int, end: int) -> int:
        mate = self._next(start + 1, self.code[start] ^ 1)
        while self.of(start + 1, mate) + self.of(mate + 1, end) != self.of(start, end):
            mate = self._next(mate + 1, self.code[start] ^ 1)
        return mate

    def _next(self, letter: int, code: int) -> int:
        """Return the next letter with a code, from some letter on."""
        while self.code[letter] != code:
            letter += 1
        return letter
