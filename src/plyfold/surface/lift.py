"""The lifted surface: a smooth layered mesh whose outline, seen from above, is the drawing (§4 of the paper)."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, cast

import numpy as np

from plyfold.arrangement.arrangement import Arrangement, require_one_loop, watched_arrangement
from plyfold.arrays import Floats, Ints, freeze
from plyfold.certify import check_boundary, check_surface
from plyfold.clock import UNWATCHED, Clock, Progress, Watch
from plyfold.disk.unwrap import UnwoundDisk, require_one_piece, unwound_mesh
from plyfold.errors import (
    InputError,
    NotEmbeddableError,
    NotImmersibleError,
    TimeLimitError,
)
from plyfold.immersion.immersion import Immersion, require_disk
from plyfold.immersion.solve import find_immersion, watched_immersions
from plyfold.io.mesh.saving import refuse_ending, save_model
from plyfold.io.saving import Target, save_bytes
from plyfold.layering.embedding import find_embedding
from plyfold.layering.layering import Layering
from plyfold.layering.orders.intersections import IntersectingLayering, least_intersecting_layering
from plyfold.layering.orders.search import first_layering
from plyfold.mesh.cells import DEFAULT_TRIANGLES, area_of_edge, refuse_sizes
from plyfold.mesh.refine import given_outline
from plyfold.obstruction import IMMERSION_REASONS, Obstruction, Unknown
from plyfold.options import refuse_unless_flag, refuse_unless_number
from plyfold.outline.curve import Curve, Outline
from plyfold.outline.given import OutlineLike
from plyfold.surface.choose import LayeringChoice, raised_as_chosen, refuse_choice
from plyfold.surface.files import Colouring, model_of_surface, trimesh_of
from plyfold.surface.gap import gap_over
from plyfold.surface.glue import cusps_of, intersection_curves
from plyfold.surface.heights import DEFAULT_STIFFNESS, PinKey, flat_weight, refuse_stiffness
from plyfold.surface.inflate import Profile, inflate
from plyfold.surface.left import kinds_of, loops_of, may_touch
from plyfold.surface.making import Making, steps_of
from plyfold.surface.thicken import Solid, thicken
from plyfold.wording import counted

if TYPE_CHECKING:
    import trimesh

__all__ = ["Surface", "layering_of", "lift"]

# They need a file with a path.
_FILMS = (".gif", ".mp4")


@dataclass(frozen=True, eq=False)
class Surface:
    """A surface over a layering, as a triangle mesh; embedded, but for reported intersections where they are allowed.

    Parameters
    ----------
    layering : Layering or IntersectingLayering
        The order of the sheets that the surface realises.
    vertices : (n, 3) float
        Where x and y are those of the drawing; the outline's own points have the input's coordinates, bit for bit.
    faces : (m, 3) int
        Vertices of each triangle, counter-clockwise seen from above.
    sheet : (m,) int
        The sheet that each triangle belongs to.
    boundary : (b,) int
        Vertices along the outline, loop after loop, each from its first point: 0, 1, …, b − 1. Crossings and points
        added on edges are among them.
    first_boundary : (loops + 1,) int
        Loop l has the vertices from ``boundary[first_boundary[l]]`` up to ``boundary[first_boundary[l + 1]]``.
    cusps : (c,) int
        Vertices at which the surface winds round a cusp of the outline like a spiral stair.
    gap : float
        Sheets over the same point are at least this far apart, at every vertex. Near intersections the distance of
        the sheets concerned is at least half the way along them to the intersection, where that is less.
    passing : (e, 4) int
        Rows (a, b, c, d): the edges from a to b and from c to d lie over each other, and two sheets pass through each
        other along them. None but with ``lift(..., allow_intersections=True)``.
    intersections : tuple of (m, 3) float
        Polylines along which sheets pass through each other, rounded; the first point is repeated where they close.
    making : Making
        What :func:`lift` was asked for; :meth:`inflate` lifts the surface anew with it.

    Examples
    --------
    >>> ramp = lift([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)], gap=1.0)
    >>> float(ramp.vertices[:, 2].max()) >= 1.0
    True
    >>> ramp.check()
    """

    layering: Layering | IntersectingLayering
    vertices: Floats
    faces: Ints
    sheet: Ints
    boundary: Ints
    first_boundary: Ints
    cusps: Ints
    gap: float
    passing: Ints = field(default_factory=lambda: np.empty((0, 4), dtype=np.int64))
    intersections: tuple[Floats, ...] = ()
    making: Making = field(default_factory=Making)

    def __post_init__(self) -> None:
        freeze(self)

    def __repr__(self) -> str:
        triangles, sheets = counted(len(self.faces), "triangle"), counted(self.n_sheets, "sheet")
        return f"<Surface: {triangles} in {sheets}>"

    @property
    def curve(self) -> Curve:
        """The curve that the surface has as its outline, if that is one curve; InputError if it has several loops."""
        require_one_loop(self.layering.immersion.arrangement)
        return cast(Curve, self.outline)

    @property
    def outline(self) -> Outline:
        """The outline of the surface, with all its loops and cusps, on the points as they were given."""
        return given_outline(self.layering.immersion.arrangement)

    @property
    def is_disk(self) -> bool:
        """Whether the surface is a disk, and in one piece on the given points."""
        return self.layering.immersion.is_disk and len(self.first_boundary) == 2

    @property
    def n_sheets(self) -> int:
        """Number of sheets that triangles are in: all of the immersion, but over cells between points that touch."""
        return len(np.unique(self.sheet))

    @property
    def n_layers(self) -> int:
        """The highest level of a triangle's sheet: over no place lie more sheets."""
        return int(self.layering.level[self.sheet].max())

    def check(self) -> None:
        """Prove the surface right with the independent checkers of :mod:`plyfold.certify`.

        Every triangle is positive seen from above, the mesh has as many pieces, holes and handles as the layering says,
        its boundary is the outline, the angles at its vertices are those of an immersion and of the cusps, and the
        sheets over every point are in strict order. Where sheets may pass through each other, they do so only in
        triangles along the edges that :attr:`passing` names. If the outline touches itself, the boundary is the outline
        but for its necks, and parts of the surface that are beside one another may touch.

        Raises
        ------
        CertificateError
            Naming the condition and the place.

        Notes
        -----
        About a second for 100,000 triangles.
        """
        gap = 0.0 if len(self.passing) else self.gap
        loops, cusps = loops_of(self)
        mesh, kinds = (self.vertices, self.faces, self.boundary), kinds_of(self)
        if touching := may_touch(self):
            check_boundary(self.outline.loops, loops)
        check_surface(loops, *mesh, gap, passing=self.passing, cusps=cusps, pieces=kinds, touching=touching)

    def unwrap(self) -> UnwoundDisk:
        """Spread the cloth out as a round disk: one-to-one, the boundary by arc length, no triangle flipped.

        Only a surface that is a disk can be.

        Returns
        -------
        UnwoundDisk
            With this surface's vertices and triangles; computed once. It has texture coordinates, ``uv``, and maps
            points of the disk to the drawing and to the surface.

        Raises
        ------
        InputError
            If the surface is no disk, or in pieces on the given points, as the outline touches itself.
        PrecisionError
            If double precision cannot hold the disk; it names the place.
        """
        return self._unwound

    @cached_property
    def _unwound(self) -> UnwoundDisk:
        immersion = require_disk(self.layering.immersion)
        require_one_piece(self.vertices[:, :2], self.first_boundary)
        return unwound_mesh(immersion, self.vertices, self.faces, self.sheet, self.boundary)

    def thicken(self, thickness: float, min_wall: float | None = None) -> Solid:
        """Return a solid with this surface in its middle, as thick as given in vertical direction: to be printed.

        Parameters
        ----------
        thickness : float
            In units of the drawing; less than :attr:`gap` where sheets overlap.
        min_wall : float, optional
            The thickness is vertical, so where the surface is steep its walls are thinner. Make it thicker there, until
            ``solid.wall`` is at least this.

        Returns
        -------
        Solid
            With ``export`` and ``check``.

        Raises
        ------
        InputError
            If the thickness is not positive or not less than the gap, or the surface passes through itself.
        WallError
            If sheets over each other leave no room for such walls; it names the places.
        PrecisionError
            If the thickness, or what is left of the gap, is lost in rounding.
        """
        return thicken(self, thickness, min_wall)

    def inflate(
        self,
        height: float | None = None,
        profile: Profile = "round",
        *,
        time_limit: float | None = None,
        progress: Progress | None = None,
    ) -> Solid:
        """Return a round body in place of this surface: thick in the middle, and thin at the outline, where it ends.

        Seen from above, its outline is the drawing, bit for bit. The surface is lifted anew, with its layering, gap and
        options, and with room: over every point of the drawing bodies are the gap apart, and none is made thinner.

        Parameters
        ----------
        height : float, optional
            Its largest thickness, measured vertically, half of it above and half below; by default half of what would
            make the widest part a round tube.
        profile : {"round", "flat"} or callable
            ``"round"``: the thickness is in proportion to the square root of the cloth's torsion function, so the
            cross-section of a strip is an ellipse, and wider parts are thicker. ``"flat"``: a plateau of this height
            with a round rim, half a circle as far as there is room for one. Or a function from numbers that rise from 0
            at the outline to 1 in the thickest place, as ``"round"`` has them, to shares of the height, more than 0 and
            at most 1: ``lambda bulge: bulge**2`` makes parabolas.
        time_limit : float, optional
            Seconds for all of it; none by default.
        progress : callable, optional
            See :func:`lift`; there is a stage "blowing up" moreover.

        Returns
        -------
        Solid
            With the middle surface, ``solid.surface``; its own mesh has some vertices more. Cost: that of lifting, and
            of one sparse system.

        Raises
        ------
        InputError
            If the height is not positive, the profile unknown or out of range, the surface passes through itself, or
            pins leave no room.
        PrecisionError
            If double precision cannot hold the body; it names the place.
        TimeLimitError
            If the time limit was reached.

        Notes
        -----
        The thickness is vertical, so where the body is steep it is thinner across.

        Examples
        --------
        >>> pillow = lift([(0, 0), (4, 0), (4, 4), (0, 4)], triangles=200).inflate(1.0)
        >>> pillow.height, bool((pillow.thickness[pillow.surface.boundary] == 0).all())
        (1.0, True)
        >>> pillow.check()
        """
        return inflate(self, height, profile, Watch(Clock(time_limit), progress))

    def export(  # noqa: PLR0913 - options of formats
        self,
        path: Target,
        force: bool = False,
        title: str | None = None,
        *,
        colours: Colouring = "layers",
        unwrapped: bool | None = None,
        ending: str | None = None,
    ) -> None:
        """Write the surface to a file.

        Parameters
        ----------
        path : path or binary file
            The ending chooses the format: ``.glb``, ``.obj``, ``.ply``, ``.stl``, ``.3mf``, or ``.html`` for a 3D page
            that works in any browser with no network; or ``.gif``, or ``.mp4`` where ffmpeg is installed, for a film of
            the round disk that unwinds onto the drawing and rises to the surface.
        force : bool, optional
            Replace an existing file.
        title : str, optional
            Heading of the page; the file's name by default.
        colours : {"layers", "sheets"}
            In a GLB, PLY or 3MF, a colour for each layer, in smooth transition, or a material for each sheet, named
            like ``sheet_3_level_2``. With ``"sheets"``, an OBJ gets its materials in an ``.mtl`` file beside it.
        unwrapped : bool, optional
            In a GLB, OBJ or PLY, texture coordinates from :meth:`unwrap`; in a GLB, moreover, the surface flat on the
            table and unwound to a disk, as morph targets ``flat`` and ``disk`` and an animation. By default, if the
            surface is a disk and double precision can hold it unwound.
        ending : str, optional
            Chooses the format, as an open file has no ending of its own. An OBJ in one names no materials, and films
            go into files with paths only.

        Raises
        ------
        InputError
            If the ending is none of these.
        FileExistsError
            If the file exists and ``force`` is not set.
        PrecisionError
            If the numbers of the format cannot hold the surface, or doubles cannot hold the disk that is asked for.
        """
        named = isinstance(path, str | os.PathLike)
        suffix = refuse_ending(path, (".html", *_FILMS) if named else (".html",), ending)
        if suffix == ".html":
            save_bytes(path, self._page(title or (Path(str(path)).stem if named else "plyfold")), force)
        elif suffix in _FILMS:
            from plyfold.draw.film import save_film

            save_film(self, str(path), force)
        else:
            save_model(lambda: model_of_surface(self, colours, unwrapped), path, force, ending)

    def to_trimesh(self, colours: Colouring = "layers") -> trimesh.Trimesh:
        """Return the surface as a mesh of trimesh_, which must be installed, vertex for vertex and face for face.

        Parameters
        ----------
        colours : {"layers", "sheets"}
            A colour at each vertex, of its layers, or of each triangle, of its sheet.

        Returns
        -------
        trimesh.Trimesh
            ``face_attributes["sheet"]`` has the sheet of each triangle.

        .. _trimesh: https://trimesh.org

        Examples
        --------
        >>> mesh = lift([(0, 0), (4, 0), (0, 3)], max_area=10.0).to_trimesh()
        >>> mesh.faces.tolist(), float(mesh.area)
        ([[0, 1, 2]], 6.0)
        """
        return trimesh_of(model_of_surface(self, colours, unwrapped=False))

    def show(self) -> None:
        """Open the 3D page in the browser, from a temporary file that stays until the system cleans up."""
        import tempfile
        import webbrowser

        with tempfile.NamedTemporaryFile("wb", prefix="plyfold-", suffix=".html", delete=False) as file:
            file.write(self._page("plyfold"))
        webbrowser.open(Path(file.name).as_uri())

    def _page(self, title: str) -> bytes:
        from plyfold.draw.viewer import page

        return page(self, title=title).encode()

    def _repr_html_(self) -> str:
        from plyfold.draw.viewer import frame

        return str(frame(self, "plyfold"))


