"""Rebuild the pictures of files.md: ``make pictures``."""

from __future__ import annotations

from pathlib import Path

import plyfold as pf
from plyfold.draw.over_under_files import save_over_under
from plyfold.gallery import CURVES

IMAGES = Path(__file__).parent / "images"


def over_and_under() -> None:
    """Draw the first layering of two named curves, from above, with hidden strands dashed and removed."""
    for name, options in {"knotted-ribbon": {"hidden": "dashed"}, "pentagram": {"colours": "sheets"}}.items():
        layering = pf.find_embedding(CURVES[name].curve)
        save_over_under(layering, IMAGES / f"over-under-{name}.svg", force=True, **options)


if __name__ == "__main__":
    over_and_under()
