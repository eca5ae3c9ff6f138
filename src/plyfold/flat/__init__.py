"""The cloth laid flat: triangles, pieces and multiplicities of an immersed disk (§2.2 of the paper)."""

from plyfold.flat.coverage import Covered, coverage
from plyfold.flat.decompose import decompose
from plyfold.flat.triangulate import triangulate

__all__ = ["Covered", "coverage", "decompose", "triangulate"]
