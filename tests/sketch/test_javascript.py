"""The page's pure modules, tested by node's own runner."""

import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from plyfold import colours, sketch
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


def test_the_pages_colours_are_those_of_the_pictures():
    page = (Path(sketch.__file__).parent / "static/colours.js").read_text(encoding="utf-8")

    def table(name):
        return json.loads(re.search(rf"const {name} = (\[.*?\]);", page).group(1))

    assert table("SHEETS") == list(colours.SHEETS)
    assert table("WINDING") == [colours.winding_colour(number) for number in range(1, 7)]
    assert table("NEGATIVE") == [colours.winding_colour(-number) for number in range(1, 6)]
