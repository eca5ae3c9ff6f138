"""Points in the middle of edges between borders.

Where two sheets pass through each other along a border, their order is open at the border's points and strict at all
others. So every edge but those of the border needs a point where it is strict.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.errors import PrecisionError
from plyfold.halfedges import ends_of, half_edges_from_to
from plyfold.mesh.cells import CellTriangulation
from plyfold.mesh.strips import Strips
from plyfold.predicates import orient
from plyfold.ragged import next_in_rows

__all__ = ["halved", "split_chords", "triangulation"]


def split_chords(mesh: CellTriangulation, borders: Ints) -> CellTriangulation:
    """Split all edges inside cells that join two points of the given borders, and borders of a single piece.

    Parameters
    ----------
    mesh : CellTriangulation
    borders : array of int

    Returns
    -------
    CellTriangulation
        No edge inside a cell joins two points of these borders, no triangle has all its corners there, and no piece of
        a border joins two crossings.

    Raises
    ------
    PrecisionError
        If double precision has no point in the middle.

    Examples
    --------
    >>> from plyfold import arrange
    >>> from plyfold.mesh.cells import triangulate_cells
    >>> square = triangulate_cells(arrange([(0, 0), (2, 0), (2, 2), (0, 2)]), triangles=0)
    >>> split = split_chords(square, np.array([0]))
    >>> split.points[4:].tolist(), len(split.triangles)
    ([[1.0, 1.0]], 4)
    """
    whole = halved(mesh, _first_pieces_of_short_borders(mesh))
    return halved(whole, _chords(whole, borders))


def _first_pieces_of_short_borders(mesh: CellTriangulation) -> Ints:
    """Return half-edges: after cutting them in two, no border is a single piece, and no cell a single triangle."""
    first, count = np.unique(mesh.chain_border, return_index=True, return_counts=True)[1:]
    # A loop's first border goes on at the loop's end; any of its pieces will do.
    return np.asarray(mesh.left[first[count < 4]])


def _chords(mesh: CellTriangulation, borders: Ints) -> Ints:
    """Return the half-edges inside cells that join two points of the given borders, one for each edge."""
    open_point = np.zeros(len(mesh.points), dtype=bool)
    pieces = np.flatnonzero(np.isin(mesh.chain_border, borders))
    open_point[mesh.chain[pieces]] = open_point[mesh.chain_end[pieces]] = True
    start, end = ends_of(mesh.triangles)
    right = mesh.twin[mesh.left]
    inside = mesh.twin >= 0
    inside[mesh.left] = inside[right[right >= 0]] = False
    return np.flatnonzero(inside & open_point[start] & open_point[end] & (start < end))


def halved(mesh: CellTriangulation, half_edges: Ints, share: float = 0.5) -> CellTriangulation:
    """Put a point in the middle of edges, each given by one half-edge, and join it to what is on both sides.

    Or at another share of the way along each half-edge.
    """
    if not len(half_edges):
        return mesh
    start, end = ends_of(mesh.triangles)
    added = mesh.points[start[half_edges]] * (1 - share) + mesh.points[end[half_edges]] * share
    points = np.concatenate([mesh.points, added])
    middle = np.full(len(start) + 1, -1)  # one more, for sides without a twin
    middle[mesh.twin[half_edges]] = middle[half_edges] = len(mesh.points) + np.arange(len(half_edges))
    middle = middle[:-1]
    touched = np.unique(np.flatnonzero(middle >= 0) // 3)
    fans = [_fan(mesh.triangles[t].tolist(), middle[3 * t : 3 * t + 3].tolist()) for t in touched.tolist()]
    parts = np.array([triangle for fan in fans for triangle in fan], dtype=np.int64).reshape(-1, 3)
    kept = np.delete(np.arange(len(mesh.triangles)), touched)
    triangles = np.concatenate([mesh.triangles[kept], parts])
    cell = np.concatenate([mesh.cell[kept], np.repeat(mesh.cell[touched], list(map(len, fans)))])
    beside = mesh.beside
    cut = np.flatnonzero((beside >= 0) & (middle[beside] >= 0))
    chain = np.insert(mesh.chain, cut + 1, middle[beside[cut]])
    chain_border = np.insert(mesh.chain_border, cut + 1, mesh.chain_border[cut])
    first_piece = mesh.first_piece + np.searchsorted(cut, mesh.first_piece)
    return triangulation(points, triangles, cell, (chain, chain_border, first_piece), mesh.strips)


def _fan(corners: list[int], middles: list[int]) -> list[tuple[int, int, int]]:
    """Return the triangles around one of the middles, to all other points on the sides of a triangle."""
    ring = [point for pair in zip(corners, middles, strict=True) for point in pair if point >= 0]
    centre = max(middles)
    at = ring.index(centre)
    return [(centre, a, b) for a, b in pairwise(ring[at + 1 :] + ring[:at])]


def triangulation(
    points: Floats, triangles: Ints, cell: Ints, chain: tuple[Ints, Ints, Ints], strips: Strips | None
) -> CellTriangulation:
    """Return a triangulation with its half-edges; all triangles must be counter-clockwise."""
    a, b, c = points[triangles].swapaxes(0, 1)
    if len(flat := np.flatnonzero(orient(a, b, c) <= 0)):
        raise PrecisionError("double precision cannot hold a point in the middle of an edge", where=a[flat])
    start, end = ends_of(triangles)
    along = chain[0], chain[0][next_in_rows(chain[2])]
    twin_and_left = half_edges_from_to(
        triangles, *(np.concatenate(ends) for ends in zip((end, start), along, strict=True))
    )
    twin, left = np.split(twin_and_left, [len(start)])
    return CellTriangulation(points, triangles, twin, cell, *chain, left, strips)
