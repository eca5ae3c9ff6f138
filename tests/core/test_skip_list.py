"""Skip lists against plain lists."""

from itertools import pairwise

import numpy as np

from plyfold.core.skip_list import SkipList


def test_links_on_every_level():
    rng = np.random.default_rng(8)
    nodes, expected = SkipList(500), []
    for node in range(1, 501):
        place = int(rng.integers(len(expected) + 1))
        nodes.link(node, expected[place - 1] if place else 0)
        expected.insert(place, node)
        if rng.random() < 0.4:
            nodes.unlink(expected.pop(int(rng.integers(len(expected)))))
    size = nodes.size
    for level in range(nodes.height[0] + 1):
        on_level = [0, *(node for node in expected if nodes.height[node] >= level), 0]
        for below, above in pairwise(on_level):
            assert nodes.above[level * size + below] == above
            assert nodes.below[level * size + above] == below
    assert nodes.height[0] > 2
