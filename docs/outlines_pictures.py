"""Draw the pictures of docs/outlines.md: ``python docs/outlines_pictures.py``."""

from __future__ import annotations

import numpy as np
import shapely
from panels import IMAGES, panels, titled

import plyfold as pf
from plyfold import draw
from plyfold.arrays import Floats
from plyfold.colours import INK, OBSTRUCTION, winding_colour
from plyfold.draw.canvas import dots, line, region
from plyfold.draw.depth_buffer import View
from plyfold.draw.placement import Frame
from plyfold.draw.render import Mesh, shade
from plyfold.gallery import OUTLINES

PIXELS = 420
# From 30° above the plane of the torus, as its front in the gallery is seen.
ASKEW = View.of(-90.0, 30.0)
RIGHT = np.array([1.0, 0.0])


def loops() -> None:
    """Draw a ring, letters and a handle: with their cells, and lifted."""
    names = ("ring", "letter-b", "letter-g", "ampersand", "disk-with-handle")
    with panels("outlines-loops", 2, len(names), (13, 5.2)) as axes:
        for name in names:
            draw.plot_arrangement(OUTLINES[name].outline, next(axes))
        for name in names:
            draw.plot_surface(pf.lift(OUTLINES[name].outline), next(axes), pixels=PIXELS)


def links() -> None:
    """Draw all ways in which two rings can lie, from above, and one of those in which they are linked, lifted."""
    rings = OUTLINES["linked-rings"].outline
    layerings = sorted(pf.embeddings(rings), key=lambda each: each.changes)
    with panels("outlines-links", 1, 5, (13, 2.6)) as axes:
        for layering in layerings:
            titled(draw.plot_casing(layering, next(axes)), "linked" if layering.changes else "one above the other")
        titled(draw.plot_surface(pf.lift(layerings[-1]), next(axes), pixels=PIXELS), "linked, lifted")


def linked(rings: pf.Outline) -> pf.Layering:
    """Return a layering of two rings in which both pass over and under the other one."""
    return max(pf.embeddings(rings), key=lambda layering: layering.changes)


def bridges() -> None:
    """Draw a cell with two holes and its bridges, and the cell cut open along them."""
    square = [(0, 0), (9, 0), (9, 6), (0, 6)]
    holes = [[(1.8, 2.6), (2.4, 4), (3.6, 3.4), (3, 1.6)], [(5, 2.6), (6.5, 3.8), (7.4, 2.4), (6, 1.2)]]
    arrangement = pf.arrange([square, *holes])
    frame, cut = Frame(arrangement.outline.points), bridge_lines(arrangement)
    with panels("outlines-bridges", 1, 2, (7.5, 2.7)) as axes:
        titled(draw.plot_arrangement(arrangement, ax := next(axes), borders=True), "a cell with holes, and its bridges")
        for bridge in cut:
            line(ax, frame(bridge), OBSTRUCTION, 1.8, linestyle=(0, (3, 2)), zorder=3)
            dots(ax, frame(bridge), OBSTRUCTION, 14, zorder=4)
        titled(ax := next(axes), "cut open along them, it is a disk")
        slits = [shapely.LineString([first + 0.3 * RIGHT, second - 0.3 * RIGHT]).buffer(0.12) for first, second in cut]
        whole = shapely.Polygon(square, holes) - shapely.union_all(slits)
        rings = [whole.exterior, *whole.interiors]
        region(ax, [frame(ring.coords[:-1]) for ring in rings], winding_colour(1), edgecolor=INK, linewidth=1.4)


def bridge_lines(arrangement: pf.Arrangement) -> list[Floats]:
    """Return the bridges from foot to foot."""
    forward = arrangement.bridges % 2 == 0
    border = arrangement.bridges // 2
    visit = np.where(forward, arrangement.start_visit[border], arrangement.start_visit[arrangement.next_border[border]])
    return list(arrangement.visit_point[visit])


# ---- cusps ---------------------------------------------------------------------------------------------------------


def cusps() -> None:
    """Draw cusps of index 1 and 2: with their cells, drawn out as curls, their layers, and lifted."""
    with panels("outlines-cusps", 2, 4, (13, 6.4)) as axes:
        for index in (1, 2):
            spiral = wound(index)
            titled(draw.plot_arrangement(spiral, next(axes)), f"a cusp of index {index}")
            titled(draw.plot_arrangement(drawn_out(spiral, index), next(axes)), "drawn out as a curl")
            layering = pf.find_embedding(spiral)
            titled(draw.plot_layers(layering, next(axes)), "its layers: a spiral stair")
            titled(draw.plot_surface(pf.lift(layering), next(axes), (-72, 38), pixels=PIXELS), "lifted")


def wound(index: int) -> pf.Curve:
    """Return a curve that winds round the middle once more than its point 0 has as a cusp, where it is innermost."""
    angle = 2 * np.pi * (index + 1) * np.linspace(0, 1, 200 * (index + 1), endpoint=False)
    radius = 1 - 0.5 * np.cos(angle / (index + 1))
    return pf.Curve(np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1), cusps={0: index})


def drawn_out(curve: pf.Curve, index: int) -> pf.Curve:
    """Return a curve with a curl in place of its cusp at point 0: a spiral, clockwise and outward."""
    inner, outer = 0.1, 0.1 + 0.12 * index
    away = (curve.points - curve.points[0]) @ (1, 1j)
    first = int(np.flatnonzero(np.abs(away) > outer)[0])
    last = int(np.flatnonzero(np.abs(away) > inner)[-1])
    start, end = np.angle(away[[last, first]])
    seen = (start - end) % (2 * np.pi)  # the angle on the left
    turn = np.linspace(0, 1, 60 * (index + 1))[1:-1]
    spiral = (inner + (outer - inner) * turn) * np.exp(1j * (start - turn * (seen + 2 * np.pi * index)))
    curl = curve.points[0] + np.stack([spiral.real, spiral.imag], axis=1)
    return pf.Curve(np.concatenate([curve.points[first : last + 1], curl]))


