"""The method in pictures: the tree over the cells, Blank's word with its brackets, and the levels round a crossing."""

from __future__ import annotations

from itertools import islice, pairwise
from typing import TYPE_CHECKING

import numpy as np
import shapely

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrangement.arrangement import arrange as arrangement_of
from plyfold.arrays import Floats
from plyfold.colours import ACCENT, INK, PAPER, mix, sheet_colour, winding_colour
from plyfold.draw.canvas import blank, dots, line, note_below, polygon, region, write
from plyfold.draw.placement import (
    Frame,
    border_line,
    border_middle,
    cell_rings,
    closed,
    drawn_loops,
    drawn_points,
    label_circle,
    line_weight,
    outer_ring_first,
)
from plyfold.errors import InputError
from plyfold.graphs import shortest_path
from plyfold.immersion.blank_word import BlankWord, blank_word
from plyfold.immersion.dual_tree import grow_tree
from plyfold.options import refuse_unless_count

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from plyfold.layering.layering import Layering
    from plyfold.outline.given import OutlineLike

__all__ = ["plot_dual_tree", "plot_levels", "plot_word"]

# How far an arrow leads out of the drawing, which has size 1.
_OUT = 0.06
# How high a bracket is above its letters, as a part of its length, and what each row needs besides.
_SLOPE = 0.28
_ROW = 1.6
# How much of the room between two borders the sheets of a cell take.
_SHARE = 0.62


# ---- the tree over the cells -----------------------------------------------------------------------------------------


def plot_dual_tree(curve: OutlineLike, ax: Axes | None = None) -> Axes:
    """Draw the cells as lakes, and over them the tree that leads from each of them to the outside.

    Where the way goes down to a lower winding number it is thin and dark; where it goes up, and there is something to
    choose, it is thick and coloured. Of one curve, the cells where such a way begins have the names of the letters of
    :func:`~plyfold.blank_word`.

    Parameters
    ----------
    curve : Outline, Curve, array_like of shape (n, 2), shapely geometry or Arrangement; or a list of curves
    ax : matplotlib Axes, optional
        Where to draw; by default on a new figure.

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    PlyfoldError
        If there is no drawing.

    Examples
    --------
    >>> from plyfold.gallery import CURVES
    >>> ax = plot_dual_tree(CURVES["milnor"].curve)
    >>> sorted(text.get_text() for text in ax.texts)
    ['a', 'b']
    """
    arrangement = arrangement_of(curve)
    axes, frame = blank(ax), Frame(drawn_points(arrangement))
    for cell in range(1, arrangement.n_cells):
        region(axes, cell_rings(arrangement, cell, frame), winding_colour(int(arrangement.winding[cell])))
    weight = line_weight(arrangement.n_crossings)
    for loop in drawn_loops(arrangement):
        line(axes, closed(frame(loop)), mix(INK, PAPER, 0.35), 1.2 * weight)
    _draw_links(axes, arrangement, frame, weight)
    for cell, name in _names_of_cells(arrangement).items():
        x, y, _ = label_circle(arrangement, cell)
        dots(axes, frame((x, y)), PAPER, 150 * weight, edgecolors=ACCENT, linewidths=1.5 * weight, zorder=4)
        write(axes, frame((x, y))[0], name, 9.0 * weight)
    return axes


def _draw_links(axes: Axes, arrangement: Arrangement, frame: Frame, weight: float) -> None:
    parent, link = grow_tree(arrangement)
    for cell in range(1, arrangement.n_cells):
        above, border = int(parent[cell]), int(link[cell])
        ascends = arrangement.winding[above] > arrangement.winding[cell]
        place, (dx, dy) = border_middle(border_line(arrangement, border))
        inner = _way_inside(arrangement, cell, place)
        outward = np.array([-dy, dx]) if ascends else np.array([dy, -dx])
        outer = _way_inside(arrangement, above, place) if above else place + _OUT * frame.size * outward[None]
        colour, width = (ACCENT, 3.2) if ascends else (INK, 1.3)
        way = frame(np.concatenate([inner, outer[::-1]]))
        line(axes, way, colour, width * weight, zorder=3, solid_capstyle="round")
        _arrowhead(axes, frame(place)[0], outward, colour, weight)
        dots(axes, way[:1], INK, 12 * weight, zorder=3.5)


def _arrowhead(axes: Axes, place: Floats, direction: Floats, colour: str, weight: float) -> None:
    corners = weight * np.array([(0.022, 0), (-0.008, 0.014), (-0.008, -0.014)])
    polygon(axes, place + corners @ np.array([direction, (-direction[1], direction[0])]), colour, zorder=3.2)


