"""The checkers of outlines that touch themselves: right moves and right pieces pass, no spoiled ones do."""

from fractions import Fraction

import numpy as np
import pytest

from plyfold.certify import check_limit, check_pieces
from plyfold.errors import CertificateError

BOW = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0), (2.0, 2.0), (1.0, 1.0), (0.0, 2.0)]
BOW_APART = [(0.0, 0.0), (1.0, 0.9), (2.0, 0.0), (2.0, 2.0), (1.0, 1.1), (0.0, 2.0)]
BOW_FACES = [[0, 1, 5], [1, 4, 5], [1, 2, 4], [2, 3, 4]]
BOW_PIECES = [[0, 1, 5], [2, 3, 4]]
NECK = [(0, 0), (2, 0), (3, -1), (4, -2), (5, -1), (3, -1), (2, 0), (2, 2), (0, 2)]
NECK_PIECES = [[0, 1, 7], [0, 7, 8], [2, 3, 4]]


def refused(check, *arguments, match, **named):
    with pytest.raises(CertificateError, match=match) as caught:
        check(*arguments, **named)
    return caught.value


# Limits


def test_a_limit():
    check_limit(BOW, BOW_APART, BOW_FACES)
    check_limit([BOW], [BOW_APART], BOW_FACES)
    check_limit(BOW_APART, BOW_APART, BOW_FACES)  # nothing was moved


def test_moves_that_doubles_cannot_tell():
    """A bow far from the origin, moved by a millionth of a rounding: strictly outward, in fractions of any kind."""
    far, off = 2**53 - 4, Fraction(1, 3 * 10**6)
    given = [(far + int(x), int(y)) for x, y in BOW]
    moved = [[(x, y + {1: -off, 4: off}.get(point, 0)) for point, (x, y) in enumerate(given)]]
    check_limit([given], moved, BOW_FACES)
    check_limit([given], [np.array(moved[0], dtype=object)], BOW_FACES)
    refused(check_limit, [given], [given], BOW_FACES, match="flat")
    inward = [[(x, 2 * y - there) for (x, y), (_, there) in zip(given, moved[0], strict=True)]]
    refused(check_limit, [given], inward, BOW_FACES, match="turned over")
    for share, outward in ((Fraction(99, 100), True), (1, False), (Fraction(3, 2), False)):
        aside = [[(x + share * off, y) if point == 1 else (x, y) for point, (x, y) in enumerate(moved[0])]]
        if outward:
            check_limit([given], aside, BOW_FACES)
        else:
            refused(check_limit, [given], aside, BOW_FACES, match="not outward")


def test_twins_must_match():
    twins = [-1, 3, -1, 1, -1, -1]
    square, halves = [(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1, 3), (3, 1, 2)]
    check_limit(square, square, halves, twins=twins)
    for wrong, match in (([-1] * 5, "one number"), ([-1, 4, -1, -1, 1, -1], "do not match"), ([-1] * 6, "boundary")):
        refused(check_limit, square, square, halves, twins=wrong, match=match)


@pytest.mark.parametrize("scale", [1e-150, 1e150])
def test_a_limit_of_any_size(scale):
    check_limit(scale * np.array(BOW), scale * np.array(BOW_APART), BOW_FACES)


def test_an_outline_that_nothing_was_done_about():
    refused(check_limit, BOW, BOW, BOW_FACES, match="triangle 1 is flat")


def test_another_number_of_points():
    refused(check_limit, BOW[:-1], BOW_APART, BOW_FACES, match="other numbers of points")
    refused(check_limit, [BOW, BOW], [BOW_APART], BOW_FACES, match="other numbers of points")


def test_triangles_of_another_outline():
    refused(check_limit, BOW, BOW_APART, BOW_FACES[:2], match="belongs to no triangle|boundary")


