"""The roundest triangles on the corners of a disk: cuts of the disk are opened one by one, and its parts put together.

Flips alone take quadratic time where triangles are long: two rows of n points that face each other can be n² / 4 flips
away from good triangles. So, as in the construction of a planar Delaunay triangulation from its halves [GS85]_, an
edge that goes is replaced by all the triangles across it at once. Those on both sides whose circles contain a corner
from beyond are removed, which leaves two chains of edges from one end of the cut to the other; then a ladder with one
corner on each chain climbs up between them.

The order in which cuts are opened is random, so small parts come first: a triangle is far from open cuts on average.
The disk may overlap itself. That does not matter here: it is looked at across one cut at a time.

References
----------
.. [GS85] L. Guibas, J. Stolfi, "Primitives for the manipulation of general subdivisions and the computation of Voronoi
   diagrams", ACM Transactions on Graphics 4, 1985.
"""

from __future__ import annotations

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.core.buffers import all_flat, flat
from plyfold.core.rounder import Corners, Triangles, open_cuts, wants_flip
from plyfold.core.turns import ExactPoints
from plyfold.halfedges import glued_pairs

__all__ = ["delaunay_triangles", "flip_edges", "replaced"]

# The order of the cuts is random, and the same each time.
_SEED = 1


def delaunay_triangles(points: Floats, faces: Ints) -> Ints:
    """Replace triangles by others on the same corners: no circle round one contains a corner that is seen from it.

    Parameters
    ----------
    points : (n, 2) float
    faces : (m, 3) int
        Counter-clockwise triangles that make a disk without inner vertices.

    Returns
    -------
    (m, 3) int
        Triangles of the same disk, counter-clockwise, exactly. Whether circles contain a corner is decided as far as
        rounding errors let it.

    Notes
    -----
    O(n log² n) on average over the order of the cuts, whatever the disk: while one of r cuts is still closed, hardly
    any edge crosses more than O(r log n) of those that were opened.

    Examples
    --------
    >>> flat_kite = np.array([(0.0, 0.0), (4.0, -1.0), (8.0, 0.0), (4.0, 1.0)])
    >>> delaunay_triangles(flat_kite, np.array([(0, 1, 2), (0, 2, 3)])).tolist()
    [[2, 3, 1], [1, 3, 0]]
    """
    return replaced(points, faces)[0]


def replaced(points: Floats, faces: Ints) -> tuple[Ints, int]:
    """Return the same, and how many triangles were replaced on the way, each as often as that happened."""
    cuts = np.random.default_rng(_SEED).permutation(glued_pairs(faces))
    start = faces.ravel().astype(np.int64)
    steps = open_cuts(_corners(points), Triangles(flat(start)), *all_flat(*cuts.T))
    return start.reshape(-1, 3), steps


def _corners(points: Floats) -> Corners:
    exponent = np.frexp(np.abs(points).max(initial=0))[1]
    return Corners(ExactPoints(flat(points)), flat(np.ldexp(points, -exponent)))


# ---- better triangles on the same points -----------------------------------------------------------------------------
#
# The disk may overlap itself. That does not matter to a flip, which looks at two triangles on either side of an edge.


def flip_edges(points: Floats, faces: Ints) -> Ints:
    """Flip inner edges until, as a rule, no circle around a triangle contains the corner beyond one of its edges.

    Parameters
    ----------
    points : (n, 2) float
    faces : (m, 3) int
        Counter-clockwise triangles that make a disk.

    Returns
    -------
    (m, 3) int
        Triangles of the same disk, counter-clockwise, exactly. Cost: O(m) if they are round already, O(m²) at worst.
    """
    corners = _corners(points)
    # No two edges join the same points: between them would lie a disk of two straight sides, without angles.
    apex = {(u, v): w for a, b, c in faces.tolist() for u, v, w in ((a, b, c), (b, c, a), (c, a, b))}
    waiting = [edge for edge in apex if edge[0] < edge[1]]
    while waiting:
        u, v = waiting.pop()
        a, b = apex.get((u, v)), apex.get((v, u))
        if a is None or b is None or not wants_flip(corners, u, b, v, a):
            continue
        del apex[u, v], apex[v, u]
        for p, q, r in ((u, b, a), (b, v, a)):
            apex[p, q], apex[q, r], apex[r, p] = r, p, q
        waiting += [(u, b), (b, v), (v, a), (a, u)]
    rows = [(u, v, w) for (u, v), w in apex.items() if u < v and u < w]
    return np.array(rows, dtype=np.int64).reshape(-1, 3)
