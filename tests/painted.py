"""What matplotlib has painted, as geometries of another library."""

from functools import reduce

import shapely


def painted(patch):
    """The region that a patch fills: its rings by the even-odd rule."""
    rings = [shapely.Polygon(ring) for ring in patch.get_path().to_polygons()]
    return reduce(shapely.symmetric_difference, rings)