def _way_inside(arrangement: Arrangement, cell: int, place: Floats) -> Floats:
    """Return a polyline from the middle of a bounded cell to a place on its boundary that does not leave the cell."""
    rings = outer_ring_first(arrangement, cell)
    middle = np.array(label_circle(arrangement, cell, rings=rings)[:2])
    inside = shapely.make_valid(shapely.Polygon(rings[0], rings[1:]))
    triangles = shapely.get_parts(shapely.constrained_delaunay_triangles(inside))
    start, end = (int(shapely.distance(triangles, shapely.Point(point)).argmin()) for point in (middle, place))
    path = shortest_path(len(triangles), _adjacent(triangles), start, end)
    doors = [_middle_of_side(triangles[one], triangles[other]) for one, other in pairwise(path)]
    return _shortened(np.array([middle, *doors, place]), inside)


def _shortened(way: Floats, inside: shapely.Geometry) -> Floats:
    """Leave out points of a way where it can go straight on inside; its last point is on the boundary."""
    kept = [way[0]]
    while len(way) > 1:
        ahead = [i for i in range(1, len(way)) if inside.contains(shapely.LineString([way[0], _just_before(way, i)]))]
        way = way[max(ahead, default=1) :]
        kept.append(way[0])
    return np.array(kept)


def _just_before(way: Floats, ahead: int) -> Floats:
    return np.asarray(way[0] + 0.999 * (way[ahead] - way[0]))


def _adjacent(triangles: np.ndarray) -> np.ndarray:
    """Return the pairs of triangles that have a side in common."""
    sides: dict[frozenset[tuple[float, ...]], list[int]] = {}
    for number, triangle in enumerate(triangles):
        for side in pairwise(map(tuple, triangle.exterior.coords)):
            sides.setdefault(frozenset(side), []).append(number)
    return np.array([pair for pair in sides.values() if len(pair) == 2]).reshape(-1, 2)


def _middle_of_side(one: shapely.Polygon, other: shapely.Polygon) -> Floats:
    common = set(one.exterior.coords) & set(other.exterior.coords)
    return np.asarray(np.mean(sorted(common), axis=0))


def _names_of_cells(arrangement: Arrangement) -> dict[int, str]:
    """Return the letters of the cells from which a way up begins, of one curve without cusps."""
    if arrangement.n_loops > 1 or arrangement.cusp_index.any():
        return {}
    word = blank_word(arrangement)
    starts = zip(word.word.cells.tolist(), word.word.minus.tolist(), strict=True)
    return {cell: word.letters[minus].label for cell, minus in starts}


# ---- Blank's word ----------------------------------------------------------------------------------------------------


def plot_word(word: BlankWord, ax: Axes | None = None, *, most: int = 4) -> Axes:
    """Draw Blank's word on the unrolled curve, once for each of its groupings, with brackets over joined letters.

    A bracket stands for a chord of the disk, which is cut there into two disks; letters that stay free are pale. Below
    each letter is its border. The curve is closed: behind the last letter comes the first one.

    Parameters
    ----------
    word : BlankWord
    ax : matplotlib Axes, optional
        Where to draw; by default on a new figure.
    most : int, optional
        How many groupings to draw; if there are more, a note says so.

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    InputError
        If ``most`` is no number of groupings.

    Examples
    --------
    >>> from plyfold import blank_word
    >>> from plyfold.gallery import CURVES
    >>> ax = plot_word(blank_word(CURVES["milnor"].curve))
    >>> len(ax.patches)
    4
    """
    refuse_unless_count("most", most)
    groupings = list(islice(word.groupings(), most + 1))
    rows = groupings[:most] or [()]
    axes = blank(ax, (max(0.55 * len(word), 3.0), 1.3 * len(rows) + 0.4))
    height = _ROW + _SLOPE * len(word)
    for number, grouping in enumerate(rows):
        _word_row(axes, word, grouping, -height * number)
    if not len(word):
        note_below(axes, "The word is empty: nothing to choose.")
    elif not groupings:
        note_below(axes, "No grouping: the curve bounds no disk.")
    elif len(groupings) > most:
        note_below(axes, f"{most} of more groupings")
    return axes


def _word_row(axes: Axes, word: BlankWord, grouping: tuple[tuple[int, int], ...], low: float) -> None:
    joined = {place for pair in grouping for place in pair}
    ends = np.array([(-0.8, low), (len(word) - 0.2, low)])
    line(axes, ends, mix(INK, PAPER, 0.4), 1.2)
    for place, letter in enumerate(word.letters):
        colour = ACCENT if letter.sign < 0 else INK
        write(axes, (place, low + 0.32), str(letter), 11, color=colour if place in joined else mix(colour, PAPER, 0.5))
        write(axes, (place, low - 0.32), str(letter.border), 7, color=mix(INK, PAPER, 0.35))
    half = np.linspace(0, np.pi, 40)
    bow = np.column_stack([-np.cos(half) / 2, _SLOPE * np.sin(half)])
    for left, right in map(sorted, grouping):
        arch = bow * (right - left) + np.array([(left + right) / 2, low + 0.62])
        region(
            axes,
            [arch],
            mix(ACCENT, PAPER, 0.85),
            edgecolor=ACCENT,
            linewidth=1.4,
            zorder=2 - 0.01 * (right - left),
        )


