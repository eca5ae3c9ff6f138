"""A film of the motion: the round disk unwinds onto the drawing, rises to the lifted surface, and goes back."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image as Picture

from plyfold.arrays import Floats
from plyfold.colours import INK, PAPER, rgb, sheet_colour
from plyfold.disk.motion import Motion
from plyfold.draw.depth_buffer import Pixels, View
from plyfold.draw.placement import closed, middle_and_size, natural_stretch
from plyfold.draw.render import Image, Mesh, shade
from plyfold.errors import InputError, PlyfoldError
from plyfold.io.saving import draft_in, refuse_existing, save_bytes
from plyfold.options import refuse_unless_count

if TYPE_CHECKING:
    from plyfold.clock import Progress
    from plyfold.surface.lift import Surface

__all__ = ["FILMS", "refuse_film", "save_film"]

_Frame = npt.NDArray[np.uint8]

_VIEW = View.of(-72.0, 52.0)
# Seconds from the disk to the surface, and of each rest at the disk, the drawing and the surface.
_SECONDS = 2.0
_REST = 0.75
_FRAMES, _SIZE = 33, 480
_FEWEST_FRAMES = 3
# More than 50 in a second are not for GIF.
_MOST_FRAMES = 101
_SMALLEST, _LARGEST = 16, 1600
# Share of the heights that flat sheets keep, so that they lie in their order.
_THICKNESS = 0.02
# The palette is made from every so many pixels each way.
_PALETTE_STEP = 4
# Colours so near the paper's are not in it.
_PAPER_ALONE = 5


def save_film(  # noqa: PLR0913 - options
    surface: Surface,
    path: str | os.PathLike[str],
    force: bool = False,
    progress: Progress | None = None,
    *,
    size: int = _SIZE,
    frames: int = _FRAMES,
) -> None:
    """Write the motion from the round disk to the drawing and the lifted surface, and back, as a GIF or MP4.

    Parameters
    ----------
    surface : Surface
    path : path
        Ending in ``.gif``, or ``.mp4``; for this the program ffmpeg must be installed.
    force : bool, optional
        Replace an existing file.
    progress : callable, optional
        Called with a few words and the fraction done.
    size : int, optional
        Width and height in pixels, from 16 to 1600; for MP4 it must be even.
    frames : int, optional
        How many pictures there are from the disk to the surface, from 3 to 101; on the way back they are shown again.
        The film takes as long with many as with few: there and back, with rests, seven seconds.

    Raises
    ------
    InputError
        If the ending is another one, or the size or number of frames cannot be.
    PlyfoldError
        If the program that writes MP4 is not installed, or fails.
    PrecisionError
        If double precision cannot hold the disk.
    FileExistsError
        If the file exists and ``force`` is not set.

    Notes
    -----
    Cost: about a twentieth of a second for each frame of 480 pixels. The surface is seen obliquely from above, as in
    :func:`plot_surface`, and sheets have their colours.

    Examples
    --------
    >>> import tempfile
    >>> from plyfold import lift
    >>> surface = lift([(0, 0), (2, 0), (2, 1), (0, 1)], triangles=50)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save_film(surface, f"{folder}/sheet.gif", size=60, frames=5)
    ...     with Picture.open(f"{folder}/sheet.gif") as film:
    ...         film.size
    (60, 60)
    """
    refuse_film(path, size, frames)
    suffix = Path(path).suffix.lower()
    refuse_existing(path, force)
    if suffix == ".mp4":
        _require_ffmpeg()
    drawn = []
    for number, frame in enumerate(_frames(surface, size, frames)):
        if progress is not None:
            progress("drawing the film", number / frames)
        drawn.append(frame)
    save_bytes(path, FILMS[suffix](drawn), force)


def refuse_film(path: str | os.PathLike[str], size: int = _SIZE, frames: int = _FRAMES) -> None:
    """Raise InputError if no film can have this ending, size in pixels and number of frames.

    Examples
    --------
    >>> refuse_film("ramp.gif", size=8)
    Traceback (most recent call last):
    plyfold.errors.InputError: the size of a film must be from 16 to 1,600 pixels, not 8
    """
    suffix = Path(path).suffix.lower()
    if suffix not in FILMS:
        raise InputError(f"a film cannot be written as {suffix or 'a file without ending'}", hint="use .gif or .mp4")
    refuse_unless_count("size", size)
    refuse_unless_count("frames", frames)
    if not _SMALLEST <= size <= _LARGEST:
        raise InputError(f"the size of a film must be from {_SMALLEST} to {_LARGEST:,} pixels, not {size:,}")
    if not _FEWEST_FRAMES <= frames <= _MOST_FRAMES:
        raise InputError(f"a film must have from {_FEWEST_FRAMES} to {_MOST_FRAMES} frames, not {frames:,}")
    if suffix == ".mp4" and size % 2:
        raise InputError(f"the size of an MP4 must be even, not {size}", hint=f"use {size + 1}, or write a .gif")


def _frames(surface: Surface, size: int, frames: int) -> Iterator[_Frame]:
    """Yield the frames from the disk to the surface."""
    motion = Motion(surface.unwrap())
    meshes = [_mesh(surface, motion, time) for time in _times(frames)]
    paint = np.array([rgb(sheet_colour(sheet)) for sheet in range(surface.layering.immersion.n_sheets)])[surface.sheet]
    paper = _Paper(_window(meshes, size))
    for mesh in meshes:
        image = shade(mesh, _VIEW, paper.pixels, paint)
        yield paper.draw(image, closed(mesh.vertices[surface.boundary]))


def _times(frames: int) -> Floats:
    """Return the times of the frames; the motion starts and ends softly at the disk, the drawing and the surface."""
    drawing = _drawing_at(frames)
    share = np.concatenate([np.arange(drawing) / drawing, np.linspace(0, 1, frames - drawing)])
    return np.asarray((np.arange(frames) >= drawing) + share * share * (3 - 2 * share))


def _drawing_at(frames: int) -> int:
    """Return the number of the frame in the middle, the drawing."""
    return frames // 2


def _mesh(surface: Surface, motion: Motion, time: float) -> Mesh:
    middle, _ = middle_and_size(surface.vertices)
    _, size = middle_and_size(surface.vertices[:, :2])
    scale = np.array([1.0, 1.0, natural_stretch(surface.vertices)]) / size
    return Mesh((motion.at(float(time), _THICKNESS) - middle) * scale, surface.faces)


def _window(meshes: list[Mesh], size: int) -> Pixels:
    """Return the pixels of a square that all frames fit in, with room for shadows."""
    low = np.min([mesh.box(_VIEW)[0] for mesh in meshes], axis=0)
    high = np.max([mesh.box(_VIEW)[1] for mesh in meshes], axis=0)
    reach = 0.58 * (high - low).max()
    return Pixels((low + high) / 2 - reach, float(2 * reach / size), size, size)


def _paper() -> npt.NDArray[np.uint8]:
    """Return red, green and blue of the paper."""
    return np.asarray(np.rint(255 * np.array(rgb(PAPER))), dtype=np.uint8)


class _Paper:
    """The window that all frames are drawn in, with a line that is kept from one to the next."""

    def __init__(self, pixels: Pixels) -> None:
        self.pixels = pixels
        self.canvas = FigureCanvasAgg(Figure(figsize=(pixels.columns / 100, pixels.rows / 100), dpi=100))
        axes = self.canvas.figure.add_axes((0, 0, 1, 1), xlim=pixels.extent[:2], ylim=pixels.extent[2:])
        (self.line,) = axes.plot([], [], color=INK, linewidth=pixels.columns / 400, solid_capstyle="round")

    def draw(self, image: Image, outline: Floats) -> _Frame:
        """Return one frame: the shaded image, and the curve where it is not hidden."""
        renderer = self.canvas.get_renderer()  # type: ignore[no-untyped-call]
        drawn = np.asarray(renderer.buffer_rgba())
        drawn[..., :3], drawn[..., 3] = _paper(), 255
        self._lay(image, drawn[::-1, :, :3])
        self.line.set_data(*np.where(image.hidden(outline)[:, None], np.nan, image.view.project(outline)[:, :2]).T)
        self.line.draw(renderer)
        return drawn[..., :3].copy()

    def _lay(self, image: Image, paper: _Frame) -> None:
        """Lay an image on paper; its pixels are some of the paper's."""
        rows, columns = image.colours.shape[:2]
        column, row = np.rint((image.seen.pixels.origin - self.pixels.origin) / self.pixels.size).astype(int)
        part = paper[row : row + rows, column : column + columns]
        colour, opacity = image.colours[..., :3], image.colours[..., 3:]
        part[:] = np.rint(255 * colour * opacity + part * (1 - opacity))


