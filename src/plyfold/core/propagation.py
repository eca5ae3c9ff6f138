"""Arc consistency over the chords of a disk, and the parts of a word that are independent. See `immersion.propagation`.

Letters, labels and their partners are those of `immersion.word`: label l may be joined to the plus letters
``partner[first[l]:first[l + 1]]``, in order along the curve.
"""

from __future__ import annotations

from collections.abc import Callable

from plyfold.core.buffers import WholeBuffer

__all__ = ["Parts", "Propagation", "room_for_parts", "room_for_propagation"]

# After walking over so many letters it is asked whether there is time left.
_LETTERS = 65536


class Parts:
    """As many parts as can be of some letters, without chords from one part across another.

    Attributes
    ----------
    part : buffer of int
        A label of the same part for each label, and so on up to the label that stands for all.
    """

    def __init__(self) -> None:
        self.labels = 0

    def begin(self, label: WholeBuffer, block: WholeBuffer, labels: int, room: WholeBuffer) -> None:
        """Look at a word next. Compiled code hands buffers to a method for nothing, but not to a constructor.

        Parameters
        ----------
        label, block : buffer of int
            Of each letter.
        labels : int
            How many labels there are.
        room : buffer of int
            Room for :func:`room_for_parts` numbers.
        """
        self.labels, self.label, self.block = labels, label, block
        self.part, self.to_come = room[:labels], room[labels : 2 * labels]
        self.waiting, self.stack = room[2 * labels : 3 * labels], room[3 * labels : 4 * labels]

    def join(self, letters: WholeBuffer, size: int) -> None:
        """Join the labels of the first so many of some letters, which come in order along the curve."""
        for label in range(self.labels):
            self.part[label] = label
            self.to_come[label] = self.waiting[label] = 0
        if size > 0:
            self._join_blocks(letters, size)
            self._join_crossing(letters, size)

    def of(self, letter: int) -> int:
        """Return the label that stands for the part of a letter; the way there is halved for the next time."""
        member = self.label[letter]
        while self.part[member] != member:
            self.part[member] = member = self.part[self.part[member]]
        return member

    def _join_blocks(self, letters: WholeBuffer, size: int) -> None:
        """Join labels with a letter in the block of another's: a chord occupies the whole block of its plus letter."""
        following = letters[size - 1]
        begin = self.block[following]
        for at in range(size - 2, -1, -1):
            letter = letters[at]
            if begin <= letter:
                self.part[self.of(letter)] = self.of(following)
            begin, following = min(begin, self.block[letter]), letter

    def _join_crossing(self, letters: WholeBuffer, size: int) -> None:
        """Join parts whose letters alternate along the curve.

        The parts of which a letter has come, and others have not, wait on a stack. A part that comes again while others
        wait above it alternates with them.
        """
        for at in range(size):
            self.to_come[self.of(letters[at])] += 1
        top = 0
        for at in range(size):
            top = self._pass(self.of(letters[at]), top)

    def _pass(self, here: int, top: int) -> int:
        """Come to a letter of a part; return how many parts wait on the stack."""
        if self.waiting[here] == 0:
            self.waiting[here] = 1
            self.stack[top] = here
            top += 1
        while self.stack[top - 1] != here:
            top -= 1
            other = self.stack[top]
            self.part[other] = here
            self.to_come[here] += self.to_come[other]
        self.to_come[here] -= 1
        return top if self.to_come[here] else top - 1

    def list_in(self, letters: WholeBuffer, size: int, listed: WholeBuffer, start: WholeBuffer) -> int:
        """List letters part by part, the parts in the order of their first labels, after :meth:`join`.

        Parameters
        ----------
        letters : buffer of int
            Those that were joined, ``size`` of them.
        listed, start : buffer of int
            Room for the same letters, and for where each part starts among them and where the last one ends: for one
            more number than there are labels.

        Returns
        -------
        int
            How many parts there are.
        """
        for label in range(self.labels):
            self.to_come[label] = self.waiting[label] = 0
        for at in range(size):
            self.waiting[self.label[letters[at]]] = 1
            self.to_come[self.of(letters[at])] += 1
        count = self._place_parts(start)
        for at in range(size):
            here = self.of(letters[at])
            listed[self.stack[here]] = letters[at]
            self.stack[here] += 1
        return count

    def _place_parts(self, start: WholeBuffer) -> int:
        """Find where each part starts, and return how many there are; the stack has the place of the next letter."""
        count = size = 0
        for label in range(self.labels):
            here = label
            while self.part[here] != here:
                here = self.part[here]
            if self.waiting[label] and self.to_come[here]:
                start[count], self.stack[here] = size, size
                size += self.to_come[here]
                self.to_come[here] = 0
                count += 1
        start[count] = size
        return count


