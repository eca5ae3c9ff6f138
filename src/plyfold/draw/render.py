"""Shaded images of a surface: exact hiding, smooth light and soft shadows, in plain numpy."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from plyfold.arrays import Bools, Floats, Ints
from plyfold.colours import BACK, CLOTH_HIGH, CLOTH_LOW, rgb
from plyfold.draw.depth_buffer import Pixels, Seen, View, look
from plyfold.matrices import one_thread

__all__ = ["Image", "Mesh", "shade"]


_LIGHTS = 16
_LAMP_WIDTH = 0.12
_SHADOW_PIXELS = 400
_SKY_PIXELS = 200
_SKY_RADIUS = 0.85
_GOLDEN_ANGLE = 2.399963
_TO_LIGHT = np.array([-0.42, 0.30, 1.0])
_FLOOR_DARKNESS = 0.18
_FLOOR_STEP = 3
_FLATTEST = 0.05
_RIM = 0.006
_RIM_STRENGTH = 0.85
_STEEPEST = 12.0
# Where colours tell sheets or layers apart, shadows darken them by so much of what they darken cloth by.
_ON_COLOURS = 0.6


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles, counter-clockwise seen from the front.

    Parameters
    ----------
    vertices : (n, 3) float
    faces : (m, 3) int
    """

    vertices: Floats
    faces: Ints

    @cached_property
    def normals(self) -> Floats:
        """Normals of the vertices, weighted by area, not of unit length; shape (n, 3)."""
        a, b, c = (self.vertices[self.faces[:, i]] for i in range(3))
        sums = np.zeros(self.vertices.shape)
        np.add.at(sums, self.faces.ravel(), np.repeat(np.cross(b - a, c - a), 3, axis=0))
        return sums

    @property
    def heights(self) -> tuple[float, float]:
        """Lowest and highest z."""
        return float(self.vertices[:, 2].min()), float(self.vertices[:, 2].max())

    @property
    def floor(self) -> float:
        """Height of the floor: a little below the lowest point."""
        low, high = self.heights
        return low - 0.1 * (high - low) - 0.02 * float(np.ptp(self.vertices[:, 0]))

    def box(self, view: View) -> tuple[Floats, Floats]:
        """Return the lower left and upper right corner of the mesh as seen."""
        plane = view.project(self.vertices)[:, :2]
        return plane.min(axis=0), plane.max(axis=0)

    @cached_property
    def lamp(self) -> Lights:
        """The lamp that shines on it: a small disk of lights."""
        return self._lights(
            [_towards(_TO_LIGHT + _spread(i, _LIGHTS, _LAMP_WIDTH)) for i in range(_LIGHTS)], _SHADOW_PIXELS
        )

    @cached_property
    def sky(self) -> Lights:
        """The sky above it: lights in all directions, the higher the brighter."""
        rings = [_spread(i, _LIGHTS, _SKY_RADIUS) for i in range(_LIGHTS)]
        return self._lights(
            [_towards(ring + np.array([0, 0, np.sqrt(1 - ring @ ring)])) for ring in rings], _SKY_PIXELS
        )

    def _lights(self, views: list[View], pixels: int) -> Lights:
        grids = [Pixels.over(*self.box(view), pixels) for view in views]
        return Lights(
            tuple(look(view.project(self.vertices), self.faces, grid) for view, grid in zip(views, grids, strict=True)),
            tuple(views),
        )


@dataclass(frozen=True, eq=False)
class Lights:
    """Distant lights, each with the depth buffer of what it sees."""

    looks: tuple[Seen, ...]
    views: tuple[View, ...]

    def shadow(self, where: Floats, facing: Floats | None = None) -> Floats:
        """Return the share of the lights that each point does not see; it may face a direction."""
        slack = 2.5 * max(seen.pixels.size for seen in self.looks)
        above = where if facing is None else where + slack * facing
        hidden = np.zeros(len(where), dtype=np.int64)
        for view, seen in zip(self.views, self.looks, strict=True):
            seen.add_hidden(view, above, slack, hidden)
        return hidden / len(self.looks)


