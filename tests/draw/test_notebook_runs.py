"""The notebook of the examples runs, and shows what it was saved with; a picture is shown once with any backend."""

from pathlib import Path

import nbclient
import nbformat
import pytest

SAVED = Path(__file__).parents[2] / "examples" / "notebook.ipynb"
PICTURES = {"image/png", "image/svg+xml", "text/html"}


# Closing a kernel's channels leaves warnings of pyzmq and asyncio that are not ours.
pytestmark = pytest.mark.filterwarnings("ignore")


def run(notebook):
    """The kinds of every output of every code cell."""
    nbclient.NotebookClient(notebook, timeout=None, kernel_name="python3").execute()
    return shown_by(notebook)


def shown_by(notebook):
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert not any(output.output_type == "error" for cell in cells for output in cell.outputs)
    return [[set(output.get("data", {})) for output in cell.outputs] for cell in cells]


def test_the_example_was_saved_small_and_runs_as_saved():
    saved = nbformat.read(SAVED, as_version=4)
    assert SAVED.stat().st_size < 400_000
    expected = shown_by(saved)
    assert all(len(outputs) == 1 and outputs[0] & PICTURES for outputs in expected)
    assert run(saved) == expected


@pytest.mark.parametrize("before", ["", "%matplotlib inline\n", "from matplotlib import pyplot\n"])
def test_a_picture_is_shown_once(before):
    cells = [
        before + "from plyfold import draw\neight = [(0, 0), (2, 2), (2, 0), (0, 2)]",
        "draw.plot_arrangement(eight)",
        "import plyfold as pf\ndraw.overview(pf.arrange(eight))",
        "draw.plot_arrangement(eight).figure",
    ]
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(source) for source in cells])
    first, *pictures = run(notebook)
    assert first == []
    assert [len(outputs) for outputs in pictures] == [1, 1, 1]
    assert all("image/png" in outputs[0] for outputs in pictures)
