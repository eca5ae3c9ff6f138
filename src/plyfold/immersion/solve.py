"""Decide, count, list and sample the immersions of a curve (§2.3 of the paper, after Blank)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from plyfold.arrangement.arrangement import Arrangement, CurveLike, arrange, require_one_loop
from plyfold.arrangement.base_visit import begun_at, numbered_from
from plyfold.clock import UNWATCHED, Watch
from plyfold.errors import InputError
from plyfold.immersion.dual_tree import DualTree, grow_dual_tree
from plyfold.immersion.grouping import (
    Grouping,
    Groupings,
    count_groupings,
    find_groupings,
    list_groupings,
    nth_grouping,
)
from plyfold.immersion.immersion import Immersion, glue_sheets, require_memory_for_gluing
from plyfold.immersion.propagation import Conflict
from plyfold.immersion.shorter_lobes import place_of_turning
from plyfold.immersion.word import write_word
from plyfold.obstruction import Obstruction

__all__ = [
    "best_immersion",
    "bounds_disk",
    "count_immersions",
    "find_immersion",
    "immersions",
    "is_visibly_no_disk",
    "negative_winding",
    "nth_immersion",
    "sample_immersion",
    "subject_of",
    "visible_obstruction",
    "watched_immersions",
    "wrong_turning",
]

# Above this many ascending links, the conflict that an obstruction names is not made minimal.
_MINIMISE_UP_TO = 300


def find_immersion(curve: CurveLike) -> Immersion | Obstruction:
    """Find an immersed disk that has the curve as its boundary, or say why there is none (§2.3 of [MGR11]_).

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement

    Returns
    -------
    Immersion or Obstruction
        The result is true if there is an immersion. An immersion has been checked against the definition. An
        obstruction names the theorem that fails: the turning number is not 1, a cell has a negative winding number,
        or the exhausted word has no grouping.

    Raises
    ------
    CurveError
        If the input is not a closed curve.
    MemoryLimitError
        If the gluing of its sheets would not fit into memory. :func:`bounds_disk` decides without it.
    InputError
        If it is several closed curves: so far their immersions are found only together with an embedding.

    Notes
    -----
    Exact and polynomial; the decision follows [Bla67]_. After the crossings are known the cost is near-linear in the
    number of sheets, counted once per border, for ribbons and the like: 16,000 crossings take about 0.2 s. What
    propagation cannot settle, in curves that cover themselves dozens of times, goes to an interval program.

    References
    ----------
    .. [MGR11] U. Mukherjee, M. Gopi, J. Rossignac, "Immersion and Embedding of Self-Crossing Loops",
       Sketch-Based Interfaces and Modeling, 2011.
    .. [Bla67] S. J. Blank, "Extending immersions and regular homotopies in codimension one", thesis, Brandeis, 1967.

    Examples
    --------
    >>> limacon = [(3, 0), (1, 3), (-2, 0), (1, -3), (3, 0.5), (1, 1), (0.5, 0), (1, -1)]
    >>> print(find_immersion(limacon))
    The curve turns 2 times, and the outline of a disk turns once.
    """
    arranged = arrange(curve)
    obstruction = visible_obstruction(arranged)
    if obstruction is not None:
        return obstruction
    family = _family_of(arranged)
    return _no_grouping(arranged) if family is None else _glued(family, next(list_groupings(family.groupings)))


def immersions(curve: CurveLike) -> Iterator[Immersion]:
    """List all immersions of a curve, each once, in a stable order; nothing if there is none.

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement

    Yields
    ------
    Immersion
        There can be exponentially many; they are made one at a time. After the decision each takes time proportional
        to its size.

    Examples
    --------
    >>> milnor = [(88, 39), (62, 102), (-17, -15), (-17, -13), (44, -7), (-75, 180),
    ...           (-88, -39), (-62, -102), (17, 15), (17, 13), (-44, 7), (75, -180)]
    >>> [len(immersion.disk_layout()) for immersion in immersions(milnor)]
    [9, 9]
    """
    yield from watched_immersions(arrange(curve), UNWATCHED)


def watched_immersions(arranged: Arrangement, watch: Watch) -> Iterator[Immersion]:
    """List the same as :func:`immersions`, or raise TimeLimitError."""
    watch = watch.begin("finding an immersion")
    family = None if visible_obstruction(arranged) is not None else _family_of(arranged, watch)
    if family is not None:
        for grouping in list_groupings(family.groupings, watch):
            yield _glued(family, grouping)


def count_immersions(curve: CurveLike) -> int:
    """Count the immersions of a curve, exactly.

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement

    Returns
    -------
    int
        0 if the curve bounds no disk. Immersions that differ by a deformation of the disk count once. Cost: polynomial
        in the number of crossings, however large the answer.

    Examples
    --------
    >>> count_immersions([(0, 0), (1, 0), (0, 1)])
    1
    """
    family = _family(curve)
    return 0 if family is None else count_groupings(family.groupings)


def bounds_disk(curve: CurveLike) -> bool:
    """Tell whether a curve is the outline of a disk of cloth laid flat on a table.

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement

    Returns
    -------
    bool
        Exact. See :func:`find_immersion` for the reason and the cost.

    Examples
    --------
    >>> bounds_disk([(0, 0), (2, 2), (2, 0), (0, 2)])
    False
    """
    return _family(curve) is not None


def sample_immersion(curve: CurveLike, rng: np.random.Generator | int) -> Immersion | Obstruction:
    """Draw one of the immersions of a curve at random, all with the same probability.

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement
    rng : numpy.random.Generator or int
        The source of randomness, or a seed for one.

    Returns
    -------
    Immersion or Obstruction
        As from :func:`find_immersion`. Cost: that of :func:`count_immersions`, however many immersions there are.

    Raises
    ------
    InputError
        If ``rng`` is neither.

    Examples
    --------
    >>> import numpy as np
    >>> sample_immersion([(0, 0), (1, 0), (0, 1)], np.random.default_rng(1)).n_sheets
    1
    """
    dice = _dice(rng)
    family = _family(curve)
    if family is None:
        return find_immersion(curve)
    index = _random_below(count_groupings(family.groupings), dice)
    return _glued(family, nth_grouping(family.groupings, index))


def _dice(rng: np.random.Generator | int) -> np.random.Generator:
    try:
        return np.random.default_rng(rng)
    except (TypeError, ValueError) as error:
        raise InputError(
            f"the source of randomness must be a Generator or a whole number from 0 up, not {rng!r}"
        ) from error


def nth_immersion(curve: CurveLike, index: int) -> Immersion:
    """Return the immersion that :func:`immersions` lists at a number, without making those before it.

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement
    index : int
        From 0 to the number of immersions less 1.

    Returns
    -------
    Immersion
        Cost: that of :func:`count_immersions`, however large the index.

    Raises
    ------
    InputError
        If there are not so many immersions.

    Examples
    --------
    >>> milnor = [(88, 39), (62, 102), (-17, -15), (-17, -13), (44, -7), (-75, 180),
    ...           (-88, -39), (-62, -102), (17, 15), (17, 13), (-44, 7), (75, -180)]
    >>> nth_immersion(milnor, 1).own_sheet.tolist() == list(immersions(milnor))[1].own_sheet.tolist()
    True
    """
    family = _family(curve)
    count = 0 if family is None else count_groupings(family.groupings)
    if family is None or not 0 <= index < count:
        raise InputError(f"there is no immersion {index}", hint=f"the curve has {count}, numbered from 0")
    return _glued(family, nth_grouping(family.groupings, index))


def best_immersion(curve: CurveLike, key: Callable[[Immersion], Any]) -> Immersion | Obstruction:
    """Return the immersion with the smallest key, the first one of several.

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement
    key : callable
        Takes an immersion and returns what to compare.

    Returns
    -------
    Immersion or Obstruction
        As from :func:`find_immersion`. A plain loop over :func:`immersions`: where there are thousands, sample some
        instead.

    Examples
    --------
    >>> milnor = [(88, 39), (62, 102), (-17, -15), (-17, -13), (44, -7), (-75, 180),
    ...           (-88, -39), (-62, -102), (17, 15), (17, 13), (-44, 7), (75, -180)]
    >>> best_immersion(milnor, key=lambda immersion: len(immersion.disk_layout())).n_sheets
    11
    """
    arranged = arrange(curve)
    return min(immersions(arranged), key=key, default=None) or find_immersion(arranged)


@dataclass(frozen=True, eq=False)
class _Family:
    """All immersions of a curve; tree and word are those of its map as numbered from the base visit."""

    arrangement: Arrangement
    base: int
    numbered: Arrangement
    tree: DualTree
    groupings: Groupings


def _family(curve: CurveLike) -> _Family | None:
    arranged = arrange(curve)
    return None if is_visibly_no_disk(arranged) else _family_of(arranged)


def _family_of(arranged: Arrangement, watch: Watch = UNWATCHED) -> _Family | None:
    """Return the family of a curve without a visible obstruction; None if its word has no grouping."""
    base = arranged.base_visit
    numbered = numbered_from(arranged, base)
    tree = grow_dual_tree(numbered)
    groupings = find_groupings(write_word(tree), watch)
    return _Family(arranged, base, numbered, tree, groupings) if isinstance(groupings, Groupings) else None


def _glued(family: _Family, grouping: Grouping) -> Immersion:
    require_memory_for_gluing(family.arrangement)
    word, link = family.groupings.word, family.tree.link.tolist()
    partner = {link[word.cells[label]]: word.border[letter] for label, letter in grouping.items()}
    immersion = _numbered_back(glue_sheets(family.numbered, family.tree, partner), family)
    immersion.check()
    return immersion


def _numbered_back(immersion: Immersion, family: _Family) -> Immersion:
    """Return the immersion with borders numbered as in the curve's own arrangement; cells are numbered alike."""
    if family.base == 0:
        return immersion
    borders = family.arrangement.n_borders
    gluing = begun_at(immersion.gluing, int(np.searchsorted(immersion.gluing[:, 0], borders - family.base)))
    gluing[:, 0] = (gluing[:, 0] + family.base) % borders
    own_sheet = begun_at(immersion.own_sheet, borders - family.base)
    return Immersion(family.arrangement, immersion.sheet_cell, immersion.first_sheet, own_sheet, gluing)