def _spread(index: int, number: int, radius: float) -> Floats:
    """Return one of some places spread evenly over a level disk, by the golden angle."""
    angle = _GOLDEN_ANGLE * index
    return np.asarray(radius * np.sqrt((index + 0.5) / number) * np.array([np.cos(angle), np.sin(angle), 0.0]))


def _towards(direction: Floats) -> View:
    x, y, z = direction
    return View.of(np.degrees(np.arctan2(y, x)), np.degrees(np.arctan2(z, np.hypot(x, y))))


def _brightness(mesh: Mesh, where: Floats, facing: Floats) -> Floats:
    """Return the brightness of points with unit normals: the sky as far as it is open, and the lamp unless hidden."""
    lamp = (facing @ _towards(_TO_LIGHT).axes[2]).clip(0) * (1 - mesh.lamp.shadow(where, facing))
    sky = (0.5 + 0.5 * facing[:, 2]) * (1 - 0.75 * mesh.sky.shadow(where, facing))
    return np.asarray(0.34 + 0.36 * sky + 0.40 * lamp)


@dataclass(frozen=True, eq=False)
class Image:
    """A finished picture.

    Parameters
    ----------
    colours : (rows, columns, 4) float
        Red, green, blue and opacity, row 0 lowest.
    view : View
    seen : Seen
        The depth buffer behind it, with twice as many pixels each way.
    """

    colours: Floats
    view: View
    seen: Seen

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """Left, right, bottom and top in the plane of projection."""
        return self.seen.pixels.extent

    def hidden(self, points: Floats) -> Bools:
        """Return which of some points in space lie behind the surface; those on its edge do not."""
        projected, size = self.view.project(points), self.seen.pixels.size
        shifts = [(i * size, j * size, 0.0) for i in (-1.5, 0, 1.5) for j in (-1.5, 0, 1.5)]
        nearest = np.min([self.seen.depth_at(projected + shift) for shift in shifts], axis=0)
        return np.asarray(nearest > projected[:, 2] + 4 * size)


def shade(mesh: Mesh, view: View, pixels: int | Pixels = 900, paint: Floats | None = None) -> Image:
    """Return a shaded image, with soft shadows on itself and a floor, and a pale rim where it passes behind itself.

    Parameters
    ----------
    mesh : Mesh
    view : View
        Where from.
    pixels : int or Pixels
        How many along the longer side, or a grid: of this, the part that the surface and its shadow meet. Each pixel is
        the mean of four samples.
    paint : (m, 3) float, optional
        Colour of the upper side of each triangle; the lower one is paler. By default blue above, lighter where it is
        higher, and warm below.

    Returns
    -------
    Image
        Cost: about a second for 900 pixels.

    Examples
    --------
    >>> triangle = Mesh(np.array([(0.0, 0, 0), (1, 0, 0), (0, 1, 0)]), np.array([(0, 1, 2)]))
    >>> image = shade(triangle, View.of(-90, 90), pixels=40)
    >>> image.colours.shape, bool(image.hidden(np.array([(0.2, 0.2, -1.0)]))[0])
    ((40, 40, 4), True)
    """
    canvas = _canvas(mesh, view, pixels)
    with one_thread():
        seen = look(view.project(mesh.vertices), mesh.faces, canvas.doubled())
        body = _rimmed(_body(mesh, view, seen, paint), seen, _is_steep(mesh, view))
        return Image(_over(body, _floor(mesh, view, canvas)), view, seen)


def _canvas(mesh: Mesh, view: View, pixels: int | Pixels) -> Pixels:
    """Return pixels with room for the mesh, and for its shadow unless the floor is seen from below."""
    low, high = mesh.box(view)
    if view.axes[2, 2] > _FLATTEST:
        fall = (mesh.vertices[:, 2:] - mesh.floor) * _TO_LIGHT / _TO_LIGHT[2]
        below = view.project(mesh.vertices - fall)[:, :2]
        low, high = np.minimum(low, below.min(axis=0)), np.maximum(high, below.max(axis=0))
    margin = 0.05 * float((high - low).max())
    if isinstance(pixels, Pixels):
        return pixels.part(low - margin, high + margin)
    return Pixels.over(low - margin, high + margin, pixels)


