import time

import numpy as np
import pytest
import shapely

from plyfold.errors import FileFormatError, InputError, StrokeError
from plyfold.io.svg import outline_of_drawn_shapes, shapes_in_svg


def read_svg(data, id=None, tolerance=None):
    return outline_of_drawn_shapes(shapes_in_svg(data, id), tolerance)


def svg(body, **attributes):
    given = " ".join(f'{name}="{value}"' for name, value in attributes.items())
    link = 'xmlns:xlink="http://www.w3.org/1999/xlink"'
    return f'<svg xmlns="http://www.w3.org/2000/svg" {link} {given}>{body}</svg>'.encode()


def path(data, attributes=""):
    return svg(f'<path d="{data}" {attributes}/>')


def distance(points, curve):
    """The farthest of the given points from the closed polyline."""
    return _farthest(points, curve.points)


def farthest_vertex(curve, points):
    """The farthest vertex of the curve from a dense polyline."""
    return _farthest(curve.points, points)


def _farthest(points, corners):
    edges = shapely.STRtree(shapely.linestrings(np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)))
    return edges.query_nearest(shapely.points(points), return_distance=True, all_matches=False)[1].max()


def cubic(controls, t):
    a, b, c, d = (np.array(control, dtype=float) for control in controls)
    t = t[:, None]
    return (1 - t) ** 3 * a + 3 * (1 - t) ** 2 * t * b + 3 * (1 - t) * t**2 * c + t**3 * d


T = np.linspace(0, 1, 20001)
UP = np.array([1, -1])


@pytest.mark.parametrize(
    "controls",
    [
        [(0, 0), (60, 90), (-30, 90), (30, 0)],
        [(0, 0), (100, 50), (0, 50), (100, 0)],
        [(0, 0), (100, 100), (-50, 100), (50, 0)],  # with a loop
        [(0, 0), (300, 200), (-200, 200), (100, 0)],
        [(0, 0), (1, 100), (99, 100), (100, 0)],
        [(5, 5), (5, 5), (50, 50), (60, 5)],
    ],
)
@pytest.mark.parametrize("tolerance", [None, 5.0, 0.01])
def test_cubic_curves_keep_the_tolerance(controls, tolerance):
    (ax, ay), (bx, by), (cx, cy), (dx, dy) = controls
    curve = read_svg(path(f"M {ax} {ay} C {bx} {by} {cx} {cy} {dx} {dy} L 20 -70 Z"), tolerance=tolerance)
    truth = cubic(controls, T) * UP
    outline = np.vstack([truth, [(20, 70)]])
    bound = tolerance or np.hypot(*np.ptp(outline, axis=0)) / 2000
    assert distance(truth, curve) <= bound
    assert farthest_vertex(curve, outline) <= 1e-6


def test_a_drawing_far_from_the_origin_is_flattened_within_rounding():
    far, near = (
        read_svg(path(f"M {x} 0 c 600 900 -300 900 300 0 z"), tolerance=tolerance)
        for x, tolerance in ((10**15, 1e-6), (0, 1e-6))
    )
    assert len(near) > 1000
    assert distance(near.points + np.array([10**15, 0]), far) <= 0.25


def test_flattening_is_adaptive_and_not_wasteful():
    coarse = read_svg(path("M 0 0 C 60 90 -30 90 30 0 Z"), tolerance=0.1)
    fine = read_svg(path("M 0 0 C 60 90 -30 90 30 0 Z"), tolerance=0.001)
    assert len(coarse) < 50
    assert 5 * len(coarse) < len(fine) < 20 * len(coarse)
    assert len(read_svg(path("M 0 0 C 10 0 20 0 30 0 L 30 30 Z"))) == 3


def test_quadratic_and_smooth_curves():
    curve = read_svg(path("M 0 0 Q 50 100 100 0 T 200 0 L 100 -90 Z"), tolerance=0.05)
    t = T[:, None]
    first = 2 * (1 - t) * t * np.array([50, 100]) + t**2 * np.array([100, 0])
    second = np.array([100, 0]) * (1 - t) ** 2 + 2 * (1 - t) * t * np.array([150, -100]) + t**2 * np.array([200, 0])
    assert distance(np.vstack([first, second]) * UP, curve) <= 0.05


