"""Pictures of least homotopies: the loops that a curve is cut into, how often cells are swept; and the contraction."""

from __future__ import annotations

import base64
import html
import os
from collections.abc import Iterator, Sequence
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from PIL import Image as Picture

from plyfold.arrangement.arrangement import CurveLike
from plyfold.colours import ACCENT, INK, PAPER, mix, page_style, sheet_colour, text_colour, winding_colour
from plyfold.draw.canvas import blank, dots, line, region, write, write_below
from plyfold.draw.film import FILMS
from plyfold.draw.placement import Frame, cell_rings, closed, drawn_points, label_circle, line_weight
from plyfold.errors import InputError
from plyfold.homotopy.contraction import Contraction, contraction_of
from plyfold.homotopy.homotopy import Homotopy, Loop, least_homotopy
from plyfold.io.saving import refuse_existing, save_bytes
from plyfold.options import refuse_unless_count
from plyfold.outline.curve import Curve

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["draw_contraction", "plot_homotopy", "save_contraction"]

_Frame = npt.NDArray[np.uint8]

_SIZE, _FRAMES = 480, 41
_LARGEST, _MOST_FRAMES = 1600, 101


def plot_homotopy(subject: CurveLike | Homotopy, ax: Axes | None = None) -> Axes:
    """Draw the loops that a curve is cut into to contract, each in a colour, and how often each cell is swept.

    Parameters
    ----------
    subject : Homotopy, or Curve, array_like of shape (n, 2), shapely geometry or Arrangement
        Its least homotopy is found if need be. Loops whose disk lies on their right are dashed; dots mark the cuts.
    ax : matplotlib Axes, optional
        Where to draw; by default on a new figure.

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    PlyfoldError
        If only the code of the curve is known.

    Examples
    --------
    >>> ax = plot_homotopy([(0, 0), (2, 2), (2, 0), (0, 2)])
    >>> [text.get_text() for text in ax.texts[:2]]
    ['1', '1']
    """
    found = subject if isinstance(subject, Homotopy) else least_homotopy(subject)
    arranged = found.arrangement
    frame, weight = Frame(drawn_points(arranged)), line_weight(arranged.n_crossings)
    axes = blank(ax)
    for cell in np.flatnonzero(found.swept).tolist():
        colour = _cloth_colour(found.loops, cell)
        region(axes, cell_rings(arranged, cell, frame), colour)
        _write_count(axes, frame, label_circle(arranged, cell), str(found.swept[cell]), text_colour(colour))
    for number, loop in enumerate(found.loops):
        if isinstance(loop.curve, Curve):
            style = "-" if loop.sign > 0 else (0, (4, 1.2))
            line(axes, closed(frame(loop.curve.points)), sheet_colour(number), 2.4 * weight, linestyle=style)
    cuts = frame(arranged.crossings[list(found.cuts)])
    dots(axes, cuts, ACCENT, 30 * weight**2, edgecolors=PAPER, linewidths=0.8 * weight, zorder=4)
    if not found.optimal:
        write_below(axes, f"at most {found.area:.6g}, at least {found.lower:.6g}")
    return axes


def _cloth_colour(loops: Sequence[Loop], cell: int) -> str:
    """Return the colour of what loops sweep over a cell: the front of their cloth, its back, or half of both."""
    counts = [int(loop.winding[cell]) for loop in loops]
    front, back = (sum(count for count in counts if count * sign > 0) for sign in (1, -1))
    shades = [winding_colour(count) for count in (front, back) if count] or [PAPER]
    return mix(shades[0], shades[-1], 0.5)


def _write_count(axes: Axes, frame: Frame, circle: tuple[float, float, float], count: str, colour: str) -> None:
    x, y, radius = circle
    size = min(12.0, 260 * radius / frame.size)
    if size >= 4:
        write(axes, frame((x, y))[0], count, size, color=colour)


def save_contraction(  # noqa: PLR0913 - options
    subject: CurveLike | Homotopy,
    path: str | os.PathLike[str],
    force: bool = False,
    *,
    title: str = "plyfold",
    size: int = _SIZE,
    frames: int = _FRAMES,
) -> None:
    """Write the contraction of a curve as a film: loop after loop shrinks through its disk, and sweeps each place once.

    Parameters
    ----------
    subject : Homotopy, or Curve, array_like of shape (n, 2), shapely geometry or Arrangement
    path : path
        Ending in ``.html`` for a page with a slider, in ``.gif``, or in ``.mp4``, for which the program ffmpeg must be
        installed.
    force : bool, optional
        Replace an existing file.
    title : str, optional
        Heading of the page.
    size : int, optional
        Width and height in pixels, up to 1600; for MP4 it must be even.
    frames : int, optional
        How many pictures there are, from 3 to 101.

    Raises
    ------
    InputError
        If the ending is another one, the size or number of frames cannot be, or only the code of the curve is known.
    FileExistsError
        If the file exists and ``force`` is not set.

    Notes
    -----
    Where a loop has its disk on the left, the cloth shows its front, in blue; where it has it on the right, its back,
    in red. Cost: about a tenth of a second for each frame, and an unwound disk for each loop.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save_contraction([(0, 0), (2, 2), (2, 0), (0, 2)], f"{folder}/eight.gif", size=60, frames=5)
    ...     with Picture.open(f"{folder}/eight.gif") as film:
    ...         film.size
    (60, 60)
    """
    suffix = Path(path).suffix.lower()
    if suffix not in {".html", *FILMS}:
        what = suffix or "a file without ending"
        raise InputError(f"a contraction cannot be written as {what}", hint="use .html, .gif or .mp4")
    refuse_unless_count("size", size, _LARGEST)
    refuse_unless_count("frames", frames, _MOST_FRAMES)
    refuse_existing(path, force)
    found = subject if isinstance(subject, Homotopy) else least_homotopy(subject)
    contraction = contraction_of(found)
    times = np.linspace(0, 1, max(frames, 3)).tolist()
    drawn = list(_frames(contraction, times, size))
    swept = [contraction.swept(time) for time in times]
    save_bytes(path, FILMS[suffix](drawn) if suffix in FILMS else _page(drawn, swept, title), force)


def _frames(contraction: Contraction, times: list[float], size: int) -> Iterator[_Frame]:
    for time in times:
        figure = Figure(figsize=(size / 100, size / 100), dpi=100, facecolor=PAPER)
        canvas = FigureCanvasAgg(figure)
        axes = figure.add_axes((0, 0, 1, 1), xlim=(-0.55, 0.55), ylim=(-0.55, 0.55))
        axes.set_axis_off()
        draw_contraction(contraction, time, axes)
        canvas.draw()  # type: ignore[no-untyped-call]
        yield np.asarray(canvas.buffer_rgba())[..., :3].copy()  # type: ignore[no-untyped-call]


def draw_contraction(contraction: Contraction, time: float, axes: Axes) -> None:
    """Draw what is left of the cloth and the curve at a time from 0 to 1, in a picture of size 1 around the origin."""
    found, now = contraction.homotopy, contraction.moment(time)
    frame = Frame(drawn_points(found.arrangement))
    waiting = [found.loops[number] for number in contraction.order[now.loop + 1 :]]
    for cell in range(1, found.arrangement.n_cells):
        if any(loop.winding[cell] for loop in waiting):
            region(axes, cell_rings(found.arrangement, cell, frame), _cloth_colour(waiting, cell))
    shrinking, moving = contraction.shrinking[now.loop], found.loops[contraction.order[now.loop]]
    rest = [frame(polygon) for polygon in shrinking.rest_at(now.size)]
    colour = winding_colour(2 * moving.sign)
    axes.add_collection(PolyCollection(rest, facecolors=colour, edgecolors=colour, linewidths=0.4, zorder=1.5))
    for loop in waiting:
        if isinstance(loop.curve, Curve):
            line(axes, closed(frame(loop.curve.points)), INK, 1.6)
    pieces = [frame(piece) for piece in shrinking.curve_at(now.size)]
    axes.add_collection(LineCollection(pieces, colors=ACCENT, linewidths=2.2, capstyle="round", zorder=3))
    dots(axes, frame(shrinking.points[0]), ACCENT, 16, zorder=4)


_PAGE = """\
<!doctype html>
<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>{style}
body {{ margin: 2rem auto; max-width: {size}px; font: 1rem system-ui; color: var(--ink); background: var(--paper); }}
img, input {{ width: 100%; }}
img {{ background: #fff; border-radius: 6px; }}</style>
<h1>{title}</h1>
<img alt="the curve on its way">
<input type="range" min="0" max="{last}" value="0" aria-label="time">
<p>swept: <output></output> of {area}</p>
<script>
const frames = {frames}, swept = {swept};
const image = document.querySelector("img"), slider = document.querySelector("input");
function show() {{
  image.src = "data:image/png;base64," + frames[slider.value];
  document.querySelector("output").textContent = swept[slider.value];
}}
slider.addEventListener("input", show);
show();
</script>
</html>
"""


def _page(frames: list[_Frame], swept: list[float], title: str) -> bytes:
    """Return a page with a slider over the frames."""
    pictures = [_png(frame) for frame in frames]
    text = _PAGE.format(
        title=html.escape(title),
        style=page_style(),
        size=frames[0].shape[1],
        last=len(frames) - 1,
        area=f"{swept[-1]:.6g}",
        frames=pictures,
        swept=[f"{area:.6g}" for area in swept],
    )
    return text.encode()


def _png(frame: _Frame) -> str:
    out = BytesIO()
    Picture.fromarray(frame).quantize(64).save(out, "PNG", optimize=True)
    return base64.b64encode(out.getvalue()).decode()
