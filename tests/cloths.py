"""The energy of a surface's heights, when all else that heights are solved with is free."""

import numpy as np

from plyfold.surface.energy import cloth_of
from plyfold.surface.grading import cloth_mesh
from plyfold.surface.heights import DEFAULT_STIFFNESS


def cloth_over(points, mesh, stiffness=DEFAULT_STIFFNESS, flat=1.0):
    """The cloth of a surface's heights, with those at the surface's own vertices first."""
    return cloth_of(cloth_mesh(points, mesh, stiffness), mesh, stiffness, flat)


def energy_matrix(points, mesh, stiffness=DEFAULT_STIFFNESS, flat=1.0):
    """The full matrix K of ½ zᵀKz: the least energy with heights z at the surface's own vertices."""
    whole = cloth_over(points, mesh, stiffness, flat).stiffness.toarray()
    own, added = np.split(np.arange(len(whole)), [len(mesh.level)])
    inner = np.linalg.solve(whole[np.ix_(added, added)], whole[np.ix_(added, own)])
    return whole[np.ix_(own, own)] - whole[np.ix_(own, added)] @ inner
