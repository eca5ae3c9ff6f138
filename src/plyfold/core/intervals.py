"""Which intervals of a word can be grouped: one row of bits for every place from which that differs.

The letters still in play are laid out in *places*. A minus letter is a *wall*: nothing passes it but a chord. Between
two walls plus letters may stay free, so what can be reached from a place is known once it is known for the *posts*:
post 2w is before wall w, and post 2w + 1 behind it.
"""

from __future__ import annotations

from collections.abc import Callable

from plyfold.core.buffers import WholeBuffer, whole_room

__all__ = ["Intervals"]

# A word of bits is a whole number, never negative.
_BITS = 63
# After so many words it is asked whether there is time left.
_WORDS = 1_000_000
# Room for rows grows fourfold up to here; what is not taken, the system does not give.
_LITTLE = 4_000_000


class Intervals:
    """The intervals of places that can be grouped: all walls in them joined, and no two chords crossing.

    Parameters
    ----------
    step : callable
        Called now and then; it may raise.
    ask : callable
        Called with a number of bytes before they are asked for; it may raise.
    wall : buffer of int
        The places of the walls; the last one is the last of all places.
    first : buffer of int
        For each place the first of the chords that begin there, and at last how many chords there are.
    bound : buffer of int
        The wall that each chord ends at.
    plus, block : buffer of int
        The place of its plus letter, and where the block of that begins: chords run from the wall to the plus letter,
        or from the block to the wall.

    Attributes
    ----------
    fits : buffer of int
        1 for each chord whose inside can be grouped.

    Notes
    -----
    O(c k / 64) for c such chords and k walls, and as many bits for each place where one begins, at most.

    Examples
    --------
    Two labels: the minus letters are at places 1 and 4, those of the first may be joined to places 3 and 5:

    >>> from array import array
    >>> wall, first = array("q", [1, 4, 6]), array("q", [0, 1, 3, 4, 4, 4, 4, 4])
    >>> bound, plus = array("q", [1, 0, 0, 1]), array("q", [0, 3, 5, 2])
    >>> table = Intervals(lambda: None, lambda size: None, wall, first, bound, plus, plus)
    >>> list(table.fits), table.has(0, 6), table.has(0, 4), table.has(1, 6)
    ([1, 1, 1, 1], True, True, True)
    """

    def __init__(
        self,
        step: Callable[[], None],
        ask: Callable[[int], None],
        wall: WholeBuffer,
        first: WholeBuffer,
        bound: WholeBuffer,
        plus: WholeBuffer,
        block: WholeBuffer,
    ) -> None:
        self.wall, self.first, self.bound, self.plus, self.block = wall, first, bound, plus, block
        self.step, self.ask = step, ask
        self.places = len(first) - 1
        self.fits, self.entry, self.next_entry = whole_room(len(plus)), whole_room(len(wall)), whole_room(len(plus))
        self.next_wall, self.row_of = whole_room(self.places), whole_room(self.places)
        self.row, self.low, self.high = whole_room(2 * len(wall) // _BITS + 1), 0, 0
        self.start, self.lowest, self.rows = whole_room(self.places + 1), whole_room(self.places), 0
        self.words, self.noted = whole_room(1024), 0
        self._find_walls()
        for place in range(self.places - 1, -1, -1):
            self._fill_row(place, self.next_wall[place])

    def has(self, start: int, end: int) -> bool:
        """Tell whether the places from one up to another, which is not among them, can be grouped."""
        if start > end:
            return False
        wall = self.next_wall[end]
        if self.wall[self.next_wall[start]] >= end:
            return True
        if self.wall[wall] == end:
            return self._reaches(start, 2 * wall)
        return self._reaches(start, 2 * wall - 1) or self._is_entered(start, wall, end)

    def _is_entered(self, start: int, wall: int, end: int) -> bool:
        """Tell whether a chord that begins at a wall may lead from a place to somewhere before another and an end."""
        chord = self.entry[wall] - 1
        while chord >= 0:
            bound = self.bound[chord]
            if self.plus[chord] < end and self.wall[bound] >= start and self._reaches(start, 2 * bound):
                return True
            chord = self.next_entry[chord] - 1
        return False

    def _reaches(self, place: int, post: int) -> bool:
        row, word = self.row_of[place], post // _BITS
        at = self.start[row] + word - self.lowest[row]
        if word < self.lowest[row] or at >= self.start[row + 1]:
            return False
        return (self.words[at] >> (post % _BITS)) & 1 == 1

    # ---- rows, from the last place to the first one ------------------------------------------------------------------

    def _find_walls(self) -> None:
        """Find the first wall at each place or behind it."""
        wall = len(self.wall) - 1
        for place in range(self.places - 1, -1, -1):
            if wall > 0 and self.wall[wall - 1] >= place:
                wall -= 1
            self.next_wall[place] = wall

    def _fill_row(self, place: int, wall: int) -> None:
        """Find what can be reached from a place; before a wall, what can be from the next place, and by chords."""
        is_wall, is_behind_wall = self.wall[wall] == place, wall > 0 and self.wall[wall - 1] == place - 1
        if is_wall:
            self._clear_row()
            self._add_post(2 * wall)
        differs = is_wall or is_behind_wall
        for chord in range(self.first[place], self.first[place + 1]):
            if self._add_chord(chord, self.wall[self.bound[chord]], self.plus[chord]):
                differs = True
        if is_behind_wall:
            self._add_post(2 * wall - 1)
        if differs:
            self._keep_row()
        self.row_of[place] = self.rows - 1

    def _add_chord(self, chord: int, bound: int, plus: int) -> bool:
        """Add what can be reached behind a chord, if its inside can be grouped."""
        fits = self.has(bound + 1, self.block[chord]) if bound < plus else self.has(plus + 1, bound)
        if fits:
            self.fits[chord] = 1
            self._add_row(self.row_of[max(bound, plus) + 1])
            if bound < plus:
                wall = self.next_wall[plus]
                self.next_entry[chord], self.entry[wall] = self.entry[wall], chord + 1
        return fits

    def _clear_row(self) -> None:
        for word in range(self.low, self.high):
            self.row[word] = 0
        self.low = self.high = 0

    def _add_post(self, post: int) -> None:
        word = post // _BITS
        self._widen(word, word + 1)
        self.row[word] |= self._bit(post % _BITS)

    def _bit(self, number: int) -> int:
        bit = 1
        return bit << number

    def _widen(self, low: int, high: int) -> None:
        if self.low == self.high:
            self.low, self.high = low, high
        else:
            self.low, self.high = min(self.low, low), max(self.high, high)

    def _add_row(self, number: int) -> None:
        row, words, start, low = self.row, self.words, self.start[number], self.lowest[number]
        size = self.start[number + 1] - start
        self._widen(low, low + size)
        for word in range(size):
            row[low + word] |= words[start + word]

    def _keep_row(self) -> None:
        """Keep the row that was filled."""
        start, size = self.start[self.rows], self.high - self.low
        if start + size > len(self.words):
            self._grow(start)
        self.words[start : start + size] = self.row[self.low : self.high]
        self.lowest[self.rows], self.start[self.rows + 1] = self.low, start + size
        self.rows += 1
        if start + size - self.noted > _WORDS:
            self.noted = start + size
            self.step()

    def _grow(self, size: int) -> None:
        """Make room for more rows; so much is taken."""
        room = (4 if size < _LITTLE else 2) * len(self.words)
        self.ask(8 * room)
        words = whole_room(room)
        words[:size] = self.words[:size]
        self.words = words
