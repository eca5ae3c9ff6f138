"""Tracks and routes from GPX, in metres on a plane that touches the earth in their middle."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pyexpat import ErrorString, ExpatError, ParserCreate

import numpy as np

from plyfold.arrays import Floats
from plyfold.errors import FileFormatError
from plyfold.io.shapes import Shape, shape_of_strokes
from plyfold.outline.points import Repair, as_points, left_out

__all__ = ["shapes_in_gpx"]

# The ellipsoid of WGS 84: its larger half axis in metres, and the square of its eccentricity.
_AXIS, _ECCENTRICITY = 6_378_137.0, 6.694379990141e-3
_LARGEST_ANGLE = 2.0
_HINT = "a GPX file has tracks or routes, with lat and lon at each point"
# Nothing that is read lies so deep; paths are cut here, for documents may be nested without end.
_BEYOND = 6
_LONGEST_TEXT = 1000


@dataclass
class _Lines:
    """What has been read so far of a document: its tracks and routes, each with lines of (lon, lat, height)."""

    names: list[str] = field(default_factory=list)
    lines: list[list[list[tuple[float, float, float]]]] = field(default_factory=list)
    waypoints: list[tuple[float, float]] = field(default_factory=list)
    path: list[str] = field(default_factory=list)
    text: str = ""

    def start(self, name: str, attributes: dict[str, str]) -> None:
        """Begin an element."""
        name = name.rpartition(" ")[2]
        if not self.path and name != "gpx":
            raise FileFormatError(f"it is XML, but no GPX: its root is <{name[:40]}>", hint=_HINT)
        self.path.append(name)
        self.text = ""
        match self.path[1:_BEYOND]:
            case ["trk" | "rte"]:
                self.names.append("")
                self.lines.append([[]] if name == "rte" else [])
            case ["trk", "trkseg"]:
                self.lines[-1].append([])
            case ["trk", "trkseg", "trkpt"] | ["rte", "rtept"]:
                self.lines[-1][-1].append((*_place(attributes), math.nan))
            case ["wpt"]:
                self.waypoints.append(_place(attributes))

    def end(self, _: str) -> None:
        """End an element."""
        match self.path[1:_BEYOND]:
            case ["trk", "trkseg", "trkpt", "ele"] | ["rte", "rtept", "ele"]:
                points = self.lines[-1][-1]
                points[-1] = (*points[-1][:2], _number(self.text, "height"))
            case ["trk" | "rte", "name"]:
                self.names[-1] = self.text.strip()
        self.path.pop()

    def characters(self, text: str) -> None:
        """Add to the text of the element."""
        if len(self.text) < _LONGEST_TEXT:
            self.text += text


def shapes_in_gpx(data: bytes) -> list[Shape]:
    """Read the tracks and routes of a GPX document, each segment as a line, in metres.

    Parameters
    ----------
    data : bytes
        Documents with a document type, which could define entities, are refused.

    Returns
    -------
    list of Shape
        One for each track or route, named as it is. x points east and y north, from the middle of all points; within
        200 km of it lengths are right to a thousandth. Heights are those of their ``ele``, NaN at points without one.

    Raises
    ------
    FileFormatError
        If the document is broken or no GPX, or has no line.

    Notes
    -----
    Linear in the size of the document.

    Examples
    --------
    >>> track = b'<gpx><trk><trkseg><trkpt lat="0" lon="9"/><trkpt lat="0" lon="9.001"/></trkseg></trk></gpx>'
    >>> [shape] = shapes_in_gpx(track)
    >>> shape.loops[0].points.round(1).tolist()
    [[-55.7, 0.0], [55.7, 0.0]]
    """
    found = _parsed(data)
    tracks = [np.array(line) for lines in found.lines for line in lines if line]
    if not tracks:
        raise FileFormatError("it has no track and no route with points", hint=_HINT)
    origin = _middle(np.concatenate(tracks))
    repairs = tuple(Repair("point left out", _plane(np.array([place]), origin)[0], 0.0) for place in found.waypoints)
    shapes = [
        _shape([np.array(line) for line in lines if line], name, origin)
        for name, lines in zip(found.names, found.lines, strict=True)
        if any(lines)
    ]
    return [shapes[0]._replace(repairs=repairs + shapes[0].repairs), *shapes[1:]]


def _parsed(data: bytes) -> _Lines:
    found, parser = _Lines(), ParserCreate(namespace_separator=" ")
    parser.StartDoctypeDeclHandler = _refuse_document_type
    parser.StartElementHandler = found.start
    parser.EndElementHandler = found.end
    parser.CharacterDataHandler = found.characters
    try:
        parser.Parse(data, True)
    except ExpatError as error:
        reason = ErrorString(error.code)
        raise FileFormatError(f"line {error.lineno}: broken XML ({reason})", hint="export it again") from error
    except FileFormatError as error:
        raise FileFormatError(f"line {parser.CurrentLineNumber}: {error.message}", hint=error.hint) from None
    except (ValueError, LookupError) as error:  # an encoding that is not known
        raise FileFormatError(f"broken XML ({error})", hint="save the GPX as UTF-8") from error
    return found


def _refuse_document_type(*_: object) -> None:
    raise FileFormatError("it has a document type, and a GPX has none", hint="remove the line with <!DOCTYPE")


def _place(attributes: dict[str, str]) -> tuple[float, float]:
    """Return longitude and latitude of a point."""
    lon, lat = (_number(attributes.get(name, ""), name) for name in ("lon", "lat"))
    if not (-180 <= lon <= 360 and -90 < lat < 90):
        raise FileFormatError(f"there is no place on a map with lat {lat:g} and lon {lon:g}", hint=_HINT)
    return lon, lat


def _number(text: str, what: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise FileFormatError(f"{text.strip()[:40]!r} is no {what} of a point", hint=_HINT)
    return number


def _middle(points: Floats) -> Floats:
    """Return the middle of longitudes and latitudes; points on both sides of the date line are near each other."""
    east = _turned_to(points[:, 0], points[0, 0])
    lat = points[:, 1]
    middle = np.array([(east.min() + east.max()) / 2, (lat.min() + lat.max()) / 2])
    reach = max(float(np.ptp(east)), float(np.ptp(lat)))
    if reach > 2 * _LARGEST_ANGLE:
        hint = "split it, or project it to a plane first"
        raise FileFormatError(f"it reaches over {reach:.3g} degrees, too far for one plane", hint=hint)
    return middle


def _turned_to(lon: Floats, origin: float) -> Floats:
    """Return longitudes by full turns nearest to that of an origin."""
    return origin + (lon - origin + 180) % 360 - 180


def _plane(points: Floats, origin: Floats) -> Floats:
    """Return metres east and north of an origin, on the plane that touches the earth there."""
    lon, lat = np.radians(origin)
    east = [-math.sin(lon), math.cos(lon), 0.0]
    north = [-math.sin(lat) * math.cos(lon), -math.sin(lat) * math.sin(lon), math.cos(lat)]
    away = _in_space(points) - _in_space(origin[None])
    return np.asarray(away @ np.array([east, north]).T)


def _in_space(points: Floats) -> Floats:
    """Return places on the ellipsoid, in metres from its middle, from longitudes and latitudes."""
    lon, lat = np.radians(points[:, :2].T)
    radius = _AXIS / np.sqrt(1 - _ECCENTRICITY * np.sin(lat) ** 2)
    flat = radius * np.cos(lat)
    return np.stack([flat * np.cos(lon), flat * np.sin(lon), (1 - _ECCENTRICITY) * radius * np.sin(lat)], axis=1)


def _shape(tracks: list[Floats], name: str, origin: Floats) -> Shape:
    shape = shape_of_strokes([_plane(track, origin) for track in tracks], name)
    heights = [None if np.isnan(track[:, 2]).all() else track[:, 2] for track in tracks]
    lines = tuple(line._replace(heights=z) for line, z in zip(shape.loops, heights, strict=True))
    if not any(z is not None for z in heights):
        return shape
    return shape._replace(loops=lines, repairs=left_out("z", as_points(lines[0].points)))
