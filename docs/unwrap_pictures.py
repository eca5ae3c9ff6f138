"""Rebuild the picture of the unwound disk: ``make pictures``. A counterpart of figures 2, 4 and 6 of the paper."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import plyfold as pf
from plyfold.arrays import Floats, Ints
from plyfold.colours import INK, rgb, sheet_colour
from plyfold.draw.canvas import blank, line
from plyfold.draw.depth_buffer import Pixels, View, look
from plyfold.draw.figures import save
from plyfold.draw.placement import natural_stretch
from plyfold.draw.render import Mesh, shade
from plyfold.gallery import CURVES

HERE = Path(__file__).parent
NAMES = ("exit-ramp", "milnor", "stacked-spiral")
SQUARES = 10
PIXELS = 500
SAMPLES = 4


@dataclass(frozen=True, eq=False)
class Cloth:
    """A surface cut along the lines of a chessboard in the disk: no triangle lies on two of its squares."""

    disk: Floats
    plane: Floats
    space: Floats
    faces: Ints
    sheet: Ints

    @classmethod
    def of(cls, surface: pf.Surface) -> Cloth:
        """Cut a surface along the lines of the chessboard."""
        points = np.concatenate([surface.unwrap().disk, surface.vertices], axis=1)
        faces, sheet = surface.faces, surface.sheet
        for axis in (0, 1):
            for place in np.arange(1, SQUARES) * 2 / SQUARES - 1:
                points, faces, origin = cut(points, faces, points[:, axis] - place)
                sheet = sheet[origin]
        return cls(points[:, :2], points[:, 2:4], points[:, 2:], faces, sheet)

    @property
    def colours(self) -> Floats:
        """The colour of each triangle: that of its sheet, darker on every other square of the disk."""
        middle = (self.disk[self.faces].mean(axis=1) + 1) / 2
        square = np.floor(middle * SQUARES).sum(axis=1) % 2
        plain = np.array([rgb(sheet_colour(sheet)) for sheet in range(self.sheet.max() + 1)])[self.sheet]
        return np.asarray(plain * (1 - 0.22 * square[:, None]))


def cut(points: Floats, faces: Ints, value: Floats) -> tuple[Floats, Ints, Ints]:
    """Cut triangles where a value at their corners changes its sign; also tell which triangle each part is of."""
    ends = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=2), axis=2)
    crossing = np.sign(value)[ends].prod(axis=2) < 0
    sides, which = np.unique(ends[crossing], axis=0, return_inverse=True)
    share = (value[sides[:, 0]] / (value[sides[:, 0]] - value[sides[:, 1]]))[:, None]
    between = points[sides[:, 0]] * (1 - share) + points[sides[:, 1]] * share
    added = np.full(faces.shape, -1)
    added[crossing] = len(points) + which.ravel()
    parts = [parts_of(face, new) for face, new in zip(faces.tolist(), added.tolist(), strict=True)]
    origin = np.repeat(np.arange(len(faces)), [len(part) for part in parts])
    return np.concatenate([points, between]), np.array([one for part in parts for one in part]), origin


def parts_of(face: list[int], added: list[int]) -> list[tuple[int, ...]]:
    """Return the parts of a triangle with points on one or two of its sides."""
    crossed = [i for i in range(3) if added[i] >= 0]
    if not crossed:
        return [tuple(face)]
    if len(crossed) == 1:
        (i,) = crossed
        a, b, c = face[i - 2], face[i - 1], face[i]
        return [(b, c, added[i]), (b, added[i], a)]
    lone = next(i for i in range(3) if added[i] >= 0 and added[i - 1] >= 0)
    a, b, c = face[lone], face[lone - 2], face[lone - 1]
    return [(a, added[lone], added[lone - 1]), (added[lone], b, c), (added[lone], c, added[lone - 1])]


def flat(ax: Axes, points: Floats, cloth: Cloth, outline: Floats, opacity: float) -> None:
    """Draw the cloth in the plane pixel by pixel, one sheet over the other, and the curve."""
    low, high = points.min(axis=0), points.max(axis=0)
    pixels = Pixels.over(low, high, SAMPLES * PIXELS)
    level = np.column_stack([points, np.zeros(len(points))])
    covered, light = np.zeros((pixels.rows, pixels.columns, 1)), np.zeros((pixels.rows, pixels.columns, 3))
    for sheet in range(cloth.sheet.max() + 1):
        own = np.flatnonzero(cloth.sheet == sheet)
        triangle = look(level, cloth.faces[own], pixels).triangle
        part = opacity * (triangle >= 0)[..., None]
        light = light * (1 - part) + cloth.colours[own][triangle] * part
        covered = covered * (1 - part) + part
    image = averaged(np.concatenate([light, covered], axis=2))
    image[..., :3] /= np.maximum(image[..., 3:], 1e-9)
    left, right, bottom, top = pixels.extent
    blank(ax).imshow(image.clip(0, 1), origin="lower", extent=(left, right, bottom, top), interpolation="antialiased")
    line(ax, np.concatenate([outline, outline[:1]]), INK, 1.6)


def averaged(samples: Floats) -> Floats:
    """Return pixels, each the mean of its samples."""
    rows, columns = (-(-n // SAMPLES) for n in samples.shape[:2])
    padding = ((0, SAMPLES * rows - samples.shape[0]), (0, SAMPLES * columns - samples.shape[1]), (0, 0))
    return np.asarray(np.pad(samples, padding).reshape(rows, SAMPLES, columns, SAMPLES, -1).mean(axis=(1, 3)))


def row(axes: list[Axes], surface: pf.Surface) -> None:
    """Draw the disk, the drawing laid flat, and the surface."""
    unwound, cloth = surface.unwrap(), Cloth.of(surface)
    flat(axes[0], cloth.disk, cloth, unwound.disk[unwound.boundary], 1.0)
    for arc in unwound.arcs:
        line(axes[0], arc.points, INK, 1.2, linestyle=(0, (4, 2)))
    for number in range(unwound.immersion.arrangement.n_borders):
        x, y = unwound.disk[unwound.border(number)[0]]
        line(axes[0], np.array([(0.97 * x, 0.97 * y), (1.05 * x, 1.05 * y)]), INK, 1.6)
    flat(axes[1], cloth.plane, cloth, unwound.plane[unwound.boundary], 0.62)
    stretched = cloth.space * [1, 1, natural_stretch(surface.vertices)]
    image = shade(Mesh(stretched, cloth.faces), View.of(-72.0, 52.0), 2 * PIXELS, cloth.colours)
    blank(axes[2]).imshow(image.colours, origin="lower", extent=image.extent, interpolation="antialiased")
    for ax in axes:
        ax.set_aspect("equal")
        ax.use_sticky_edges = False
        ax.margins(0.03)


def main() -> None:
    """Draw one row for each curve."""
    figure = Figure(figsize=(12, 4 * len(NAMES)), layout="tight")
    for axes, name in zip(figure.subplots(len(NAMES), 3), NAMES, strict=True):
        row(list(axes), pf.lift(CURVES[name].curve, triangles=40_000))
    save(figure, HERE / "images" / "unwound.png", force=True)


if __name__ == "__main__":
    main()