def lift(  # noqa: PLR0913 - each option is keyword-only and independent
    curve: OutlineLike | Immersion | Layering | IntersectingLayering,
    *,
    choose: LayeringChoice = "low",
    allow_intersections: bool = False,
    gap: float | None = None,
    triangles: int = DEFAULT_TRIANGLES,
    max_area: float | None = None,
    size: float | None = None,
    stiffness: float = DEFAULT_STIFFNESS,
    pins: Mapping[PinKey, float] | None = None,
    flat: bool | float = False,
    time_limit: float | None = None,
    progress: Progress | None = None,
) -> Surface:
    """Lift an outline to a layered surface that does not cut itself: the whole way (§2 to §4 of [MGR11]_).

    Parameters
    ----------
    curve : Curve, (n, 2) array_like, shapely geometry, Arrangement, Immersion, Layering or IntersectingLayering
        Of a curve that bounds a disk the first immersion that can be layered is lifted; of any other outline, such as
        an :class:`~plyfold.Outline` or a list of curves, an embedding. Pieces that do not hang together keep the gap
        too, where they lie over each other, and lie on the table where not. Round a cusp the surface is a spiral stair.
    choose : {"low", "first", "nicest"}
        Which layering of the immersion is lifted, unless one is given. ``"low"``: one whose heights range little, never
        more than those of the other two where they are known soon; ``"first"``: that of :func:`~plyfold.find_layering`
        or :func:`~plyfold.find_embedding`; ``"nicest"``: that of :func:`~plyfold.nicest_layering`. The surface's
        ``layering`` is the one that was taken.
    allow_intersections : bool, optional
        If no immersion can be layered, lift the one that does with the shortest self-intersections, as far as is known
        (``surface.layering.optimal``), and report them.
    gap : float, optional
        Least distance of sheets over the same point, in units of the drawing; by default, 1/20 of its larger side or
        1/5 of the cloth's mean width, whichever is less. The mean width is twice the area by the length of the outline.
    triangles : int, optional
        Roughly how many triangles to make; curves with many points or crossings have more.
    max_area : float, optional
        Largest area of a triangle seen from above, instead of ``triangles``.
    size : float, optional
        Usual length of the edges, in units of the drawing, instead of ``triangles`` or ``max_area``.
    stiffness : float, optional
        The length below which the cloth resists bending more than sloping, as a fraction of its mean width: stiffer
        cloth swings out further, softer cloth creases where sheets touch.
    pins : mapping, optional
        Heights that are given, in units of the drawing: ``{sheet: z}`` holds a whole sheet level, ``{(x, y): z}`` a
        point where a single sheet lies, and ``{(x, y, sheet): z}`` one of several sheets. Without pins the lowest
        vertex has the height 0, also that of pieces which lie over no other.
    flat : bool or float, optional
        Keep those parts level that nothing overlaps: they are so many times as stiff (at least 1), or 100 times if
        true. The way up and down is made where sheets overlap, as far as it can be.
    time_limit : float, optional
        Seconds for all of it; none by default. What ends it is given back within a second, even where a library's
        routine is still to come to its end. With ``allow_intersections``, half of the time is for the search.
    progress : callable, optional
        Called with the name of the stage and the fraction of it done: "finding the crossings", "finding an immersion",
        "layering immersion 1" or "layering the sheets", "looking for short intersections", "triangulating the cells",
        "choosing the layering", "gluing the sheets", "smoothing heights".

    Returns
    -------
    Surface

    Raises
    ------
    NotImmersibleError
        If the outline bounds no immersed surface; ``error.obstruction`` says why.
    NotEmbeddableError
        If none of its immersions can be layered; ``error.obstruction`` belongs to the first. Not with
        ``allow_intersections``.
    TimeLimitError
        If the time limit was reached: the answer is unknown. ``error.stage`` is the stage that was going on.
    PrecisionError
        If double precision cannot hold the mesh; it names the place. What is returned passes :meth:`Surface.check`:
        its parts that rounding can break have been checked.
    InputError
        If an option is of the wrong kind, ``gap`` or a size is not positive, or the triangles would be more than ten
        million; if pins name no place of the surface, or leave less room than the gap somewhere; with
        ``allow_intersections``, if sheets change places on the way round a ring.

    References
    ----------
    .. [MGR11] U. Mukherjee, M. Gopi, J. Rossignac, "Immersion and Embedding of Self-Crossing Loops",
       Sketch-Based Interfaces and Modeling, 2011.

    Examples
    --------
    >>> flat = lift([(0, 0), (4, 0), (0, 3)], max_area=10.0)
    >>> flat.vertices.tolist(), flat.faces.tolist()
    ([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]], [[0, 1, 2]])
    """
    _refuse_wrong_kinds(allow_intersections, stiffness, pins, flat)
    refuse_choice(choose)
    watch = Watch(Clock(time_limit), progress)
    layering = layering_of(curve, allow_intersections, watch)
    drawn = layering.immersion.arrangement
    distance = gap_over(drawn, gap)
    max_area = area_of_edge(size, max_area)
    refuse_sizes(given_outline(drawn).points, triangles, max_area)
    refuse_stiffness(stiffness)
    making = Making(triangles, max_area, stiffness, dict(pins or {}), flat_weight(flat))
    steps = steps_of(layering, making, watch)
    choice: LayeringChoice = "first" if layering is curve else choose
    made = raised_as_chosen(layering, choice, steps, distance, making, watch=watch)
    mesh = made.mesh
    return Surface(
        layering=made.layering,
        vertices=made.vertices,
        faces=mesh.faces,
        sheet=mesh.sheet,
        boundary=mesh.boundary,
        first_boundary=mesh.first_boundary,
        cusps=mesh.cusps,
        gap=distance,
        passing=mesh.passing,
        intersections=intersection_curves(made.vertices, mesh),
        making=making,
    )