@pytest.mark.parametrize("tolerance", [None, 1.0, 0.001])
@pytest.mark.parametrize("transform", ["", "rotate(20) scale(3 1)", "skewX(40)", "matrix(1 2 3 -4 50 60)"])
def test_ellipses_keep_the_tolerance_under_every_transform(transform, tolerance):
    a, b, c, d, e, f = {
        "": (1, 0, 0, 1, 0, 0),
        "rotate(20) scale(3 1)": (
            3 * np.cos(np.pi / 9),
            3 * np.sin(np.pi / 9),
            -np.sin(np.pi / 9),
            np.cos(np.pi / 9),
            0,
            0,
        ),
        "skewX(40)": (1, 0, np.tan(np.radians(40)), 1, 0, 0),
        "matrix(1 2 3 -4 50 60)": (1, 2, 3, -4, 50, 60),
    }[transform]
    angle = 2 * np.pi * T
    x, y = 30 + 20 * np.cos(angle), 10 + 5 * np.sin(angle)
    truth = np.column_stack([a * x + c * y + e, -(b * x + d * y + f)])
    curve = read_svg(svg(f'<ellipse cx="30" cy="10" rx="20" ry="5" transform="{transform}"/>'), tolerance=tolerance)
    bound = tolerance or np.hypot(*np.ptp(truth, axis=0)) / 2000
    assert distance(truth, curve) <= bound
    assert farthest_vertex(curve, truth) <= 1e-5


def test_arcs_of_a_path_under_a_skew():
    curve = read_svg(path("M 10 0 A 10 10 0 1 1 0 -10 L 0 0 Z", 'transform="skewX(45)"'), tolerance=0.01)
    angle = np.linspace(0, 1.5 * np.pi, 20001)
    x, y = 10 * np.cos(angle), 10 * np.sin(angle)
    assert distance(np.column_stack([x + y, -y]), curve) <= 0.01
    assert shapely.Polygon(curve.points).area == pytest.approx(75 * np.pi, rel=1e-3)


def test_an_arc_without_radius_is_a_straight_line():
    curve = read_svg(path("M 0 0 A 0 5 0 0 1 4 0 L 0 3 Z"))
    assert curve.points.tolist() == [[0, 0], [4, 0], [0, -3]]


@pytest.mark.parametrize(
    ("body", "points"),
    [
        ('<polygon points="0,0 4,0 0,3"/>', [(0, 0), (4, 0), (0, -3)]),
        ('<polyline points="0,0 4,0 0,3 0,0"/>', [(0, 0), (4, 0), (0, -3)]),
        ('<rect x="1" y="2" width="3" height="4"/>', [(1, -2), (4, -2), (4, -6), (1, -6)]),
        ('<path d="M1,2 h3 v4 h-3 z"/>', [(1, -2), (4, -2), (4, -6), (1, -6)]),
        ('<path d="M0 0L4 0L0 3L0 0"/>', [(0, 0), (4, 0), (0, -3)]),
        ('<path d="M9 9 M0 0L4 0L0 3Z M 7 7"/>', [(0, 0), (4, 0), (0, -3)]),
        (
            '<line x1="0" y1="0" x2="4" y2="0"/><line x1="0" y1="3" x2="0" y2="0"/><line x1="4" x2="0" y2="3"/>',
            [(0, 0), (4, 0), (0, -3)],
        ),
        ('<path d="M0 0L4 0 M0 3L0 0 M4 0L0 3"/>', [(0, 0), (4, 0), (0, -3)]),
        (
            '<g transform="translate(10 20)"><g transform="scale(2)"><polygon points="0,0 4,0 0,3"/></g></g>',
            [(10, -20), (18, -20), (10, -26)],
        ),
        (
            '<defs><polygon id="t" points="0,0 4,0 0,3"/></defs><use xlink:href="#t" x="1" y="1"/>',
            [(1, -1), (5, -1), (1, -4)],
        ),
        ('<symbol id="t"><polygon points="0,0 4,0 0,3"/></symbol><use href="#t"/>', [(0, 0), (4, 0), (0, -3)]),
        (
            '<marker><path d="M0 0L1 0L1 1z"/></marker><mask><rect width="9" height="9"/></mask>'
            '<polygon points="0,0 4,0 0,3"/>',
            [(0, 0), (4, 0), (0, -3)],
        ),
        ('<path/><path d=""/><title>x</title><polygon points="0,0 4,0 0,3"/>', [(0, 0), (4, 0), (0, -3)]),
        ('<polygon points="1,1 2,2 3,1" display="none"/><polygon points="0,0 4,0 0,3"/>', [(0, 0), (4, 0), (0, -3)]),
    ],
)
def test_shapes(body, points):
    assert read_svg(svg(body)).points.tolist() == [list(point) for point in points]