class Propagation:
    """What is left to choose in a word; ``after`` and ``before`` lead to the neighbours of letters in play, in rings.

    Parameters
    ----------
    step : callable
        Called now and then; it may raise.

    Attributes
    ----------
    chosen : buffer of int
        For each label the plus letter that it is joined to, −1 where there is a choice.
    partner, stop : buffer of int
        The plus letters that are left for each label: ``partner[first[l]:stop[l]]``.
    removed_by : buffer of int
        For each plus letter out of play the label that removed it, −1 for others.
    walked : int
        How many letters were walked over.

    Examples
    --------
    Two labels; the first may be joined to the last letter alone, and that chord crosses one of the second's:

    >>> from array import array
    >>> border, label, block = array("q", range(5)), array("q", [0, 1, 1, 0, 1]), array("q", range(5))
    >>> minus, first, partner = array("q", [0, 1]), array("q", [0, 1, 3]), array("q", [3, 2, 4])
    >>> left, room = Propagation(lambda: None), memoryview(array("q", [0] * room_for_propagation(5, 2)))
    >>> left.begin(border, label, block, minus, first, partner, room)
    >>> left.narrow(), list(left.chosen), list(left.removed_by)
    (-1, [3, 2], [-1, -1, -1, -1, 0])
    """

    def __init__(self, step: Callable[[], None]) -> None:
        self.step = step
        self.parts = Parts()
        self.letters = self.labels = self.walked = self.noted = 0

    def begin(
        self,
        border: WholeBuffer,
        label: WholeBuffer,
        block: WholeBuffer,
        minus: WholeBuffer,
        first: WholeBuffer,
        partner: WholeBuffer,
        room: WholeBuffer,
    ) -> None:
        """Look at a word next.

        Parameters
        ----------
        border, label, block : buffer of int
            Of each letter.
        minus : buffer of int
            The minus letter of each label.
        first, partner : buffer of int
            The plus letters of each label: those that go are taken out of ``partner``.
        room : buffer of int
            Room for :func:`room_for_propagation` numbers.
        """
        n, labels = len(label), len(minus)
        self.letters, self.labels = n, labels
        self.border, self.label, self.block = border, label, block
        self.minus, self.first, self.partner = minus, first, partner
        self.after, self.before, self.removed_by = room[:n], room[n : 2 * n], room[2 * n : 3 * n]
        self.found, rest = room[3 * n : 5 * n], room[5 * n :]
        self.chosen, self.stop = rest[:labels], rest[labels : 2 * labels]
        self.due, self.is_due = rest[2 * labels : 3 * labels], rest[3 * labels : 4 * labels]
        self.parts.begin(label, block, labels, rest[4 * labels :])

    def narrow(self) -> int:
        """Remove the partners that fit no grouping, as far as looking at two labels at a time can tell.

        Returns
        -------
        int
            −1, or a label that has no partner left: then there is no grouping.
        """
        for letter in range(self.letters):
            self.removed_by[letter], self.found[letter] = -1, letter
        for label in range(self.labels):
            self.stop[label] = self.first[label + 1]
            if self.stop[label] == self.first[label]:
                return label
            self.chosen[label], self.due[label], self.is_due[label] = -1, label, 1
        self._close_rings()
        self.next_due, self.n_due = 0, self.labels
        return self._settle_all()

    def narrow_further(self, letters: WholeBuffer) -> int:
        """Take plus letters out of play, in addition to those that went, and look at all labels that this concerns.

        Returns
        -------
        int
            As :meth:`narrow`.
        """
        for place in range(len(letters)):
            letter = letters[place]
            owner = self.label[letter]
            self.removed_by[letter] = owner
            self._remove(letter, owner)
            self._put_due(owner)
            if self.stop[owner] == self.first[owner]:
                return owner
        return self._settle_all()

    def _settle_all(self) -> int:
        """Look at all labels that are due; return one that has no partner left, or −1."""
        failed = -1
        while failed < 0 and self.n_due > 0:
            label = self._take_due()
            if self.chosen[label] < 0:
                failed = self._settle(label)
        return failed

    def letters_in_play(self) -> int:
        """Put the letters of labels that have a choice left into ``found``, and return how many they are."""
        size = 0
        for letter in range(self.letters):
            if self.chosen[self.label[letter]] < 0 and self.removed_by[letter] < 0:
                self.found[size] = letter
                size += 1
        return size

    def _close_rings(self) -> None:
        """Make one ring of the letters of each part."""
        self.parts.join(self.found, self.letters)
        first, last = self.parts.stack, self.parts.waiting
        for label in range(self.labels):
            last[label] = -1
        for letter in range(self.letters):
            here = self.parts.of(letter)
            if last[here] < 0:
                first[here] = last[here] = letter
            self._link(last[here], letter)
            self._link(letter, first[here])
            last[here] = letter

    def _link(self, letter: int, following: int) -> None:
        self.after[letter], self.before[following] = following, letter

    # ---- labels that are due to be looked at: a queue ------------------------------------------------------------

    def _take_due(self) -> int:
        label = self.due[self.next_due]
        self.next_due = self.next_due + 1 if self.next_due + 1 < self.labels else 0
        self.n_due -= 1
        self.is_due[label] = 0
        return label

    def _put_due(self, label: int) -> None:
        if self.is_due[label] == 0:
            self.is_due[label] = 1
            place = self.next_due + self.n_due
            self.due[place if place < self.labels else place - self.labels] = label
            self.n_due += 1

    def _settle(self, label: int) -> int:
        """Remove what crosses every chord of a label; return a label that has no partner left then, or −1."""
        for place in range(self._find_misfits(label)):
            letter = self.found[place]
            owner = self.label[letter]
            if self.removed_by[letter] < 0:
                self.removed_by[letter] = label
                self._remove(letter, owner)
                self._put_due(owner)
            if self.stop[owner] == self.first[owner]:
                return owner
        if self.stop[label] == self.first[label] + 1:
            self._draw_chord(label, self.minus[label], self.partner[self.first[label]])
        return -1

    def _remove(self, letter: int, label: int) -> None:
        """Take a plus letter of a label out of play."""
        self._link(self.before[letter], self.after[letter])
        partner, place, stop = self.partner, self.first[label], self.stop[label] - 1
        while partner[place] != letter:
            place += 1
        while place < stop:
            partner[place] = partner[place + 1]
            place += 1
        self.stop[label] = stop

    def _draw_chord(self, label: int, minus: int, plus: int) -> None:
        """Fix a label's chord, and close the rings of letters on both sides of it."""
        self.chosen[label] = plus
        first, last = self.after[minus], self.before[plus]
        if first != plus:
            self._link(last, first)
        first, last = self.after[plus], self.before[minus]
        if first != minus:
            self._link(last, first)

    # ---- what fits no chord of a label -------------------------------------------------------------------------------

    def _find_misfits(self, label: int) -> int:
        """Find the plus letters that no chord may end on, whichever partner a label takes; some may come twice."""
        self.n_found = 0
        if self.stop[label] == self.first[label] + 1:
            self._find_sharing_border(self.partner[self.first[label]])
        self._find_across_gap(label, self.minus[label])
        return self.n_found

    def _note(self, letter: int) -> None:
        self.found[self.n_found] = letter
        self.n_found += 1

    def _find_sharing_border(self, plus: int) -> None:
        """Find the plus letters on the same border that cannot be taken beside a given one.

        Arcs one of which runs behind the other cannot end on the same border: the sheet that leaves the disk there has
        left it for both.
        """
        letter = self.before[plus]
        while self.block[plus] <= letter < plus:
            self._note(letter)
            letter = self.before[letter]
        letter = self.after[plus]
        while letter > plus and self.border[letter] == self.border[plus]:
            if self.block[letter] <= plus:
                self._note(letter)
            letter = self.after[letter]

    def _find_across_gap(self, label: int, minus: int) -> None:
        """Find the plus letters of the chords that join the two sides of a label's gap."""
        self._walk_out(label, minus)
        self._find_reach(label, minus)
        following = self.before if self.on_left else self.after
        bound, owner = self.minus, self.label
        letter = minus
        for _ in range(self.steps):
            letter = following[letter]
            other = owner[letter]
            if letter == bound[other]:
                self._find_beyond(other, minus)
            elif self._steps_to(bound[other], minus) < self.reach:
                self._note(letter)

    def _walk_out(self, label: int, minus: int) -> None:
        """Walk from a minus letter both ways at once, up to the first partner: see how far it is, and on which side."""
        before, after, owner = self.before, self.after, self.label
        left, right, steps = before[minus], after[minus], 0
        while owner[left] != label and owner[right] != label:
            left, right, steps = before[left], after[right], steps + 1
        self.steps, self.on_left = steps, owner[left] == label
        self._count(steps + 1)

    def _count(self, letters: int) -> None:
        """Count letters that were walked over."""
        self.walked += letters
        if self.walked - self.noted > _LETTERS:
            self.noted = self.walked
            self.step()

    def _find_reach(self, label: int, minus: int) -> None:
        """Find how far the nearest partner is on the other side."""
        partner, reach = self.partner, self.letters
        for place in range(self.first[label], self.stop[label]):
            reach = min(reach, self._steps_to(partner[place], minus))
        self.reach = reach

    def _find_beyond(self, other: int, minus: int) -> None:
        """Find the partners that another label has on the other side of the gap around a minus letter."""
        partner = self.partner
        for place in range(self.first[other], self.stop[other]):
            if self._steps_to(partner[place], minus) < self.reach:
                self._note(partner[place])

    def _steps_to(self, letter: int, minus: int) -> int:
        """Return how many letters further a letter is than a minus letter, counted away from the side walked over."""
        steps = letter - minus if self.on_left else minus - letter
        return steps if steps >= 0 else steps + self.letters


def room_for_parts(labels: int) -> int:
    """Return how many numbers :class:`Parts` takes room for."""
    return 4 * labels


def room_for_propagation(letters: int, labels: int) -> int:
    """Return how many numbers :class:`Propagation` takes room for."""
    return 5 * letters + 4 * labels + room_for_parts(labels)