# ---- contacts ------------------------------------------------------------------------------------------------------


TOUCHING = {
    "two triangles in a point": [(0, 0), (2, 1.2), (4, 0), (4, 2.4), (2, 1.2), (0, 2.4)],
    "squares on a neck": [
        (0, 0), (1.6, 0), (1.6, 1), (3, 1), (3, 0), (4.6, 0), (4.6, 2), (3, 2), (3, 1), (1.6, 1), (1.6, 2), (0, 2),
    ],
    "a hole on a cut": [(0, 0), (4, 0), (4, 3), (0, 3), (0, 0), (1, 0.75), (1, 2), (2.8, 2), (2.8, 0.75), (1, 0.75)],
    "no disk": [(0, 0), (2, 0), (2, 1.4), (2, 2.8), (4, 2.8), (4, 1.4), (2, 1.4), (0, 1.4)],
}  # fmt: skip
AWAY = 0.16
"""How far points that touch others are moved in the picture, in place of a ten-thousandth of it."""


def contacts() -> None:
    """Draw outlines that touch themselves: as they are, with points moved outward visibly, and what is left of them."""
    with panels("outlines-contacts", 3, len(TOUCHING), (13, 7.6)) as axes:
        for name, points in TOUCHING.items():
            drawn = pf.arrange(points)
            frame = Frame(drawn.given.points)
            titled(ax := next(axes), name)
            line(ax, frame(np.concatenate([drawn.given.points, drawn.given.points[:1]])), INK, 1.4)
            touching = drawn.given.points[(drawn.given.points != drawn.outline.points).any(axis=1)]
            dots(ax, frame(touching), OBSTRUCTION, 26, zorder=4)
        for points in TOUCHING.values():
            titled(draw.plot_arrangement(moved_visibly(pf.arrange(points)), next(axes)), "moved outward")
        for points in TOUCHING.values():
            titled(ax := next(axes), "pieces")
            frame = Frame(np.array(points, dtype=np.float64))
            for winding, pieces in zip((1, -1), pf.decompose(points, signed=True), strict=True):
                for piece in pieces:
                    region(
                        ax, [frame(piece.exterior.coords[:-1])], winding_colour(winding), edgecolor=INK, linewidth=1.4
                    )


def moved_visibly(drawn: pf.Arrangement) -> pf.Curve:
    """Return an outline with the moves that keep it from touching itself, made larger."""
    move = drawn.outline.points - drawn.given.points
    return pf.Curve(drawn.given.points + AWAY * move / np.hypot(*move.T).max())


# ---- a torus -------------------------------------------------------------------------------------------------------


def torus() -> None:
    """Draw a torus and what its front looks like: its outline, an end of the hole enlarged, and the lifted surface."""
    front = OUTLINES["torus-front"].outline
    surface = pf.lift(torus_layering(front))
    with panels("outlines-torus", 1, 5, (14, 2.9)) as axes:
        image = shade(torus_mesh(), ASKEW, PIXELS)
        titled(ax := next(axes), "a torus, seen from 30° above")
        ax.imshow(image.colours, origin="lower", extent=image.extent, interpolation="antialiased")
        titled(draw.plot_arrangement(front, next(axes)), "the outline of its front")
        titled(draw.plot_arrangement(front, ax := next(axes)), "an end of the hole, enlarged")
        ax.set_aspect("equal", adjustable="box")
        ax.set(xlim=(0.1, 0.3), ylim=(-0.1, 0.1))
        for text in ax.texts:
            text.set_clip_on(True)
        titled(draw.plot_surface(surface, next(axes), (-90, 60), pixels=PIXELS), "lifted")
        titled(draw.plot_surface(surface, next(axes), (-50, 30), pixels=PIXELS), "the same from aside")


def torus_layering(front: pf.Outline) -> pf.Layering:
    """Return the layering of a torus's front: the near side of the hole hides what is behind it."""
    lower = np.arange(len(front.loops[0]) + len(front.loops[1]) // 4, len(front.loops[0]) + len(front.loops[1]) // 2)
    arrangement = pf.arrange(front)
    near = np.isin(arrangement.visit_edge, lower) & (arrangement.crossing_of_visit >= 0)
    return next(layering for layering in pf.embeddings(front) if layering.casing[near].all())


def torus_mesh(wide: float = 3.0, tube: float = 1.3, steps: int = 120) -> Mesh:
    """Return the torus whose front is in the gallery."""
    u, v = np.meshgrid(*2 * [2 * np.pi * np.arange(steps) / steps], indexing="ij")
    ring = wide + tube * np.cos(v)
    points = np.stack([ring * np.cos(u), ring * np.sin(u), tube * np.sin(v)], axis=-1).reshape(-1, 3)
    here = np.arange(steps * steps).reshape(steps, steps)
    ahead, aside = np.roll(here, -1, axis=0), np.roll(here, -1, axis=1)
    across = np.roll(ahead, -1, axis=1)
    faces = [np.stack(corners, axis=-1).reshape(-1, 3) for corners in ((here, ahead, across), (here, across, aside))]
    return Mesh(points / (2 * wide), np.concatenate(faces))


if __name__ == "__main__":
    IMAGES.mkdir(exist_ok=True)
    for picture in (loops, links, bridges, cusps, contacts, torus):
        picture()
