"""Whether the equations between levels at some crossings have a solution, by trying all values; and joined curves."""

from collections.abc import Collection

from reference.gluings import borders_at
from reference.layerings import levels_agree
from reference.planar_maps import Corner, GaussCode, corners, left_and_right, windings


def corners_by_first_visit(code: GaussCode) -> list[Corner]:
    """The crossings in the order in which the curve first visits them."""
    visits = [a for a in range(len(code.partner)) if code.ccw[a]]
    first_visits = [min(a, code.partner[a]) for a in visits]
    return [corner for _, corner in sorted(zip(first_visits, corners(code), strict=True))]


def levels_fit(code: GaussCode, crossings: Collection[int]) -> bool:
    """Whether all borders can have levels such that the rule holds at the given crossings.

    At each crossing two levels of the top cell are tried, the other two follow.
    """
    highest = [windings(code)[left] for left, _ in left_and_right(code)]
    every = corners_by_first_visit(code)
    waiting = [every[crossing] for crossing in crossings]

    def fits(level: dict[int, int], waiting: list[Corner]) -> bool:
        if not waiting:
            return True
        corner = max(waiting, key=lambda corner: sum(border in level for border in borders_at(corner)))
        rest = [other for other in waiting if other is not corner]
        for a in range(1, highest[corner.a_top] + 1):
            for b in range(1, highest[corner.a_top] + 1):
                own = {corner.a_top: a, corner.b_top: b}
                own.setdefault(corner.a_bottom, a - (b < a))
                own.setdefault(corner.b_bottom, b - (a < b))
                agrees = all(level.get(border, value) == value for border, value in own.items())
                if agrees and levels_agree(corner, own) and fits(level | own, rest):
                    return True
        return False

    return fits({}, waiting)


def joined(first: GaussCode, second: GaussCode) -> GaussCode:
    """The curve made of two, by a band outside them between the last border of the first and that of the second.

    The unbounded cell lies on the right of both borders.
    """
    n = len(first.partner)
    partner = first.partner + tuple(p + n for p in second.partner)
    return GaussCode(partner, first.ccw + second.ccw, 2 * (len(partner) - 1) + 1)


def ending_outside(code: GaussCode) -> GaussCode:
    """The same curve, started such that its last border has the unbounded cell on its right."""
    border, backward = divmod(code.outer, 2)
    assert backward
    n = len(code.partner)
    partner = tuple((code.partner[(p + border + 1) % n] - border - 1) % n for p in range(n))
    return GaussCode(partner, code.ccw[border + 1 :] + code.ccw[: border + 1], 2 * (n - 1) + 1)
