"""Regions of a noded outline as polygons: faces with the same label put together, and only their boundaries walked."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import numpy.typing as npt
import shapely

from plyfold.arrangement.noding import Noding, node_rounded
from plyfold.arrangement.polylines import signed_areas
from plyfold.arrays import Bools, Floats, Ints
from plyfold.errors import PrecisionError
from plyfold.flat.rays import windings_round
from plyfold.graphs import components
from plyfold.outline.direction import sense
from plyfold.ragged import previous_in_rows

if TYPE_CHECKING:
    from shapely import Polygon

__all__ = ["Region", "refuse_invalid", "regions"]

# A loop with less area than this share of its squared length may have lost all of it when its nodes were rounded.
_THIN = 1e-9
FINEST_GRID = 2.0**-50
"""Of the largest coordinate: half a step must be a double, too."""
_GRIDS = (FINEST_GRID, 2.0**-46, 2.0**-40, 2.0**-32)


class Region(NamedTuple):
    """A connected region of faces with one label."""

    polygon: Polygon
    label: int


def regions(noding: Noding, label_of: Callable[[Ints], Ints]) -> list[Region]:
    """Return the connected regions of faces that have the same label, but for label 0.

    Parameters
    ----------
    noding : Noding
    label_of : callable
        Returns the label of each of some winding numbers, 0 for winding number 0.

    Returns
    -------
    list of Region
        Faces hang together along parts, and not at nodes. Polygons are valid; one that touches itself at a node has a
        hole that touches its outline there. What has no area left when its crossings are rounded is left out. Crossings
        on a straight side are left out if nothing else of the boundary is there.

        Where rounding the crossings makes strands cross that did not, the regions are those of the rounded strands; and
        if that had no end, all nodes are put on a grid of :data:`FINEST_GRID` of the largest coordinate, or the finest
        one beyond it that will do.

    Raises
    ------
    PrecisionError
        If there is no such grid; never seen so far.
    """
    size = np.ldexp(1.0, int(np.frexp(np.abs(noding.points).max(initial=0.0))[1]))
    attempts: list[Callable[[], list[Region]]] = [
        lambda: _regions(noding, label_of),
        lambda: _regions(node_rounded(noding), label_of),
        *(partial(_regions_on_grid, noding, label_of, size * grid) for grid in _GRIDS),
    ]
    for attempt in attempts:
        with suppress(PrecisionError, shapely.errors.GEOSException):
            return attempt()
    raise PrecisionError(
        "strands are so crowded that no rounding of their crossings keeps polygons apart",
        where=noding.points[~noding.is_vertex][:5],
        hint="move the strands apart there",
    )


def _regions_on_grid(noding: Noding, label_of: Callable[[Ints], Ints], grid: float) -> list[Region]:
    """Return the regions with all nodes on a grid: strands that pass near a node are led through it."""
    start, end = noding.points[noding.ends].swapaxes(0, 1)
    on_grid = np.rint(np.stack([start, end], axis=1) / grid) * grid
    strands = shapely.union_all(shapely.linestrings(on_grid), grid_size=grid)
    faces = np.array(shapely.polygonize([strands]).geoms, dtype=object)
    places = shapely.get_coordinates(shapely.point_on_surface(faces))
    label = label_of(windings_round(places, start, end, noding.times)[0])
    found = [
        Region(polygon, one)
        for one in np.unique(label[label != 0]).tolist()
        for polygon in shapely.get_parts(shapely.union_all(faces[label == one], grid_size=grid)).tolist()
    ]
    refuse_invalid(np.array([region.polygon for region in found], dtype=object))
    return [Region(shapely.orient_polygons(polygon), one) for polygon, one in found]


def _regions(noding: Noding, label_of: Callable[[Ints], Ints]) -> list[Region]:
    label = label_of(noding.winding)
    boundary, following = _boundary(noding, label[noding.face])
    loops = list(_simple_loops(boundary, following, _starts(noding)))
    if not loops:
        return []
    start = np.cumsum([0, *map(len, loops)])
    half_edges = np.concatenate(loops)
    left = noding.face[half_edges[start[:-1]]]
    region = np.unique(_regions_of_faces(noding, label)[left], return_inverse=True)[1]
    is_hole = ~_run_counter_clockwise(noding, half_edges, start)
    polygons = _polygons(_rings(noding, half_edges, start, boundary), region, is_hole)
    # Each region has one loop that is no hole.
    shell = np.flatnonzero(~is_hole)[np.argsort(region[~is_hole])]
    kept = ~shapely.is_missing(polygons)
    polygons, labels = polygons[kept], label[left[shell[kept]]]
    # Regions with one label share no sides: if they are valid together, they are valid and do not overlap.
    for one in np.unique(labels).tolist():
        refuse_invalid(np.array([shapely.MultiPolygon(list(polygons[labels == one]))], dtype=object))
    return list(map(Region, polygons, labels.tolist()))


def _starts(noding: Noding) -> Ints:
    """Return the node at which each half-edge starts."""
    return noding.ends.ravel()


def _boundary(noding: Noding, left: Ints) -> tuple[Ints, Ints]:
    """Return the half-edges between different labels that have one on their left, and the one after each of them."""
    other = np.arange(len(left)) ^ 1
    is_boundary = (left != left[other]) & (left != 0)
    boundary = np.flatnonzero(is_boundary)
    following = noding.following[boundary]
    while (inner := ~is_boundary[following]).any():
        following[inner] = noding.following[other[following[inner]]]
    return boundary, following


def _simple_loops(boundary: Ints, following: Ints, start: Ints) -> Iterator[list[int]]:
    """Yield closed walks of half-edges along the boundary, split whenever they come back to a node."""
    after = dict(zip(boundary.tolist(), following.tolist(), strict=True))
    node = dict(zip(after, start[boundary].tolist(), strict=True))
    for start_of_walk in boundary.tolist():
        path: list[int] = []
        place: dict[int, int] = {}
        half_edge = start_of_walk
        while half_edge in after:
            path.append(half_edge)
            place[node[half_edge]] = len(path) - 1
            half_edge = after.pop(half_edge)
            if (first := place.get(node[half_edge])) is not None:
                loop = path[first:]
                yield loop
                del path[first:]
                for passed in loop:
                    del place[node[passed]]


def _regions_of_faces(noding: Noding, label: Ints) -> Ints:
    """Return the region of each face."""
    one, other = noding.face.reshape(-1, 2).T
    same = label[one] == label[other]
    return components(len(label), one[same], other[same])


def _run_counter_clockwise(noding: Noding, half_edges: Ints, start: Ints) -> Bools:
    """Tell which simple loops do: those that leave their leftmost node below the way they come. Exact."""
    loop = np.repeat(np.arange(len(start) - 1), np.diff(start))
    leftmost = np.lexsort([_starts(noding)[half_edges], loop])[start[:-1]]
    line = noding.line[half_edges // 2]
    return np.asarray(line[leftmost] < line[previous_in_rows(start)[leftmost]])


def _rings(noding: Noding, half_edges: Ints, start: Ints, boundary: Ints) -> npt.NDArray[np.object_]:
    """Return the ring of each loop, None for those that have no area once their nodes are rounded."""
    node, line = _starts(noding)[half_edges], noding.line[half_edges // 2]
    loop = np.repeat(np.arange(len(start) - 1), np.diff(start))
    passes = np.bincount(_starts(noding)[boundary], minlength=len(noding.points))
    is_corner = noding.is_vertex[node] | (line != line[previous_in_rows(start)]) | (passes[node] > 1)
    loop, corners = loop[is_corner], noding.points[node[is_corner]]
    fresh = (corners != corners[previous_in_rows(_starts_of_rows(loop))]).any(axis=1)
    loop, corners = loop[fresh], corners[fresh]
    rings = np.full(len(start) - 1, None, dtype=object)
    enough = np.bincount(loop, minlength=len(rings))[loop] >= 3
    loop, corners = loop[enough], corners[enough]
    wide = _with_area(corners, _starts_of_rows(loop))[np.unique(loop, return_inverse=True)[1]]
    loop, corners = loop[wide], corners[wide]
    kept, row = np.unique(loop, return_inverse=True)
    rings[kept] = shapely.linearrings(corners, indices=row)
    return rings


def _starts_of_rows(row: Ints) -> Ints:
    """Return where each row starts, and where the last one ends, given the row of each entry."""
    return np.concatenate([np.unique(row, return_index=True)[1], [len(row)]])


def _with_area(corners: Floats, start: Ints) -> Bools:
    """Tell which rings have an area that is not 0. Exact."""
    if len(corners) == 0:
        return np.empty(0, dtype=bool)
    first = np.repeat(corners[start[:-1]], np.diff(start), axis=0)
    reach = np.maximum.reduceat(np.abs(corners - first).max(axis=1), start[:-1])
    wide = np.abs(signed_areas(corners, start)) >= _THIN * reach * reach
    for ring in np.flatnonzero(~wide).tolist():
        wide[ring] = sense(corners[start[ring] : start[ring + 1]]) != 0
    return np.asarray(wide)


def _polygons(rings: npt.NDArray[np.object_], region: Ints, is_hole: Bools) -> npt.NDArray[np.object_]:
    """Return the polygon of each region from its one shell and its holes, None where the shell has no area."""
    polygons = np.full(int(region.max()) + 1, None, dtype=object)
    shells = np.flatnonzero(~is_hole & ~shapely.is_missing(rings))
    polygons[region[shells]] = shapely.polygons(rings[shells])
    holes = np.flatnonzero(is_hole & ~shapely.is_missing(rings))
    holes = holes[np.argsort(region[holes], kind="stable")]
    for group in np.split(holes, np.flatnonzero(np.diff(region[holes])) + 1):
        if len(group) and (shell := polygons[region[group[0]]]) is not None:
            polygons[region[group[0]]] = shapely.Polygon(shell.exterior, rings[group])
    return polygons


def refuse_invalid(polygons: npt.NDArray[np.object_], corner: Floats | None = None) -> None:
    """Raise PrecisionError if a polygon is not valid, or missing; then its place is the given corner."""
    bad = np.flatnonzero(~shapely.is_valid(polygons))
    if len(bad) == 0:
        return
    # The library divides by differences that may be 0.
    with np.errstate(all="ignore"):
        reasons = " ".join(filter(None, shapely.is_valid_reason(polygons[bad])))
    places = [(float(x), float(y)) for x, y in re.findall(r"\[(\S+) (\S+)\]", reasons)]
    raise PrecisionError(
        "strands are so close that rounding their crossings to double precision spoils a polygon there",
        where=places or ([] if corner is None else corner[bad]),
        hint="move the strands apart there",
    )
