"""Places on the given points: crossings of a moved outline are nodes of the given one, and refusals name no others."""

import numpy as np

import plyfold as pf
from plyfold.arrangement.places import place_in_cell, places_of_crossings, places_of_visits
from plyfold.arrangement.polylines import total_winding
from reference.contacts import random_touching, random_touching_loops
from reference.crossings import exact
from reference.touching_drawings import touching_drawing

TWICE = [(0, 0), (4, 0), (4, 4), (0, 4)] * 2


def outlines_in_contact():
    """Arrangements of random outlines that touch themselves."""
    for seed in range(60):
        rng = np.random.default_rng(seed)
        drawn = pf.arrange(random_touching_loops(rng) if seed % 2 else random_touching(rng))
        if len(drawn.contacts):
            yield drawn


def nodes_of(drawn):
    """The nodes of the outline as given, in doubles."""
    found = touching_drawing([exact(loop.tolist()) for loop in drawn.given.loops])
    return np.array([(float(x), float(y)) for x, y in found.nodes])


def distance(nodes, place):
    """How far a place is from the nearest node."""
    return np.abs(nodes - place).max(axis=1).min()


def test_crossings_fall_back_on_nodes():
    judged = 0
    for drawn in outlines_in_contact():
        nodes = nodes_of(drawn)
        for place, moved in zip(
            places_of_crossings(drawn, range(drawn.n_crossings)), drawn.crossings.tolist(), strict=True
        ):
            assert distance(nodes, place) < 1e-13
            judged += distance(nodes, moved) > 1e-13
    assert judged > 100


def test_refusals_name_given_places():
    judged = 0
    for drawn in outlines_in_contact():
        nodes = nodes_of(drawn)
        for found in (pf.find_immersion(drawn), pf.find_embedding(drawn)):
            for place in () if found else found.where:
                assert not 1e-13 < distance(nodes, place) < 1e-3, found
                judged += 1
    assert judged > 50


def test_places_in_cells_are_wound_round_as_often():
    opened = 0
    for drawn in outlines_in_contact():
        nodes = nodes_of(drawn)
        for cell in range(drawn.n_cells):
            place = place_in_cell(drawn, cell)
            if total_winding(drawn.given.loops, place) != drawn.winding[cell]:
                assert distance(nodes, place) < 1e-13
                opened += 1
    assert opened > 20


def test_a_curve_that_turns_too_often():
    """The place is a corner of the square, where the two rounds of it touch."""
    found = pf.find_immersion(TWICE)
    assert found.where
    assert set(found.where) <= set(TWICE)


def test_cusps_and_feet():
    """A cusp stays, and a foot of a bridge is where it is."""
    rings = pf.arrange([[(0, 0), (9, 0), (9, 9), (0, 9)], [(3, 3), (3, 6), (6, 3)], [(6, 6), (6, 9), (8, 8)]])
    assert len(rings.contacts)
    assert places_of_visits(rings, [0]) == ((0.0, 6.0),)
    assert places_of_visits(pf.Arrangement.from_gauss([1, 0], [True, False], 1), [0]) == ()
    cusp = pf.arrange(pf.Curve([(3, 4), (1, 2), (4, 4), (2, 4), (3, 3)], cusps={0: 1}))
    assert (3.0, 4.0) in places_of_visits(cusp, np.flatnonzero(cusp.cusp_index).tolist())