def _body(mesh: Mesh, view: View, seen: Seen, paint: Floats | None) -> Floats:
    """Return the lit surface in each pixel, premultiplied by its opacity."""
    sample, pixel, weight = _samples_to_light(seen, _parts(mesh, paint))
    triangle = seen.triangle.ravel()[sample]
    row, column = np.divmod(sample, seen.pixels.columns)
    plane = seen.pixels.origin + seen.pixels.size * (np.column_stack([column, row]) + 0.5)
    projected = np.column_stack([plane, seen.depth.ravel()[sample]])
    where = projected @ view.axes
    normal = _smooth_normals(mesh, view, triangle, projected)
    front = normal @ view.axes[2] > 0
    facing = np.where(front[:, None], normal, -normal)
    colour = _cloth(mesh, where[:, 2], front) if paint is None else _painted(paint[triangle], front)
    brightness = _brightness(mesh, where, facing)
    lit = colour * (brightness if paint is None else 1 - _ON_COLOURS * (1 - brightness))[:, None]
    rows, columns = seen.pixels.rows // 2, seen.pixels.columns // 2
    sums = [np.bincount(pixel, weight * share, rows * columns) for share in (*lit.clip(0, 1).T, 1.0)]
    return np.asarray(np.stack(sums, axis=-1).reshape(rows, columns, 4), dtype=np.float64)


def _parts(mesh: Mesh, paint: Floats | None) -> Ints:
    """Return a number for each triangle: triangles of the same colour have the same."""
    if paint is None:
        return np.arange(len(mesh.faces))
    return np.asarray(np.unique(paint, axis=0, return_inverse=True)[1].ravel())


def _samples_to_light(seen: Seen, part: Ints) -> tuple[Ints, Ints, Floats]:
    """Return one sample for each pixel and part seen in it, the pixel, and what share of it sees that part.

    Light changes slowly along a part: the four samples of one pixel need not be lit one by one.
    """
    rows, columns = seen.pixels.rows // 2, seen.pixels.columns // 2
    number = np.append(part, -1)[seen.triangle]
    fours = number.reshape(rows, 2, columns, 2).transpose(1, 3, 0, 2).reshape(4, -1)
    alike = ((fours[1] == fours[0]) & (fours[2] == fours[0]) & (fours[3] == fours[0])).ravel()
    whole, mixed = np.flatnonzero(alike & (fours[0] >= 0)), np.flatnonzero(~alike)
    same = fours[:, None, mixed] == fours[:, mixed]
    is_first = ~np.tril(same.transpose(2, 0, 1), -1).any(axis=2).T & (fours[:, mixed] >= 0)
    quarter, place = np.nonzero(is_first)
    pixel = np.concatenate([whole, mixed[place]])
    row, column = np.divmod(pixel, columns)
    quarter = np.concatenate([np.zeros_like(whole), quarter])
    sample = (2 * row + quarter // 2) * seen.pixels.columns + 2 * column + quarter % 2
    return sample, pixel, np.concatenate([np.ones(len(whole)), same.sum(axis=1)[is_first] / 4])


def _is_steep(mesh: Mesh, view: View) -> Bools:
    """Return which triangles are seen so much from the side that depth falls from pixel to pixel without an edge."""
    a, b, c = (view.project(mesh.vertices)[mesh.faces[:, i]] for i in range(3))
    x, y, depth = np.cross(b - a, c - a).T
    return np.asarray(np.hypot(x, y) > _STEEPEST / 2 * np.abs(depth))


def _rimmed(body: Floats, seen: Seen, is_steep: Bools) -> Floats:
    """Pale the surface just behind the edges of what lies well before it, so that the two stand apart."""
    from scipy.ndimage import gaussian_filter, maximum_filter, minimum_filter

    depth, size = seen.depth[::2, ::2].astype(np.float32), 2 * seen.pixels.size
    solid = np.isfinite(depth)
    flat = solid & ~is_steep[seen.triangle[::2, ::2]]
    back = np.where(flat, depth, np.float32(np.inf))
    edge = np.where(depth > minimum_filter(back, 3) + _STEEPEST * size, depth, np.float32(-np.inf))
    if not np.isfinite(edge).any():
        return body
    reach = max(round(_RIM * max(depth.shape)), 1)
    y, x = np.mgrid[-reach : reach + 1, -reach : reach + 1]
    nearest = maximum_filter(edge, footprint=x**2 + y**2 <= (reach + 0.5) ** 2)
    far = flat & (nearest > back + _STEEPEST * reach * size / 2)
    rim = _RIM_STRENGTH * gaussian_filter(far.astype(float), 0.6)[..., None]
    return np.asarray(body * (1 - rim) + body[..., 3:] * rim)


def _smooth_normals(mesh: Mesh, view: View, triangle: Ints, projected: Floats) -> Floats:
    """Return unit normals at points of triangles, interpolated between the corners."""
    corners = view.project(mesh.vertices)[:, :2][mesh.faces[triangle]]
    weights = _barycentric(corners, projected[:, :2])
    normal = np.einsum("pi,pij->pj", weights, mesh.normals[mesh.faces[triangle]])
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    return np.asarray(normal / np.maximum(length, np.finfo(float).tiny))


def _barycentric(corners: Floats, at: Floats) -> Floats:
    a, b, c = (corners[:, i] for i in range(3))
    second, third = _cross(at - a, c - a), _cross(b - a, at - a)
    whole = _cross(b - a, c - a)
    whole = np.where(whole == 0, 1.0, whole)
    return np.stack([1 - (second + third) / whole, second / whole, third / whole], axis=1).clip(0, 1)


def _cross(first: Floats, second: Floats) -> Floats:
    return first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]


