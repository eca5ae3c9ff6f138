"""What values say of themselves counts one thing as one."""

import plyfold as pf

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
