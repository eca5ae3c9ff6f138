"""SVG drawings, through svgelements, which knows transforms, ``use``, units and viewBox."""

from __future__ import annotations

import io
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pyexpat import ErrorString, ExpatError, ParserCreate
from typing import Any
from xml.etree import ElementTree

import numpy as np
from svgelements import SVG, Arc, Close, CubicBezier, Image, Length, Move, QuadraticBezier, Text
from svgelements import Shape as ShapeElement

from plyfold.arrays import Floats
from plyfold.core.vertices import LARGEST_COORDINATE
from plyfold.errors import FileFormatError, InputError
from plyfold.io.beziers import Bezier, DrawnPath, EllipticArc, sample_points
from plyfold.io.cusp_notation import CuspMark, parse_cusps, written_cusp
from plyfold.io.own_version import SVG_MARK, refuse_later_version
from plyfold.io.shapes import Line, Shape, StrokeStyle, outline_of_shapes
from plyfold.outline.curve import Outline
from plyfold.outline.direction import even_odd_directions, sense
from plyfold.outline.points import Repair, as_points, diagonal
from plyfold.outline.ribbons.sides import CapStyle, JoinStyle

__all__ = ["DrawnShape", "flattened_shapes", "outline_of_drawn_shapes", "shapes_in_svg"]

_TOLERANCE_SHARE = 1 / 2000
_FINEST_SHARE = 1e-9
_LONGEST_DECLARATION = 256
_MOST_ELEMENTS = 1_000_000
_SVG = "{http://www.w3.org/2000/svg}"
_LINK = "{http://www.w3.org/1999/xlink}href"
_TEMPLATES = ("symbol", "marker", "mask")
_GEOGRAPHIC = ("kml", "gml")
_JOINS: dict[object, JoinStyle] = {"round": "round", "bevel": "bevel"}
_MITRE_LIMIT = 4.0  # by default, says the format
_CAPS: dict[object, CapStyle] = {"round": "round", "square": "square"}
_SHAPE_HINT = "draw one closed path, polygon, polyline, rect, circle or ellipse"


@dataclass(frozen=True, eq=False)
class DrawnShape:
    """A shape of an SVG: its pieces, how it is filled and stroked, and its cusps, at the nodes of the pieces.

    The first shape of a document has the record of what was left out of it.
    """

    pieces: tuple[DrawnPath, ...]
    name: str
    even_odd: bool
    cusps: tuple[CuspMark, ...]
    filled: bool = True
    pen: StrokeStyle | None = None
    repairs: tuple[Repair, ...] = ()


def shapes_in_svg(data: bytes, id: str | None = None) -> list[DrawnShape]:
    """Return the shapes that an SVG document draws, in their order, or those in one of its elements.

    Parameters
    ----------
    data : bytes
        The document.
    id : str, optional
        The element to read, a shape or a group; by default all that is drawn.

    Returns
    -------
    list of DrawnShape
        With y up.

    Raises
    ------
    FileFormatError
        If the document is broken, or holds no shape.

    Notes
    -----
    Linear in the size of the document.

    Examples
    --------
    >>> [shape.name for shape in shapes_in_svg(b'<svg><rect id="a" width="9" height="9"/><circle id="b" r="9"/></svg>')]
    ['a', 'b']
    """
    with np.errstate(all="ignore"):  # infinite coordinates are refused when it is flattened
        shapes = _drawn_shapes(data, id)
    if not shapes:
        raise FileFormatError("nothing is drawn in it that has an outline", hint=_SHAPE_HINT)
    return shapes


def outline_of_drawn_shapes(shapes: Sequence[DrawnShape], tolerance: float | None = None) -> Outline:
    """Return shapes of an SVG as one outline; subpaths are loops, and open paths alone are joined as strokes.

    Parameters
    ----------
    shapes : sequence of DrawnShape
    tolerance : float, optional
        Bound on the distance between the drawing and the polylines, in the units of the result (the document's pixels,
        after all transforms); by default 1/2000 of the diagonal of the bounding box.

    Returns
    -------
    Outline
        The directions are those of the file; but of shapes that are filled by even and odd, loops that meet no other
        loop of their shape are turned so that the painted side is on their left, or on their right, if the other shapes
        run clockwise. Repairs say so.

    Raises
    ------
    FileFormatError
        If a coordinate is not finite, or a cusp is not at a node.
    StrokeError
        If open paths leave a gap too wide to be meant.

    Notes
    -----
    Linear in the size of the document, plus one vertex per √tolerance.

    Examples
    --------
    >>> outline_of_drawn_shapes(shapes_in_svg(b'<svg><polygon points="0,0 4,0 0,3"/></svg>')).points.tolist()
    [[0.0, 0.0], [4.0, 0.0], [0.0, -3.0]]
    """
    return outline_of_shapes(flattened_shapes(shapes, tolerance))