@dataclass(frozen=True)
class _Showing:
    """The number of a frame, and whether the film rests at it."""

    number: int
    rests: bool


def _there_and_back(frames: int) -> list[_Showing]:
    """Return the frames of the film in their order: it rests at the disk, the drawing and the surface."""
    there = [_Showing(number, number in (0, _drawing_at(frames), frames - 1)) for number in range(frames)]
    return there + there[-2:0:-1]


def _gif(frames: list[_Frame]) -> bytes:
    """Write a GIF with one palette for all frames."""
    palette = _palette(frames)
    pictures = [Picture.fromarray(frame).quantize(palette=palette, dither=Picture.Dither.NONE) for frame in frames]
    step = 1000 * _SECONDS / (len(frames) - 1)
    shown = _there_and_back(len(frames))
    durations = [round(max(1000 * _REST, step) if showing.rests else step) for showing in shown]
    first, *others = (pictures[showing.number] for showing in shown)
    out = BytesIO()
    first.save(out, "GIF", save_all=True, append_images=others, duration=durations, loop=0, disposal=1, optimize=False)
    return out.getvalue()


def _palette(frames: list[_Frame]) -> Picture.Image:
    """Return the paper and colours that stand for those of some pixels; common ones count more, by their roots.

    None is nearly the paper, which would take its place where Pillow rounds.
    """
    few = np.concatenate([frame[::_PALETTE_STEP, ::_PALETTE_STEP].reshape(-1, 3) for frame in frames])
    numbers, counts = np.unique(few.astype(np.int32) @ (1 << 16, 1 << 8, 1), return_counts=True)
    numbers = np.repeat(numbers, np.sqrt(counts).astype(int))
    colours = np.stack([numbers >> 16, numbers >> 8 & 255, numbers & 255], axis=-1).astype(np.uint8)
    chosen = np.array(Picture.fromarray(colours[None]).quantize(255).getpalette()).reshape(-1, 3)
    apart = np.abs(chosen - _paper().astype(int)).max(axis=1) > _PAPER_ALONE
    palette = Picture.new("P", (1, 1))
    palette.putpalette(np.vstack([_paper(), chosen[apart]]).astype(np.uint8).tobytes())
    return palette


