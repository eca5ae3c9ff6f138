"""Draw the pictures of docs/repair.md, and write its table: ``python docs/repair_pictures.py``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import shapely
from matplotlib.axes import Axes
from panels import panels, titled

import plyfold as pf
from plyfold.arrays import Floats
from plyfold.colours import INK, OBSTRUCTION, winding_colour
from plyfold.draw.canvas import line, region
from plyfold.draw.placement import Frame

DOCUMENT = Path(__file__).parent / "repair.md"
BEGIN, END = "<!-- others -->\n", "<!-- end of others -->\n"


def pen_stroke(line_of_pen: Sequence[tuple[float, float]], half: float) -> Floats:
    """Return the outline that a simple tool makes of a pen stroke: both sides of it, with loops at inner corners."""
    pen = np.array(line_of_pen, dtype=np.float64)
    steps = np.diff(pen, axis=0)
    aside = half * np.stack([-steps[:, 1], steps[:, 0]], axis=1) / np.hypot(*steps.T)[:, None]
    left, right = (np.stack([pen[:-1] + n, pen[1:] + n], axis=1).reshape(-1, 2) for n in (aside, -aside))
    return np.concatenate([right, left[::-1]])


def drawings() -> dict[str, Floats]:
    """Return drawings that are no disks, most of them by a hair."""
    knot = [(0, 0), (9, 0), (11, 5), (6, 8), (3, 4), (6, -5), (12, -4)]
    waist = [(0, 0), (4, 2.3), (7, 2.3), (11, 0), (11, 4), (7, 2), (4, 2), (0, 4)]
    corner = [(0, 0), (9, 0), (9, 5.6), (9.7, 5.6), (9.7, 5), (0, 5)]
    return {
        "pen stroke": pen_stroke([(0, 0), (4, 3), (8, 0), (12, 3), (16, 0)], 0.6),
        "pen stroke across itself": pen_stroke(knot, 0.5),
        "corner": np.array(corner),
        "waist": np.array(waist),
        "figure eight": np.array([(0, 0), (4, 4), (4, 0), (0, 4)], dtype=np.float64),
    }


# ---- pictures --------------------------------------------------------------------------------------------------------


def before_and_after() -> None:
    """Draw outlines with what a repair changes, and the outlines that it returns."""
    shown = drawings()
    with panels("repair", 2, len(shown), (13, 4.2)) as axes:
        found = {name: pf.repair(points, 0.1, 0.3) for name, points in shown.items()}
        for name, points in shown.items():
            titled(before := next(axes), name)
            painted(before, points, Frame(points))
            changes = found[name].changes if isinstance(found[name], pf.Repaired) else ()
            for strand in [strand for change in changes for strand in change.strands]:
                line(before, Frame(points)(strand), OBSTRUCTION, 2.4, zorder=4)
        for name, points in shown.items():
            mended = found[name]
            if isinstance(mended, pf.Repaired):
                painted(next(axes), mended.outline.points, Frame(points))
            else:
                titled(next(axes), "no: half of it would go")


def painted(ax: Axes, points: Floats, frame: Frame) -> None:
    """Paint the cells of a drawing by their winding numbers, and the drawing."""
    drawn = pf.arrange(points)
    for cell in np.flatnonzero(drawn.winding).tolist():
        region(ax, [frame(outline) for outline in drawn.cell_outlines(cell)], winding_colour(int(drawn.winding[cell])))
    line(ax, frame(np.concatenate([points, points[:1]])), INK, 1.2, zorder=3)


# ---- the table -------------------------------------------------------------------------------------------------------


def row(name: str, points: Floats) -> str:
    """Return a line of the table: what each way returns, and what it loses of all that the drawing covers."""
    covered, polygon = layers(points), shapely.Polygon(points)
    repaired = pf.repair(points, 0.1, 0.3)
    mended = "refused"
    if isinstance(repaired, pf.Repaired):
        mended = f"a disk, {lost(layers(repaired.outline), covered)}"
    others = [shapely.make_valid(polygon), polygon.buffer(0), pf.fill(points, "nonzero")]
    return (
        f"| {name} | {mended} | " + " | ".join(f"{parts(each)}, {lost(each.area, covered)}" for each in others) + " |\n"
    )


def layers(outline: pf.Outline | Floats) -> float:
    """Return the area of all that an outline covers, each place as often as it does."""
    return float(sum(abs(cell.winding) * cell.polygon.area for cell in pf.coverage(outline)))


def parts(geometry: shapely.Geometry) -> str:
    """Say how many polygons there are, and how many holes in them."""
    polygons = [part for part in shapely.get_parts(geometry) if part.geom_type == "Polygon"]
    holes = sum(len(part.interiors) for part in polygons)
    many = "1 polygon" if len(polygons) == 1 else f"{len(polygons)} polygons"
    return f"{many} with {holes} hole{'s' * (holes > 1)}" if holes else many


def lost(area: float, of: float) -> str:
    """Say what is lost."""
    change = 100 * (area / of - 1)
    return "nothing" if abs(change) < 0.05 else f"{change:+.1f} %".replace("-", "−")


def others() -> None:
    """Write the table between its marks."""
    before, _, rest = DOCUMENT.read_text().partition(BEGIN)
    titles = ["drawing", "`pf.repair`", "`make_valid`", "`buffer(0)`", '`fill`, `"nonzero"`']
    head = f"| {' | '.join(titles)} |\n|{'---|' * len(titles)}\n"
    table = "".join(row(name, points) for name, points in drawings().items())
    DOCUMENT.write_text(before + BEGIN + head + table + END + rest.partition(END)[2])


if __name__ == "__main__":
    before_and_after()
    others()
