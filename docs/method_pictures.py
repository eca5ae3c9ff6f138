"""Rebuild the pictures of docs/immersion.md and docs/layering.md: ``python docs/method_pictures.py``."""

from __future__ import annotations

from panels import panels, titled

import plyfold as pf
from plyfold import draw
from plyfold.gallery import CURVES

MILNOR = pf.GaussCode.of(CURVES["milnor"].curve).to_curve()
UNLIFTABLE = CURVES["smallest-unliftable"].curve


def method() -> None:
    """Draw the whole way of Milnor's curve: one curve, two disks, four surfaces."""
    with panels("method", 2, 4, (13.5, 6.4)) as axes:
        ax = next(axes)
        draw.plot_arrangement(MILNOR, ax)
        titled(ax, "one curve")
        ax = next(axes)
        draw.plot_dual_tree(MILNOR, ax)
        titled(ax, "two choices, a and b")
        for number, immersion in enumerate(pf.immersions(MILNOR), 1):
            ax = next(axes)
            draw.plot_layout(immersion, ax)
            titled(ax, f"disk {number}, unwound")
        for number, immersion in enumerate(pf.immersions(MILNOR), 1):
            for layering in pf.layerings(immersion):
                ax = next(axes)
                draw.plot_layers(layering, ax)
                titled(ax, f"disk {number} in layers")


def cells() -> None:
    """Draw the cells with their winding numbers, and the tree over them."""
    with panels("method-tree", 1, 2, (11, 4.4)) as axes:
        for plot, title in (
            (lambda ax: draw.plot_arrangement(MILNOR, ax, borders=True), "cells, winding numbers and borders"),
            (lambda ax: draw.plot_dual_tree(MILNOR, ax), "the tree: two ways go up, a and b"),
        ):
            ax = next(axes)
            plot(ax)
            titled(ax, title)


def word() -> None:
    """Draw the word with its two bracketings."""
    with panels("method-word", 1, 1, (6, 3.6)) as axes:
        draw.plot_word(pf.blank_word(MILNOR), next(axes))


def disks() -> None:
    """Draw both immersions as disk layouts, and as they lie."""
    with panels("method-disks", 2, 2, (10, 7.4)) as axes:
        both = list(pf.immersions(MILNOR))
        for number, immersion in enumerate(both, 1):
            ax = next(axes)
            draw.plot_layout(immersion, ax)
            titled(ax, f"disk {number}, unwound")
        for number, immersion in enumerate(both, 1):
            ax = next(axes)
            draw.plot_immersion(immersion, ax)
            titled(ax, f"disk {number}, as it lies")


def levels() -> None:
    """Draw the layers, and a cut through them round the crossing with most sheets."""
    layering = pf.find_embedding(MILNOR)
    arranged = layering.immersion.arrangement
    tops = [
        int(arranged.winding[arranged.left_cell[visit]])
        for visit in map(int, arranged.border_before[arranged.first_visits])
    ]
    highest = tops.index(max(tops))
    with panels("method-levels", 1, 2, (11, 3.6)) as axes:
        draw.plot_layers(layering, next(axes))
        ax = next(axes)
        draw.plot_levels(layering, highest, ax)
        titled(ax, f"round crossing {highest}")


def refused() -> None:
    """Draw the smallest curve of which one disk lifts and one does not."""
    lies, lifts = pf.immersions(UNLIFTABLE)
    with panels("method-refused", 1, 2, (12, 6.4)) as axes:
        ax = next(axes)
        draw.plot_obstruction(lies, ax=ax)
        ax = next(axes)
        draw.plot_layers(pf.find_layering(lifts), ax)
        titled(ax, "the other disk lifts")


if __name__ == "__main__":
    for picture in (method, cells, word, disks, levels, refused):
        picture()