def _cloth(mesh: Mesh, height: Floats, front: Bools) -> Floats:
    low, high = mesh.heights
    share = ((height - low) / (high - low or 1.0))[:, None]
    upper = np.array(rgb(CLOTH_LOW)) * (1 - share) + np.array(rgb(CLOTH_HIGH)) * share
    return np.where(front[:, None], upper, np.array(rgb(BACK)))


def _painted(colour: Floats, front: Bools) -> Floats:
    return np.where(front[:, None], colour, 0.5 * colour + 0.5)


def _floor(mesh: Mesh, view: View, pixels: Pixels) -> Floats:
    """Return the opacity of the shadow on a floor a little below the surface, as seen in each pixel.

    The shadow is soft: one place in every few pixels is enough, with straight transitions between them.
    """
    if view.axes[2, 2] < _FLATTEST:
        return np.zeros((pixels.rows, pixels.columns))
    coarse = Pixels(
        pixels.origin, _FLOOR_STEP * pixels.size, *(n // _FLOOR_STEP + 2 for n in (pixels.columns, pixels.rows))
    )
    flat = coarse.centres().reshape(-1, 2) @ view.axes[:2]
    towards_eye = (mesh.floor - flat[:, 2]) / view.axes[2, 2]
    where = flat + towards_eye[:, None] * view.axes[2]
    dark = mesh.lamp.shadow(where)
    return _FLOOR_DARKNESS * _enlarged(dark.reshape(coarse.rows, coarse.columns), pixels)


def _enlarged(coarse: Floats, pixels: Pixels) -> Floats:
    """Return values at every pixel from those at every few, by straight interpolation each way."""
    from scipy.ndimage import map_coordinates

    rows, columns = (((np.arange(n) + 0.5) / _FLOOR_STEP - 0.5) for n in (pixels.rows, pixels.columns))
    return np.asarray(map_coordinates(coarse, np.meshgrid(rows, columns, indexing="ij"), order=1, mode="nearest"))


def _over(body: Floats, shadow: Floats) -> Floats:
    """Lay the premultiplied body over a black shadow, and divide by the opacity again."""
    opacity = body[..., 3] + shadow * (1 - body[..., 3])
    colour = body[..., :3] / np.maximum(opacity, np.finfo(float).tiny)[..., None]
    return np.concatenate([colour.clip(0, 1), opacity[..., None]], axis=-1)