def _refuse_wrong_kinds(allow_intersections: object, stiffness: object, pins: object, flat: object) -> None:
    """Refuse options of the wrong kind before any work; those of sizes are refused where these are."""
    refuse_unless_flag("allow_intersections", allow_intersections)
    refuse_unless_number("stiffness", stiffness)
    if not isinstance(flat, bool):
        refuse_unless_number("flat", flat)
    if pins is not None and not isinstance(pins, Mapping):
        raise InputError(f"pins must be a mapping from sheets or points to heights, not {pins!r}")


def layering_of(
    curve: OutlineLike | Immersion | Layering | IntersectingLayering,
    allow_intersections: bool,
    watch: Watch = UNWATCHED,
) -> Layering | IntersectingLayering:
    """Return the first layering that :func:`lift` could lift, with its options and errors."""
    if isinstance(curve, Layering | IntersectingLayering):
        return curve
    choose = _least_intersecting if allow_intersections else _liftable
    if isinstance(curve, Obstruction):
        raise _refusal(curve)
    if isinstance(curve, Immersion):
        return choose([curve], watch)
    drawn = watched_arrangement(curve, "perturb", watch)
    if not allow_intersections and not _is_plain(drawn):
        return _embedding(drawn, watch)
    candidates = watched_immersions(drawn, watch)
    first = next(candidates, None)
    if first is None:
        raise NotImmersibleError(cast(Obstruction, find_immersion(drawn)))
    return choose(chain([first], candidates), watch)


