"""A slice of the drawings at every scale through links and files, and a fault that it finds."""

import json

import pytest

from nightly import scales
from nightly.curves import MIX
from plyfold.sketch.schema import document_data

pytestmark = pytest.mark.skipif(scales.NODE is None, reason="node is not there")

FIRST_SEED = 20_000_000


def test_a_round_of_drawings_comes_back(capsys):
    assert scales.main(["--drawings", str(len(MIX)), "--first", str(FIRST_SEED)]) == 0
    assert f"{len(MIX)} drawings through links and files, 0 came back" in capsys.readouterr().out


def test_coordinates_with_three_decimals_are_found(monkeypatch, capsys):
    def with_three_decimals(documents):
        data = json.loads(json.dumps([document_data(document) for document in documents]))
        for document in data:
            for stroke in document["strokes"]:
                stroke["points"] = [[round(x, 3), round(y, 3)] for x, y in stroke["points"]]
        return [{"link": document, "file": json.dumps(document)} for document in data]

    monkeypatch.setattr(scales, "through_page", with_three_decimals)
    assert scales.main(["--drawings", str(len(MIX)), "--first", str(FIRST_SEED)]) == 1
    told = capsys.readouterr().out
    assert ", link:" in told
    assert ", file of the page:" in told
    assert "of the server" not in told
