"""The order of the rooms holds, and what breaks it is seen."""

import ast

import house
import pytest


@pytest.fixture(scope="module")
def trees():
    return house.modules()


def test_the_house_is_in_order(trees):
    assert sorted(house.broken_rules(trees)) == []


def test_every_module_has_a_room(trees):
    known = {name for names in house.ORDER for name in names}
    assert {house.room(module) for module in trees} <= known


def test_every_exception_has_its_reason():
    assert all(house.EXCEPTIONS.values())
    assert all(house.SAME_THINGS.values())
    assert all(house.LATE.values())


def with_lines(trees, module, *lines):
    """The modules, with some more lines in one of them."""
    planted = ast.Module([*trees[module].body, *ast.parse("\n".join(lines)).body], [])
    return trees | {module: planted}


# A module, lines that break a rule in it, and what is said of them.
BROKEN = [
    ("plyfold.outline.points", "import plyfold.draw.svg", "reads plyfold.draw.svg, which does not come before it"),
    ("plyfold.outline.vertices", "from plyfold.draw import svg", "reads plyfold.draw.svg, which does not"),
    (
        "plyfold.io.svg",
        "def draw():\n    from plyfold.cli.commands import main",
        "reads plyfold.cli.commands, which",
    ),
    ("plyfold.hard.flaps", "import plyfold.paper.gluing", "reads plyfold.paper.gluing, which does not"),
    ("plyfold.outline.curve", "from plyfold.draw.svg import curve_svg", "reads plyfold.draw.svg, which does not"),
    (
        "plyfold.outline.points",
        "import plyfold.outline.curve",
        "in a circle: plyfold.outline.curve, plyfold.",
    ),
    ("plyfold.certify.solid", "import plyfold.arrays", "a checker reads plyfold.arrays"),
    (
        "plyfold.draw.svg",
        "class Curve:\n    pass",
        "Curve names several things: in plyfold.draw.svg, plyfold.outline",
    ),
    ("plyfold.flat.sweep", "def sweep():\n    import scipy.sparse", "imports scipy inside a function"),
    ("plyfold.flat.sweep", "def sweep():\n    from shapely import box", "imports shapely inside a function"),
]


@pytest.fixture(scope="module")
def before(trees):
    return set(house.broken_rules(trees))


@pytest.fixture(scope="module")
def said(trees, before):
    """What is said of all the lines together: to go through the house takes a second."""
    for module, line, _ in BROKEN:
        trees = with_lines(trees, module, line)
    return set(house.broken_rules(trees)) - before


@pytest.mark.parametrize(("module", "line", "sentence"), BROKEN)
def test_what_breaks_a_rule_is_seen(said, module, line, sentence):
    assert any(sentence in broken and module in broken for broken in said)


def test_lines_for_types_alone_are_free(trees, before):
    line = "if TYPE_CHECKING:\n    import matplotlib\n    from plyfold.draw import svg"
    assert set(house.broken_rules(with_lines(trees, "plyfold.outline.points", line))) == before


def test_what_is_not_needed_any_more_is_seen(trees, before, monkeypatch):
    monkeypatch.setitem(house.EXCEPTIONS, ("plyfold.outline.points", "plyfold.draw.svg"), "none")
    monkeypatch.setitem(house.SAME_THINGS, "Curve", "none")
    monkeypatch.setitem(house.LATE, ("plyfold.outline.points", "scipy"), "none")
    assert len(set(house.broken_rules(trees)) - before) == 3
