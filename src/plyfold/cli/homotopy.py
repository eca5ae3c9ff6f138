"""``plyfold homotopy``: how a curve contracts and sweeps the least area."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from plyfold.cli.inputs import DISK, UNKNOWN, add_command, add_outputs, add_time_limit, prepare
from plyfold.cli.progress import Stopwatch, timing
from plyfold.cli.standard_output import say_written

if TYPE_CHECKING:
    from plyfold.homotopy.homotopy import Homotopy

__all__ = ["add_homotopy_command"]

_FILMS, _PICTURES = (".html", ".gif", ".mp4"), (".png", ".svg", ".pdf")

_JSON_GUIDE = """\
the object that --json prints:
  area, lower, optimal      the area that is swept, what is swept at least, and whether these are the same
  winding_area              winding numbers times areas of cells, without signs: no contraction sweeps less
  branch_points             of the disk with branch points that the curve bounds; null: none, or not known
  cuts                      list of [x, y]: the crossings where the curve is cut
  loops                     list of {sign, parent, area, points}: 1 if the disk lies on the left; the loop that each is
                            cut off, -1 for the first
  seconds                   object: stage -> seconds
"""


def add_homotopy_command(commands: Any) -> None:
    """Add the subcommand to a parser."""
    what = "contract a closed curve so that it sweeps the least area, and say in which loops"
    homotopy = add_command(commands, "homotopy", _homotopy, what)
    add_time_limit(homotopy, "the search; bounds are printed")
    add_outputs(homotopy, ".html .gif .mp4 of the film, .png .svg .pdf of the loops", required=False)
    homotopy.add_argument("--json", action="store_true", help="print one JSON object and nothing else (see below)")
    homotopy.epilog, homotopy.formatter_class = _JSON_GUIDE, argparse.RawDescriptionHelpFormatter


def _homotopy(options: argparse.Namespace) -> int:
    from plyfold.homotopy.homotopy import least_homotopy

    watch = Stopwatch()
    arranged = prepare(options, (*_FILMS, *_PICTURES), watch)
    watch("finding the least homotopy")
    found = least_homotopy(arranged, options.time_limit)
    for path in options.output:
        watch("drawing")
        _write(found, path, options.force)
    watch.stop()
    if options.json:
        print(json.dumps(options.shape | _figures(found) | {"seconds": watch.seconds}), flush=True)
    else:
        print("\n".join(_lines(found)))
        print(timing(watch))
        for path in options.output:
            say_written(path)
    return DISK if found.optimal else UNKNOWN


def _write(found: Homotopy, path: str, force: bool) -> None:
    from plyfold.draw.figures import save
    from plyfold.draw.homotopy_plot import plot_homotopy, save_contraction

    if Path(path).suffix.lower() in _FILMS:
        save_contraction(found, path, force, title=Path(path).stem)
    else:
        save(plot_homotopy(found).figure, path, force)  # type: ignore[arg-type]


def _lines(found: Homotopy) -> list[str]:
    area = f"{found.area:.6g}" if found.optimal else f"between {found.lower:.6g} and {found.area:.6g}"
    from plyfold.report import branched_in_words

    lines = [f"The curve contracts and sweeps {area}; winding numbers alone ask for {found.winding_area:.6g}."]
    if found.branch_points is not None:
        lines.append(f"It is the outline of {branched_in_words(found.branch_points)}.")
    lines += [f"  loop {number}: {_loop(found, number)}" for number in range(len(found.loops))]
    return lines


def _loop(found: Homotopy, number: int) -> str:
    loop = found.loops[number]
    side = "left" if loop.sign > 0 else "right"
    said = f"disk on its {side}, {found.area_of(loop):.6g}"
    if loop.parent < 0:
        return said
    x, y = found.arrangement.crossings[loop.crossing].tolist()
    return f"{said}, cut off loop {loop.parent} at ({x:.6g}, {y:.6g})"


def _figures(found: Homotopy) -> dict[str, Any]:
    from plyfold.outline.curve import Curve

    return {
        "area": found.area,
        "lower": found.lower,
        "optimal": found.optimal,
        "winding_area": found.winding_area,
        "branch_points": found.branch_points,
        "cuts": found.arrangement.crossings[list(found.cuts)].tolist(),
        "loops": [
            {
                "sign": loop.sign,
                "parent": loop.parent,
                "area": found.area_of(loop),
                "points": loop.curve.points.tolist() if isinstance(loop.curve, Curve) else [],
            }
            for loop in found.loops
        ],
    }
