"""The colours of all pictures and pages, chosen in one place: the pages get them as CSS variables.

The sheets of a surface are told apart by hues that stay apart for colour-blind eyes (after Okabe and Ito [OI08]_);
winding numbers are an order, so they go from light to strong in one hue, and negative ones warn in red.

References
----------
.. [OI08] M. Okabe, K. Ito, "Color Universal Design: how to make figures and presentations that are friendly to
   colorblind people", 2008.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

__all__ = [
    "ACCENT",
    "BACK",
    "CLOTH_HIGH",
    "CLOTH_LOW",
    "CUSP",
    "INK",
    "LINE_ON_DARK",
    "OBSTRUCTION",
    "PALE",
    "PAPER",
    "SHEETS",
    "layer_colour",
    "mix",
    "page_style",
    "rgb",
    "sheet_colour",
    "text_colour",
    "winding_colour",
]

INK = "#1d2638"
PAPER = "#ffffff"
ACCENT = "#c8501e"
OBSTRUCTION = "#d1203a"
CUSP = "#7b2a86"

CLOTH_LOW = "#1f57a4"
CLOTH_HIGH = "#79b8ee"
BACK = "#e8a87c"
PALE = "#b4bccb"
LINE_ON_DARK = "#0b0f17"

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

# On a dark page winding numbers go from dim to bright.
_WINDING_AT_NIGHT = ("#1c3a5e", "#24568d", "#2f75ba", "#4a95da", "#78b6ec", "#abd4f3")
_NEGATIVE_AT_NIGHT = ("#54262c", "#823039", "#b04550", "#d56f73", "#f0a6a2")

_PAPER_AT_NIGHT = "#1e2430"
_INK_AT_NIGHT = "#e8ecf3"

# The names of the pages' variables: their colours on a light and on a dark page. Of what is behind a colour with eight
# digits, some is seen: the last two say how little.
_PAGE: Mapping[str, tuple[str, str]] = {
    "ink": (INK, _INK_AT_NIGHT),
    "soft": ("#566072", "#a8b2c2"),
    "paper": ("#fdfdfc", "#171c25"),
    "ground": ("#eef1f5", "#10141b"),
    "raised": (PAPER, _PAPER_AT_NIGHT),
    "panel": (f"{PAPER}e0", f"{_PAPER_AT_NIGHT}e6"),
    "edge": (f"{INK}21", f"{_INK_AT_NIGHT}26"),
    "shade": ("#0a0e1673", "#0a0e1673"),
    "strong": (CLOTH_LOW, CLOTH_HIGH),
    "on-strong": (PAPER, "#10141b"),
    "accent": (ACCENT, "#f29b6b"),
    "wrong": (OBSTRUCTION, "#ff6b78"),
    "cusp": (CUSP, "#d9a3e2"),
    "touch": ("#8f5f00", "#f2c55c"),
    "good": ("#10705a", "#6fd3b5"),
    "lit": ("#f2b632", "#d99a1c"),
    "dot": ("#cfd6e0", "#333c4b"),
    "centre": (PAPER, "#2c3444"),
    "rim": ("#e3e8ef", "#151a23"),
}


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


def page_style() -> str:
    """Return the colours of the pages as a style sheet: CSS variables for light pages and for dark ones.

    A page is as the system has it, unless an attribute ``data-theme`` says ``light`` or ``dark``. Shades of winding
    numbers, the colours of words on them, and the sheets' colours are variables with a list.

    Examples
    --------
    >>> page_style().splitlines()[:3]
    [':root, [data-theme="light"] {', '  color-scheme: light;', '  --ink: #1d2638;']
    """
    light, dark = (_variables(theme) for theme in (0, 1))
    by_system = ':root:not([data-theme="light"], :has([data-theme="light"]))'
    return (
        f':root, [data-theme="light"] {{\n  color-scheme: light;\n{light}}}\n\n'
        f'[data-theme="dark"] {{\n  color-scheme: dark;\n{dark}}}\n\n'
        f"@media (prefers-color-scheme: dark) {{ {by_system} {{\n  color-scheme: dark;\n{dark}}} }}\n\n"
    )


def _variables(theme: int) -> str:
    """Return the variables of a light (0) or dark (1) page."""
    winding, negative = ((_WINDING, _NEGATIVE), (_WINDING_AT_NIGHT, _NEGATIVE_AT_NIGHT))[theme]
    lists = {
        "winding": winding,
        "on-winding": map(text_colour, winding),
        "negative": negative,
        "on-negative": map(text_colour, negative),
        "sheets": map(sheet_colour, range(3 * len(SHEETS))),
    }
    values = {name: colours[theme] for name, colours in _PAGE.items()} | {k: " ".join(v) for k, v in lists.items()}
    return "".join(f"  --{name}: {value};\n" for name, value in values.items())


def _hex(channels: Sequence[float]) -> str:
    return "#" + "".join(f"{round(255 * min(max(channel, 0.0), 1.0)):02x}" for channel in channels)


def _contrast(first: str, second: str) -> float:
    """Return the contrast ratio of two colours, 1 to 21, as the Web Content Accessibility Guidelines define it."""
    darker, lighter = sorted((_luminance(first), _luminance(second)))
    return (lighter + 0.05) / (darker + 0.05)


def _luminance(colour: str) -> float:
    red, green, blue = (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in rgb(colour))
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue
