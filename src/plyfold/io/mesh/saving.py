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
from plyfold.io.saving import Target, refuse_existing, save_bytes

__all__ = ["WRITERS", "refuse_ending", "save_model"]

WRITERS: Mapping[str, Callable[[Model], bytes]] = {".glb": glb, ".obj": obj, ".ply": ply, ".stl": stl, ".3mf": threemf}


def refuse_ending(path: Target, more: tuple[str, ...] = (), ending: str | None = None) -> str:
    """Return the ending that chooses the format, in lower case; raise InputError if there is no such format.

    Examples
    --------
    >>> refuse_ending("a.GLB"), refuse_ending("a", ending="stl")
    ('.glb', '.stl')
    """
    name = Path(path).name if isinstance(path, str | os.PathLike) else "an open file"
    suffix = Path(name).suffix if ending is None else f".{ending.removeprefix('.')}"
    known = (*more, *WRITERS)
    if suffix.lower() not in known:
        raise InputError(
            f"{name}: a mesh cannot be written as {suffix or 'a file without ending'}",
            hint=f"use one of {' '.join(known)}",
        )
    return suffix.lower()


def save_model(make: Callable[[], Model], path: Target, force: bool = False, ending: str | None = None) -> None:
    """Write a model to a file; nothing is made if the file cannot be written.

    Parameters
    ----------
    make : callable
        Returns the model.
    path : path or binary file
        The ending chooses the format. An OBJ whose sheets have colours gets its materials in an ``.mtl`` beside it.
    force : bool
        Replace existing files.
    ending : str, optional
        Chooses the format instead of the path's own.

    Raises
    ------
    InputError
        If the ending is none of :data:`WRITERS`.
    FileExistsError
        If a file exists and ``force`` is not set.
    PrecisionError
        If the numbers of the format cannot hold the mesh.
    """
    suffix = refuse_ending(path, (), ending)
    refuse_existing(path, force)
    model = make()
    if suffix == ".obj" and model.colours is None and isinstance(path, str | os.PathLike):
        library = Path(path).with_suffix(".mtl")
        refuse_existing(library, force)
        save_bytes(library, material_library(model), force)
        save_bytes(path, obj(model, library.name), force)
    else:
        save_bytes(path, WRITERS[suffix](model), force)
