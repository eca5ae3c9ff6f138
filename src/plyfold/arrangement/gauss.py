"""Signed Gauss codes of closed plane curves as values: read, written, turned, mirrored, compared.

In text, a code lists the crossings as the curve visits them. Behind each stands ``+`` if the other strand crosses there
from right to left and ``-`` if it crosses from left to right, so the two visits of a crossing have opposite signs. A
slash and a dart of the unbounded cell follow (CONVENTIONS.md numbers the darts)::

    / outer 1                          a circle
    1+ 1- / outer 1                    Pascal's limaçon
    1+ 2- 3+ 1- 2+ 3- / outer 1        the shadow of a trefoil knot
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import NoReturn, TypeAlias

import numpy as np
import numpy.typing as npt

from plyfold.arrangement.arrangement import Arrangement, CurveLike, arrange
from plyfold.arrangement.planar_diagrams import gauss_of_diagram, largest_cell
from plyfold.arrangement.planar_map import next_darts, reversed_code, whole_number
from plyfold.errors import GaussCodeError
from plyfold.mistaken import mistaken_code
from plyfold.outline.curve import Curve

__all__ = ["GaussCode"]

# One for each visit, the same wherever the numbering starts: how many visits later the partner comes, the sign, and
# whether the unbounded cell is on the left and on the right of the border that follows.
_Letter: TypeAlias = tuple[int, bool, bool, bool]
_Word: TypeAlias = tuple[_Letter, ...]

_PLUS, _MINUS = "+＋", "−–‐‑﹣－-"
_SEPARATOR = re.compile(r"[\s,;]*")
_VISIT = re.compile(rf"([^\W_]+)\s*([{_PLUS}{_MINUS}])")
_OUTER = re.compile(r"\s*outer\s*[:=]?\s*(\d+)\s*")
_MOST_CROSSINGS_DRAWN = 200
_HINT = "a code looks like '1+ 1- / outer 1': the crossings in order with their signs, and a dart of the unbounded cell"


@dataclass(frozen=True)
class GaussCode:
    """A signed Gauss code with its unbounded cell: a generic closed plane curve up to deformation, with its start.

    Two codes are equal if and only if they mean the same oriented curve with the same start; codes can be dictionary
    keys. See :meth:`canonical` for curves that differ in start, direction or by a mirror.

    Parameters
    ----------
    partner : (2k,) int
        The other visit to the same crossing.
    ccw : (2k,) bool
        True where the other strand crosses from right to left.
    outer : int
        Any dart of the unbounded cell; the lowest one is kept.

    Raises
    ------
    GaussCodeError
        If no closed plane curve has this code.

    Notes
    -----
    All operations are O(k).

    Examples
    --------
    >>> limacon = GaussCode([1, 0], [True, False], 1)
    >>> print(limacon)
    1+ 1- / outer 1
    >>> print(limacon.reversed())
    1- 1+ / outer 0
    >>> limacon.reversed().canonical() == limacon.canonical()
    True
    """

    partner: tuple[int, ...]
    ccw: tuple[bool, ...]
    outer: int

    def __post_init__(self) -> None:
        Arrangement.from_gauss(self.partner, self.ccw, self.outer)
        object.__setattr__(self, "partner", tuple(int(visit) for visit in self.partner))
        object.__setattr__(self, "ccw", tuple(bool(sign) for sign in self.ccw))
        object.__setattr__(self, "outer", int(min(self._outer_darts)))

    @classmethod
    def of(cls, curve: CurveLike) -> GaussCode:
        """Return the code of a curve, in the direction that :func:`~plyfold.arrange` gives it.

        Parameters
        ----------
        curve : Curve, array_like of shape (n, 2), shapely geometry, Arrangement or GaussCode
            A code is returned as it is.

        Returns
        -------
        GaussCode

        Raises
        ------
        CurveError
            If the points do not make a closed curve.

        Examples
        --------
        >>> print(GaussCode.of([(0, 0), (2, 2), (2, 0), (0, 2)]))
        1+ 1- / outer 0
        """
        if isinstance(curve, cls):
            return curve
        partner, ccw, outer = arrange(curve).gauss_code()
        return cls(tuple(partner), tuple(ccw), outer)

    @classmethod
    def parse(cls, text: str) -> GaussCode:
        """Read a code from text; ``str(code)`` is the way back.

        Parameters
        ----------
        text : str
            Crossings may be named by numbers or words, separated by spaces, commas or nothing; every minus of Unicode
            counts.

        Returns
        -------
        GaussCode

        Raises
        ------
        GaussCodeError
            Naming the character where the text stops being a code, or if no closed plane curve has this code.

        Examples
        --------
        >>> GaussCode.parse("a+, b−, c+, a−, b+, c− / outer 1").partner
        (3, 4, 5, 0, 1, 2)
        """
        if not isinstance(text, str):
            raise GaussCodeError(f"a {type(text).__name__} is no text", hint='write a code as in "1+ 1- / outer 1"')
        visits, slash, tail = text.partition("/")
        match = _OUTER.fullmatch(tail)
        if match is None:
            if not slash and (mistake := mistaken_code(text)):
                raise GaussCodeError(mistake.message, hint=mistake.hint)
            _refuse("expected '/ outer' and a dart", text, len(visits + slash))
        partner, ccw = _read_visits(visits)
        return cls(tuple(partner), tuple(ccw), int(match[1]))

    @classmethod
    def from_pd(cls, diagram: str | npt.ArrayLike, outer: int | None = None) -> GaussCode:
        """Read the shadow of a knot from its planar diagram, as KnotTheory, SnapPy and Spherogram write it.

        Parameters
        ----------
        diagram : (k, 4) array_like of int, or str
            The labels of the edges around each crossing, counter-clockwise, from the strand below that comes in.
        outer : int, optional
            A dart of the unbounded cell, which a diagram does not tell; by default one of the cell with most borders.

        Returns
        -------
        GaussCode
            It starts on the edge that is named first.

        Raises
        ------
        GaussCodeError
            If it is no planar diagram, or one of several curves.

        Examples
        --------
        >>> print(GaussCode.from_pd([(1, 4, 2, 5), (3, 6, 4, 1), (5, 2, 6, 3)]))
        1+ 2- 3+ 1- 2+ 3- / outer 1
        """
        partner, ccw, _ = gauss_of_diagram(diagram)
        return cls(tuple(partner), tuple(ccw), largest_cell(partner, ccw) if outer is None else outer)

    def to_pd(self, over: npt.ArrayLike) -> list[tuple[int, int, int, int]]:
        """Return the planar diagram of the knot that the curve is with strands over and under each other.

        Parameters
        ----------
        over : (2k,) bool
            Whether the strand passes over, by visits, as ``casing`` of a layering.

        Returns
        -------
        list of four int
            For each crossing the labels of the edges around it, counter-clockwise, from the strand below that comes in.
            Edge i, counted from 1, leads to visit i − 1.

        Raises
        ------
        GaussCodeError
            If there are other than one truth value for each visit, or not one of each two strands passes over.

        Examples
        --------
        >>> trefoil = GaussCode.from_pd([(1, 4, 2, 5), (3, 6, 4, 1), (5, 2, 6, 3)])
        >>> trefoil.to_pd([False, True] * 3)
        [(1, 4, 2, 5), (3, 6, 4, 1), (5, 2, 6, 3)]
        """
        passes, (partner, ccw) = np.asarray(over, dtype=bool), self._arrays()
        if passes.shape != partner.shape or (passes == passes[partner]).any():
            raise GaussCodeError("over says of each visit whether its strand passes over, and the other one does not")
        return [
            _around(int(visit), int(partner[visit]), bool(ccw[visit]), len(partner))
            for visit in np.flatnonzero(~passes)
        ]

    def __str__(self) -> str:
        first = [min(visit, other) for visit, other in enumerate(self.partner)]
        label = {visit: number for number, visit in enumerate(dict.fromkeys(first), start=1)}
        visits = [f"{label[visit]}{'+' if sign else '-'}" for visit, sign in zip(first, self.ccw, strict=True)]
        return " ".join([*visits, f"/ outer {self.outer}"])

    @property
    def n_crossings(self) -> int:
        """Number of crossings, k."""
        return len(self.partner) // 2

    def rotated(self, start: int) -> GaussCode:
        """Return the code of the same curve with visit ``start`` as visit 0.

        Examples
        --------
        >>> print(GaussCode.parse("1+ 1- 2- 2+ / outer 3").rotated(1))
        1- 2- 2+ 1+ / outer 1
        """
        word = self._word()
        start = whole_number("start", start) % len(word)
        return _from_word(word[start:] + word[:start])

    def reversed(self) -> GaussCode:
        """Return the code of the curve run the other way from the same starting point.

        Examples
        --------
        >>> print(GaussCode.parse("1+ 1- 2- 2+ / outer 3").reversed())
        1+ 1- 2- 2+ / outer 2
        """
        partner, ccw, outer = reversed_code(*self._arrays(), self.outer)
        return GaussCode(tuple(partner.tolist()), tuple(ccw.tolist()), outer)

    def reflected(self) -> GaussCode:
        """Return the code of the mirror image, with the same start and direction.

        Examples
        --------
        >>> print(GaussCode.parse("1+ 1- 2- 2+ / outer 3").reflected())
        1- 1+ 2+ 2- / outer 1
        """
        return _from_word(_mirrored(self._word()))

    def with_outer(self, dart: int) -> GaussCode:
        """Return the code of the same curve on the sphere, with another cell as the unbounded one.

        Parameters
        ----------
        dart : int
            A dart with that cell on its left.

        Returns
        -------
        GaussCode

        Raises
        ------
        GaussCodeError
            If there is no such dart.

        Examples
        --------
        >>> print(GaussCode.parse("1+ 1- / outer 1").with_outer(0))
        1+ 1- / outer 0
        """
        return GaussCode(self.partner, self.ccw, whole_number("dart", dart))

    def canonical(self, reversal: bool = True, reflection: bool = True, any_outer: bool = False) -> GaussCode:
        """Return the same code for all equivalent curves, and different ones for others.

        Parameters
        ----------
        reversal, reflection : bool, optional
            Whether a curve counts as equivalent to the same curve run the other way, and to its mirror image. The
            start never counts.
        any_outer : bool, optional
            Whether curves that differ only in the unbounded cell are equivalent: curves on the sphere.

        Returns
        -------
        GaussCode
            The one whose word is lexicographically least.

        Notes
        -----
        O(k): the word of a code is written so that another start rotates it, and the least rotation is found in one
        pass.

        Examples
        --------
        >>> eight, limacon = GaussCode.parse("1+ 1- / outer 0"), GaussCode.parse("1+ 1- / outer 1")
        >>> eight.canonical() == limacon.canonical()
        False
        >>> eight.canonical(any_outer=True) == limacon.canonical(any_outer=True)
        True
        """
        words = [self._word()]
        if reversal:
            words += [self.reversed()._word()]
        if reflection:
            words += [_mirrored(word) for word in words]
        if any_outer:
            words = [tuple((gap, sign, False, False) for gap, sign, *_ in word) for word in words]
        return _from_word(min(map(_least_rotation, words)))

    def to_curve(self) -> Curve:
        """Draw a round, evenly spaced curve with this code and this unbounded cell.

        Returns
        -------
        Curve
            In the direction of the code, starting on the border before its visit 0, around the origin; the longer side
            of its bounding box is 2. Its code was read back and is the same. An arrangement of it is turned round if
            the turning number is negative, and then has the code's ``reversed()``.

        Raises
        ------
        PrecisionError
            If no drawing was found that double precision can hold.

        Notes
        -----
        See :func:`plyfold.arrangement.drawing.smooth.draw_code` for the method. Ten crossings take about a tenth of a
        second, some hundreds take seconds.

        Examples
        --------
        >>> arrange(GaussCode.parse("1+ 1- / outer 1").to_curve()).turning_number
        2
        """
        # Codes are read and decided without scipy, which only drawing needs.
        from plyfold.arrangement.drawing.smooth import draw_code

        wanted = Arrangement.from_gauss(self.partner, self.ccw, self.outer)
        drawn = draw_code(wanted)
        return drawn.reversed() if wanted.reversed else drawn

    def _repr_svg_(self) -> str:
        from plyfold.draw.svg import arrangement_svg

        if self.n_crossings > _MOST_CROSSINGS_DRAWN:
            return arrangement_svg(Arrangement.from_gauss(self.partner, self.ccw, self.outer))
        return arrangement_svg(arrange(self.to_curve()))

    @cached_property
    def _outer_darts(self) -> frozenset[int]:
        following = next_darts(*self._arrays()).tolist()
        darts, dart = {self.outer}, following[self.outer]
        while dart != self.outer:
            darts.add(dart)
            dart = following[dart]
        return frozenset(darts)

    def _arrays(self) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.bool_]]:
        return np.array(self.partner, dtype=np.int64), np.array(self.ccw, dtype=bool)

    def _word(self) -> _Word:
        """Return one letter for each visit; a circle is one letter with itself as partner."""
        visits = zip(self.partner or (0,), self.ccw or (False,), strict=True)
        n, outer = max(len(self.partner), 1), self._outer_darts
        return tuple(
            ((other - visit) % n, sign, 2 * visit in outer, 2 * visit + 1 in outer)
            for visit, (other, sign) in enumerate(visits)
        )


def _around(below: int, above: int, from_right: bool, visits: int) -> tuple[int, int, int, int]:
    """Return the labels of the edges around a crossing, given its visits and the side from which the upper comes."""
    incoming, outgoing = above + 1, (above + 1) % visits + 1
    right, left = (incoming, outgoing) if from_right else (outgoing, incoming)
    return below + 1, right, (below + 1) % visits + 1, left


def _from_word(word: _Word) -> GaussCode:
    """Return the code of a word; if no letter says which cell is unbounded, it is the one right of border 0."""
    flags = (flag for letter in word for flag in letter[2:])
    outer = next((dart for dart, flag in enumerate(flags) if flag), 1)
    if word[0][0] == 0:
        return GaussCode((), (), outer)
    partner = tuple((visit + letter[0]) % len(word) for visit, letter in enumerate(word))
    return GaussCode(partner, tuple(letter[1] for letter in word), outer)


def _mirrored(word: _Word) -> _Word:
    return tuple((gap, gap > 0 and not sign, right, left) for gap, sign, left, right in word)


def _least_rotation(word: _Word) -> _Word:
    """Compare two starts letter by letter; where they differ, all starts passed on the losing side lose too."""
    n, best, rival, same = len(word), 0, 1, 0
    while rival < n and same < n:
        ahead, behind = word[(best + same) % n], word[(rival + same) % n]
        if ahead == behind:
            same += 1
            continue
        if ahead > behind:
            best, rival = rival, max(rival, best + same) + 1
        else:
            rival += same + 1
        same = 0
    return word[best:] + word[:best]


def _read_visits(text: str) -> tuple[list[int], list[bool]]:
    """Return partner and ccw of the visits in a text."""
    partner: list[int] = []
    ccw: list[bool] = []
    met: dict[str, list[int]] = {}
    for visit, (label, sign, position) in enumerate(_tokens(text)):
        earlier = met.setdefault(label, [])
        if len(earlier) == 2:
            _refuse(f"crossing {label} is visited a third time", text, position)
        if earlier and ccw[earlier[0]] == sign:
            _refuse(
                f"both visits to crossing {label} have the same sign: one strand must see + and one -", text, position
            )
        partner.append(earlier[0] if earlier else visit)
        partner[partner[-1]] = visit
        ccw.append(sign)
        earlier.append(visit)
    for label, visits in met.items():
        if len(visits) == 1:
            raise GaussCodeError(f"crossing {label} is visited only once", hint=_HINT)
    return partner, ccw


def _tokens(text: str) -> Iterator[tuple[str, bool, int]]:
    """Yield the label, the sign and the position of each visit."""
    position = _SEPARATOR.match(text).end()  # type: ignore[union-attr]
    while position < len(text):
        match = _VISIT.match(text, position)
        if match is None:
            _refuse("expected a crossing with its sign behind it", text, position)
        if re.fullmatch(r"[OUou]\d+", match[1]):
            _refuse("over and under belong to knots; a curve in the plane has signs alone", text, position)
        yield match[1], match[2] in _PLUS, position
        position = _SEPARATOR.match(text, match.end()).end()  # type: ignore[union-attr]


def _refuse(message: str, text: str, position: int) -> NoReturn:
    found = text[position : position + 12].strip() or "the end"
    raise GaussCodeError(f"{message}, at character {position + 1} ({found})", hint=_HINT)