def test_the_view_box_scales_to_the_size_of_the_picture():
    curve = read_svg(svg('<polygon points="10,10 14,10 10,13"/>', viewBox="10 10 50 50", width="100", height="100"))
    assert curve.points.tolist() == [[0, 0], [8, 0], [0, -6]]


@pytest.mark.parametrize("size", [{"width": "200", "height": "100"}, {"width": "200px", "viewBox": "0 0 200 100"}])
def test_lengths_in_percent_are_shares_of_the_view(size):
    curve = read_svg(svg('<rect width="3" height="30%"/>', **size))
    assert curve.points.tolist() == [[0, 0], [3, 0], [3, -30], [0, -30]]


def test_documents_without_namespace_or_with_prefix_or_in_another_encoding():
    bodies = [
        b'<svg><polygon points="0,0 4,0 0,3"/></svg>',
        b'<s:svg xmlns:s="http://www.w3.org/2000/svg"><s:polygon points="0,0 4,0 0,3"/></s:svg>',
        '<?xml version="1.0" encoding="utf-16"?><svg><polygon points="0,0 4,0 0,3"/></svg>'.encode("utf-16"),
    ]
    for body in bodies:
        assert read_svg(body).points.tolist() == [[0, 0], [4, 0], [0, -3]]


TWO = '<polygon id="a" points="0,0 4,0 0,3"/><g id="outer"><circle id="b" r="5"/></g><text id="t">x</text>'


def test_one_of_several_closed_shapes_is_chosen_by_id():
    assert len(read_svg(svg(TWO), id="a")) == 3
    assert read_svg(svg(TWO), id="b").points.tolist() == read_svg(svg(TWO), id="outer").points.tolist()
    assert read_svg(svg(TWO)).n_loops == 2


@pytest.mark.parametrize("id", ["nowhere", "t"])
def test_an_id_without_a_shape_lists_the_others(id):
    with pytest.raises(FileFormatError, match=f"no shape in it has the id '{id}'") as caught:
        read_svg(svg(TWO), id=id)
    assert caught.value.hint == "ids with shapes: a, outer, b"


def test_an_open_path_is_a_stroke():
    curve = read_svg(path("M0 0 L40 0 L40 30 L0 30 L 0 1"))
    assert [(repair.where, repair.size) for repair in curve.repairs] == [((0, -0.5), 1)]
    with pytest.raises(StrokeError):
        read_svg(path("M0 0 L40 0 L40 30 L0 30"))


@pytest.mark.parametrize("tolerance", [0, -1, np.nan, np.inf, 1e-30])
def test_a_tolerance_that_cannot_be_kept(tolerance):
    with pytest.raises(InputError, match="tolerance"):
        read_svg(svg('<circle r="5"/>'), tolerance=tolerance)