def _mp4(frames: list[_Frame]) -> bytes:
    """Let ffmpeg write the film as H.264 in 4:2:0, which all players read, with its index first for browsers."""
    height, width = frames[0].shape[:2]
    rate = (len(frames) - 1) / _SECONDS
    raw = ("-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", str(rate), "-i", "-")
    coded = ("-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart")
    with draft_in(Path(tempfile.gettempdir()), ".mp4") as draft, tempfile.TemporaryFile() as content:
        for showing in _there_and_back(len(frames)):
            for _ in range(max(round(_REST * rate), 1) if showing.rests else 1):
                content.write(frames[showing.number].data)
        content.seek(0)
        command = ["ffmpeg", "-loglevel", "error", *raw, *coded, str(draft)]
        done = subprocess.run(command, stdin=content, capture_output=True, check=False)
        if done.returncode != 0:
            said = done.stderr.decode(errors="replace").strip().splitlines()
            raise PlyfoldError(f"ffmpeg failed: {said[-1] if said else done.returncode}", hint="write a .gif")
        return draft.read_bytes()


def _require_ffmpeg() -> None:
    if shutil.which("ffmpeg") is None:
        raise PlyfoldError(
            "an MP4 needs the program ffmpeg, which is not installed", hint="write a .gif, or install it"
        )


FILMS: dict[str, Callable[[list[_Frame]], bytes]] = {".gif": _gif, ".mp4": _mp4}
"""How a film is written, by ending."""