def _is_plain(drawn: Arrangement) -> bool:
    """Tell whether an outline is one curve without cusps that may bound a disk: its immersions are soon found."""
    return drawn.n_loops == 1 == drawn.turning_number and not len(cusps_of(drawn))


def _embedding(drawn: Arrangement, watch: Watch) -> Layering:
    """Return an embedding of any outline, found without its immersions."""
    watch.begin("layering the sheets")
    found = find_embedding(drawn, watch.clock.left)
    if isinstance(found, Layering):
        return found
    if isinstance(found, Unknown):
        raise TimeLimitError(found.sentence, stage="layering the sheets")
    raise _refusal(found)


def _refusal(obstruction: Obstruction) -> NotImmersibleError | NotEmbeddableError:
    return (NotImmersibleError if obstruction.reason in IMMERSION_REASONS else NotEmbeddableError)(obstruction)


def _liftable(candidates: Iterable[Immersion], watch: Watch) -> Layering:
    found, examined = first_layering(candidates, watch.clock.left, watch.progress)
    if isinstance(found, Layering):
        return found
    raise NotEmbeddableError(found, hint=f"{examined} immersion(s) were examined")


def _least_intersecting(candidates: Iterable[Immersion], watch: Watch) -> Layering | IntersectingLayering:
    """Return a layering of the first immersion that has one, or else the best of those examined in time."""
    clock = watch.clock.share(1 / 2)
    examined: list[Immersion] = []
    try:
        return _liftable(_noted(candidates, examined), replace(watch, clock=clock.share(1 / 2)))
    except (NotEmbeddableError, TimeLimitError):
        watch.begin("looking for short intersections")
    best = least_intersecting_layering(examined[0], clock.left)
    for immersion in examined[1:]:
        if not clock.over:
            best = min(best, least_intersecting_layering(immersion, clock.left), key=lambda found: found.total_length)
    return best


def _noted(candidates: Iterable[Immersion], examined: list[Immersion]) -> Iterator[Immersion]:
    for immersion in candidates:
        examined.append(immersion)
        yield immersion
