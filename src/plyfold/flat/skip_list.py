"""The edges that meet a vertical line, from below upward, as a skip list [Pug90]_ that loops can work on.

Nodes are numbered; node 0 is both ends. A node of height h is linked on levels 0 to h, where a quarter of the nodes on
each level are on the next one as well. The link of a node on a level is at ``level · nodes + node``.

References
----------
.. [Pug90] W. Pugh, "Skip lists: a probabilistic alternative to balanced trees", Communications of the ACM 33, 1990.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from plyfold.arrays import Ints
from plyfold.compiled import called_from_loops

# Multiples of this, without their whole parts, are spread evenly.
_GOLDEN = (5**0.5 - 1) / 2

__all__ = ["SkipList", "empty_skip_list", "link_above", "unlink"]


class SkipList(NamedTuple):
    """Links to the node above and to the node below on every level, and the height of each node."""

    above: Ints
    below: Ints
    height: Ints


def empty_skip_list(nodes: int) -> SkipList:
    """Return a list without nodes that has room for some, numbered from 1 on."""
    levels = max(1, (nodes.bit_length() + 1) // 2)
    scattered = np.arange(1, nodes + 2) * _GOLDEN % 1
    height = np.minimum(-np.log(scattered) / np.log(4), levels - 1).astype(np.int64)
    height[0] = levels - 1
    links = np.zeros((2, levels * (nodes + 1)), dtype=np.int64)
    return SkipList(links[0], links[1], height)


@called_from_loops
def link_above(nodes: SkipList, node: int, place: int) -> None:
    """Put a new node above another one, or at the lower end if that is node 0."""
    size = len(nodes.height)
    for level in range(nodes.height[node] + 1):
        while nodes.height[place] < level:
            place = nodes.below[(level - 1) * size + place]
        base = level * size
        above = nodes.above[base + place]
        nodes.above[base + place] = nodes.below[base + above] = node
        nodes.below[base + node], nodes.above[base + node] = place, above


@called_from_loops
def unlink(nodes: SkipList, node: int) -> None:
    """Take a node out."""
    size = len(nodes.height)
    for level in range(nodes.height[node] + 1):
        base = level * size
        above, below = nodes.above[base + node], nodes.below[base + node]
        nodes.above[base + below] = above
        nodes.below[base + above] = below
