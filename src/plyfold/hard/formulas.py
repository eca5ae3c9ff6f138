"""Formulas as immersed disks: one that lifts if and only if the variables can be set such that no clause is constant.

This is a reduction from not-all-equal satisfiability, as in Theorem 5 of Eppstein and Mumford, by way of the disks with
flaps: above or below the base is true or false. Flaps that cover each other's handles have different values; three that
cover one another's in a circle do not all have the same value. To keep clauses from making longer circles together,
each of them goes through a flap of its own, a copy of one of its literals:

* The other two literals of a clause, in a fixed order, have one arc from the first to the second. Such arcs alone make
  no directed cycle.
* So every directed cycle without opposite arcs passes through the copy of some clause; the only ways into and out of
  a copy are the other two literals, and thus the cycle contains the whole clause.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from numbers import Integral

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import reverse_cuthill_mckee

from plyfold.errors import InputError
from plyfold.hard.flaps import FlapDisk, flap_disk
from plyfold.layering.layering import Layering

__all__ = ["FormulaDisk", "formula_disk"]

_Literals = tuple[int, ...]


@dataclass(frozen=True, eq=False)
class FormulaDisk:
    """An immersed disk that lifts if and only if a formula is satisfiable in the sense of not-all-equal.

    Parameters
    ----------
    disk : FlapDisk
    flap_of_variable : mapping of int to int
        The flap that shows the value of each variable: above the base is true.

    Examples
    --------
    >>> formula_disk([(1, 2)]).flap_of_variable.keys()
    dict_keys([1, 2])
    """

    disk: FlapDisk
    flap_of_variable: Mapping[int, int]

    def assignment(self, layering: Layering) -> dict[int, bool]:
        """Return the values of the variables in a layering of the disk; no clause is constant.

        Examples
        --------
        >>> from plyfold import find_layering
        >>> made = formula_disk([(1, 2), (2, 3)])
        >>> values = made.assignment(find_layering(made.disk.immersion))
        >>> values[1] != values[2] != values[3]
        True
        """
        sides = self.disk.sides(layering)
        return {variable: sides[flap] for variable, flap in self.flap_of_variable.items()}


def formula_disk(clauses: Iterable[Sequence[int]]) -> FormulaDisk:
    """Return the immersed disk of a formula.

    Parameters
    ----------
    clauses : iterable of sequences of int
        Literals: the variable's number, negative if it is negated. A clause has two or three different ones, and holds
        if they do not all have the same value.

    Returns
    -------
    FormulaDisk
        Its immersion lifts if and only if there are values for which all clauses hold.

    Raises
    ------
    InputError
        If there is no clause, or one has other than two or three different literals, or one that is 0 or no integer.

    Notes
    -----
    At most one flap for each clause and two for each variable, before :func:`plyfold.hard.flap_disk`. Theorem 5 of
    [EM09]_ has a reduction from the same problem.

    References
    ----------
    .. [EM09] D. Eppstein, E. Mumford, "Self-overlapping curves revisited", SODA 2009.

    Examples
    --------
    Seven points cannot have two colours such that every line of the Fano plane has both.

    >>> from plyfold import find_layering
    >>> fano = formula_disk([(1, 2, 3), (1, 4, 5), (1, 6, 7), (2, 4, 6), (2, 5, 7), (3, 4, 7), (3, 5, 6)])
    >>> print(find_layering(fano.disk.immersion).reason)
    cyclic order
    """
    checked = [_checked(clause) for clause in clauses]
    if not checked:
        raise InputError("a formula without clauses has no disk", hint="give at least one clause")
    digraph = _Digraph()
    for literal in sorted({abs(literal) for clause in checked for literal in clause}):
        digraph.add(literal)
    open_clauses = [clause for clause in checked if not any(-literal in clause for literal in clause)]
    uses = Counter(literal for clause in open_clauses for literal in clause)
    for clause in open_clauses:
        _add_clause(digraph, clause, uses)
    place = _places(digraph)
    disk = flap_disk(len(place), [(place[i], place[j]) for i, j in digraph.arcs])
    return FormulaDisk(disk, {literal: place[flap] for literal, flap in digraph.flap_of.items() if literal > 0})


def _checked(clause: Sequence[int]) -> _Literals:
    literals = tuple(sorted(set(clause)))
    if len(literals) not in (2, 3) or 0 in literals or not all(isinstance(literal, Integral) for literal in literals):
        raise InputError(
            f"{tuple(clause)} is no clause with two or three different literals",
            hint="write variables as 1, 2, … and their negations as -1, -2, …; a longer clause can be split",
        )
    return tuple(int(literal) for literal in literals)


@dataclass
class _Digraph:
    """A digraph that grows: flaps, some of them standing for literals, and who covers whose handle."""

    flaps: int = 0
    flap_of: dict[int, int] = field(default_factory=dict)
    arcs: list[tuple[int, int]] = field(default_factory=list)

    def new_flap(self) -> int:
        self.flaps += 1
        return self.flaps - 1

    def add(self, literal: int) -> int:
        """Return the flap of a literal; a new one differs from the flap of its negation."""
        if literal not in self.flap_of:
            self.flap_of[literal] = self.new_flap()
            if -literal in self.flap_of:
                self.differ(self.flap_of[literal], self.flap_of[-literal])
        return self.flap_of[literal]

    def differ(self, one: int, other: int) -> None:
        self.arcs += [(one, other), (other, one)]

    def circle(self, flaps: Sequence[int]) -> None:
        self.arcs += zip(flaps, [*flaps[1:], flaps[0]], strict=True)


def _add_clause(digraph: _Digraph, clause: _Literals, uses: Counter[int]) -> None:
    """Add a circle through a flap for one literal that is in no other clause, and the flaps of the others."""
    own = min(clause, key=lambda literal: (uses[literal] > 1, -literal not in digraph.flap_of, -uses[literal]))
    if uses[own] == 1:
        through = digraph.add(own)
    else:
        through = digraph.new_flap()
        digraph.differ(through, digraph.add(-own))
    digraph.circle([through, *(digraph.add(literal) for literal in clause if literal != own)])


def _places(digraph: _Digraph) -> list[int]:
    """Return where each flap hangs, those that cover each other's handles close together."""
    ends = np.array(digraph.arcs + [(j, i) for i, j in digraph.arcs], dtype=np.int32).reshape(-1, 2).T
    graph = coo_array((np.ones(ends.shape[1]), ends), shape=(digraph.flaps, digraph.flaps)).tocsr()
    place: list[int] = np.argsort(reverse_cuthill_mckee(graph, symmetric_mode=True)).tolist()
    return place
