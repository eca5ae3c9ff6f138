"""What values say of themselves counts one thing as one."""

import plyfold as pf
from plyfold.report import verdict

TRIANGLE = [(0, 0), (1, 0), (0, 1)]


def test_one_is_not_many():
    immersion = pf.find_immersion(TRIANGLE)
    assert repr(immersion) == "<Immersion: 1 sheet over 1 cell>"
    assert repr(pf.find_layering(immersion)) == "<Layering: 1 sheet on up to 1 level>"
    assert repr(pf.lift(TRIANGLE, triangles=1)) == "<Surface: 1 triangle in 1 sheet>"
    assert repr(pf.unwrap(TRIANGLE, triangles=1)) == "<UnwoundDisk: 1 triangle in 1 sheet>"
    assert repr(pf.gallery.CURVES["exit-ramp"]) == "<NamedCurve exit-ramp: 4 crossings, 1 immersion>"


def test_and_many_are_many():
    assert repr(pf.find_immersion(pf.gallery.CURVES["milnor"].curve)) == "<Immersion: 11 sheets over 7 cells>"


def test_numbers_are_those_of_the_drawing_as_given():
    """As in reports: not those of cells and crossings that only moves apart make."""
    eight = [(0, 0), (1, 1), (2, 2), (2, 0), (0, 2)]
    keyhole = [(0, 0), (6, 0), (6, 6), (0, 6), (0, 2), (2, 2), (2, 4), (4, 4), (4, 2), (2, 2), (0, 2)]
    assert repr(pf.arrange(eight)).startswith("<Arrangement of a curve of 5 points: 0 crossings, turning number 0")
    for outline in (keyhole, [*keyhole[:-1], (-1, 2)]):
        drawn = pf.arrange(outline)
        figures, immersion = verdict(drawn), pf.find_immersion(drawn)
        cells = sum(count for winding, count in figures["cells"].items()) - 1
        sheets = f"{figures['sheets']} sheet{'s' if figures['sheets'] != 1 else ''}"
        assert f": {figures['crossings']} crossing" in repr(drawn)
        assert repr(immersion) == f"<Immersion: {sheets} over {cells} cell{'s' if cells != 1 else ''}>"
        assert repr(pf.find_layering(immersion)).startswith(f"<Layering: {sheets} on up to {figures['levels']} level")
