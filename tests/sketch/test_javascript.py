"""The page's pure modules, tested by node's own runner."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from plyfold import colours, draw, sketch
from plyfold.colours import page_style
from plyfold.sketch.pages import page_file
from sketch.by_hand import LIMIT

TESTS = sorted((Path(__file__).parent / "js").glob("*.test.mjs"))


def node_version() -> int:
    node = shutil.which("node")
    if node is None:
        return 0
    said = subprocess.run([node, "--version"], capture_output=True, text=True, check=True).stdout
    return int(said.strip().removeprefix("v").split(".")[0])


@pytest.mark.skipif(node_version() < 20, reason="node 20 or later is not there")
@pytest.mark.parametrize("test", TESTS, ids=lambda path: path.name)
def test_module(test):
    run = subprocess.run(["node", "--test", str(test)], capture_output=True, text=True, check=False, timeout=LIMIT)
    assert run.returncode == 0, run.stdout


def test_every_pure_module_has_tests():
    """Modules that do not touch the page, but for tables of colours and icons, come with tests of their own."""
    assert {"document", "geometry", "strokes"} <= {path.name.removesuffix(".test.mjs") for path in TESTS}


COLOUR = re.compile(r"#[0-9a-fA-F]{3,8}\b(?!\w)|rgba?\(|hsl", re.ASCII)
STATIC = [Path(sketch.__file__).parent / "static", Path(draw.__file__).parent / "static"]
WRITTEN = [path for folder in STATIC for path in sorted(folder.iterdir()) if path.name != "three.min.js"]


@pytest.mark.parametrize("path", WRITTEN, ids=lambda path: path.name)
def test_no_colour_is_copied_by_hand(path):
    """They are all of the palette: in scripts and style sheets by name, and in pictures filled in when served."""
    assert not COLOUR.findall(path.read_text(encoding="utf-8"))


def test_the_page_has_the_colours_of_the_pictures():
    light = page_style().partition("}")[0]

    def listed(name):
        return re.search(rf"--{name}: (.*);", light).group(1).split()

    assert listed("sheets")[: len(colours.SHEETS)] == list(colours.SHEETS)
    assert listed("winding") == [colours.winding_colour(number) for number in range(1, 7)]
    assert listed("negative") == [colours.winding_colour(-number) for number in range(1, 6)]
    assert colours.CLOTH_LOW in page_file("/icon.svg").body.decode()


def test_every_variable_of_the_pages_has_a_colour_by_day_and_by_night():
    day, night, by_system = (set(re.findall(r"--([\w-]+):", part)) for part in page_style().split("}\n\n")[:3])
    assert day == night == by_system
    for path in WRITTEN:
        used = set(re.findall(r"var\(--([\w-]+)\)", path.read_text(encoding="utf-8")))
        assert used <= day, path.name
