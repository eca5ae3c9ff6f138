"""Numbered nodes in a row, as a skip list [Pug90]_.

Node 0 is both ends. A node of height h is linked on levels 0 to h, where a quarter of the nodes on each level are on
the next one as well. The link of a node on a level is at ``level · size + node``.

References
----------
.. [Pug90] W. Pugh, "Skip lists: a probabilistic alternative to balanced trees", Communications of the ACM 33, 1990.
"""

from __future__ import annotations

from plyfold.core.buffers import whole_room

__all__ = ["SkipList"]

# Multiples of this, without their whole parts, are spread evenly.
_GOLDEN = 0.6180339887498949


class SkipList:
    """Links to the node above and to the node below on every level, and the height of each node.

    At first there are no nodes.

    Parameters
    ----------
    most : int
        The highest number that nodes will have.

    Examples
    --------
    >>> row = SkipList(2)
    >>> row.link(2, 0)
    >>> row.link(1, 2)
    >>> row.above[0], row.above[2]
    (2, 1)
    """

    def __init__(self, most: int) -> None:
        self.size, self.levels = most + 1, 1
        places = 4
        while places <= most:
            places *= 4
            self.levels += 1
        self.room = whole_room((2 * self.levels + 1) * self.size)
        links = self.levels * self.size
        self.above, self.below, self.height = self.room[:links], self.room[links : 2 * links], self.room[2 * links :]
        self._choose_heights()

    def _choose_heights(self) -> None:
        """Make a node one level higher for each time that a scattered number is less than a quarter of that."""
        scattered = 0.0
        for node in range(1, self.size):
            scattered += _GOLDEN
            if scattered >= 1.0:
                scattered -= 1.0
            height, rest = 0, 4.0 * scattered
            while rest < 1.0 and height < self.levels - 1:
                height, rest = height + 1, 4.0 * rest
            self.height[node] = height
        self.height[0] = self.levels - 1

    def link(self, node: int, place: int) -> None:
        """Put a new node above another one, or at the lower end if that is node 0."""
        for level in range(self.height[node] + 1):
            while self.height[place] < level:
                place = self.below[(level - 1) * self.size + place]
            base = level * self.size
            above = self.above[base + place]
            self.above[base + place] = self.below[base + above] = node
            self.below[base + node], self.above[base + node] = place, above

    def unlink(self, node: int) -> None:
        """Take a node out."""
        for level in range(self.height[node] + 1):
            base = level * self.size
            above, below = self.above[base + node], self.below[base + node]
            self.above[base + below] = above
            self.below[base + above] = below
