"""3MF: double precision, a name and a colour for each sheet, for printers in colour."""

from __future__ import annotations

import io
import zipfile

import numpy as np

from plyfold.errors import PrecisionError
from plyfold.io.mesh.model import Model
from plyfold.io.mesh.plain import rows_as_text

__all__ = ["threemf"]

_HEAD = '<?xml version="1.0" encoding="UTF-8"?>\n'
_CONTENT_TYPES = (
    _HEAD + '<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">'
    '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
    '<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>'
)
_RELATIONSHIPS = (
    _HEAD + '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
    '<Relationship Target="/3D/3dmodel.model" Id="rel0" '
    'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>'
)
_MODEL = (
    _HEAD + '<model unit="millimeter" xml:lang="en-US" '
    'xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" '
    'xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02">\n'
    '<metadata name="Application">plyfold</metadata>\n'
)
# The format's own library refuses what is farther away, in millimetres.
_FARTHEST = 1e9


def threemf(model: Model) -> bytes:
    """Return the model as a 3MF, a unit of the drawing being a millimetre; the lowest corner is put at the origin.

    Solids are objects of type *model*, open surfaces of type *surface*. Colours are smooth, as a colour group of the
    materials extension, or those of the base materials, one for each sheet.

    Raises
    ------
    PrecisionError
        If a coordinate is beyond a thousand kilometres, where readers of the format give up.
    """
    far = np.abs(model.vertices).max(axis=1) > _FARTHEST
    if far.any():
        raise PrecisionError(
            "readers of 3MF cannot hold the mesh, with a unit of the drawing being a millimetre",
            where=model.vertices[far][:1],
            hint="move it to the origin, scale it, or write .obj or .ply",
        )
    kind = "model" if model.closed else "surface"
    properties, triangles = _base_materials(model) if model.colours is None else _colour_group(model)
    place = " ".join(repr(-x) for x in model.vertices.min(axis=0).tolist())
    parts = [
        f'{_MODEL}<resources>\n{properties}<object id="1" type="{kind}" name="plyfold" pid="2" pindex="0"><mesh>\n',
        "<vertices>\n",
        rows_as_text('<vertex x="%r" y="%r" z="%r"/>\n', model.vertices),
        "</vertices>\n<triangles>\n",
        triangles,
        "</triangles>\n</mesh></object>\n</resources>\n",
        f'<build><item objectid="1" transform="1 0 0 0 1 0 0 0 1 {place}"/></build>\n</model>\n',
    ]
    return _package("".join(parts))


def _base_materials(model: Model) -> tuple[str, str]:
    """Return the sheets' names and colours, and the triangles that refer to them."""
    bases = "".join(f'<base name="{one.name}" displaycolor="{one.colour.upper()}"/>\n' for one in model.materials)
    triangles = rows_as_text(
        '<triangle v1="%d" v2="%d" v3="%d" pid="2" p1="%d"/>\n', np.column_stack([model.faces, model.material])
    )
    return f'<basematerials id="2">\n{bases}</basematerials>\n', triangles


def _colour_group(model: Model) -> tuple[str, str]:
    """Return the colours of the vertices, each once, and the triangles that refer to them."""
    levels = np.rint(255 * np.asarray(model.colours)).astype(np.int64) @ [1 << 16, 1 << 8, 1]
    colours, of_vertex = np.unique(levels, return_inverse=True)
    listed = "".join(f'<m:color color="#{colour:06X}"/>\n' for colour in colours.tolist())
    triangles = rows_as_text(
        '<triangle v1="%d" v2="%d" v3="%d" pid="2" p1="%d" p2="%d" p3="%d"/>\n',
        np.column_stack([model.faces, of_vertex[model.faces]]),
    )
    return f'<m:colorgroup id="2">\n{listed}</m:colorgroup>\n', triangles


def _package(model: str) -> bytes:
    content = {"[Content_Types].xml": _CONTENT_TYPES, "_rels/.rels": _RELATIONSHIPS, "3D/3dmodel.model": model}
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as package:
        for name, text in content.items():
            # Without a date, the same surface gives the same file.
            package.writestr(zipfile.ZipInfo(name), text, zipfile.ZIP_DEFLATED, compresslevel=1)
    return packed.getvalue()
