"""The layered surface seen from straight above: pieces of cloth from back to front, and the outline where it is seen.

Sheets lie over one cell each, and their levels count from below. So drawing level by level puts everything that is
above something else after it, also where no order of larger pieces would: where three strips lie over one another in a
circle.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby
from typing import Literal, TypeAlias, get_args

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Bools, Floats, Ints
from plyfold.colours import CLOTH_HIGH, PAPER, layer_colour, mix, sheet_colour
from plyfold.draw.casing_gaps import cut_strands, strand_with_gaps
from plyfold.draw.placement import Frame, border_line, cusps_drawn, drawn_points, line_weight, mark_weight
from plyfold.errors import InputError
from plyfold.graphs import components
from plyfold.layering.layering import Layering
from plyfold.mesh.strips import cells_left

__all__ = [
    "DASHES",
    "HIDDEN_OPACITY",
    "HIDDEN_WIDTH",
    "ClothColours",
    "ClothPiece",
    "Hidden",
    "OverUnder",
    "Strand",
    "over_under",
]

ClothColours: TypeAlias = Literal["cloth", "layers", "sheets"]
Hidden: TypeAlias = Literal["removed", "dashed"]

# The width of lines, as a fraction of the larger side, and of gaps from the middle of the strand above, in widths.
_STROKE = 0.005
_GAP = 2.0
_CUSP = 0.015

# How hidden strands are drawn: dashes on and off, in widths of lines, and how much thinner and paler they are.
DASHES = (2.2, 1.8)
HIDDEN_WIDTH, HIDDEN_OPACITY = 0.7, 0.6


@dataclass(frozen=True, eq=False)
class ClothPiece:
    """A connected piece of cloth on one level.

    Parameters
    ----------
    level : int
        From 1 at the bottom.
    sheets : tuple of int
    rings : tuple of (m, 2) float
        Closed polygons around it, to be filled by the even-odd rule. They may touch in crossings.
    colour : str
        ``"#rrggbb"``.
    """

    level: int
    sheets: tuple[int, ...]
    rings: tuple[Floats, ...]
    colour: str

    @property
    def name(self) -> str:
        """A name for people, like ``sheets 2, 5``."""
        return f"sheet{'s' if len(self.sheets) > 1 else ''} {', '.join(map(str, self.sheets))}"


@dataclass(frozen=True, eq=False)
class Strand:
    """A part of the outline, as long as can be, that is seen or hidden: a polyline, which may be closed."""

    points: Floats
    hidden: bool
    closed: bool


@dataclass(frozen=True, eq=False)
class OverUnder:
    """A layered drawing; its middle is the origin, its larger side 1, and y points up.

    Parameters
    ----------
    pieces : tuple of ClothPiece
        From back to front.
    strands : tuple of Strand
        Before all pieces; hidden ones first.
    cusps : (c, 2) float
        The places of cusps.
    cusp_indices : tuple of int
    half : (2,) float
        Half the width and half the height.
    stroke : float
        How wide lines should be.
    cusp_radius : float
        How large the signs of cusps should be.
    """

    pieces: tuple[ClothPiece, ...]
    strands: tuple[Strand, ...]
    cusps: Floats
    cusp_indices: tuple[int, ...]
    half: Floats
    stroke: float
    cusp_radius: float

    @property
    def layers(self) -> tuple[tuple[ClothPiece, ...], ...]:
        """The pieces of each level, from below."""
        return tuple(tuple(pieces) for _, pieces in groupby(self.pieces, key=lambda piece: piece.level))


def over_under(layering: Layering, *, colours: ClothColours = "cloth", hidden: Hidden = "removed") -> OverUnder:
    """Return what is seen of a layered surface from above.

    Parameters
    ----------
    layering : Layering
        Of a drawing.
    colours : {"cloth", "layers", "sheets"}
        One colour for all, or one for each layer, or for each sheet. Where sheets need not be told apart, those of one
        level that are glued together are one piece.
    hidden : {"removed", "dashed"}
        Leave out the strands that are covered, or return them too.

    Returns
    -------
    OverUnder
        Strands end a little before the strand that they pass under, or at a cusp, where the outline goes on under the
        surface. Cost: O(Σ w) and the number of points along the
        borders.

    Raises
    ------
    InputError
        If it is no layering, or an option is unknown.

    Examples
    --------
    >>> from plyfold import find_immersion, find_layering
    >>> ramp = find_immersion([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)])
    >>> seen = over_under(find_layering(ramp))
    >>> [piece.level for piece in seen.pieces], [strand.closed for strand in seen.strands]
    ([1, 1, 2], [False, False])
    """
    _refuse_options(layering, colours, hidden)
    arrangement = layering.immersion.arrangement
    points = drawn_points(arrangement)
    frame, stroke = Frame(points), _STROKE * line_weight(arrangement.n_crossings)
    cusps, indices = cusps_drawn(arrangement)
    strands = sorted(_strands(layering, frame, _GAP * stroke), key=lambda strand: not strand.hidden)
    return OverUnder(
        pieces=tuple(_pieces(layering, frame, colours)),
        strands=tuple(strand for strand in strands if hidden == "dashed" or not strand.hidden),
        cusps=frame(cusps),
        cusp_indices=tuple(indices),
        half=np.abs(frame(points)).max(axis=0),
        stroke=stroke,
        cusp_radius=_CUSP * mark_weight(arrangement.n_crossings),
    )


def _refuse_options(layering: Layering, colours: str, hidden: str) -> None:
    if not isinstance(layering, Layering):
        raise InputError(
            f"a {type(layering).__name__} has no over and under everywhere", hint="find_layering(immersion) finds them"
        )
    for value, known in ((colours, get_args(ClothColours)), (hidden, get_args(Hidden))):
        if value not in known:
            raise InputError(f"there is no option {value!r} for this drawing", hint=f"use one of {', '.join(known)}")


# ---- pieces --------------------------------------------------------------------------------------------------------


def _pieces(layering: Layering, frame: Frame, colours: ClothColours) -> Iterator[ClothPiece]:
    """Yield the pieces, from the lowest level on."""
    arrangement, cell = layering.immersion.arrangement, layering.immersion.sheet_cell
    part = np.arange(len(layering.level)) if colours == "sheets" else _glued_on_one_level(layering)
    there = cells_left(arrangement)[cell]
    levels = int(layering.level[there].max())
    for level in range(1, levels + 1):
        here = np.flatnonzero((layering.level == level) & there)
        owner = np.full(arrangement.n_cells, -1)
        owner[cell[here]] = part[here]
        sheets: dict[int, list[int]] = {}
        rings: dict[int, list[Floats]] = {}
        for sheet in here.tolist():
            sheets.setdefault(int(part[sheet]), []).append(sheet)
        for piece, ring in _rings(arrangement, owner):
            rings.setdefault(piece, []).append(frame(ring))
        for piece, members in sheets.items():
            colour = _colour(colours, members[0], level, levels)
            yield ClothPiece(level, tuple(members), tuple(rings[piece]), colour)


def _colour(colours: ClothColours, sheet: int, level: int, levels: int) -> str:
    if colours == "cloth":
        return mix(CLOTH_HIGH, PAPER, 0.45)
    return layer_colour(level, levels) if colours == "layers" else sheet_colour(sheet)


def _glued_on_one_level(layering: Layering) -> Ints:
    """Return a number for each sheet, the same for those that are connected by gluings within their level."""
    _, right, left = layering.immersion.gluing.T
    same = layering.level[right] == layering.level[left]
    return components(len(layering.level), right[same], left[same])


def _rings(arrangement: Arrangement, owner: Ints) -> Iterator[tuple[int, Floats]]:
    """Yield the polygons around the unions of cells with the same owner, each with the owner; −1 is none."""
    left, right = owner[arrangement.cell_of_dart.reshape(-1, 2).T]
    around = np.stack([(left >= 0) & (left != right), (right >= 0) & (left != right)], axis=1).ravel()
    waiting = dict.fromkeys(np.flatnonzero(around).tolist())
    while waiting:
        ring = [next(iter(waiting))]
        while ring[-1] in waiting:
            del waiting[ring[-1]]
            ring.append(_following(arrangement, around, ring[-1]))
        points = np.concatenate([_dart_points(arrangement, dart) for dart in ring[:-1]])
        yield int(owner[arrangement.cell_of_dart[ring[0]]]), points


def _following(arrangement: Arrangement, around: Bools, dart: int) -> int:
    """Return the next dart around a union of cells: past those inside it, turning about the crossing."""
    dart = int(arrangement.next_dart[dart])
    while not around[dart]:
        dart = int(arrangement.next_dart[dart ^ 1])
    return dart


def _dart_points(arrangement: Arrangement, dart: int) -> Floats:
    points = border_line(arrangement, dart // 2)
    return points[:0:-1] if dart % 2 else points[:-1]


# ---- strands -------------------------------------------------------------------------------------------------------


def _strands(layering: Layering, frame: Frame, gap: float) -> Iterator[Strand]:
    """Yield the outline in parts that are seen or hidden as a whole.

    A border is hidden where a sheet lies over its own sheet. Beyond the border, that sheet goes on.
    """
    arrangement = layering.immersion.arrangement
    hidden = layering.border_level < arrangement.winding[arrangement.left_cell]
    changes = np.zeros(len(hidden), dtype=bool)
    changes[arrangement.next_border] = hidden != hidden[arrangement.next_border]
    for borders, is_loop in cut_strands(arrangement, changes):
        covered = bool(hidden[borders[0]])
        points = strand_with_gaps(arrangement, borders, frame, 0.0 if covered or is_loop else gap)
        yield Strand(points[:-1] if is_loop else points, covered, is_loop)
