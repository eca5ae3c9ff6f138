"""What can be done about an outline that bounds no surface."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass

from plyfold.arrangement.arrangement import Arrangement
from plyfold.clock import Clock
from plyfold.errors import PrecisionError
from plyfold.offers.cusps import SuggestedCusps, suggest_cusps
from plyfold.offers.repair import Repaired, repair

__all__ = ["Offers", "offers"]


@dataclass(frozen=True, eq=False)
class Offers:
    """What makes an outline that bounds no surface the outline of one; none of it is done yet.

    Parameters
    ----------
    repaired : Repaired or None
        With small changes it bounds a disk, or a surface if it has several loops.
    cusps : SuggestedCusps or None
        With cusps it bounds a surface in one piece.
    """

    repaired: Repaired | None
    cusps: SuggestedCusps | None


def offers(
    arranged: Arrangement, time_limit: float | None = None, allow: float = 0.01, allow_layers: float = 0.2
) -> Offers:
    """Return all that can be done about an outline that bounds no surface, as far as it is found in time.

    Parameters
    ----------
    arranged : Arrangement
        With a drawing.
    time_limit : float, optional
        Seconds for all of it.
    allow, allow_layers : float, optional
        How much small changes may change, as :func:`repair` says.

    Examples
    --------
    >>> from plyfold import arrange
    >>> found = offers(arrange([(0, 0), (60, 0), (60, 41), (61, 41), (61, 40), (0, 40)]))
    >>> found.repaired
    <Repaired: 1 loop left out; 0.000416 of the region, 0.000416 of the layers>
    >>> found.cusps is None
    True
    """
    clock = Clock(time_limit)
    repaired = None
    with suppress(PrecisionError):  # what doubles cannot show is not offered
        repaired = repair(arranged, allow, allow_layers, clock.left)
    cusps = suggest_cusps(arranged, time_limit=clock.left)
    return Offers(
        repaired if isinstance(repaired, Repaired) else None, cusps if isinstance(cusps, SuggestedCusps) else None
    )