def flattened_shapes(shapes: Sequence[DrawnShape], tolerance: float | None = None) -> list[Shape]:
    """Return shapes of an SVG with polylines for curves, and directions as :func:`outline_of_drawn_shapes` says."""
    with np.errstate(all="ignore"):
        size = _checked_size(sample_points([piece for shape in shapes for piece in shape.pieces]))
    tolerance = _checked_tolerance(tolerance, size)
    flat = [_flattened(shape, tolerance) for shape in shapes]
    alone = sum(len(shape.pieces) for shape in shapes) == 1
    if alone or not any(shape.even_odd for shape in shapes):
        return flat
    way = _way_round([part for shape, part in zip(shapes, flat, strict=True) if not shape.even_odd])
    return [_painted(part, way) if shape.even_odd else part for shape, part in zip(shapes, flat, strict=True)]


def _flattened(shape: DrawnShape, tolerance: float) -> Shape:
    cusps = _cusps_at_vertices(shape, tolerance)
    lines = (
        _line(shape, piece, piece.flattened(tolerance))._replace(cusps=marks)
        for piece, marks in zip(shape.pieces, cusps, strict=True)
    )
    return Shape(tuple(lines), shape.name, shape.repairs)


def _line(shape: DrawnShape, piece: DrawnPath, points: Floats) -> Line:
    """Return a piece as a line: one that could have a width if it is open, or stroked and not filled."""
    is_line = not piece.closed or (shape.pen is not None and not shape.filled)
    if is_line and piece.closed and not np.array_equal(points[0], points[-1]):
        points = np.vstack([points, points[:1]])
    return Line(points, piece.closed, is_line=is_line, pen=shape.pen)


def _way_round(shapes: list[Shape]) -> int:
    """Return 1 if shapes run counter-clockwise, −1 if clockwise: as the loop does that reaches farthest left."""
    closed = [as_points(line.points) for shape in shapes for line in shape.loops if line.closed]
    loops = [points for points in closed if sense(points)]
    return sense(min(loops, key=lambda points: points[:, 0].min())) if loops else 1


def _cusps_at_vertices(shape: DrawnShape, tolerance: float) -> list[dict[int, int]]:
    """Return for each piece the vertices of its polyline that are cusps; they are given by nodes."""
    found: list[dict[int, int]] = [{} for _ in shape.pieces]
    nodes = [piece.nodes(tolerance) for piece in shape.pieces] if shape.cusps else []
    for mark in shape.cusps:
        if mark.loop >= len(nodes) or mark.point >= len(nodes[mark.loop]):
            hint = "count the subpaths from 0, and in each its nodes: the start, and the ends of its segments"
            raise FileFormatError(f"{shape.name or 'a shape'} has no node {written_cusp(mark)} to be a cusp", hint=hint)
        found[mark.loop][nodes[mark.loop][mark.point]] = mark.turns
    return found


def _painted(shape: Shape, way: int) -> Shape:
    """Return a shape that is filled by even and odd with the directions that can be told, and a record of them."""
    lines = list(shape.loops)
    loops = [number for number, line in enumerate(lines) if line.closed]
    points = [as_points(lines[number].points) for number in loops]
    repairs = []
    for number, along, painted in zip(loops, points, even_odd_directions(points) if loops else [], strict=True):
        lines[number] = lines[number]._replace(direction=(direction := way * painted))
        x, y = along[0].tolist()
        if direction == 0:
            repairs.append(Repair("direction kept (even-odd loops that meet)", (x, y), 0.0))
        elif sense(along) == -direction:
            repairs.append(Repair("loop turned round (even-odd)", (x, y), 0.0))
    return shape._replace(loops=tuple(lines), repairs=(*shape.repairs, *repairs))


def _checked_size(points: Floats) -> float:
    hint = "check the coordinates and transforms"
    if not (np.abs(points) <= LARGEST_COORDINATE).all():
        raise FileFormatError(f"a coordinate is not finite, or beyond {LARGEST_COORDINATE:g}", hint=hint)
    if (size := diagonal(points)) == 0:
        raise FileFormatError("all that is drawn is one point", hint=hint)
    return size


def _checked_tolerance(tolerance: float | None, size: float) -> float:
    if tolerance is None:
        return size * _TOLERANCE_SHARE
    if not size * _FINEST_SHARE <= tolerance < np.inf:
        hint = f"the drawing measures {size:.6g} across; the finest tolerance is {_FINEST_SHARE:g} of that"
        raise InputError(f"a tolerance of {tolerance:g} cannot be kept", hint=hint)
    return tolerance


def _listed(names: Iterable[str]) -> str:
    names = list(names)
    return ", ".join(names[:20]) + (f" and {len(names) - 20} more" if len(names) > 20 else "")