# ---- levels round a crossing -----------------------------------------------------------------------------------------


def plot_levels(layering: Layering, crossing: int, ax: Axes | None = None) -> Axes:
    """Draw a cut through the layers on a small circle round a crossing: every sheet at its level, and what is glued.

    From left to right the circle is unrolled, counter-clockwise from the top cell: over it, over the cell that follows,
    over the lowest one, the other side, and the top cell again. Sheets have the colours of
    :func:`~plyfold.draw.plot_layers`; glued sheets are joined, and where the outline passes, one sheet ends in a dot.

    Parameters
    ----------
    layering : Layering
    crossing : int
        Number of the crossing.
    ax : matplotlib Axes, optional
        Where to draw; by default on a new figure.

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    InputError
        If there is no such crossing.

    Examples
    --------
    >>> from plyfold import find_embedding
    >>> ramp = find_embedding([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)])
    >>> ax = plot_levels(ramp, 0)
    >>> [text.get_text() for text in ax.texts[:5]]
    ['w = 2', 'w = 1', 'w = 0', 'w = 1', 'w = 2']
    """
    borders = _borders_round(layering.immersion.arrangement, crossing)
    axes = blank(ax, (6.0, 3.0))
    cells = _cells_round(layering.immersion.arrangement, borders)
    top = len(layering.immersion.sheets[cells[0]])
    for column, cell in enumerate(cells):
        for sheet in layering.immersion.sheets[cell]:
            level = float(layering.level[sheet])
            ends = np.array([(column - _SHARE / 2, level), (column + _SHARE / 2, level)])
            line(axes, ends, sheet_colour(sheet), 5.0, solid_capstyle="butt")
        write(axes, (column, 0.4), f"w = {len(layering.immersion.sheets[cell])}", 9.0)
    for number in range(1, top + 1):
        write(axes, (-_SHARE / 2 - 0.1, number), f"level {number}", 8.0, ha="right", color=mix(INK, PAPER, 0.35))
    for place, (border, falls) in enumerate(borders):
        line(axes, np.array([(place + 0.5, 0.2), (place + 0.5, top + 0.4)]), mix(INK, PAPER, 0.8), 0.8, zorder=0.5)
        _across(axes, layering, place + 0.5, border, falls)
    return axes


def _borders_round(arrangement: Arrangement, crossing: int) -> list[tuple[int, bool]]:
    """Return the borders at a crossing, counter-clockwise from the top cell, and whether winding numbers fall there."""
    if not 0 <= crossing < arrangement.n_crossings:
        raise InputError(
            f"there is no crossing {crossing}", hint=f"crossings are numbered from 0 to {arrangement.n_crossings - 1}"
        )
    visits = np.flatnonzero((arrangement.crossing_of_visit == crossing) & arrangement.ccw)
    here = int(visits[0])
    other = int(arrangement.partner[here])
    before, after = arrangement.border_before.tolist(), arrangement.border_after.tolist()
    return [(before[here], True), (before[other], True), (after[here], False), (after[other], False)]


def _cells_round(arrangement: Arrangement, borders: list[tuple[int, bool]]) -> list[int]:
    first, _ = borders[0]
    beyond = [arrangement.right_cell[border] if falls else arrangement.left_cell[border] for border, falls in borders]
    return [int(arrangement.left_cell[first]), *map(int, beyond)]


def _across(axes: Axes, layering: Layering, x: float, border: int, falls: bool) -> None:
    """Draw what happens to the sheets at a border: all but one go on, and one ends."""
    immersion, level = layering.immersion, layering.level
    gap = (1 - _SHARE) / 2
    side = -gap if falls else gap
    for _, right, left in immersion.gluing[immersion.gluing[:, 0] == border].tolist():
        ends = np.array([(x + side, level[left]), (x - side, level[right])], dtype=float)
        line(axes, ends, mix(INK, PAPER, 0.45), 1.6)
    own = int(immersion.own_sheet[border])
    end = np.array([(x + side, level[own]), (x, level[own])], dtype=float)
    line(axes, end, sheet_colour(own), 5.0)
    dots(axes, end[1:], INK, 42, zorder=4)
    write(axes, (x, 0.0), f"border {border}", 7.5, color=mix(INK, PAPER, 0.35))
