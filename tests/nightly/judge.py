"""Everything that must hold for one curve; an AssertionError says what does not."""

from collections.abc import Iterator

import numpy as np

import plyfold as pf
from nightly.curves import DISKS, LISTS, Drawn
from nightly.lists import judge_list
from nightly.meshes import judge_certificate, judge_spike
from reference import crossings, gluings, shor_van_wyk
from reference.planar_maps import GaussCode, gauss_code, windings
from test_against_reference import (
    assert_right_layering,
    assert_same_crossings,
    assert_same_immersions,
    turned_inside_out,
)

MOST_CROSSINGS = 20
"""Immersions are enumerated by the reference up to this many crossings ..."""

HIGHEST_WINDING = 5
"""... and this winding number: it tries all injections of sheets."""

MOST_CORNERS = 60
"""Triangles are sought by the reference up to this many corners of the polygon."""


MESHES = {"thin spike": judge_spike, "certificate": judge_certificate}
"""Kinds of which the mesh is judged, and how."""


def judge(drawn: Drawn) -> None:
    """Compare a curve with the references where they can, and with itself in other frames; or a list of curves."""
    if drawn.kind in LISTS:
        judge_list(drawn.points)
        return
    if drawn.kind in MESHES:
        MESHES[drawn.kind](drawn.points, np.random.default_rng(drawn.seed))
        return
    try:
        arranged = pf.arrange(drawn.points, general_position="raise")
    except pf.errors.PlyfoldError:
        assert not in_general_position(drawn.points), "refused a curve in general position"
        return
    if "large" not in drawn.kind:
        assert_right_arrangement(arranged, drawn.points)
    count = pf.count_immersions(arranged)
    assert count or drawn.kind not in DISKS, "this bounds a disk by construction"
    judge_immersions(arranged, count)
    assert_right_triangles(arranged, drawn.points, count)
    if "polygon" in drawn.kind:
        for code in turned_inside_out(gauss_code(arranged.partner, arranged.ccw, arranged.outer)):
            judge_immersions(pf.Arrangement.from_gauss(*code))
    for name, points in frames(np.array(drawn.points, dtype=np.float64)):
        assert_same_answers(arranged, count, pf.arrange(points, general_position="raise"), name)


def assert_right_triangles(arranged: pf.Arrangement, points: list[tuple[int, int]], count: int) -> None:
    """The dynamic program over triangles finds some if and only if there is a disk; and ours fill it.

    Positive triangles with every side glued to another or on the curve, each side of the curve once, are a disk.
    """
    n = len(points)
    along = [(i, (i + 1) % n) for i in range(n)]
    if n <= MOST_CORNERS:
        forward = crossings.reversed_polygon(points) if arranged.reversed else points
        assert bool(shor_van_wyk.triangulation(forward)) == bool(count)
    if count:
        faces = pf.triangulate(points).tolist()
        assert len(faces) == n - 2
        assert all(shor_van_wyk.turn(*(points[corner] for corner in face)) > 0 for face in faces)
        sides = [(face[i - 1], face[i]) for face in faces for i in range(3)]
        glued = set(sides)
        assert len(glued) == len(sides)
        free = {(i, j) for i, j in sides if (j, i) not in glued}
        assert free == ({(j, i) for i, j in along} if arranged.reversed else set(along))


def in_general_position(points: list[tuple[int, int]]) -> bool:
    """Whether the reference finds it so."""
    try:
        crossings.crossings(points)
        crossings.turning_number(points)
    except crossings.DegenerateError:
        return False
    return True


def assert_right_arrangement(arranged: pf.Arrangement, points: list[tuple[int, int]]) -> None:
    """Turning number and direction, crossings, cells and windings, as the exact fractions say."""
    turning = crossings.turning_number(points)
    assert arranged.turning_number == abs(turning)
    assert arranged.reversed == (turning < 0)
    assert_same_crossings(arranged, crossings.reversed_polygon(points) if turning < 0 else points)


def small(code: GaussCode) -> bool:
    """Whether the references can list all immersions and try all layerings."""
    return len(code.partner) <= 2 * MOST_CROSSINGS and max(windings(code)) <= HIGHEST_WINDING


def judge_immersions(arranged: pf.Arrangement, count: int | None = None) -> None:
    """All immersions and their layerings if the curve is small; else that the first immersion is one."""
    code = gauss_code(arranged.partner, arranged.ccw, arranged.outer)
    if small(code):
        for immersion in assert_same_immersions(arranged):
            assert_right_layering(immersion)
        return
    first = pf.find_immersion(arranged)
    assert bool(first) == bool(pf.count_immersions(arranged) if count is None else count)
    if first:
        assert gluings.problems(code, first.own_sheet.tolist(), [tuple(row) for row in first.gluing.tolist()]) == []


def frames(points: np.ndarray) -> Iterator[tuple[str, np.ndarray]]:
    """The same curve in other ways: nothing that counts may change."""
    yield "another start", np.roll(points, len(points) // 3, axis=0)
    yield "reversed", points[::-1]
    yield "reflected", points * [-1, 1]
    yield "a quarter turn", points[:, ::-1] * [-1, 1]
    yield "large", points * 2.0**40
    yield "small", points * 2.0**-60


def assert_same_answers(arranged: pf.Arrangement, count: int, other: pf.Arrangement, frame: str) -> None:
    """Crossings, turning number, windings and immersions of a curve in another frame."""
    assert other.n_crossings == arranged.n_crossings, frame
    assert other.turning_number == arranged.turning_number, frame
    if arranged.turning_number:  # with none, no direction is the positive one, so windings may change sign
        assert sorted(other.winding.tolist()) == sorted(arranged.winding.tolist()), frame
    assert pf.count_immersions(other) == count, frame
