"""The planar map on which immersions are looked for: numbered from the base visit, with curls in place of cusps.

So the first of several immersions belongs to the drawing, and no search knows of cusps. What is found is carried back.
"""

from __future__ import annotations

from dataclasses import dataclass

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrangement.base_visit import begun_at, borders_numbered_back, numbered_from
from plyfold.arrays import Ints
from plyfold.immersion.curls import DrawnOut, draw_out_cusps, without_curls
from plyfold.immersion.immersion import Immersion

__all__ = ["SearchMap", "search_map_of"]


@dataclass(frozen=True, eq=False)
class SearchMap:
    """An outline, its map as numbered from the base visit, and that without cusps.

    Parameters
    ----------
    arrangement, numbered : Arrangement
        Cells are numbered alike.
    drawn_out : DrawnOut
    """

    arrangement: Arrangement
    numbered: Arrangement
    drawn_out: DrawnOut

    @property
    def map(self) -> Arrangement:
        """The map to search on."""
        return self.drawn_out.arrangement

    def carried_back(self, found: Immersion) -> Immersion:
        """Return an immersion of the map as one of the outline, and check it."""
        immersion = _numbered_back(without_curls(found, self.drawn_out, self.numbered), self.arrangement)
        immersion.check()
        return immersion

    def visits_at(self, visits: Ints) -> Ints:
        """Return the visits of the outline at which some visits of the map are: for those of a curl, the cusp."""
        borders = self.drawn_out.border_at(self.map.border_after[visits])
        return (self.numbered.start_visit[borders] + self.arrangement.base_visit) % len(self.arrangement.partner)


def search_map_of(arranged: Arrangement) -> SearchMap:
    """Return the search map of an outline. Cost: O(k + Σ m)."""
    numbered = numbered_from(arranged, arranged.base_visit)
    return SearchMap(arranged, numbered, draw_out_cusps(numbered))


def _numbered_back(immersion: Immersion, arranged: Arrangement) -> Immersion:
    """Return the immersion with borders numbered as in the outline's own arrangement."""
    base, borders = arranged.base_visit, arranged.n_borders
    if base == 0:
        return immersion
    start = int(immersion.first_pair[borders - base])
    return Immersion(
        arranged, borders_numbered_back(arranged, immersion.own_sheet), begun_at(immersion.glued_to, start)
    )
