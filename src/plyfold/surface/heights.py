"""Heights that look like cloth: as smooth as can be, with the sheets apart.

The height z minimises a bending and a membrane energy over the glued disk,

    E(z) = ½ ∫ ℓ² (Δz)² + |∇z|²,

while sheets above each other keep a distance: z_upper − z_lower ≥ gap over every point of the drawing. Bending alone
would let far ends droop, and a membrane alone would crease where the sheets part. Only derivatives of z occur, since
anything that pulls z towards a plane makes spikes where sheets cross.

The distance is kept by forces at the places of contact, or, where these are thousands, by springs; both are in
:mod:`plyfold.surface.contact`. Both keep a distance that is a millionth of the gap too large,
to within that millionth; so no other heights have less energy but for two millionths, and what remains to be done in
the end is the work of rounding errors. The forces prove it each time: they bound the energy from below.

Where two sheets pass through each other, their distance may shrink to nothing: near there it is half the way along the
sheets to that place, if this is less than the gap.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

import numpy as np

from plyfold.arrays import Bools, Floats, Ints
from plyfold.clock import UNWATCHED, Watch
from plyfold.errors import InputError, PrecisionError
from plyfold.surface.answers import Answers
from plyfold.surface.contact import Balance, Distances, Problem, forced_heights, sprung_heights
from plyfold.surface.energy import Cloth, cloth_of
from plyfold.surface.glue import LiftedMesh, shares_of_gap
from plyfold.surface.grading import ClothMesh, cloth_mesh

__all__ = [
    "DEFAULT_STIFFNESS",
    "PinKey",
    "Pins",
    "Room",
    "SpreadCloth",
    "distances_apart",
    "flat_weight",
    "highest_below",
    "pins_of",
    "refuse_stiffness",
    "room_between",
    "rows_upward",
    "smooth_heights",
    "spread_cloth",
]


# ℓ, below which bending rules and above which the membrane does, as a fraction of the mean width of the cloth. Were it
# wider than a ribbon, the ribbon would rather climb many times the gap than bend in its width where sheets touch.
DEFAULT_STIFFNESS = 0.5
# Of the gap: distances are asked for so much larger, and kept to within so much.
_TOLERANCE = 1e-6
# The same as a fraction of pinned heights, whose rounding errors may be larger.
_RELATIVE = 1e-11
_SOFTEST, _STIFFEST = 1e-3, 1e3
_FLAT, _FLATTEST = 100.0, 1e6
_HIGHEST_PIN = 1000.0
# Vertices between pins that have less room than this part of the gap are held too.
_NO_ROOM = 1e-3
# Of the energy: heights that may have so much more than the least are an error.
_LARGEST_EXCESS = 1e-3
# Where the springs leave more of a gap, the pins contradict each other.
_LARGEST_REST = 1e-3


def smooth_heights(  # noqa: PLR0913 - each option is keyword-only and independent
    points: Floats,
    mesh: LiftedMesh,
    gap: float,
    *,
    thickness: Floats | None = None,
    stiffness: float = DEFAULT_STIFFNESS,
    pins: Mapping[PinKey, float] | None = None,
    flat: float = 1.0,
    spread: SpreadCloth | None = None,
    watch: Watch = UNWATCHED,
) -> Floats:
    """Return smooth heights that keep stacked vertices apart.

    Parameters
    ----------
    points : (p, 2) float
        The points of the planar triangulation.
    mesh : LiftedMesh
        The glued disk.
    gap : float
        Least distance of two sheets over the same point, in units of the drawing.
    thickness : (v,) float, optional
        How thick a body is to be round each vertex, half of it above and half of it below: bodies over the same point
        are the gap apart.
    stiffness : float
        The length below which bending rules, as a fraction of the mean width of the cloth.
    pins : mapping, optional
        Heights of sheets and points, see :func:`plyfold.surface.lift`.
    flat : float
        How many times as stiff the cloth is where nothing overlaps.
    spread : SpreadCloth, optional
        That of the same mesh, stiffness and weight, with the sheets in whatever order, if it is there already and
        nothing is pinned.
    watch : Watch, optional

    Returns
    -------
    (v,) float
        Heights of the mesh's vertices, the lowest 0 unless there are pins, also of pieces that lie over no other; all 0
        if no two sheets overlap and nothing is pinned. For each row
        (lower, upper) of ``mesh.stacked``, ``z[lower] + gap <= z[upper]`` holds exactly, or
        with a share of the gap near intersections; with bodies, the gap and half of both thicknesses, see
        :func:`distances_apart`.

    Raises
    ------
    InputError
        If the pins leave less room than the gap; it names the place.
    PrecisionError
        If the gap is less than rounding errors of heights, or if these leave it open whether other heights have a
        thousandth less energy; it names the place.

    Notes
    -----
    10 to 25 ms for 4,000 triangles, 0.1 to 0.2 s for 40,000, 8 to 20 s for a million, most where sheets touch along
    whole curves or in hundreds of places; with pinned sheets up to twice as long.
    """
    watch = watch.begin("smoothing heights")
    given = pins_of(pins or {}, points, mesh, _HIGHEST_PIN * float(np.ptp(points, axis=0).max()))
    if len(mesh.stacked) == 0 and not pins:
        return np.zeros(len(mesh.planar_vertex))
    distance = distances_apart(mesh, gap * shares_of_gap(points, mesh, gap), thickness)
    room = room_between(given, points, mesh, distance)
    held, fixed = _without_room(given, room, gap)
    fine = cloth_mesh(points, mesh, stiffness) if spread is None else spread.fine
    cloth = cloth_of(fine, mesh, stiffness, flat, watch) if spread is None else spread.cloth
    # With the largest distance, mostly the gap, as the unit of height, the numbers are of the order of 1.
    unit = max(gap, float(distance.max(initial=0.0)))
    tolerance = max(_TOLERANCE, _RELATIVE * float(np.abs([*fixed, *given.heights]).max()) / unit)
    wanted = _distances(mesh, distance / unit + tolerance, given, held, unit)
    problem = _on_finer_mesh(fine, Problem(cloth, wanted, held, fixed / unit, tolerance))
    # Where next to no room is left, vertices are held: then answers are others.
    answers = None if spread is None or held.any() else spread.answers
    found = forced_heights(problem, watch, answers) or sprung_heights(problem, watch)
    z = found.heights[: len(held)]
    if pins and np.max(missing := wanted.missing(z), initial=0.0) > _LARGEST_REST:
        place = points[mesh.planar_vertex[wanted.rows[[int(np.argmax(missing))]].indices[:1]]]
        raise InputError("the pins leave less room than the gap", where=place, hint="move the pinned heights apart")
    settled = _settled(unit * z, mesh, given, held, fixed)
    heights = _kept_apart(settled, mesh, distance, held)
    _require_order(heights, points, mesh)
    moved = fine.continued((heights - settled) / unit)
    _require_least(found.heights + moved, found, problem, points[mesh.planar_vertex])
    return heights


@dataclass(frozen=True, eq=False)
class SpreadCloth:
    """The cloth of a surface in one piece without pins: the same in whatever order its sheets lie.

    Parameters
    ----------
    fine : ClothMesh
    cloth : Cloth
    answers : Answers
    """

    fine: ClothMesh
    cloth: Cloth
    answers: Answers


def spread_cloth(
    points: Floats, mesh: LiftedMesh, stiffness: float, flat: float, watch: Watch = UNWATCHED
) -> SpreadCloth:
    """Return what :func:`smooth_heights` needs of a surface in one piece, for one order of its sheets after another."""
    fine = cloth_mesh(points, mesh, stiffness)
    cloth = cloth_of(fine, mesh, stiffness, flat, watch)
    return SpreadCloth(fine, cloth, Answers(cloth, np.zeros(len(fine.places), dtype=bool), watch))


def distances_apart(mesh: LiftedMesh, gap: float | Floats, thickness: Floats | None) -> Floats:
    """Return the least distance of each pair of stacked vertices, shape (c,): the gap, and half of both thicknesses."""
    lower, upper = mesh.stacked.T
    halves = 0.0 if thickness is None else (thickness[lower] + thickness[upper]) / 2
    return np.asarray(gap + halves + np.zeros(len(lower)))


def _on_finer_mesh(fine: ClothMesh, problem: Problem) -> Problem:
    """Return a problem for the vertices of the surface as one for those of a finer mesh, which may have more."""
    if not fine.added:
        return problem
    rows = problem.wanted.rows.copy()
    rows.resize(rows.shape[0], rows.shape[1] + fine.added)
    if not problem.held.any():
        none = np.zeros(len(fine.places), dtype=bool)
        return replace(problem, wanted=replace(problem.wanted, rows=rows), held=none, given=none.astype(np.float64))
    # In the middle between held vertices, vertices are held.
    held = fine.continued(problem.held.astype(np.float64)) == 1
    given = np.where(held, fine.continued(problem.given), 0.0)
    return replace(problem, wanted=replace(problem.wanted, rows=rows), held=held, given=given)


def _require_order(heights: Floats, points: Floats, mesh: LiftedMesh) -> None:
    """Raise PrecisionError where a gap is lost in rounding."""
    lower, upper = mesh.stacked.T
    if len(equal := np.flatnonzero(~(heights[lower] < heights[upper]))):
        raise PrecisionError(
            "the gap of sheets is lost in rounding their heights",
            where=points[mesh.planar_vertex[lower[equal[:1]]]],
            hint="make the gap larger, or the pinned heights smaller",
        )


def _require_least(z: Floats, found: Balance, problem: Problem, places: Floats) -> None:
    """Raise PrecisionError where forces do not prove that these heights have next to no more energy than needed."""
    energy = problem.cloth.energy(z)
    above = energy - found.least_energy(problem)
    if not above <= _LARGEST_EXCESS * max(energy, problem.tolerance):
        raise PrecisionError(
            f"the heights of least energy were not found: these may have {above / energy:.1%} more than needed",
            where=places[[int(np.argmax(np.abs(z - found.heights)[: len(places)]))]],
            hint="ask for other triangles, or for softer cloth",
        )


def refuse_stiffness(stiffness: float) -> None:
    """Raise InputError for a stiffness that is no number in reason."""
    if not _SOFTEST <= stiffness <= _STIFFEST:
        raise InputError(f"the stiffness must be from {_SOFTEST:g} to {_STIFFEST:g}, not {stiffness!r}")


def flat_weight(flat: bool | float) -> float:
    """Return how many times as stiff cloth is where nothing overlaps; InputError for a weight not in reason.

    Examples
    --------
    >>> flat_weight(False), flat_weight(True), flat_weight(20)
    (1.0, 100.0, 20.0)
    """
    if isinstance(flat, bool):
        return _FLAT if flat else 1.0
    if not 1 <= flat <= _FLATTEST:
        raise InputError(f"how flat parts are must be true, false or from 1 to {_FLATTEST:g}, not {flat!r}")
    return float(flat)


def _without_room(pins: Pins, room: Room, gap: float) -> tuple[Bools, Floats]:
    """Return the vertices whose heights are given, and the heights; also those with next to no room between pins."""
    held = pins.held | (room.highest - room.lowest <= gap * _NO_ROOM)
    return held, np.where(held, room.lowest, 0.0)


def _distances(mesh: LiftedMesh, least: Floats, pins: Pins, held: Bools, gap: float) -> Distances:
    """Return the pinned points and the stacked vertices as rows; those between held vertices need no row."""
    from scipy.sparse import csr_array, vstack

    stacked = np.flatnonzero(~held[mesh.stacked].all(axis=1))
    lower, upper = mesh.stacked[stacked].T
    n, c = len(mesh.level), len(stacked)
    signs, ends = np.tile([-1.0, 1.0], c), np.column_stack([lower, upper]).ravel()
    difference = csr_array((signs, ends, 2 * np.arange(c + 1)), shape=(c, n))
    pinned, heights = pins.rows(mesh), pins.heights / gap
    if len(heights) and not held.any():
        # The free constant follows from the first of them.
        first = csr_array(np.ones((len(heights) - 1, 1))) @ pinned[:1] if len(heights) > 1 else pinned[1:]
        pinned, heights = pinned[1:] - first, heights[1:] - heights[0]
    exact = len(heights)
    row = np.full(n, -1)
    row[lower] = exact + np.arange(c)
    sides = np.concatenate([row[mesh.faces[:, [0, 1]]], row[mesh.faces[:, [1, 2]]], row[mesh.faces[:, [2, 0]]]])
    beside = sides[(sides >= 0).all(axis=1)]
    rows = vstack([pinned, difference], format="csr") if exact else difference
    return Distances(rows, np.concatenate([heights, least[stacked]]), exact, beside)


def _settled(z: Floats, mesh: LiftedMesh, pins: Pins, held: Bools, fixed: Floats) -> Floats:
    """Return the heights with the free constant chosen, and given heights as they were given."""
    if held.any():
        return np.where(held, fixed, z)
    if len(pins.heights):
        return np.asarray(z + (pins.heights[0] - (pins.rows(mesh) @ z)[0]))
    lowest = np.full(int(mesh.heap.max()) + 1, np.inf)
    np.minimum.at(lowest, mesh.heap, z)
    return np.asarray(z - lowest[mesh.heap])


def _kept_apart(z: Floats, mesh: LiftedMesh, distance: Floats, held: Bools) -> Floats:
    """Return the heights with the same distances once more, now as floating point has them."""
    apart = z.copy()
    for rows in rows_upward(mesh):
        lower, upper = mesh.stacked[rows].T
        np.maximum.at(apart, upper, np.where(held[upper], -np.inf, apart[lower] + distance[rows]))
    if held.any():
        for rows in reversed(list(rows_upward(mesh))):
            lower, upper = mesh.stacked[rows].T
            below = highest_below(apart[upper], distance[rows])
            np.minimum.at(apart, lower, np.where(held[lower], np.inf, below))
    return apart


def highest_below(upper: Floats, distance: Floats) -> Floats:
    """Return the largest numbers that, with the distance added in floating point, are not above others.

    Examples
    --------
    >>> lower = highest_below(np.array([0.3]), np.array([0.1]))
    >>> bool(lower[0] + 0.1 <= 0.3), bool(np.nextafter(lower[0], 1) + 0.1 <= 0.3)
    (True, False)
    """
    lower = np.nextafter(np.nextafter(upper - distance, np.inf), np.inf)
    while (high := lower + distance > upper).any():
        lower = np.where(high, np.nextafter(lower, -np.inf), lower)
    return lower


# ---- pins ------------------------------------------------------------------------------------------------------------

# A sheet; a point (x, y); or a point and a sheet, (x, y, sheet).
PinKey: TypeAlias = int | tuple[float, float] | tuple[float, float, int]

# How far outside of a triangle a point may be, in barycentric coordinates, and how far off a height, in gaps.
_ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class Pins:
    """Heights that are given, in units of the drawing.

    Parameters
    ----------
    held : (v,) bool
        The vertices of pinned sheets.
    height : (v,) float
        Their heights; 0 for all others.
    faces : (p,) int
        The triangles that pinned points lie in.
    weights : (p, 3) float
        Of their corners.
    heights : (p,) float
        Of the pinned points.
    """

    held: Bools
    height: Floats
    faces: Ints
    weights: Floats
    heights: Floats

    def rows(self, mesh: LiftedMesh) -> Any:
        """Return the matrix that takes heights of vertices to those of the pinned points; (p, v) sparse."""
        from scipy.sparse import csr_array

        start = 3 * np.arange(len(self.faces) + 1)
        content = (self.weights.ravel(), mesh.faces[self.faces].ravel(), start)
        return csr_array(content, shape=(len(self.faces), len(mesh.level)))


def pins_of(pins: Mapping[PinKey, float], points: Floats, mesh: LiftedMesh, highest: float) -> Pins:
    """Find the vertices and triangles that pins name.

    Parameters
    ----------
    pins : mapping
        From sheets, points (x, y) or points and sheets (x, y, sheet) to heights.
    points : (p, 2) float
        The points of the planar triangulation.
    mesh : LiftedMesh
    highest : float
        Heights beyond this, up or down, are refused.

    Returns
    -------
    Pins

    Raises
    ------
    InputError
        If a pin names no sheet or place of the surface, or if pins contradict each other.
    """
    values = {key: _height(key, value, highest) for key, value in pins.items()}
    places = [(_place(key, points, mesh), value) for key, value in values.items() if isinstance(key, tuple)]
    held, height = _held_sheets({k: v for k, v in values.items() if not isinstance(k, tuple)}, points, mesh)
    faces = np.array([face for (face, _), _ in places], dtype=np.int64)
    weights = np.array([shares for (_, shares), _ in places]).reshape(-1, 3)
    found = Pins(held, height, faces, weights, np.array([value for _, value in places], dtype=np.float64))
    _refuse_dependent(found, points, mesh)
    return found


def _height(key: PinKey, value: float, highest: float) -> float:
    if not isinstance(value, int | float | np.number) or not abs(value) <= highest:
        raise InputError(f"the height of the pin {key} must be a number of at most {highest:g}, not {value!r}")
    return float(value)


def _held_sheets(heights: Mapping[int, float], points: Floats, mesh: LiftedMesh) -> tuple[Bools, Floats]:
    """Return the vertices of pinned sheets, and their heights."""
    held, height = np.zeros(len(mesh.level), dtype=bool), np.zeros(len(mesh.level))
    sheets = int(mesh.sheet.max()) + 1
    for sheet, value in heights.items():
        if not isinstance(sheet, int | np.integer) or not 0 <= sheet < sheets:
            raise InputError(f"there is no sheet {sheet!r} to pin", hint=f"sheets are numbered from 0 to {sheets - 1}")
        members = np.unique(mesh.faces[mesh.sheet == sheet])
        if len(clash := members[held[members] & (height[members] != value)]):
            raise InputError(
                f"sheet {sheet} is pinned at {value:g}, and a sheet that it meets at {height[clash[0]]:g}",
                where=points[mesh.planar_vertex[clash[:1]]],
                hint="pin sheets that meet at the same height",
            )
        held[members], height[members] = True, value
    return held, height


def _place(key: tuple[float, ...], points: Floats, mesh: LiftedMesh) -> tuple[int, Floats]:
    """Return the triangle that a point lies in, and its barycentric coordinates there."""
    real = all(isinstance(part, int | float | np.number) for part in key)
    if len(key) not in (2, 3) or not real or not np.isfinite(np.array(key[:2], dtype=float)).all():
        raise InputError(f"a pin is a sheet, a point (x, y) or a point and a sheet (x, y, sheet), not {key!r}")
    where = np.array(key[:2], dtype=np.float64)
    candidates = np.arange(len(mesh.faces)) if len(key) == 2 else np.flatnonzero(mesh.sheet == key[2])
    weights = _barycentric(points[mesh.planar_vertex[mesh.faces[candidates]]], where)
    inside = weights.min(axis=1) >= -_ROUNDING
    sheets = np.unique(mesh.sheet[candidates[inside]])
    if len(sheets) != 1:
        there = "no sheet lies" if len(sheets) == 0 else f"sheets {', '.join(map(str, sheets.tolist()))} lie"
        hint = "name one of them: (x, y, sheet)" if len(sheets) else "pin a point inside of the sheet"
        raise InputError(f"a pin names no place of the surface: {there} over the point", where=[where], hint=hint)
    best = int(np.argmax(weights.min(axis=1)))
    shares = weights[best].clip(0, 1)
    return int(candidates[best]), shares / shares.sum()


def _barycentric(corners: Floats, where: Floats) -> Floats:
    opposite = np.stack([_area(corners[:, (i + 1) % 3], corners[:, (i + 2) % 3], where) for i in range(3)], axis=1)
    whole = _area(corners[:, 0], corners[:, 1], corners[:, 2])
    return np.asarray(opposite / np.maximum(whole, np.finfo(float).tiny)[:, None])


def _area(a: Floats, b: Floats, c: Floats) -> Floats:
    u, v = b - a, c - a
    return np.asarray(u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0])


def _refuse_dependent(pins: Pins, points: Floats, mesh: LiftedMesh) -> None:
    """Raise InputError for points that are pinned twice, or lie on pinned sheets."""
    rows = pins.rows(mesh)
    for number, face in enumerate(pins.faces):
        free = rows[: number + 1].toarray() * ~pins.held
        if np.linalg.matrix_rank(free, tol=_ROUNDING) <= number:
            where = pins.weights[number] @ points[mesh.planar_vertex[mesh.faces[face]]]
            raise InputError("the height at a pinned point is given by other pins already", where=[where])


@dataclass(frozen=True, eq=False)
class Room:
    """How low and high each vertex can be, between what is pinned below and above it.

    Parameters
    ----------
    lowest, highest : (v,) float
        Infinite where nothing is pinned below or above.
    """

    lowest: Floats
    highest: Floats


def room_between(pins: Pins, points: Floats, mesh: LiftedMesh, distance: Floats) -> Room:
    """Return the room that pins leave.

    Parameters
    ----------
    pins : Pins
    points : (p, 2) float
    mesh : LiftedMesh
    distance : (c,) float
        Least distance of each row of ``mesh.stacked``.

    Raises
    ------
    InputError
        If there is none somewhere: pinned sheets would be closer than their distance.
    """
    lowest, highest = np.where(pins.held, pins.height, -np.inf), np.where(pins.held, pins.height, np.inf)
    for rows in rows_upward(mesh):
        lower, upper = mesh.stacked[rows].T
        np.maximum.at(lowest, upper, lowest[lower] + distance[rows])
    for rows in reversed(list(rows_upward(mesh))):
        lower, upper = mesh.stacked[rows].T
        np.minimum.at(highest, lower, highest[upper] - distance[rows])
    over = np.where(pins.held, lowest - pins.height, -np.inf)
    if (over > 0).any():
        worst = int(np.argmax(over))
        _refuse_meeting_itself(worst, pins, points, mesh)
        raise _too_close(points[mesh.planar_vertex[worst]], lowest[worst], pins.height[worst])
    _refuse_points_without_room(pins, points, mesh, Room(lowest, highest), distance)
    return Room(lowest, highest)


def _refuse_points_without_room(pins: Pins, points: Floats, mesh: LiftedMesh, room: Room, distance: Floats) -> None:
    slack = _ROUNDING * distance.max(initial=0.0)
    for face, weight, height in zip(pins.faces, pins.weights, pins.heights, strict=True):
        corners = mesh.faces[face]
        used = weight > 0
        low, high = (float(weight[used] @ bound[corners][used]) for bound in (room.lowest, room.highest))
        if not low - slack <= height <= high + slack:
            bound = low if height < low else high
            raise _too_close(weight @ points[mesh.planar_vertex[corners]], bound, float(height))


def _refuse_meeting_itself(worst: int, pins: Pins, points: Floats, mesh: LiftedMesh) -> None:
    """Raise InputError if all that is pinned over a vertex's point belongs to a single sheet."""
    there = np.flatnonzero((mesh.planar_vertex == mesh.planar_vertex[worst]) & pins.held)
    loose = set(mesh.sheet[~pins.held[mesh.faces].all(axis=1)].tolist())
    sheets = [set(mesh.sheet[(mesh.faces == vertex).any(axis=1)].tolist()) - loose for vertex in there]
    if set.intersection(*sheets):
        raise InputError(
            "a pinned sheet comes to lie over itself at a crossing, so it cannot be level",
            where=points[mesh.planar_vertex[[worst]]],
            hint="pin a point of it: (x, y, sheet)",
        )


def _too_close(where: Floats, bound: float, height: float) -> InputError:
    side = "lower" if height < bound else "higher"
    return InputError(
        f"pins are closer than the gap: a sheet pinned at {height:g} may be no {side} than {bound:g} there",
        where=[where],
        hint="move the pinned heights apart, or choose a smaller gap",
    )


def rows_upward(mesh: LiftedMesh) -> Iterator[Ints]:
    """Yield the rows of stacked vertices, by the level of the lower one."""
    level = mesh.level[mesh.stacked[:, 0]]
    return (np.flatnonzero(level == number) for number in range(mesh.level.max()))
