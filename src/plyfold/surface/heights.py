"""Heights that look like cloth: as smooth as can be, with the sheets apart.

The height z minimises a bending and a membrane energy over the glued disk,

    E(z) = ½ ∫ ℓ² (Δz)² + |∇z|²,

while sheets above each other keep a distance: z_upper − z_lower ≥ gap over every point of the drawing. Bending alone
would let far ends droop, and a membrane alone would crease where the sheets part. Only derivatives of z occur, since
anything that pulls z towards a plane makes spikes where sheets cross.

The distance is kept by forces at the places of contact (:mod:`plyfold.surface.contact`), or, where these are
thousands, by springs (:mod:`plyfold.surface.springs`). Both keep a distance that is a millionth of the gap too large,
to within that millionth; so no other heights have less energy but for two millionths, and what remains to be done in
the end is the work of rounding errors.

Where two sheets pass through each other, their distance may shrink to nothing: near there it is half the way along the
sheets to that place, if this is less than the gap.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from plyfold.arrays import Bools, Floats
from plyfold.clock import UNWATCHED, Watch
from plyfold.errors import InputError, PrecisionError
from plyfold.surface.contact import Distances, Problem, forced_heights
from plyfold.surface.energy import cloth_of
from plyfold.surface.glue import LiftedMesh
from plyfold.surface.passages import shares_of_gap
from plyfold.surface.pins import PinKey, Pins, Room, pins_of, room_between, rows_upward
from plyfold.surface.springs import sprung_heights

__all__ = ["DEFAULT_STIFFNESS", "flat_weight", "refuse_stiffness", "smooth_heights"]

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
# Where the springs leave more of a gap, the pins contradict each other.
_LARGEST_REST = 1e-3


def smooth_heights(  # noqa: PLR0913 - each option is keyword-only and independent
    points: Floats,
    mesh: LiftedMesh,
    gap: float,
    *,
    stiffness: float = DEFAULT_STIFFNESS,
    pins: Mapping[PinKey, float] | None = None,
    flat: float = 1.0,
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
    stiffness : float
        The length below which bending rules, as a fraction of the mean width of the cloth.
    pins : mapping, optional
        Heights of sheets and points, see :func:`plyfold.surface.lift`.
    flat : float
        How many times as stiff the cloth is where nothing overlaps.
    watch : Watch, optional

    Returns
    -------
    (v,) float
        Heights of the mesh's vertices, the lowest 0 unless there are pins; all 0 if no two sheets overlap and nothing
        is pinned. For each row (lower, upper) of ``mesh.stacked``, ``z[lower] + gap <= z[upper]`` holds exactly, or
        with a share of the gap near intersections.

    Raises
    ------
    InputError
        If the pins leave less room than the gap; it names the place.
    PrecisionError
        If the gap is less than rounding errors of heights; it names the place.

    Notes
    -----
    10 to 25 ms for 4,000 triangles, 0.1 to 0.2 s for 40,000, 8 to 20 s for a million, most where sheets touch along
    whole curves or in hundreds of places; with pinned sheets up to twice as long.
    """
    watch = watch.begin("smoothing heights")
    given = pins_of(pins or {}, points, mesh, _HIGHEST_PIN * float(np.ptp(points, axis=0).max()))
    if len(mesh.stacked) == 0 and not pins:
        return np.zeros(len(mesh.planar_vertex))
    shares = shares_of_gap(points, mesh, gap)
    room = room_between(given, points, mesh, gap * shares)
    held, fixed = _without_room(given, room, gap)
    cloth = cloth_of(points, mesh, stiffness, flat, watch)
    # With the gap as the unit of height, the numbers are of the order of 1.
    tolerance = max(_TOLERANCE, _RELATIVE * float(np.abs([*fixed, *given.heights]).max()) / gap)
    wanted = _distances(mesh, shares + tolerance, given, held, gap)
    problem = Problem(cloth, wanted, held, fixed / gap, tolerance)
    z = forced_heights(problem, watch)
    if z is None:
        z = sprung_heights(problem, watch)
    if pins and np.max(missing := wanted.missing(z), initial=0.0) > _LARGEST_REST:
        place = points[mesh.planar_vertex[wanted.rows[[int(np.argmax(missing))]].indices[:1]]]
        raise InputError("the pins leave less room than the gap", where=place, hint="move the pinned heights apart")
    heights = _kept_apart(_settled(gap * z, mesh, given, held, fixed), mesh, gap * shares, held)
    _require_order(heights, points, mesh)
    return heights


def _require_order(heights: Floats, points: Floats, mesh: LiftedMesh) -> None:
    """Raise PrecisionError where a gap is lost in rounding."""
    lower, upper = mesh.stacked.T
    if len(equal := np.flatnonzero(~(heights[lower] < heights[upper]))):
        raise PrecisionError(
            "the gap of sheets is lost in rounding their heights",
            where=points[mesh.planar_vertex[lower[equal[:1]]]],
            hint="make the gap larger, or the pinned heights smaller",
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
    return np.asarray(z - z.min())


def _kept_apart(z: Floats, mesh: LiftedMesh, distance: Floats, held: Bools) -> Floats:
    """Return the heights with the same distances once more, now as floating point has them."""
    apart = z.copy()
    for rows in rows_upward(mesh):
        lower, upper = mesh.stacked[rows].T
        np.maximum.at(apart, upper, np.where(held[upper], -np.inf, apart[lower] + distance[rows]))
    if held.any():
        for rows in reversed(list(rows_upward(mesh))):
            lower, upper = mesh.stacked[rows].T
            below = _highest_below(apart[upper], distance[rows])
            np.minimum.at(apart, lower, np.where(held[lower], np.inf, below))
    return apart


def _highest_below(upper: Floats, distance: Floats) -> Floats:
    """Return the largest numbers that, with the distance added in floating point, are not above others.

    Examples
    --------
    >>> lower = _highest_below(np.array([0.3]), np.array([0.1]))
    >>> bool(lower[0] + 0.1 <= 0.3), bool(np.nextafter(lower[0], 1) + 0.1 <= 0.3)
    (True, False)
    """
    lower = np.nextafter(np.nextafter(upper - distance, np.inf), np.inf)
    while (high := lower + distance > upper).any():
        lower = np.where(high, np.nextafter(lower, -np.inf), lower)
    return lower
