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

from plyfold.arrays import Floats
from plyfold.core.buffers import all_flat, flat
from plyfold.core.rounder import Corners, Triangles, open_cuts, wants_flip
from plyfold.core.turns import ExactPoints
from plyfold.halfedges import GluedTriangles, before, flip

__all__ = ["delaunay_triangles", "flip_edges", "replaced"]

# The order of the cuts is random, and the same each time.
_SEED = 1


def delaunay_triangles(points: Floats, triangles: GluedTriangles) -> GluedTriangles:
    """Replace triangles by others on the same corners: no circle round one contains a corner that is seen from it.

    Parameters
    ----------
    points : (n, 2) float
    triangles : GluedTriangles
        Counter-clockwise triangles that make a disk, or another surface, without inner vertices.

    Returns
    -------
    GluedTriangles
        Triangles of the same surface, counter-clockwise, exactly. Whether circles contain a corner is decided as far as
        rounding errors let it.

    Notes
    -----
    O(n log² n) on average over the order of the cuts, whatever the disk: while one of r cuts is still closed, hardly
    any edge crosses more than O(r log n) of those that were opened.

    Examples
    --------
    >>> flat_kite = np.array([(0.0, 0.0), (4.0, -1.0), (8.0, 0.0), (4.0, 1.0)])
    >>> halves = GluedTriangles(np.array([(0, 1, 2), (0, 2, 3)]), np.array([-1, -1, 3, 2, -1, -1]))
    >>> delaunay_triangles(flat_kite, halves).faces.tolist()
    [[2, 3, 1], [1, 3, 0]]
    """
    return replaced(points, triangles)[0]


def replaced(points: Floats, triangles: GluedTriangles) -> tuple[GluedTriangles, int]:
    """Return the same, and how many triangles were replaced on the way, each as often as that happened."""
    cuts = np.random.default_rng(_SEED).permutation(triangles.pairs)
    start, beyond = triangles.faces.ravel().astype(np.int64), np.empty(triangles.faces.size, dtype=np.int64)
    steps = open_cuts(_corners(points), Triangles(*all_flat(start, beyond)), *all_flat(*cuts.T))
    return GluedTriangles(start.reshape(-1, 3), beyond), steps


def _corners(points: Floats) -> Corners:
    exponent = np.frexp(np.abs(points).max(initial=0))[1]
    return Corners(ExactPoints(flat(points)), flat(np.ldexp(points, -exponent)))


# ---- better triangles on the same points -----------------------------------------------------------------------------
#
# The disk may overlap itself. That does not matter to a flip, which looks at two triangles on either side of an edge.


def flip_edges(points: Floats, triangles: GluedTriangles) -> GluedTriangles:
    """Flip inner edges until, as a rule, no circle around a triangle contains the corner beyond one of its edges.

    Parameters
    ----------
    points : (n, 2) float
    triangles : GluedTriangles
        Counter-clockwise triangles that make a surface.

    Returns
    -------
    GluedTriangles
        Triangles of the same surface, counter-clockwise, exactly. Cost: O(m) if they are round already, O(m²) at worst.
    """
    corners = _corners(points)
    start, beyond = triangles.faces.ravel().tolist(), triangles.twin.tolist()
    waiting = triangles.pairs[:, 0].tolist()
    while waiting:
        side = waiting.pop()
        other = beyond[side]
        if other < 0:
            continue
        if wants_flip(corners, start[side], start[before(other)], start[other], start[before(side)]):
            flip(start, beyond, side)
            waiting += [side, before(side), other, before(other)]
    return GluedTriangles(np.array(start, dtype=np.int64).reshape(-1, 3), np.array(beyond, dtype=np.int64))
