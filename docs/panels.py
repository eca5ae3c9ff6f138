"""Figures of the documentation in panels, saved as small files."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

from plyfold.colours import INK
from plyfold.draw.canvas import blank
from plyfold.io.saving import save_bytes

IMAGES = Path(__file__).parent / "images"


@contextmanager
def panels(name: str, rows: int, columns: int, size: tuple[float, float]) -> Iterator[Iterator[Axes]]:
    """Give the panels of a figure one by one, row by row, and save it in the end."""
    figure = Figure(figsize=size, layout="constrained")
    yield iter([blank(ax) for ax in figure.subplots(rows, columns, squeeze=False).ravel()])
    save_small(figure, name, 125)


def titled(ax: Axes, title: str) -> None:
    """Put a title over a panel."""
    ax.set_title(title, fontsize=10, color=INK)


def save_small(figure: Figure, name: str, dots_per_inch: int) -> None:
    """Save a figure among the images, in 256 colours."""
    drawn, small = BytesIO(), BytesIO()
    figure.savefig(drawn, dpi=dots_per_inch, facecolor="white")
    Image.open(drawn).convert("RGB").quantize(256).save(small, "png", optimize=True)
    save_bytes(IMAGES / f"{name}.png", small.getvalue(), force=True)
