"""Outlines made of Bézier curves and elliptic arcs, and the polylines that stand for them.

A chord over a parameter step h of a curve P is nowhere farther from it than h² max|P''| / 8. Both kinds of segment have
an easy bound on P'', so each is cut until this bound is within the tolerance.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plyfold.arrays import Floats

__all__ = ["Bezier", "DrawnPath", "EllipticArc", "sample_points"]

_SAMPLES = 16


@dataclass(frozen=True, eq=False)
class Bezier:
    """A Bézier curve of any degree; degree 1 is a straight edge.

    Parameters
    ----------
    controls : ndarray, shape (degree + 1, 2)
        Control points.
    """

    controls: Floats

    @property
    def end(self) -> Floats:
        """The last point, shape (2,)."""
        return np.asarray(self.controls[-1])

    def transformed(self, matrix: Floats, shift: Floats) -> Bezier:
        """Return the curve under x ↦ matrix x + shift."""
        return Bezier(self.controls @ matrix.T + shift)

    def at(self, parameters: Floats) -> Floats:
        """Return the points at parameters from 0 to 1, shape (m, 2), by de Casteljau's scheme."""
        t = parameters[:, None, None]
        points = np.broadcast_to(self.controls, (len(parameters), *self.controls.shape))
        while points.shape[1] > 1:
            points = (1 - t) * points[:, :-1] + t * points[:, 1:]
        return points[:, 0]

    def flattened(self, tolerance: float) -> list[Floats]:
        """Return the vertices after the first point; straight stretches get few, bends many."""
        origin = self.controls[0]
        waiting, vertices = [self.controls - origin], []  # near zero, so that rounding cannot stop the halving
        while waiting:
            controls = waiting.pop()
            if _chord_error(controls) <= tolerance:
                vertices.append(origin + controls[-1])
            else:
                waiting.extend(reversed(_halves(controls)))
        return [*vertices[:-1], self.end]


@dataclass(frozen=True, eq=False)
class EllipticArc:
    """An arc of an ellipse: center + axes @ (cos t, sin t) for t from start_angle, over sweep.

    Parameters
    ----------
    center : ndarray, shape (2,)
    axes : ndarray, shape (2, 2)
        Its columns are two conjugate radii.
    start_angle, sweep : float
        In radians; a negative sweep runs clockwise in the plane of the columns.
    end : ndarray, shape (2,)
        The last point, free of rounding.
    """

    center: Floats
    axes: Floats
    start_angle: float
    sweep: float
    end: Floats

    def transformed(self, matrix: Floats, shift: Floats) -> EllipticArc:
        """Return the arc under x ↦ matrix x + shift."""
        center, end = matrix @ self.center + shift, matrix @ self.end + shift
        return EllipticArc(center, matrix @ self.axes, self.start_angle, self.sweep, end)

    def at(self, parameters: Floats) -> Floats:
        """Return the points at parameters from 0 to 1, shape (m, 2)."""
        angles = self.start_angle + self.sweep * parameters
        return self.center + np.column_stack([np.cos(angles), np.sin(angles)]) @ self.axes.T

    def flattened(self, tolerance: float) -> list[Floats]:
        """Return the vertices after the first point, at equal steps of the angle."""
        longest_radius = float(np.linalg.norm(self.axes, 2))
        steps = max(1, int(np.ceil(abs(self.sweep) * np.sqrt(longest_radius / (8 * tolerance)))))
        return [*self.at(np.arange(1, steps) / steps), self.end]


@dataclass(frozen=True, eq=False)
class DrawnPath:
    """One connected piece of a drawing, open or closed.

    Parameters
    ----------
    start : ndarray, shape (2,)
    segments : tuple of Bezier or EllipticArc
        Each begins where the one before ends.
    closed : bool
        Whether the end is to be joined to the start.
    """

    start: Floats
    segments: tuple[Bezier | EllipticArc, ...]
    closed: bool

    def flattened(self, tolerance: float) -> Floats:
        """Return the vertices of a polyline nowhere farther from the outline than ``tolerance``, shape (n, 2)."""
        return np.array([self.start, *(vertex for piece in self.segments for vertex in piece.flattened(tolerance))])

    def nodes(self, tolerance: float) -> list[int]:
        """Return which vertices of the polyline are the start and the ends of the segments."""
        steps = [len(piece.flattened(tolerance)) for piece in self.segments]
        return [0, *np.cumsum(steps).tolist()]


def sample_points(outlines: list[DrawnPath]) -> Floats:
    """Return points along all segments of the outlines, dense enough to measure their size; shape (n, 2)."""
    parameters = np.linspace(0, 1, _SAMPLES + 1)
    return np.concatenate([piece.at(parameters) for outline in outlines for piece in outline.segments])


def _chord_error(controls: Floats) -> float:
    """Bound the distance of the Bézier curve from its chord: |P''| ≤ d (d − 1) · the longest second difference."""
    degree = len(controls) - 1
    bends = np.diff(controls, 2, axis=0)
    return degree * (degree - 1) / 8 * float(np.hypot(*bends.T).max(initial=0.0))


def _halves(controls: Floats) -> tuple[Floats, Floats]:
    left, right = [controls[0]], [controls[-1]]
    while len(controls) > 1:
        controls = (controls[:-1] + controls[1:]) / 2
        left.append(controls[0])
        right.append(controls[-1])
    return np.array(left), np.array(right[::-1])