@pytest.mark.parametrize("scale", [1e-8, 1e8])
def test_the_default_tolerance_goes_with_the_size(scale):
    plain = read_svg(path("M 0 0 C 60 90 -30 90 30 0 Z")).points
    numbers = " ".join(f"{number * scale!r}" for number in (60, 90, -30, 90, 30, 0))
    np.testing.assert_allclose(read_svg(path(f"M 0 0 C {numbers} Z")).points, plain * scale, rtol=1e-9)


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (svg(""), "nothing is drawn"),
        (svg("<text>hello</text>"), "nothing is drawn"),
        (svg('<path d="M 1 1"/>'), "nothing is drawn"),
        (b"<svg><path", "line 1: broken XML"),
        (b"<svg>\n\n<path d=></svg>", "line 3: broken XML"),
        (b"<svg>&nothing;</svg>", "broken XML"),
        (b"<!DOCTYPE svg SYSTEM 'x'><svg>&nothing;</svg>", "broken XML"),
        (b"<html><body/></html>", "no SVG: its root is <html>"),
        (b'<?xml version="1.0" encoding="klingon"?><svg/>', "broken XML"),
        (b"<svg>\xff\xfe</svg>", "broken XML"),
        (b"not xml at all", "broken XML"),
        (path("M 0 0 L 1 banana 2 Z"), "broken SVG"),
        (path("M 0 0 L 1e999 2 3 4 Z"), "not finite"),
        (path("M 1 1 L 1 1 Z"), "is one point"),
        (svg('<rect width="foo" height="1"/>'), "broken SVG|nothing is drawn"),
        (path("C 1 2 3 4 5 6 Z"), "broken SVG"),
        (svg('<rect width="3" height="3%"/>', viewBox="0 99", width="3mm", height="50%"), "broken SVG"),
        (path("M 1.7e308 1 Q 1.6e308 3 1.7e308 4 Z"), "not finite, or beyond"),
        (svg('<g id="g"><use href="#g"/></g>'), "contain themselves"),
        (svg('<use id="g" href="#g"/>'), "contain themselves"),
        (svg("<g>" * 5000 + "</g>" * 5000), "too deep"),
    ],
)
def test_unusable_documents_give_one_clear_error(data, message):
    with pytest.raises(FileFormatError, match=message) as caught:
        read_svg(data)
    assert caught.value.hint


def laughs():
    names = "".join(f"<!ENTITY l{i + 1} '{f'&l{i};' * 10}'>" for i in range(20))
    return f"<!DOCTYPE svg [<!ENTITY l0 'ha'>{names}]><svg>&l20;</svg>".encode()


def long_entity():
    return f"<!DOCTYPE svg [<!ENTITY l '{'ha' * 10**6}'>]><svg>{'&l;' * 10**5}</svg>".encode()


def long_default():
    return f"<!DOCTYPE svg [<!ATTLIST g a CDATA '{'ha' * 10**6}'>]><svg>{'<g/>' * 10**5}</svg>".encode()


def parameter_entities():
    return b"<!DOCTYPE svg [<!ENTITY % a 'x'><!ENTITY % b '&#37;a;&#37;a;'>]><svg/>"


def uses(hash_sign="#"):
    def level(i):
        return f'<g id="g{i}">' + f'<use href="{hash_sign}g{i - 1}"/>' * 10 + "</g>"

    return svg('<rect id="g0" width="1" height="1"/>' + "".join(level(i) for i in range(1, 20)))


@pytest.mark.parametrize(
    "data", [laughs(), long_entity(), long_default(), parameter_entities(), uses(), uses("x")], ids=range(6)
)
def test_bombs_do_not_explode(data):
    start = time.perf_counter()
    with pytest.raises(FileFormatError):
        read_svg(data)
    assert time.perf_counter() - start < 5


def test_short_entities_as_some_editors_write_them_are_fine():
    data = b"<!DOCTYPE svg [<!ENTITY ns 'http://www.w3.org/2000/svg'>]><svg xmlns='&ns;'><circle r='3'/></svg>"
    assert len(read_svg(data)) > 20
