"""A film of the motion: the round disk unwinds onto the drawing, rises to the lifted surface, and goes back."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable
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
from plyfold.draw.depth_buffer import View
from plyfold.draw.placement import middle_and_size, natural_stretch
from plyfold.draw.render import Image, Mesh, shade
from plyfold.errors import InputError, PlyfoldError
from plyfold.io.saving import draft_in, refuse_existing, save_bytes

if TYPE_CHECKING:
    from plyfold.clock import Progress
    from plyfold.surface.lift import Surface

__all__ = ["FILMS", "save_film"]

_Frame = npt.NDArray[np.uint8]

_VIEW = View.of(-72.0, 52.0)
_PIXELS = 480
_PER_SECOND = 16
# Steps from the disk to the drawing and from there to the surface, and how long the film rests at these three, in
# steps.
_STEPS = 16
_REST = 12
# Share of the heights that flat sheets keep, so that they lie in their order.
_THICKNESS = 0.02


def save_film(
    surface: Surface, path: str | os.PathLike[str], force: bool = False, progress: Progress | None = None
) -> None:
    """Write the motion from the round disk to the drawing and the lifted surface, and back, as a GIF or MP4.

    Parameters
    ----------
    surface : Surface
    path : path
        Ending in ``.gif``, or ``.mp4``; for this the program ffmpeg must be installed.
    force : bool
        Replace an existing file.
    progress : callable, optional
        Called with a few words and the fraction done.

    Raises
    ------
    InputError
        If the ending is another one.
    PlyfoldError
        If the program that writes MP4 is not installed, or fails.
    PrecisionError
        If double precision cannot hold the disk.
    FileExistsError
        If the file exists and ``force`` is not set.

    Notes
    -----
    About a second for each of 33 frames. The surface is seen obliquely from above, as in :func:`plot_surface`, and
    sheets have their colours.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in FILMS:
        raise InputError(f"a film cannot be written as {suffix or 'a file without ending'}", hint="use .gif or .mp4")
    refuse_existing(path, force)
    if suffix == ".mp4":
        _require_ffmpeg()
    save_bytes(path, FILMS[suffix](_there_and_back(_frames(surface, progress))), force)


def _frames(surface: Surface, progress: Progress | None) -> list[_Frame]:
    """Return the frames from the disk to the surface."""
    motion = Motion(surface.unwrap())
    times = _eased(np.arange(2 * _STEPS + 1) / _STEPS)
    meshes = [_mesh(surface, motion, time) for time in times]
    paint = np.array([rgb(sheet_colour(sheet)) for sheet in range(surface.layering.immersion.n_sheets)])[surface.sheet]
    middle, reach = _window(meshes)
    frames = []
    for number, mesh in enumerate(meshes):
        if progress is not None:
            progress("drawing the film", number / len(meshes))
        low, high = mesh.box(_VIEW)
        image = shade(mesh, _VIEW, max(round(_PIXELS * (high - low).max() / (2 * reach)), 2), paint)
        frames.append(_drawn(image, mesh.vertices[np.append(surface.boundary, surface.boundary[0])], middle, reach))
    return frames


def _eased(times: Floats) -> Floats:
    """Let the motion start and end softly at each station."""
    whole = np.floor(times)
    share = times - whole
    return np.asarray(whole + share * share * (3 - 2 * share))


def _mesh(surface: Surface, motion: Motion, time: float) -> Mesh:
    middle, _ = middle_and_size(surface.vertices)
    _, size = middle_and_size(surface.vertices[:, :2])
    scale = np.array([1.0, 1.0, natural_stretch(surface.vertices)]) / size
    return Mesh((motion.at(float(time), _THICKNESS) - middle) * scale, surface.faces)


def _window(meshes: list[Mesh]) -> tuple[Floats, float]:
    """Return the middle and half the side of a square that all frames fit in, with room for shadows."""
    low = np.min([mesh.box(_VIEW)[0] for mesh in meshes], axis=0)
    high = np.max([mesh.box(_VIEW)[1] for mesh in meshes], axis=0)
    return (low + high) / 2, float(0.58 * (high - low).max())


def _drawn(image: Image, outline: Floats, middle: Floats, reach: float) -> _Frame:
    """Return one frame: the shaded image in the common window, and the curve where it is not hidden."""
    figure = Figure(figsize=(_PIXELS / 100, _PIXELS / 100), dpi=100, facecolor=PAPER)
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.imshow(image.colours, origin="lower", extent=image.extent, interpolation="antialiased")
    seen = np.where(image.hidden(outline)[:, None], np.nan, image.view.project(outline)[:, :2])
    axes.plot(*seen.T, color=INK, linewidth=1.2, solid_capstyle="round")
    axes.set(xlim=middle[0] + np.array([-reach, reach]), ylim=middle[1] + np.array([-reach, reach]))
    axes.axis("off")
    canvas.draw()  # type: ignore[no-untyped-call]
    return np.asarray(canvas.buffer_rgba())[..., :3].copy()  # type: ignore[no-untyped-call]


def _there_and_back(frames: list[_Frame]) -> list[tuple[_Frame, int]]:
    """Return frames with how many steps each is shown: a rest at the disk, the drawing and the surface."""
    shown = [(frame, 1 if number % _STEPS else _REST) for number, frame in enumerate(frames)]
    return shown + shown[-2:0:-1]


def _gif(shown: list[tuple[_Frame, int]]) -> bytes:
    pictures = [Picture.fromarray(frame).quantize(128) for frame, _ in shown]
    out = BytesIO()
    durations = [1000 * steps // _PER_SECOND for _, steps in shown]
    pictures[0].save(out, "GIF", save_all=True, append_images=pictures[1:], duration=durations, loop=0)
    return out.getvalue()


def _mp4(shown: list[tuple[_Frame, int]]) -> bytes:
    """Let ffmpeg write the film as H.264 in 4:2:0, which all players read, with its index first for browsers."""
    height, width = shown[0][0].shape[:2]
    raw = ("-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", str(_PER_SECOND), "-i", "-")
    coded = ("-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart")
    content = b"".join(frame.tobytes() * steps for frame, steps in shown)
    with draft_in(Path(tempfile.gettempdir()), ".mp4") as draft:
        command = ["ffmpeg", "-loglevel", "error", *raw, *coded, str(draft)]
        done = subprocess.run(command, input=content, capture_output=True, check=False)
        if done.returncode != 0:
            said = done.stderr.decode(errors="replace").strip().splitlines()
            raise PlyfoldError(f"ffmpeg failed: {said[-1] if said else done.returncode}", hint="write a .gif")
        return draft.read_bytes()


def _require_ffmpeg() -> None:
    if shutil.which("ffmpeg") is None:
        raise PlyfoldError(
            "an MP4 needs the program ffmpeg, which is not installed", hint="write a .gif, or install it"
        )


FILMS: dict[str, Callable[[list[tuple[_Frame, int]]], bytes]] = {".gif": _gif, ".mp4": _mp4}