def _drawn_shapes(data: bytes, id: str | None) -> list[DrawnShape]:
    """Return all drawn shapes that have an outline, or those in the chosen element."""
    document = _safe_document(data)
    try:
        elements = _elements_by_id(document)
        chosen = elements.get(id, [])
        shapes = [_drawn_shape(element) for element in chosen if isinstance(element, ShapeElement)]
        others = tuple(_left_out(element) for element in chosen if not isinstance(element, ShapeElement))
    except FileFormatError:
        raise
    except Exception as error:  # svgelements lets through whatever a bad number or attribute runs into
        reason = str(error) or "a number or a command is not understood"
        hint = "check the path data, transforms and lengths of its shapes"
        raise FileFormatError(f"broken SVG: {reason}", hint=hint) from error
    if id is not None and not shapes:
        named = [name for name, found in elements.items() if any(isinstance(part, ShapeElement) for part in found)]
        hint = f"ids with shapes: {_listed(filter(None, named)) or 'none'}"
        raise FileFormatError(f"no shape in it has the id {id!r}", hint=hint)
    drawn = [shape for shape in shapes if shape.pieces]
    return [replace(drawn[0], repairs=others), *drawn[1:]] if drawn else []


def _elements_by_id(document: bytes) -> dict[str | None, list[Any]]:
    """Return what is drawn within each element that has an id, and under None all: shapes, texts and pictures."""
    drawing = SVG.parse(io.BytesIO(document), reify=False, on_error="raise")
    return {name: _drawn_within(element) for name, element in [(None, drawing), *drawing.objects.items()]}


def _drawn_within(element: Any) -> list[Any]:
    kinds = (ShapeElement, Text, Image)
    if isinstance(element, kinds):
        return [element]
    return list(element.select(lambda part: isinstance(part, kinds))) if hasattr(element, "select") else []


def _left_out(element: Any) -> Repair:
    """Return the record of a text or a picture, which have no outline here."""
    x, y = element.transform.point_in_matrix_space((float(element.x or 0), float(element.y or 0)))
    return Repair("text left out" if isinstance(element, Text) else "picture left out", (float(x), 0.0 - float(y)), 0.0)


def _drawn_shape(element: Any) -> DrawnShape:
    """Return a shape in final coordinates: transforms applied, y up."""
    transform = element.transform
    matrix = np.array([(transform.a, transform.c), (-transform.b, -transform.d)])
    shift = np.array((transform.e, -transform.f))
    pieces = []
    for run, closed in _runs(element.segments(transformed=False)):
        segments = tuple(_segment(part).transformed(matrix, shift) for part in run)
        start = matrix @ _place(run[0].start) + shift
        pieces.append(DrawnPath(start, segments, closed or np.array_equal(start, segments[-1].end)))
    cusps = parse_cusps(element.values.get("attributes", {}).get("data-cusps", ""))
    even_odd, filled = element.values.get("fill-rule") == "evenodd", _is_painted(element.fill)
    return DrawnShape(tuple(pieces), element.id or "", even_odd, tuple(cusps), filled, _pen(element))


def _pen(element: Any) -> StrokeStyle | None:
    """Return the stroke of a shape as it looks in the end, if it has one."""
    width = float(element.implicit_stroke_width or 0)
    if not _is_painted(element.stroke) or not width > 0:
        return None
    join, cap = (element.values.get(f"stroke-line{what}") for what in ("join", "cap"))
    return StrokeStyle(width, _JOINS.get(join, "mitre"), _CAPS.get(cap, "flat"), _mitre_limit(element))


def _mitre_limit(element: Any) -> float:
    """Return the limit of mitres of a shape; what is no limit, below 1, counts as not given."""
    try:
        limit = float(element.values.get("stroke-miterlimit"))
    except (TypeError, ValueError):
        return _MITRE_LIMIT
    return limit if 1 <= limit < math.inf else _MITRE_LIMIT


def _is_painted(paint: Any) -> bool:
    return paint is not None and paint.value is not None


def _runs(segments: Iterable[Any]) -> Iterator[tuple[list[Any], bool]]:
    """Split a path at its moves and closings into runs of segments, and tell whether each was closed."""
    run: list[Any] = []
    for segment in segments:
        if not isinstance(segment, Move | Close):
            run.append(segment)
        elif run:
            yield run, isinstance(segment, Close)
            run = []
    if run:
        yield run, False


def _segment(part: Any) -> Bezier | EllipticArc:
    if isinstance(part, CubicBezier):
        return Bezier(_places(part.start, part.control1, part.control2, part.end))
    if isinstance(part, QuadraticBezier):
        return Bezier(_places(part.start, part.control, part.end))
    if isinstance(part, Arc) and part.sweep and part.rx and part.ry:
        center = _place(part.center)
        axes = np.column_stack([_place(part.prx) - center, _place(part.pry) - center])
        return EllipticArc(center, axes, float(part.get_start_t()), float(part.sweep), _place(part.end))
    return Bezier(_places(part.start, part.end))


