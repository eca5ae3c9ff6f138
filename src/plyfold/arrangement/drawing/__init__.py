"""Drawing a round closed curve with a given signed Gauss code."""

from plyfold.arrangement.drawing.smooth import draw_code

__all__ = ["draw_code"]
