"""What is asked of a repair: that it is the one by definition, keeps its promises, and does not depend on the start."""

from collections import Counter

import numpy as np

import plyfold as pf
from reference import contacts, gluings
from reference import repairs as reference
from reference.crossings import DegenerateError, crossings
from reference.planar_maps import may_bound_disk, reversed_code


def drawn_by_reference(polygon):
    try:
        return reference.drawing(polygon)
    except DegenerateError:
        return None


def agree(polygon, caps, most=8):
    """Compare a repair with that by definition, of a polygon in general position with no more crossings."""
    drawn = drawn_by_reference(polygon)
    if drawn is None or len(drawn.sides) > 2 * most:
        return
    expected = reference.repair(drawn, caps)
    found = pf.repair(polygon, *caps)
    assert bool(found) == (expected is not None)
    if expected is None:
        agree_beyond(drawn, found, caps)
        return
    places = [min(drawn.found.points[visit] for run in move.runs for visit in run) for move in expected.moves]
    kinds = ["lens undone" if len(move.runs) == 2 else "loop left out" for move in expected.moves]
    assert [change.kind for change in found.changes] == kinds
    assert np.allclose(np.ravel([change.where for change in found.changes]), np.array(places, dtype=float).ravel())
    assert np.allclose([found.region_change, found.layer_change], [float(x) for x in expected[1:]], atol=1e-12)


def agree_beyond(drawn, found, caps):
    """Compare what an obstruction names with what is found by definition: of two ways the one less beyond the caps."""
    ways = [reference.beyond(drawn, layers_first) for layers_first in (False, True)]
    parts = [(float(way.region), float(way.layers)) for way in ways if way is not None]
    if not parts:
        assert found.value is None
        return
    factors = [max(part / cap for part, cap in zip(pair, caps, strict=True)) for pair in parts]
    named = (found.value["region"], found.value["layers"])
    factor = max(part / cap for part, cap in zip(named, caps, strict=True))
    assert np.isclose(factor, min(factors), rtol=1e-9)
    assert any(np.allclose(named, pair, rtol=1e-9, atol=1e-12) for pair in parts)


def segments(loops):
    """How often each segment is passed forward, less how often backward."""
    passed = Counter()
    for points in loops:
        corners = [(x, y) for x, y in points.tolist()]
        for start, end in zip(corners, corners[1:] + corners[:1], strict=True):
            passed[min(start, end), max(start, end)] += (start < end) - (start > end)
    return {segment: times for segment, times in passed.items() if times}


def added(*many):
    total = Counter()
    for passed in many:
        for segment, times in passed.items():
            total[segment] += times
    return {segment: times for segment, times in total.items() if times}


def check_promises(outline, found, caps=(0.01, 0.2)):
    """Within the caps, a surface, and nothing else changed than what the polygons go round."""
    drawn, left = pf.arrange(outline), found.outline
    given = drawn.given.reversed() if drawn.reversed else drawn.given
    assert found.region_change <= caps[0] * (1 + 1e-9)
    assert found.layer_change <= caps[1] * (1 + 1e-9)
    assert pf.find_immersion(left)
    polygons = [polygon for change in found.changes for polygon in change.polygons]
    # As chains of segments, so around each place, whatever is rounded.
    assert segments(left.loops) == added(segments(given.loops), segments(polygons))
    assert sum(change.region for change in found.changes) >= found.region_change * (1 - 1e-9)
    assert sum(change.layers for change in found.changes) >= found.layer_change * (1 - 1e-9)
    assert set(found.changes) <= set(left.repairs)


def is_disk_by_reference(outline):
    """Whether an outline is that of a disk, by the slow reference; None if it is too large for that.

    In general position by gluings of its cells, which is quick; where it touches itself, as a limit of disks.
    """
    if outline.n_loops > 1 or len(outline) > 40:
        return None
    points = outline.points.tolist()
    try:
        code = crossings(points).code
    except DegenerateError:
        return bool(contacts.answer(points).outward) if len(outline) <= 30 else None
    if len(code.partner) > 12:
        return None
    ways = (code, reversed_code(code))
    return any(may_bound_disk(way) and (not way.partner or bool(gluings.immersions(*way))) for way in ways)


def as_answer(found):
    """What does not depend on where an outline begins and which way it runs."""
    if not found:
        return found.reason, found.value
    corners = [(x, y) for x, y in found.outline.points.tolist()]
    starts = [at for at, corner in enumerate(corners) if corner == min(corners)]
    forward = [corners[at:] + corners[:at] for at in starts]
    ways = forward + [[way[0], *way[:0:-1]] for way in forward]
    return (
        min(ways),
        [(change.kind, change.where) for change in found.changes],
        found.region_change,
        found.layer_change,
    )


def as_close(found, like):
    """Equal answers: points alike, areas up to rounding."""
    one, other = as_answer(found), as_answer(like)
    if not found or not like:
        assert one[0] == other[0]
        assert (one[1] is None) == (other[1] is None)
        return
    assert one[0] == other[0]
    assert one[1] == other[1]
    assert np.allclose(one[2:], other[2:], rtol=1e-9, atol=1e-15)
