"""The colours of all pictures, chosen in one place.

The sheets of a surface are told apart by hues that stay apart for colour-blind eyes (after Okabe and Ito [OI08]_);
winding numbers are an order, so they go from light to strong in one hue, and negative ones warn in red.

References
----------
.. [OI08] M. Okabe, K. Ito, "Color Universal Design: how to make figures and presentations that are friendly to
   colorblind people", 2008.
"""

from __future__ import annotations

from collections.abc import Sequence

__all__ = [
    "ACCENT",
    "BACK",
    "CLOTH_HIGH",
    "CLOTH_LOW",
    "INK",
    "OBSTRUCTION",
    "PAPER",
    "SHEETS",
    "layer_colour",
    "mix",
    "rgb",
    "sheet_colour",
    "text_colour",
    "winding_colour",
]

INK = "#1d2638"
PAPER = "#ffffff"
ACCENT = "#c8501e"
OBSTRUCTION = "#d1203a"

CLOTH_LOW = "#1f57a4"
CLOTH_HIGH = "#79b8ee"
BACK = "#e8a87c"

SHEETS = (
    "#2f7fc1",
    "#eaa221",
    "#1f9e7a",
    "#cf7fae",
    "#7cc3ea",
    "#d4582a",
    "#e9d94f",
    "#63539f",
)

_WINDING = ("#dcebf8", "#abcff1", "#76aee4", "#4889d0", "#2768b0", "#134886")
_NEGATIVE = ("#fbd9d6", "#f2a49d", "#dd6a66", "#bf3a44", "#9b1c30")
_LAYERS = ("#1b4f98", "#bfe3f2")


def rgb(colour: str) -> tuple[float, float, float]:
    """Return the red, green and blue of a colour ``"#rrggbb"``, each from 0 to 1.

    Examples
    --------
    >>> rgb("#ff0033")
    (1.0, 0.0, 0.2)
    """
    red, green, blue = (int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5))
    return red, green, blue


def mix(first: str, second: str, share: float) -> str:
    """Return the colour that is ``share`` of the way from the first colour to the second.

    Examples
    --------
    >>> mix("#000000", "#ffffff", 0.2)
    '#333333'
    """
    return _hex([a + share * (b - a) for a, b in zip(rgb(first), rgb(second), strict=True)])


def winding_colour(winding: int) -> str:
    """Return the fill of a cell: white for 0, stronger blues for 1, 2, 3, ..., reds for -1, -2, ....

    The last shade stands for everything beyond it, and the colour of a number does not depend on the picture.

    Examples
    --------
    >>> winding_colour(0), winding_colour(1), winding_colour(-1)
    ('#ffffff', '#dcebf8', '#fbd9d6')
    """
    if winding == 0:
        return PAPER
    shades = _WINDING if winding > 0 else _NEGATIVE
    return shades[min(abs(int(winding)), len(shades)) - 1]


def sheet_colour(sheet: int) -> str:
    """Return the colour of a sheet; after the last hue they come round again, first paler and then darker.

    Examples
    --------
    >>> sheet_colour(0), sheet_colour(8)
    ('#2f7fc1', '#86b5db')
    """
    turn, hue = divmod(int(sheet), len(SHEETS))
    other, share = ((PAPER, 0.0), (PAPER, 0.42), (INK, 0.38))[turn % 3]
    return mix(SHEETS[hue], other, share)


def layer_colour(level: int, levels: int) -> str:
    """Return the colour of a level, counted from 1 at the bottom (deep) to ``levels`` at the top (light).

    Examples
    --------
    >>> layer_colour(1, 3), layer_colour(3, 3)
    ('#1b4f98', '#bfe3f2')
    """
    return mix(*_LAYERS, (level - 1) / max(levels - 1, 1))


def text_colour(background: str) -> str:
    """Return ink or white, whichever has the better contrast on the background.

    Examples
    --------
    >>> text_colour("#ffffff"), text_colour("#12467f")
    ('#1d2638', '#ffffff')
    """
    ink, paper = (_contrast(colour, background) for colour in (INK, PAPER))
    return INK if ink >= paper else PAPER


def _hex(channels: Sequence[float]) -> str:
    return "#" + "".join(f"{round(255 * min(max(channel, 0.0), 1.0)):02x}" for channel in channels)


def _contrast(first: str, second: str) -> float:
    """Return the contrast ratio of two colours, 1 to 21, as the Web Content Accessibility Guidelines define it."""
    darker, lighter = sorted((_luminance(first), _luminance(second)))
    return (lighter + 0.05) / (darker + 0.05)


def _luminance(colour: str) -> float:
    red, green, blue = (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in rgb(colour))
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue
