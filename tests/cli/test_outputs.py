"""What the command line must not write: the drawing that it reads, or one file twice."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from plyfold.cli.commands import main

RAMP = Path(__file__).parents[2] / "examples" / "ramp.svg"


@pytest.fixture
def drawing(tmp_path, monkeypatch):
    """A drawing in the working directory, under an ending that pictures have too."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "other").mkdir()
    return Path(shutil.copy(RAMP, "loop.svg"))


def link(target, path):
    Path(path).symlink_to(Path(target).absolute())
    return path


def hard_link(target, path):
    Path(path).hardlink_to(target)
    return path


OTHER_NAMES = {
    "the same word": lambda drawing: "loop.svg",
    "another spelling": lambda drawing: "./other/../loop.svg",
    "the whole path": lambda drawing: str(drawing.absolute()),
    "a symbolic link": lambda drawing: link(drawing, "link.svg"),
    "a link to a link": lambda drawing: link(link(drawing, "link.svg"), "second.svg"),
    "a hard link": lambda drawing: hard_link(drawing, "hard.svg"),
    "through a linked folder": lambda drawing: link(".", "here") + "/loop.svg",
}


@pytest.mark.parametrize("force", [[], ["--force"]])
@pytest.mark.parametrize("other_name", OTHER_NAMES.values(), ids=OTHER_NAMES)
def test_the_drawing_is_not_replaced(other_name, force, drawing, capsys, monkeypatch):
    monkeypatch.setattr("plyfold.io.read", pytest.fail)  # refused before anything is read
    output = other_name(drawing)
    assert main(["draw", "loop.svg", "--what", "over-under", "-o", output, *force]) == 2
    complaint = capsys.readouterr().err
    assert "is the drawing that is read" in complaint
    assert output in complaint
    assert drawing.read_bytes() == RAMP.read_bytes()


@pytest.mark.parametrize("command", ["lift", "split", "draw"])
def test_no_command_replaces_the_drawing(command, drawing, capsys):
    output = {"lift": "loop.obj", "split": "loop.wkt", "draw": "loop.svg"}[command]
    drawing.rename(output)
    assert main([command, output, "-o", "first.svg" if command != "lift" else "a.glb", "-o", output, "--force"]) == 2
    assert "is the drawing that is read" in capsys.readouterr().err
    assert [path.name for path in Path().iterdir() if path.is_file()] == [output]
    assert Path(output).read_bytes() == RAMP.read_bytes()


def test_materials_do_not_replace_the_drawing(drawing, capsys):
    drawing.rename("loop.mtl")
    command = ["lift", "loop.mtl", "--colours", "sheets", "-o", "loop.obj", "--force", "--triangles", "100"]
    assert main(command) == 2
    assert "loop.mtl is the drawing that is read" in capsys.readouterr().err
    assert Path("loop.mtl").read_bytes() == RAMP.read_bytes()
    assert not Path("loop.obj").exists()


def test_a_drawing_on_standard_input_is_not_replaced(drawing):
    words = [sys.executable, "-m", "plyfold", "split", "-", "-o", "loop.svg", "--force"]
    with drawing.open("rb") as file:
        done = subprocess.run(words, stdin=file, capture_output=True, check=False)
    assert done.returncode == 2
    assert b"loop.svg is the drawing that is read" in done.stderr
    assert drawing.read_bytes() == RAMP.read_bytes()


@pytest.mark.parametrize("exists", [False, True])
@pytest.mark.parametrize("second", ["./out.wkt", "other/../out.wkt", "link.wkt", "link.svg"])
def test_two_outputs_that_are_one_file(second, exists, drawing, capsys):
    for name in ("link.wkt", "link.svg"):
        link("out.wkt", name)
    if exists:
        Path("out.wkt").write_text("old")
    assert main(["split", "loop.svg", "-o", "out.wkt", "-o", second, "--force"]) == 2
    assert f"out.wkt and {second} are the same file" in capsys.readouterr().err
    assert Path("out.wkt").exists() == exists


def test_two_outputs_that_are_hard_links(drawing, capsys):
    Path("out.wkt").write_text("old")
    hard_link("out.wkt", "hard.wkt")
    assert main(["split", "loop.svg", "-o", "out.wkt", "-o", "hard.wkt", "--force"]) == 2
    assert "are the same file" in capsys.readouterr().err


def test_a_copy_of_the_drawing_may_be_replaced(drawing):
    shutil.copy(drawing, "copy.svg")
    assert main(["split", "loop.svg", "-o", "copy.svg", "--force"]) == 0
    assert Path("copy.svg").read_bytes() != drawing.read_bytes() == RAMP.read_bytes()


def test_no_file_is_read_from_the_gallery(drawing):
    Path("gallery:milnor.svg").write_text("old")
    assert main(["split", "gallery:milnor", "-o", "gallery:milnor.svg", "--force"]) == 0
