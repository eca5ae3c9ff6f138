"""What a mesh file says of an unwound disk."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrays import Floats
from plyfold.colours import sheet_colour
from plyfold.disk.motion import Motion
from plyfold.io.mesh.model import DETAIL, Material, Model, size_of

if TYPE_CHECKING:
    from plyfold.disk.unwrap import UnwoundDisk

__all__ = ["model_of_disk", "shapes_of_disk"]

# Shapes from the flat drawing to the disk are so many that no cloth folds over on the straight way between them, up to
# a number; larger surfaces do without those between.
_MOST_SHAPES = 17
_MANY_VERTICES = 20_000


def model_of_disk(unwound: UnwoundDisk) -> Model:
    """Return the model of an immersed disk flat on the table, a material for each sheet; its shapes lead to the disk.

    Examples
    --------
    >>> from plyfold import unwrap
    >>> list(model_of_disk(unwrap([(0, 0), (1, 0), (0, 1)], max_area=1.0)).shapes)
    ['unwinding 1', 'unwinding 2', 'unwinding 3', 'disk']
    """
    flat, *others = shapes_of_disk(unwound).items()
    return Model(
        vertices=flat[1],
        faces=unwound.faces,
        material=unwound.sheet,
        materials=tuple(Material(f"sheet_{i}", sheet_colour(i)) for i in range(unwound.immersion.n_sheets)),
        smooth=np.zeros(len(unwound.faces), dtype=np.int64),
        closed=False,
        detail=DETAIL * size_of(unwound.plane),
        uv=unwound.uv,
        shapes=dict(others),
    )


def shapes_of_disk(unwound: UnwoundDisk) -> dict[str, Floats]:
    """Return the disk flat on the table, on its way to be round, and round."""
    motion = Motion(unwound)
    if len(unwound.plane) < _MANY_VERTICES:
        drawn, *between, disk = motion.shapes(_MOST_SHAPES)
    else:
        drawn, between, disk = unwound.plane, [], motion.disk
    named = {"flat": drawn, **{f"unwinding {number + 1}": shape for number, shape in enumerate(between)}, "disk": disk}
    return {name: np.pad(shape, ((0, 0), (0, 1))) for name, shape in named.items()}