def _places(*points: Any) -> Floats:
    return np.array([_place(point) for point in points])


def _place(point: Any) -> Floats:
    place = np.array(point)
    if place.dtype.kind not in "if" or place.shape != (2,):
        raise ValueError(f"{point} is no place; a unit or the start of a path is missing")
    return place.astype(np.float64)


def _safe_document(data: bytes) -> bytes:
    """Return the document rid of what must not be drawn, after refusing what would make its reader run away."""
    try:
        _refuse_entity_bombs(data)
        root = ElementTree.fromstring(data)
        if root.tag.removeprefix(_SVG) != "svg":
            raise _other_xml(root.tag.rpartition("}")[2])
        _refuse_use_bombs(root)
        _tidy(root)
        _state_size(root)
        return ElementTree.tostring(root)
    except FileFormatError:
        raise
    except (ExpatError, ElementTree.ParseError) as error:
        line = error.lineno if isinstance(error, ExpatError) else error.position[0]
        raise FileFormatError(f"line {line}: broken XML ({ErrorString(error.code)})", hint="export it again") from error
    except RecursionError as error:
        raise FileFormatError("its elements are nested too deep", hint="ungroup the drawing") from error
    except (ValueError, LookupError) as error:
        raise FileFormatError(f"broken XML ({error})", hint="save the SVG as UTF-8") from error


def _other_xml(root: str) -> FileFormatError:
    if root.lower() in _GEOGRAPHIC:
        hint = "convert it to GeoJSON, for example with GDAL's ogr2ogr"
        return FileFormatError(f"it is {root.upper()}, which is not read yet", hint=hint)
    return FileFormatError(f"it is XML, but no SVG: its root is <{root[:40]}>", hint=_SHAPE_HINT)


def _refuse_entity_bombs(data: bytes) -> None:
    """Refuse entities that hold entities, and long ones: a few lines of them can stand for gigabytes."""
    parser = ParserCreate()

    def check_entity(name: str, _: object, value: str | None, *__: object) -> None:
        if value is not None and ("&" in value or "%" in value or len(value) > _LONGEST_DECLARATION):
            raise FileFormatError(f"the XML entity {name[:40]!r} is nested or too long", hint="export the SVG again")

    def check_default(_: object, name: str, __: object, default: str | None, ___: object) -> None:
        check_entity(name, None, default)

    parser.EntityDeclHandler = check_entity
    parser.AttlistDeclHandler = check_default
    parser.Parse(data, True)


def _refuse_use_bombs(root: ElementTree.Element) -> None:
    """Refuse ``use`` elements that contain themselves, or multiply each other beyond measure."""
    target = {element.get("id"): element for element in root.iter()}
    sizes: dict[ElementTree.Element, float] = {}

    def size(element: ElementTree.Element) -> float:
        if element not in sizes:
            sizes[element] = np.inf  # stays so for whoever comes back here from below
            used = target.get(_link(element))
            parts = [*element, *([] if used is None else [used])]
            sizes[element] = 1 + sum(map(size, parts))
        return sizes[element]

    if size(root) > _MOST_ELEMENTS:
        hint = "replace the use elements by copies of what they show"
        raise FileFormatError("use elements contain themselves, or multiply beyond measure", hint=hint)


def _link(element: ElementTree.Element) -> str:
    """Return the id that a ``use`` element shows; empty for other elements."""
    return element.get("href", element.get(_LINK, ""))[1:] if element.tag.endswith("use") else ""


def _state_size(root: ElementTree.Element) -> None:
    """Give a drawing without viewBox the one it has by default: svgelements would mix up its width and height.

    Where plyfold has written it, the view box is for viewers alone, and numbers are as they stand.
    """
    if root.get(SVG_MARK) is not None:
        refuse_later_version(root.get(SVG_MARK))
        for name in ("viewBox", "width", "height"):
            root.attrib.pop(name, None)
        return
    sizes = [Length(root.get(side, "100%")).value(ppi=96) for side in ("width", "height")]
    if root.get("viewBox") is None and all(isinstance(size, float) and size > 0 for size in sizes):
        root.set("viewBox", f"0 0 {sizes[0]!r} {sizes[1]!r}")


def _tidy(root: ElementTree.Element) -> None:
    """Put templates, which are only shown where they are used, among the definitions; drop paths without data."""
    for parent in list(root.iter()):
        for position, child in enumerate(list(parent)):
            kind = str(child.tag).removeprefix(_SVG)
            if kind == "path" and not child.get("d", "").strip():
                child.tag = "desc"
            elif kind in _TEMPLATES:
                parent[position] = definitions = ElementTree.Element(_SVG + "defs")
                definitions.append(child)