@pytest.mark.parametrize("place", [(0.0, -0.1), (0.1, 0.1), (0.1, -0.1), (0.1, 0.0)])
def test_moves_that_are_not_outward(place):
    """To the right of one edge at most."""
    square, moved = [(0, 0), (2, 0), (2, 2), (0, 2)], [place, (2, 0), (2, 2), (0, 2)]
    faces = [[0, 1, 2], [0, 2, 3]]
    error = refused(check_limit, square, moved, faces, match="not outward")
    assert error.where == ((0, 0),)
    check_limit(square, moved, faces, free=[0])
    refused(check_limit, square, moved, faces, free=[1], match="not outward")
    refused(check_limit, square, moved, faces, free=[4], match="free")


def test_a_cusp_has_no_outside():
    """The surface goes round the limaçon's inner corner more than once."""
    outer = [(3, 0), (1, 3), (-2, 0), (1, -3)]
    limacon, apart = [*outer, (3, 0.5), (1, 1), (0.5, 0), (1, -1)], [*outer, (3, 0.5), (1, 1), (0.25, 0), (1, -1)]
    cusps = [0, 0, 0, 0, 0, 0, 1, 0]
    faces = [[6, 7, 0], [6, 0, 1], [6, 1, 2], [6, 2, 3], [6, 3, 4], [6, 4, 5]]
    check_limit(limacon, limacon, faces, cusps)
    refused(check_limit, limacon, apart, faces, cusps, match="not outward")
    check_limit(limacon, apart, faces, cusps, free=[6])


def test_a_triangle_that_turns_over_on_the_way():
    """Both triangles are right at the end of the move; at its beginning one lies on the other side."""
    given, moved = [(0, 0), (4, 0), (3, 3), (0, 4)], [(0, 0), (4, 0), (-1, -1), (0, 4)]
    refused(check_limit, moved, given, [[0, 1, 2], [0, 2, 3]], free=[2], match="turns over")
    check_limit([(0, 0), (4, 0), (2, 2), (0, 4)], given, [[0, 1, 2], [0, 2, 3]])


def test_areas_that_vanish_half_way():
    """At both ends all is well, but both triangles of the square are turned by half a turn, through flat ones."""
    square = np.array([(0, 0), (2, 0), (2, 2), (0, 2)])
    refused(check_limit, square, 2 - square, [[0, 1, 2], [0, 2, 3]], free=range(4), match="turns over")


def test_a_point_that_becomes_a_spike():
    """A corner of more than half a turn that closes: all triangles stay as they are."""
    given, moved = [(0, 0), (4, 0), (4, 2), (-4, 0)], [(0, 0), (4, -1), (4, 2), (-4, 0)]
    spike = [(0, 0), (-2, 0), (-2, -2), (4, -2), (4, 4), (-4, 4), (-4, 0)]
    apart = [(0, 0), (-2, -0.5), (-2, -2), (4, -2), (4, 4), (-4, 4), (-4, 0)]
    check_limit(given, moved, [[0, 1, 2], [0, 2, 3]], free=[1])
    faces = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 5, 6]]
    refused(check_limit, spike, apart, faces, free=[1], match="doubles back")


# Pieces


def test_pieces():
    check_pieces(BOW, BOW, BOW_PIECES)
    check_pieces(NECK, NECK, NECK_PIECES)
    check_pieces([NECK], np.array(NECK, dtype=float), NECK_PIECES)


def test_pieces_that_share_a_vertex():
    points = BOW[:4] + BOW[5:]
    check_pieces(BOW, points, [[0, 1, 4], [2, 3, 1]])


def test_points_that_touch_edges_from_within_cut_them():
    """A corner of a square's notch on its far side."""
    notched = [(0, 0), (4, 0), (4, 4), (3, 4), (2, 0), (1, 4), (0, 4)]
    check_pieces(notched, notched, [[0, 4, 5], [0, 5, 6], [4, 1, 2], [4, 2, 3]])
    refused(check_pieces, notched, notched, [[0, 4, 5], [0, 5, 6]], match="not the outline")


def test_a_piece_that_is_missing():
    error = refused(check_pieces, BOW, BOW, BOW_PIECES[:1], match="not the outline")
    assert error.where in {((1.5, 0.5),), ((1.5, 1.5),), ((2, 1),)}


def test_a_piece_too_large():
    refused(check_pieces, BOW, [*BOW, (3, 1)], [[0, 1, 5], [2, 6, 4], [6, 3, 4]], match="not the outline")


def test_a_piece_twice():
    refused(check_pieces, BOW, [*BOW, *BOW[2:5]], [*BOW_PIECES, [6, 7, 8]], match="not the outline")


def test_a_neck_is_run_both_ways():
    """An outline that runs there and back somewhere else is another one."""
    one_way = [(0, 0), (2, 0), (3, -1), (4, -2), (5, -1), (3, -1), (2, 1), (2, 2), (0, 2)]
    refused(check_pieces, one_way, NECK, NECK_PIECES, match="not the outline")


def test_a_cut_that_the_outline_does_not_run_along():
    """Two halves of a square that are not glued."""
    square = [(0, 0), (2, 0), (2, 2), (0, 2)]
    refused(check_pieces, square, [*square, *square], [[0, 1, 2], [4, 6, 7]], match="not the outline")
    check_pieces(square, square, [[0, 1, 2], [0, 2, 3]])


def test_triangles_without_area():
    refused(check_pieces, BOW, BOW, BOW_FACES, match="triangle 1 is flat")
    refused(check_pieces, BOW, BOW, [[0, 5, 1], [2, 3, 4]], match="triangle 0 is flat or turned over")


def test_triangles_that_are_no_surface():
    refused(check_pieces, BOW, BOW, [*BOW_PIECES, [0, 1, 4]], match="same side")
    refused(check_pieces, BOW, BOW[:5], BOW_PIECES, match="does not exist")


def test_triangles_that_turn_round_a_point_twice():
    """The limaçon: its boundary is right, but it is a disk only with a cusp where the triangles meet."""
    limacon = [(3, 0), (1, 3), (-2, 0), (1, -3), (3, 0.5), (1, 1), (0.5, 0), (1, -1)]
    faces = [[6, 7, 0], [6, 0, 1], [6, 1, 2], [6, 2, 3], [6, 3, 4], [6, 4, 5]]
    error = refused(check_pieces, limacon, limacon, faces, match="too often")
    assert error.where == ((0.5, 0),)
    check_pieces(limacon, limacon, faces, cusps=[0, 0, 0, 0, 0, 0, 1, 0])
    refused(check_pieces, limacon, limacon, faces, cusps=[0, 0, 0, 0, 0, 1, 0, 0], match="too often")


def test_vertices_between_points_of_the_outline():
    """A third of the way along an edge: no double is there."""
    triangle, third = [(0.0, 0.0), (1.0, 0.3), (0.0, 1.0)], (1 / 3, 0.1)
    points, faces = [*triangle, third], [[0, 3, 2], [3, 1, 2]]
    refused(check_pieces, triangle, points, faces, match="not the outline")
    check_pieces(triangle, points, faces, boundary=[0, 3, 1, 2], along=[0, 0, 1, 2])
    refused(check_pieces, triangle, points, faces, boundary=[0, 3, 1, 2], along=[0, 0, 0, 2], match="runs backwards")
    refused(check_pieces, triangle, points, faces, boundary=[0, 3, 1, 2], match="not a row of all")
    refused(check_pieces, triangle, points, faces, boundary=[0, 3, 1], along=[0, 0, 1], match="not a row of all")
    refused(check_pieces, triangle, points, faces, boundary=[0, 3, 1, 2], along=[0, 0, 1, 3], match="row of edges")


def test_a_shared_vertex_has_no_edge_of_its_own():
    points = BOW[:4] + BOW[5:]
    named = {"boundary": [0, 1, 2, 3, 1, 4], "along": [0, 1, 2, 3, 4, 5]}
    refused(check_pieces, BOW, points, [[0, 1, 4], [2, 3, 1]], **named, match="twice")


def test_rings_and_several_loops():
    square, hole = [(0, 0), (9, 0), (9, 9), (0, 9)], [(0, 0), (3, 6), (6, 3)]
    faces = [[0, 1, 6], [1, 2, 6], [2, 5, 6], [2, 3, 5], [3, 4, 5]]
    check_pieces([square, hole], square + hole, faces)
    refused(check_pieces, [square], square + hole, faces, match="not the outline")
    refused(check_pieces, [square, hole[::-1]], square + hole, faces, match="not the outline")
