"""Drawings at every scale through the page's links and files: ``python -m nightly.scales`` (in tests/).

What comes back must have the same Gauss code, turning number and number of immersions as what was drawn.
"""

import argparse
import json
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from nightly.curves import LISTS, MIX, draw
from plyfold.errors import PlyfoldError
from plyfold.sketch.export import export
from plyfold.sketch.look import look_at
from plyfold.sketch.opening import open_file
from plyfold.sketch.schema import Document, Export, Lift, Look, document_data, read_document

NODE = shutil.which("node")
PAGE = Path(__file__).with_name("through_page.mjs")
AT_ONCE = 50
POWERS = 12
# The page draws one loop; and certificates have scales of their own, beyond those of the page.
ELSEWHERE = {*LISTS, "certificate"}


class Scaled(NamedTuple):
    """A drawing at some scale."""

    seed: int
    scale: float
    document: Document


def scaled(seed: int) -> Scaled:
    """The curve of a seed, at a scale between 1e-12 and 1e12."""
    scale = float(10 ** np.random.default_rng(seed).uniform(-POWERS, POWERS))
    points = [[scale * x, scale * y] for x, y in draw(seed).points]
    data = {"plyfold": 1, "strokes": [{"points": points, "closed": True}]}
    return Scaled(seed, scale, read_document(data))


def answers(document: Document) -> tuple[object, ...]:
    """What the page says of a drawing."""
    try:
        told = look_at(Look(document.strokes))
    except PlyfoldError as error:
        return (type(error), error.message)
    return told["gauss"], told["turning_numbers"], told["verdict"]["immersions"]


def through_page(documents: list[Document]) -> list[dict[str, Any]]:
    """What becomes of documents in links and in the files that the page itself writes."""
    assert NODE is not None
    text = json.dumps([document_data(document) for document in documents])
    run = subprocess.run([NODE, str(PAGE)], input=text, capture_output=True, text=True, check=True)
    return json.loads(run.stdout)


def ways(document: Document, saved: dict[str, Any]) -> Iterator[tuple[str, Document]]:
    """The document as it comes back, by the ways it went."""
    yield "link", read_document(saved["link"])
    yield "file of the page", open_file("drawing.json", saved["file"].encode())
    for kind in ("json", "svg"):
        content, _ = export(Export(document, kind, Lift(document.strokes, 0, 0, None, 100)))
        yield f"{kind} of the server", open_file(f"drawing.{kind}", content)


def failures(seeds: range) -> list[str]:
    """The drawings that came back as others, in words."""
    drawn = [scaled(seed) for seed in seeds if MIX[seed % len(MIX)] not in ELSEWHERE]
    found = []
    for (seed, scale, document), saved in zip(drawn, through_page([one.document for one in drawn]), strict=True):
        before = answers(document)
        for way, back in ways(document, saved):
            if answers(back) != before:
                found.append(f"seed {seed}, scale {scale:.3g}, {way}: {answers(back)} instead of {before}")
    return found


def main(words: list[str] | None = None) -> int:
    """Return 0 if all is well, 1 if anything came back as something else."""
    parser = argparse.ArgumentParser(prog="nightly.scales", description=__doc__)
    parser.add_argument("--drawings", type=int, default=2000)
    parser.add_argument("--first", type=int, default=0, metavar="SEED", help="the first seed; default 0")
    options = parser.parse_args(words)
    end = options.first + options.drawings
    batches = (range(start, min(start + AT_ONCE, end)) for start in range(options.first, end, AT_ONCE))
    found = [failure for batch in batches for failure in failures(batch)]
    print(
        "\n".join([*found, f"{options.drawings:,} drawings through links and files, {len(found)} came back as others"])
    )
    return int(bool(found))


if __name__ == "__main__":
    sys.exit(main())
