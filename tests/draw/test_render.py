import numpy as np
import pytest
import shapely

from plyfold.colours import BACK, CLOTH_HIGH, SHEETS, rgb
from plyfold.draw.depth_buffer import Pixels, View, look
from plyfold.draw.render import Mesh, shade

SQUARE = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
TWO = np.array([(0, 1, 2), (0, 2, 3)])


def stacked(*heights):
    """Horizontal unit squares."""
    vertices = np.concatenate([np.column_stack([SQUARE, np.full(4, z)]) for z in heights])
    return Mesh(vertices, np.concatenate([TWO + 4 * i for i in range(len(heights))]))


def nearest_triangle(point, projected, faces):
    """Cast one ray: solve for barycentric coordinates, triangle by triangle."""
    best, depth = -1, -np.inf
    for index, face in enumerate(faces):
        corners = projected[face]
        weights = np.linalg.solve(np.vstack([corners[:, :2].T, np.ones(3)]), [*point, 1.0])
        if (weights >= 0).all() and weights @ corners[:, 2] > depth:
            best, depth = index, weights @ corners[:, 2]
    return best, depth


@pytest.mark.parametrize("direction", [(-90, 90), (-60, 30), (20, -50)])
def test_depth_buffer_agrees_with_casting_rays(direction):
    rng = np.random.default_rng(3)
    projected = View.of(*direction).project(rng.uniform(size=(30, 3)))
    faces = rng.permuted(np.tile(np.arange(30), (12, 1)), axis=1)[:, :3]
    pixels = Pixels.over(projected[:, :2].min(axis=0), projected[:, :2].max(axis=0), 23)
    seen = look(projected, faces, pixels)
    for row, column in np.ndindex(pixels.rows, pixels.columns):
        triangle, depth = nearest_triangle(pixels.centres()[row, column], projected, faces)
        assert seen.triangle[row, column] == triangle
        assert seen.depth[row, column] == pytest.approx(depth)


def test_view_from_above_is_the_drawing():
    points = np.random.default_rng(0).uniform(size=(9, 3))
    assert View.of(-90, 90).project(points) == pytest.approx(points)


@pytest.mark.parametrize("direction", [(-90, 90), (-60, 30), (20, -50)])
def test_views_are_right_handed(direction):
    axes = View.of(*direction).axes
    assert axes @ axes.T == pytest.approx(np.eye(3))
    assert np.linalg.det(axes) == pytest.approx(1)


def test_triangles_seen_edge_on_leave_no_trace():
    image = shade(stacked(0.0, 0.4), View.of(-90, 0), pixels=30)
    assert np.isfinite(image.colours).all()


def test_straight_above_the_square_is_opaque_and_its_margin_is_not():
    image = shade(stacked(0.0), View.of(-90, 90), pixels=132)
    left, right, bottom, top = image.extent
    share = (image.colours[..., 3] == 1).mean() * (right - left) * (top - bottom)
    assert share == pytest.approx(1.0, abs=0.02)
    assert image.colours[0, 0, 3] == 0


def test_upper_side_is_blue_and_lower_side_is_warm():
    above, below = (shade(stacked(0.0), View.of(-90, e), pixels=20).colours[10, 10, :3] for e in (90, -90))
    assert above[2] > above[0]
    assert below[0] > below[2]
    assert rgb(CLOTH_HIGH)[2] > rgb(BACK)[2]


def test_a_colour_stays_what_it_is_in_the_shadow():
    """Seen from the side, the lower of two sheets is in the shadow of the upper one; orange is not brown there."""
    orange = np.array(rgb(SHEETS[1]))
    image = shade(stacked(0.0, 0.4), View.of(-90, 25), pixels=80, paint=np.tile(orange, (4, 1)))
    seen = image.colours[image.colours[..., 3] == 1][:, :3]
    shadow = seen[np.argsort(seen.sum(axis=1))[: len(seen) // 10]]
    assert (shadow > 0.6 * orange - 0.02).all()
    assert len(np.unique(seen.round(2), axis=0)) > 3


def test_shadow_falls_on_what_lies_below_only():
    roof = Mesh(
        np.concatenate(
            [np.column_stack([SQUARE, np.zeros(4)]), np.column_stack([SQUARE * 0.4 + 0.3, np.full(4, 0.3)])]
        ),
        np.concatenate([TWO, TWO + 4]),
    )
    under, open_sky, on_top = [(0.5, 0.5, 0.001)], [(0.05, 0.05, 0.001)], [(0.5, 0.5, 0.31)]
    assert roof.lamp.shadow(np.array(under)) > 0.5
    assert roof.lamp.shadow(np.array(open_sky)) == 0
    assert roof.lamp.shadow(np.array(on_top)) == 0


def test_hidden_points_lie_behind():
    image = shade(stacked(0.0, 1.0), View.of(-90, 90), pixels=60)
    points = np.array([(0.5, 0.5, 0.0), (0.5, 0.5, 1.0), (0.5, 0.5, 2.0), (1.1, 0.5, 0.0), (0.0, 0.5, 0.0)])
    assert image.hidden(points).tolist() == [True, False, False, False, False]


def test_neighbours_leave_no_gap():
    grid = np.stack(np.meshgrid(np.linspace(0, 1, 9), np.linspace(0, 1, 9)), axis=-1).reshape(-1, 2)
    vertices = np.column_stack([grid, np.zeros(81)])
    corner = (np.arange(8)[:, None] * 9 + np.arange(8)).ravel()
    faces = np.concatenate([corner[:, None] + (0, 1, 10), corner[:, None] + (0, 10, 9)])
    seen = look(View.of(-81, 55).project(vertices), faces, Pixels(np.array([-0.5, 0.2]), 0.003, 300, 200))
    inside = View.of(-81, 55).project(np.column_stack([SQUARE * 0.98 + 0.01, np.zeros(4)]))
    square = shapely.Polygon(inside[:, :2])
    covered = shapely.contains_xy(square, *np.moveaxis(seen.pixels.centres(), -1, 0))
    assert covered.sum() > 10_000
    assert (seen.triangle[covered] >= 0).all()


def plates(gap):
    """A small plate above a large one."""
    square = np.array([(-1.0, -1), (1, -1), (1, 1), (-1, 1)])
    vertices = np.concatenate([np.column_stack([square, np.zeros(4)]), np.column_stack([square / 2, np.full(4, gap)])])
    faces = np.array([(0, 1, 2), (0, 2, 3)])
    return Mesh(vertices, np.concatenate([faces, faces + 4]))


def test_a_pale_rim_parts_what_lies_apart():
    paint = np.tile((0.2, 0.3, 0.6), (4, 1))
    saturation = []
    for gap in (0.0, 0.5):
        image = shade(plates(gap), View.of(-90, 90), 400, paint).colours
        middle = image[len(image) // 2]
        opaque = middle[middle[:, 3] == 1, :3]
        saturation.append((np.ptp(opaque, axis=1) / opaque.max(axis=1)).min())
    assert saturation[0] == pytest.approx(2 / 3, abs=0.02)  # nothing lies before anything
    assert saturation[1] < 0.3


def test_what_is_steep_has_no_rim_on_itself():
    """A plane that is seen from the side falls by many pixels' depth from one pixel to the next, and hides nothing."""
    corners = np.array(
        [(0.0, 0, 0), (1, 0, 0), (1, 20, 20 * np.tan(np.radians(4.0))), (0, 20, 20 * np.tan(np.radians(4.0)))]
    )
    plane = Mesh(corners, np.array([(0, 1, 2), (0, 2, 3)]))
    colours = shade(plane, View.of(-90, -1.5), 300, np.tile((0.2, 0.3, 0.6), (2, 1))).colours
    opaque = colours[colours[..., 3] == 1][:, :3]
    assert len(opaque) > 100
    assert (np.ptp(opaque, axis=1) / opaque.max(axis=1)).min() > 0.3


def test_what_lies_close_above_darkens_the_sky():
    mesh = plates(0.2)
    below, beside = (mesh.sky.shadow(np.array([(x, 0.0, 0.0)]), np.array([(0.0, 0, 1)]))[0] for x in (0.0, 0.9))
    assert below > 0.6
    assert beside < 0.5 * below
