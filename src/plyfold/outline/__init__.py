"""Closed curves: points, strokes, and what was changed in them (the self-crossing loop of §2.1 of the paper)."""
