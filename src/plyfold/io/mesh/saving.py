"""Mesh files: GLB, OBJ, PLY, STL and 3MF.

They are written here, in a few lines each, because the general libraries round everything to 32 bits, leave the back
of a surface invisible, and know nothing of sheets. OBJ, PLY and 3MF keep double precision.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path

from plyfold.errors import InputError
from plyfold.io.mesh.glb import glb
from plyfold.io.mesh.model import Model
from plyfold.io.mesh.plain import material_library, obj, ply, stl
from plyfold.io.mesh.threemf import threemf
from plyfold.io.saving import refuse_existing, save_bytes

__all__ = ["WRITERS", "refuse_ending", "save_model"]

WRITERS: Mapping[str, Callable[[Model], bytes]] = {".glb": glb, ".obj": obj, ".ply": ply, ".stl": stl, ".3mf": threemf}


def refuse_ending(path: str | os.PathLike[str], more: tuple[str, ...] = ()) -> str:
    """Return the ending of a path in lower case; raise InputError if there is no such format."""
    suffix = Path(path).suffix.lower()
    known = (*more, *WRITERS)
    if suffix not in known:
        raise InputError(
            f"{Path(path).name}: a mesh cannot be written as {suffix or 'a file without ending'}",
            hint=f"use one of {' '.join(known)}",
        )
    return suffix


def save_model(make: Callable[[], Model], path: str | os.PathLike[str], force: bool = False) -> None:
    """Write a model to a file; nothing is made if the file cannot be written.

    Parameters
    ----------
    make : callable
        Returns the model.
    path : path
        The ending chooses the format. An OBJ whose sheets have colours gets its materials in an ``.mtl`` beside it.
    force : bool
        Replace existing files.

    Raises
    ------
    InputError
        If the ending is none of :data:`WRITERS`.
    FileExistsError
        If a file exists and ``force`` is not set.
    PrecisionError
        If the numbers of the format cannot hold the mesh.
    """
    suffix, library = refuse_ending(path), Path(path).with_suffix(".mtl")
    refuse_existing(path, force)
    model = make()
    if suffix == ".obj" and model.colours is None:
        refuse_existing(library, force)
        save_bytes(library, material_library(model), force)
        save_bytes(path, obj(model, library.name), force)
    else:
        save_bytes(path, WRITERS[suffix](model), force)
