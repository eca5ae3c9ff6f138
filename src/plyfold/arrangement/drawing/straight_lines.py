"""Drawings of a triangulated disk with straight edges in which no triangle is turned over.

Tutte's [Tut63]_ is the better start when double precision can hold it: its features may shrink exponentially. The one
on a grid [CP95]_ has integer coordinates of at most twice the number of vertices, so it always exists in doubles.

References
----------
.. [Tut63] W. T. Tutte, "How to draw a graph", Proceedings of the London Mathematical Society, 1963.
.. [CP95] M. Chrobak, T. H. Payne, "A linear-time algorithm for drawing a planar graph on a grid", Information
   Processing Letters 54, 1995.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse.linalg import splu

from plyfold.arrays import Complexes, Ints
from plyfold.matrices import laplacian

__all__ = ["grid_drawing", "tutte_drawing"]

Rotation = list[dict[int, int]]


def tutte_drawing(triangles: Ints, boundary: Ints) -> Complexes:
    """Return positions with the boundary on a circle and every other vertex in the middle of its neighbours.

    Parameters
    ----------
    triangles : (m, 3) int
        Counter-clockwise triangles of a disk without double edges.
    boundary : (b,) int
        Its boundary vertices, counter-clockwise.

    Returns
    -------
    (n,) complex
        Rounding may turn tiny triangles over.

    Notes
    -----
    One sparse solve.

    Examples
    --------
    >>> fan = np.array([[0, 1, 3], [1, 2, 3], [2, 0, 3]])
    >>> bool(abs(tutte_drawing(fan, np.array([0, 1, 2]))[3]) < 1e-12)
    True
    """
    tail, head = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    forces = laplacian(tail, head, np.ones(len(tail)))
    n = forces.shape[0]
    places = np.zeros(n, dtype=np.complex128)
    places[boundary] = np.exp(2j * np.pi * np.arange(len(boundary)) / len(boundary))
    inner = np.setdiff1d(np.arange(n), boundary)
    solver = splu(forces[inner][:, inner].tocsc())
    pull = -(forces[inner][:, boundary] @ places[boundary])
    places[inner] = solver.solve(pull.real) + 1j * solver.solve(pull.imag)
    return places


def grid_drawing(triangles: Ints, boundary: Ints) -> Complexes:
    """Return a drawing with integer coordinates.

    Parameters
    ----------
    triangles : (m, 3) int
        Counter-clockwise triangles of a disk without double edges.
    boundary : (b,) int
        Its boundary vertices, counter-clockwise.

    Returns
    -------
    (n,) complex
        All triangles counter-clockwise, exactly.

    Notes
    -----
    Linear but for vertices of high degree: their neighbours are looked through once for each.

    Examples
    --------
    >>> fan = np.array([[0, 1, 3], [1, 2, 3], [2, 0, 3]])
    >>> [(int(z.real), int(z.imag)) for z in grid_drawing(fan, np.array([0, 1, 2]))]
    [(0, 0), (6, 0), (3, 2), (3, 1)]
    """
    n = int(triangles.max()) + 1
    roof = np.column_stack([np.roll(boundary, -1), boundary, np.full(len(boundary), n)])
    rotation = _rotation(np.concatenate([triangles, roof]))
    return _shift(rotation, _canonical_order(rotation, int(boundary[0]), int(boundary[1])))[:n]


def _rotation(triangles: Ints) -> Rotation:
    """Return for each vertex a dictionary from each neighbour to the next one counter-clockwise."""
    rotation: Rotation = [{} for _ in range(int(triangles.max()) + 1)]
    for a, b, c in triangles.tolist():
        rotation[a][b], rotation[b][c], rotation[c][a] = c, a, b
    return rotation


def _canonical_order(rotation: Rotation, left: int, right: int) -> list[int]:
    """Order the vertices so that each one sees a single run of earlier ones; the last one goes on top of all."""
    top = len(rotation) - 1
    placed = [vertex in (left, right) for vertex in range(len(rotation))]
    order, stack = [left, right], [rotation[left][right]]
    while stack:
        vertex = stack.pop()
        if not placed[vertex] and vertex != top and _sees_one_run(rotation[vertex], placed):
            placed[vertex] = True
            order.append(vertex)
            stack.extend(rotation[vertex])
    return [*order, top]


def _sees_one_run(around: dict[int, int], placed: list[bool]) -> bool:
    runs = sum(placed[u] and not placed[w] for u, w in around.items())
    return runs == 1 and sum(placed[u] for u in around) > 1


def _shift(rotation: Rotation, order: list[int]) -> Complexes:
    """Place the vertices in order, each above those it sees, moving what is right of it aside.

    The skyline runs from the first vertex to the second along ``right``. Abscissas are kept relative to a parent:
    the vertex before on the skyline, or the one that covered it.
    """
    left_end, right_end, *rest = order
    offset, height = [0] * len(order), [0] * len(order)
    right, under, before = {left_end: right_end}, dict[int, int](), {right_end: left_end}
    skyline = {left_end, right_end}
    for vertex in rest:
        run = _seen(rotation[vertex], skyline, before, right)
        start, end = run[0], run[-1]
        offset[run[1]] += 1
        offset[end] += 1
        width = sum(offset[w] for w in run[1:])
        offset[vertex] = (width + height[end] - height[start]) // 2
        height[vertex] = (width + height[end] + height[start]) // 2
        offset[end] = width - offset[vertex]
        if len(run) > 2:
            offset[run[1]] -= offset[vertex]
            under[vertex] = run[1]
            del right[run[-2]]
        right[start], right[vertex], before[vertex], before[end] = vertex, end, start, vertex
        skyline.difference_update(run[1:-1])
        skyline.add(vertex)
    return _absolute(left_end, offset, right, under) + 1j * np.array(height)


def _seen(around: dict[int, int], skyline: set[int], before: dict[int, int], right: dict[int, int]) -> list[int]:
    """Return the vertices of the skyline that a new one is joined to, from left to right."""
    seen = skyline.intersection(around)
    run = [next(vertex for vertex in seen if before.get(vertex) not in seen)]
    while len(run) < len(seen):
        run.append(right[run[-1]])
    return run


def _absolute(root: int, offset: list[int], right: dict[int, int], under: dict[int, int]) -> Complexes:
    """Add the offsets up, from each parent to the vertex right of it and to the first one under it."""
    abscissa = np.zeros(len(offset), dtype=np.complex128)
    stack = [root]
    while stack:
        vertex = stack.pop()
        for child in (table[vertex] for table in (right, under) if vertex in table):
            abscissa[child] = abscissa[vertex] + offset[child]
            stack.append(child)
    return abscissa