def _random_below(limit: int, rng: np.random.Generator) -> int:
    """Return a whole number from 0 to limit − 1, however large, all with the same probability."""
    while True:
        number = int.from_bytes(rng.bytes((limit.bit_length() + 7) // 8)) >> (-limit.bit_length() % 8)
        if number < limit:
            return number


# ---- why there is none (§2.4 of the paper) --------------------------------------------------------------------------


def is_visibly_no_disk(arranged: Arrangement) -> bool:
    """Tell whether there is a visible obstruction, without looking for its place."""
    require_one_loop(arranged, "the search for immersions")
    return arranged.turning_number != 1 or bool(arranged.winding.min() < 0)


def visible_obstruction(arranged: Arrangement) -> Obstruction | None:
    """Return the obstruction that numbers alone show, if there is one: the turning number or a winding number."""
    require_one_loop(arranged, "the search for immersions")
    turning = arranged.turning_number
    if turning != 1:
        sentence = f"The curve turns {turning} times, and the outline of a disk turns once."
        return wrong_turning(arranged, sentence)
    return negative_winding(arranged)


def wrong_turning(arranged: Arrangement, sentence: str) -> Obstruction:
    """Return the obstruction of a turning number that is not the one looked for, as a sentence says."""
    place = place_of_turning(arranged)
    return Obstruction("turning number", sentence, place, arranged.turning_number, subject_of(arranged))


def negative_winding(arranged: Arrangement) -> Obstruction | None:
    """Return the obstruction of a negative winding number, if there is one: the lowest of them."""
    lowest = int(np.argmin(arranged.winding))
    winding = int(arranged.winding[lowest])
    if winding >= 0:
        return None
    who = "curve winds" if arranged.n_loops == 1 else "curves wind"
    sentence = f"The {who} {winding} times around a cell, and cloth cannot cover it a negative number of times."
    return Obstruction("negative winding", sentence, _places(arranged, [lowest]), winding, subject_of(arranged))


def subject_of(arranged: Arrangement) -> Arrangement | None:
    """Return what a picture of an obstruction shows; there is none yet of several curves."""
    return arranged if arranged.n_loops == 1 else None


def _no_grouping(arranged: Arrangement) -> Obstruction:
    """Return the obstruction of a curve whose word has no grouping: cells whose ways out are in conflict."""
    tree = grow_dual_tree(arranged)
    cells = _conflict(tree)
    if len(cells) == 1:
        sentence = "No grouping: the way out of a cell can be joined to no border that would cut off a disk."
    else:
        sentence = f"No grouping: the ways out of {len(cells)} cells cannot be joined to borders without crossing."
    links = tuple(tree.link[cells].tolist())
    return Obstruction("no grouping", sentence, _places(arranged, cells), links, arranged)


def _places(arranged: Arrangement, cells: list[int]) -> tuple[tuple[float, float], ...]:
    return tuple(arranged.cell_point(cell) for cell in cells if arranged.curves)


def _conflict(tree: DualTree) -> list[int]:
    """Return cells whose ascending links cannot all be joined; as few as leaving out some at a time can reach.

    Begins with those that led to the contradiction. Whole stretches are left out first, each half as long as those
    before, and single cells at last.
    """
    cells = _contradiction(tree, tree.ascending_cells())
    stretch = len(cells) if len(cells) <= _MINIMISE_UP_TO else 0
    while stretch > 1:
        stretch = -(-stretch // 2)
        for start in range(0, len(cells), stretch)[::-1]:
            cells = _contradiction(tree, cells[:start] + cells[start + stretch :]) or cells
    return cells


def _contradiction(tree: DualTree, cells: list[int]) -> list[int]:
    """Return those of some cells that contradict each other; none if their links can be joined."""
    word = write_word(tree, cells)
    found = find_groupings(word)
    return [word.cells[label] for label in found.labels] if isinstance(found, Conflict) else []
