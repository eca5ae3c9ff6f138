"""How many solutions constraints have, exactly: tables are joined, and what no other table knows is counted out.

A table holds the values of some variables that are possible together, each with the number of ways to complete it by
variables that are no longer there. To count out a variable, join all tables that have it, and add up the rows that
differ in nothing else. The order in which that is done is settled beforehand, so that tables stay small. Parts of the
problem that have no variable in common never share a table, and their numbers multiply.

A table is a tree: the root branches by the values of one variable, the nodes below it by those of the next, and so on.
All trees ask for their variables in the same order, last for those that are counted out first. So tables are joined by
walking down all their trees at once, variable by variable, and counted out by adding up from below. All constraints
between the variables of a join take part in the walk, also those that are counted elsewhere: what they forbid need not
be kept till then, which often leaves a tenth of the rows.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import prod
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Bools, Ints, Wholes
from plyfold.clock import Clock
from plyfold.layering.elimination import elimination_order

__all__ = ["Relation", "Table", "TooLargeError", "count_solutions"]

_MOST_ROWS = 2_000_000
# From here on numbers are added and multiplied as Python's own.
_LARGE = 2**62
# Joins with so few variables are small in any case.
_FEW_VARIABLES = 8

Nodes: TypeAlias = npt.NDArray[np.int32]


class TooLargeError(Exception):
    """A table has too many rows."""


@dataclass(frozen=True, eq=False)
class Relation:
    """Values that are possible together.

    Parameters
    ----------
    rows : tuple of tuple of int
        Each row once; values from 0 on.
    ways : tuple of int
        How often each row counts.
    """

    rows: tuple[tuple[int, ...], ...]
    ways: tuple[int, ...]
    _trees: dict[tuple[int, ...], _Tree] = field(default_factory=dict, repr=False)

    def tree(self, places: Sequence[int]) -> _Tree:
        """Return the relation as a tree, given the places of its variables in the order of counting out."""
        columns = tuple(sorted(range(len(places)), key=lambda column: -places[column]))
        if columns not in self._trees:
            self._trees[columns] = _planted(self, columns)
        return replace(self._trees[columns], places=tuple(sorted(places, reverse=True)))


class Table(NamedTuple):
    """A relation between some variables, each of them named once. Tables may share a relation."""

    variables: tuple[int, ...]
    relation: Relation


def count_solutions(tables: Iterable[Table], clock: Clock) -> int:
    """Count the values of all variables that are possible in every table, weighted by the products of ways.

    Raises
    ------
    TimeoutError
        When the time is over.
    TooLargeError
        If a table has more than two million rows.

    Examples
    --------
    >>> unequal = Relation(((0, 1), (1, 0)), (1, 1))
    >>> count_solutions([Table((1, 2), unequal), Table((2, 3), unequal), Table((4, 5), unequal)], Clock(None))
    4
    """
    given = list(clock.while_time(tables))
    order = elimination_order([table.variables for table in given], clock)
    counter = _Counter.of(given, {variable: place for place, variable in enumerate(order)})
    for place in range(len(order)):
        counter.count_out(place, clock)
    return counter.total


# ---- trees ---------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _Tree:
    """A table as a tree.

    Parameters
    ----------
    places : tuple of int
        The variables by their places in the order in which they are counted out: from the last one to the first.
    steps : tuple of (nodes, values) int
        For each variable the nodes after it, by the node before it and the value; −1 where there is none.
    ways : (leaves,) int
        How often each leaf counts.
    is_given : bool
        Whether it is one of the tables to start with.
    """

    places: tuple[int, ...]
    steps: tuple[Nodes, ...]
    ways: Ints | Wholes
    is_given: bool = False

    @cached_property
    def most(self) -> int:
        """The most ways of a leaf."""
        return int(self.ways.max(initial=0))


def _planted(relation: Relation, columns: tuple[int, ...]) -> _Tree:
    """Return the tree of a relation that asks for its columns in a given order, as if these were the places."""
    rows = sorted(zip(([row[c] for c in columns] for row in relation.rows), relation.ways, strict=True))
    node, is_new, steps = np.zeros(len(rows), dtype=np.int64), np.arange(len(rows)) == 0, []
    for column in np.array([row for row, _ in rows], dtype=np.int64).reshape(len(rows), len(columns)).T:
        is_new[1:] |= np.diff(column) != 0
        steps.append(_step(1 + int(node.max(initial=0)), node[is_new], column[is_new]))
        node = np.cumsum(is_new) - 1
    return _Tree(columns, tuple(steps), _whole([ways for _, ways in rows]), is_given=True)


def _step(nodes: int, before: Ints, value: Ints) -> Nodes:
    """Return the step from some nodes to those after them, numbered in order, given the node before and the value."""
    step = np.full((nodes, 1 + int(value.max(initial=0))), -1, dtype=np.int32)
    step[before, value] = np.arange(len(before))
    return step


def _whole(numbers: Sequence[int] | Ints | Wholes) -> Ints | Wholes:
    """Return whole numbers as an array, of machine numbers if they are small."""
    numbers = np.asarray(numbers)
    return numbers.astype(np.int64) if numbers.max(initial=0) < _LARGE else numbers


# ---- joining -------------------------------------------------------------------------------------------------------


@dataclass(eq=False)
class _Counter:
    """What is left to do.

    Parameters
    ----------
    due : dict of int to list of _Tree
        The trees still to be joined, by the places at which they will be.
    n_due : Counter of int
        How many of them have each variable.
    given : dict of int to list of _Tree
        Those to start with, by the same places.
    total : int
        The product of what needs no more joining.
    """

    due: dict[int, list[_Tree]]
    n_due: Counter[int]
    given: dict[int, list[_Tree]]
    total: int = 1

    @classmethod
    def of(cls, tables: list[Table], place_of: dict[int, int]) -> _Counter:
        """Plant the trees of some tables, given the places of their variables."""
        counter = cls({}, Counter(), {})
        for variables, relation in tables:
            counter.add(relation.tree([place_of[variable] for variable in variables]))
        counter.given = {place: list(trees) for place, trees in counter.due.items()}
        return counter

    def add(self, tree: _Tree) -> None:
        """Put a tree where its first variable is counted out; one without variables is a number of ways."""
        if tree.places:
            self.due.setdefault(tree.places[-1], []).append(tree)
            for place in tree.places:
                self.n_due[place] += 1
        else:
            self.total *= tree.most

    def count_out(self, place: int, clock: Clock) -> None:
        """Count out a variable, and those after it that make the join hardly larger."""
        joined = self._take(place)
        if not joined:
            return
        scope = _scope(joined)
        gone, most = 1, max(len(scope), _FEW_VARIABLES)
        while gone < len(scope) and self._can_join_all(scope[-1 - gone], scope, most):
            joined += self._take(scope[-1 - gone])
            scope, gone = _scope(joined), gone + 1
        walk = _Walk([*joined, *self._implied(joined, set(scope))], len(joined))
        for other in scope:
            walk.go_down(other, clock)
        steps, ways = walk.added_up(len(scope) - gone)
        factor = int(np.gcd.reduce(ways))
        self.total *= factor
        if gone < len(scope):
            self.add(_Tree(tuple(scope[:-gone]), steps, _whole(ways // max(factor, 1))))

    def _take(self, place: int) -> list[_Tree]:
        trees = self.due.pop(place, [])
        for tree in trees:
            for other in tree.places:
                self.n_due[other] -= 1
        return trees

    def _can_join_all(self, place: int, scope: list[int], most: int) -> bool:
        """Tell whether a join can have all trees of one more variable without having too many variables."""
        trees = self.due.get(place, [])
        return self.n_due[place] == len(trees) and len({*scope}.union(*(tree.places for tree in trees))) <= most

    def _implied(self, joined: list[_Tree], scope: set[int]) -> list[_Tree]:
        """Return the given trees between variables of the scope that no tree to be joined knows of."""
        made = [set(tree.places) for tree in joined if not tree.is_given]
        return [
            tree
            for place in scope
            for tree in self.given.get(place, ())
            if scope.issuperset(tree.places)
            and not any(places.issuperset(tree.places) for places in made)
            and not any(tree is other for other in joined)
        ]


def _scope(trees: list[_Tree]) -> list[int]:
    """Return the places of all variables of some trees, from the last one to the first."""
    return sorted({place for tree in trees for place in tree.places}, reverse=True)


class _Level(NamedTuple):
    """All ways down to some variable: the way that each goes on from and its value; and numbers of ways to multiply."""

    before: Ints
    value: Ints
    counts: list[Ints | Wholes]


class _Walk:
    """The ways down several trees at once, variable by variable: the rows of their join.

    Parameters
    ----------
    trees : list of _Tree
    n_joined : int
        Only so many of them count. Each of these ends with a variable that is counted out.
    """

    def __init__(self, trees: list[_Tree], n_joined: int) -> None:
        self._joined = trees[:n_joined]
        self._levels: list[_Level] = []
        self._n_ways = 1
        self._steps: dict[int, list[tuple[int, Nodes]]] = {}
        for number, tree in enumerate(trees):
            for place, step in zip(tree.places, tree.steps, strict=True):
                self._steps.setdefault(place, []).append((number, step))
        # Where all ways are in each tree that has not ended: one node, if they have it in common.
        self._at: dict[int, Nodes] = {number: np.zeros(1, dtype=np.int32) for number in range(len(trees))}
        self._last = [tree.places[-1] for tree in trees]

    def go_down(self, place: int, clock: Clock) -> None:
        """Let all ways go on by one variable, with the values that all trees that have it allow."""
        after = {number: step[self._at[number]] for number, step in self._steps[place]}
        before, value = _possible(after.values(), self._n_ways)
        self._n_ways = len(before)
        if self._n_ways > _MOST_ROWS:
            raise TooLargeError
        for number, nodes in self._at.items():
            clock.check()
            if number in after:
                self._at[number] = after[number][0 if len(nodes) == 1 else before, value]
            elif len(nodes) != 1:
                self._at[number] = nodes[before]
        leaves = [(number, self._at.pop(number)) for number in after if self._last[number] == place]
        counts = [self._joined[number].ways[nodes] for number, nodes in leaves if self._counts(number)]
        self._levels.append(_Level(before, value, counts))

    def _counts(self, number: int) -> bool:
        return number < len(self._joined) and self._joined[number].most > 1

    def added_up(self, kept: int) -> tuple[tuple[Nodes, ...], Ints | Wholes]:
        """Return steps and ways of the tree of the first variables, all others counted out."""
        ways = self._ones()
        alive = np.arange(len(ways))
        for level in reversed(self._levels[kept:]):
            for count in level.counts:
                ways = ways * count[alive]
            before = level.before[alive]
            first = _is_first_in_run(before).nonzero()[0]
            ways, alive = np.add.reduceat(ways, first) if len(first) else ways, before[first]
        return self._steps_to(alive, kept), ways

    def _ones(self) -> Ints | Wholes:
        """Return 1 for each way, as numbers that can be multiplied by all counts and added up."""
        most = prod(tree.most for tree in self._joined)
        values = prod(1 + int(level.value.max(initial=0)) for level in self._levels)
        return np.ones(len(self._levels[-1].before), dtype=object if most * values >= _LARGE else np.int64)

    def _steps_to(self, alive: Ints, kept: int) -> tuple[Nodes, ...]:
        """Return the steps of the tree of the first variables, only with the given leaves."""
        steps: list[Nodes] = []
        for level in reversed(self._levels[:kept]):
            value, before = level.value[alive], level.before[alive]
            is_first = _is_first_in_run(before)
            alive = before[is_first]
            steps.append(_step(max(1, len(alive)), np.cumsum(is_first) - 1, value))
        return tuple(reversed(steps))


def _possible(after: Iterable[Nodes], n_ways: int) -> tuple[Ints, Ints]:
    """Return the ways that can go on, and the values with which."""
    first, *others = after
    possible = first >= 0
    for nodes in others:
        shared = min(possible.shape[1], nodes.shape[1])
        possible = possible[:, :shared] & (nodes[:, :shared] >= 0)
    if len(possible) != n_ways:
        possible = np.broadcast_to(possible, (n_ways, possible.shape[1]))
    before, value = possible.nonzero()
    return before, value


def _is_first_in_run(values: Ints) -> Bools:
    """Tell which of some sorted values differ from the one before them."""
    is_first = np.ones(len(values), dtype=bool)
    np.not_equal(values[1:], values[:-1], out=is_first[1:])
    return is_first
