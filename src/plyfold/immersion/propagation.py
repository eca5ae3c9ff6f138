"""Most labels of a word have only one partner that fits: arc consistency over the chords of the disk.

Chords must not cross. So every label clears the space around it: between the nearest of its partners on its left and
the nearest on its right lies a gap with its minus letter in it, and whatever chord joins the two sides of the gap
crosses each of its own, so it can go. When a label has one partner left, its chord is drawn; then the two sides of
the gap are the two sides of the chord, and have nothing to do with each other from there on.

Either way only the smaller of the two sides is walked through, in the ring of letters that are still in play; each
part of the word that no chord of another crosses has a ring of its own.
"""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from plyfold.clock import UNWATCHED, Watch
from plyfold.graphs import representative
from plyfold.immersion.word import Word

__all__ = ["Conflict", "Narrowed", "independent_parts", "narrow"]


@dataclass(frozen=True, eq=False)
class Narrowed:
    """What is left to choose in a word.

    Parameters
    ----------
    word : Word
    chosen : dict of int to int
        The plus letter of each label that has no choice.
    partners : list of list of int
        The plus letters that are left for each label.
    regions : list of list of int
        The letters still in play, in order along the curve, region by region: no chord of one joins or crosses another.
    removed_by : dict of int to int
        For each plus letter out of play, the label that removed it.
    """

    word: Word
    chosen: dict[int, int]
    partners: list[list[int]]
    regions: list[list[int]]
    removed_by: dict[int, int]

    def conflict(self, region: list[int]) -> Conflict:
        """Return the conflict of a region that turned out to have no grouping."""
        return Conflict(_reasons(self, {self.word.label[letter] for letter in region}))


@dataclass(frozen=True)
class Conflict:
    """Labels that cannot all be joined; false as a truth value."""

    labels: tuple[int, ...]

    def __bool__(self) -> bool:
        return False


def narrow(word: Word, watch: Watch = UNWATCHED) -> Narrowed | Conflict:
    """Remove the partners that fit no grouping, as far as looking at two labels at a time can tell.

    Returns
    -------
    Narrowed or Conflict
        A conflict if a label has no partner left: the word has no grouping. Otherwise all groupings remain.

    Notes
    -----
    Near-linear as a rule. Drawing all chords costs O(n log n) for n letters, since letters that are walked over move
    to a side of at most half the size; every other walk follows the removal of a partner.
    """
    board = _Board.of(word)
    if not all(board.partners):
        return Conflict((board.partners.index([]),))
    while board.due:
        watch.step()
        label = board.due.popleft()
        board.waiting[label] = False
        for letter in _misfits(board, label):
            board.removed_by[letter] = label
            if not _remove(board, letter):
                return Conflict(_reasons(board, [word.label[letter]]))
        if len(board.partners[label]) == 1 and label not in board.chosen:
            _draw_chord(board, label)
    undecided = [label for label in range(len(word.minus)) if label not in board.chosen]
    regions = independent_parts(word, undecided, board.partners) if undecided else []
    return Narrowed(word, board.chosen, board.partners, regions, board.removed_by)


@dataclass(eq=False)
class _Board:
    """The letters in play, in rings: ``after`` and ``before`` lead to the neighbours of each."""

    word: Word
    after: list[int]
    before: list[int]
    partners: list[list[int]]
    due: deque[int]
    waiting: list[bool]
    chosen: dict[int, int] = field(default_factory=dict)
    removed_by: dict[int, int] = field(default_factory=dict)

    @classmethod
    def of(cls, word: Word) -> _Board:
        labels = len(word.minus)
        after, before = [-1] * len(word), [-1] * len(word)
        for ring in independent_parts(word, range(labels), word.partners):
            for letter, following in zip(ring, [*ring[1:], ring[0]], strict=True):
                after[letter], before[following] = following, letter
        return cls(
            word=word,
            after=after,
            before=before,
            partners=[list(letters) for letters in word.partners],
            due=deque(range(labels)),
            waiting=[True] * labels,
        )


def _remove(board: _Board, letter: int) -> bool:
    """Take a plus letter out of play; return False if that leaves its label without partner."""
    before, after = board.before[letter], board.after[letter]
    board.after[before], board.before[after] = after, before
    label = board.word.label[letter]
    board.partners[label].remove(letter)
    if not board.waiting[label]:
        board.waiting[label] = True
        board.due.append(label)
    return bool(board.partners[label])


def _misfits(board: _Board, label: int) -> list[int]:
    """Return the plus letters that no chord may end on, whichever partner the label takes."""
    if label in board.chosen:
        return []
    partners = board.partners[label]
    shared = _sharing_border(board, partners[0]) if len(partners) == 1 else []
    return shared + [letter for letter in _across_gap(board, label) if letter not in shared]


def _sharing_border(board: _Board, plus: int) -> list[int]:
    """Return the plus letters on the same border that cannot be taken beside a given one.

    Arcs one of which runs behind the other cannot end on the same border: the sheet that leaves the disk there has
    left it for both.
    """
    word = board.word
    border, behind, outside = word.border[plus], [], []
    letter = board.before[plus]
    while word.block[plus] <= letter < plus:
        behind.append(letter)
        letter = board.before[letter]
    letter = board.after[plus]
    while letter > plus and word.border[letter] == border:
        if word.block[letter] <= plus:
            outside.append(letter)
        letter = board.after[letter]
    return behind + outside


def _across_gap(board: _Board, label: int) -> list[int]:
    """Return the plus letters of the chords that join the two sides of a label's gap."""
    word, n = board.word, len(board.word)
    minus, partners = word.minus[label], board.partners[label]
    side, on_left = _smaller_side(board, minus, partners)
    # The other side, as steps from the minus letter away from this one.
    sign = 1 if on_left else -1
    reach = min(sign * (partner - minus) % n for partner in partners)
    across = []
    for letter in side:
        other = word.label[letter]
        if letter != word.minus[other]:
            if sign * (word.minus[other] - minus) % n < reach:
                across.append(letter)
        else:
            across += [plus for plus in board.partners[other] if sign * (plus - minus) % n < reach]
    return across


def _smaller_side(board: _Board, minus: int, partners: list[int]) -> tuple[list[int], bool]:
    """Walk from a minus letter both ways at once, up to the first partner; return the letters there and the side."""
    ends = set(partners)
    on_left, on_right = [], []
    left, right = board.before[minus], board.after[minus]
    while left not in ends and right not in ends:
        on_left.append(left)
        on_right.append(right)
        left, right = board.before[left], board.after[right]
    return (on_left, True) if left in ends else (on_right, False)


def _draw_chord(board: _Board, label: int) -> None:
    """Fix a label's chord, and close the rings of letters on both sides of it."""
    minus, (plus,) = board.word.minus[label], board.partners[label]
    board.chosen[label] = plus
    first, last = board.after[minus], board.before[plus]
    if first != plus:
        board.after[last], board.before[first] = first, last
    first, last = board.after[plus], board.before[minus]
    if first != minus:
        board.after[last], board.before[first] = first, last


def _reasons(found: _Board | Narrowed, labels: Iterable[int]) -> tuple[int, ...]:
    """Return the labels to which some others owe it that they have no more partners, themselves included."""
    reasons, waiting = set(labels), list(labels)
    while waiting:
        for letter in found.word.partners[waiting.pop()]:
            label = found.removed_by.get(letter)
            if label is not None and label not in reasons:
                reasons.add(label)
                waiting.append(label)
    return tuple(sorted(reasons))


# ---- parts that have nothing to do with each other ------------------------------------------------------------------


def independent_parts(word: Word, labels: Sequence[int], partners: Sequence[Sequence[int]]) -> list[list[int]]:
    """Split the letters of some labels into as many parts as can be without chords from one part across another.

    A band between two disks joins their words so that one disk's letters lie between two letters of the other's. Each
    part can be looked at by itself, however long the word is.

    Parameters
    ----------
    word : Word
    labels : sequence of int
    partners : sequence of sequence of int
        The plus letters that each label of the word may still be joined to.

    Returns
    -------
    list of list of int
        The letters of each part in order along the curve; the parts in the order of their first labels. Near-linear.
    """
    letters = sorted(letter for label in labels for letter in (word.minus[label], *partners[label]))
    part = list(range(len(word.minus)))
    _join_blocks(word, letters, part)
    _join_crossing(word, letters, part)
    parts: dict[int, list[int]] = {representative(part, label): [] for label in labels}
    for letter in letters:
        parts[representative(part, word.label[letter])].append(letter)
    return list(parts.values())


def _join_blocks(word: Word, letters: list[int], part: list[int]) -> None:
    """Join labels with a letter in the block of another's: a chord occupies the whole block of its plus letter."""
    begin, following = len(word), -1
    for letter in reversed(letters):
        if begin <= letter:
            part[representative(part, word.label[letter])] = representative(part, word.label[following])
        begin, following = min(begin, word.block[letter]), letter


def _join_crossing(word: Word, letters: list[int], part: list[int]) -> None:
    """Join parts whose letters alternate along the curve.

    The parts of which a letter has come, and others have not, wait on a stack. A part that comes again while others
    wait above it alternates with them.
    """
    to_come = Counter(representative(part, word.label[letter]) for letter in letters)
    open_parts: list[int] = []
    waiting: set[int] = set()
    for letter in letters:
        here = representative(part, word.label[letter])
        if here not in waiting:
            open_parts.append(here)
            waiting.add(here)
        while open_parts[-1] != here:
            other = open_parts.pop()
            part[other] = here
            to_come[here] += to_come[other]
        to_come[here] -= 1
        if not to_come[here]:
            open_parts.pop()
