"""How soon the sketching page answers: ``python benchmarks/sketch.py``, a minute; ``--no-page``: the server alone.

For each sketch, with some 30 crossings: the time of `look` in the warm worker; from question to answer through HTTP of
`look`, `lie` and `surface`; and, in the page itself, drawn with real pointer events in Chromium, from pointer-up to the
first question, to the verdict and to the painted surface. Each is the least and the median of some runs, in
milliseconds, about a drawing that was never asked about before: its points are moved a little each time.
"""

from __future__ import annotations

import argparse
import json
import re
import shutil
import signal
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from http.client import HTTPConnection
from typing import Any
from urllib.parse import urlsplit

import numpy as np
import numpy.typing as npt
from families import chain, coil, random_walk, ribbon_disk

import plyfold as pf
from plyfold.gallery import CURVES

Points = npt.NDArray[np.float64]

PROGRAMS = ("chromium", "chromium-browser", "google-chrome")
BROWSER_OPTIONS = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]

# Notes when the pen was lifted, when the verdict was there, and when the surface was painted: with the first triangles
# that are drawn after it has come.
WATCH = """
const seen = (window.seen = {});
const start = () => Object.assign(seen, { up: performance.now(), asked: 0, verdict: 0, came: 0, painted: 0 });
addEventListener("pointerup", start, true);
const note = (name) => { if (seen.up && !seen[name]) seen[name] = performance.now(); };
const fetched = window.fetch;
window.fetch = async (...asked) => {
  note("asked");
  const answer = await fetched(...asked);
  const address = String(asked[0].url ?? asked[0]);
  if (address.endsWith("/look")) setTimeout(() => requestAnimationFrame(() => note("verdict")));
  if (address.endsWith("/surface")) note("came");
  return answer;
};
const draw = WebGL2RenderingContext.prototype.drawElements;
WebGL2RenderingContext.prototype.drawElements = function (...triangles) {
  if (seen.came) note("painted");
  return draw.apply(this, triangles);
};
"""


def sketches() -> dict[str, Points]:
    """Return loops with about 30 crossings, about 400 across, as a pen draws them."""
    drawn = {
        "chain of loops": chain(400),
        "coil": coil(400),
        "ribbon": ribbon_disk(260, seed=3, wildness=0.3),
        "pretzel": CURVES["pretzel"].draw(40),
        "knotted ribbon": CURVES["knotted-ribbon"].draw(40),
        "scribble (no disk)": random_walk(52, seed=5),
    }
    return {name: _scaled(np.asarray(points, dtype=float)) for name, points in drawn.items()}


def _scaled(points: Points) -> Points:
    low, high = points.min(axis=0), points.max(axis=0)
    return np.asarray((points - low) * 400 / (high - low).max())


def moved(points: Points, rng: np.random.Generator) -> Points:
    """Move all points by next to nothing: a drawing that no cache knows."""
    return np.asarray(points + rng.uniform(-1e-3, 1e-3, points.shape))


@contextmanager
def server() -> Iterator[str]:
    """Run the server, and yield its address."""
    command = [sys.executable, "-m", "plyfold", "sketch", "--no-browser", "--port", "0"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None
    try:
        found = re.search(r"http://\S+", process.stdout.readline())
        assert found is not None
        yield found[0]
    finally:
        process.send_signal(signal.SIGINT)
        process.wait()


def ask(connection: HTTPConnection, name: str, points: Points) -> tuple[float, dict[str, Any]]:
    """Put a question, and return the milliseconds and the answer."""
    body = json.dumps({"version": 2, "points": points.tolist()})
    began = time.perf_counter()
    connection.request("POST", f"/api/v2/{name}", body, {"Content-Type": "application/json"})
    content = connection.getresponse().read()
    return 1000 * (time.perf_counter() - began), json.loads(content)


def through_http(url: str, points: Points, runs: int) -> dict[str, list[float]]:
    """Return the milliseconds of all questions about one drawing, and of `look` without the way there and back."""
    connection = HTTPConnection(urlsplit(url).netloc)
    rng = np.random.default_rng(0)
    taken: dict[str, list[float]] = {"look alone": [], "look": [], "lie": [], "surface": []}
    for _ in range(runs):
        drawing = moved(points, rng)
        for name in ("look", "lie", "surface"):
            milliseconds, answer = ask(connection, name, drawing)
            taken[name].append(milliseconds)
            if name == "look":
                taken["look alone"].append(1000 * answer["seconds"])
    connection.close()
    return taken


@contextmanager
def chromium() -> Iterator[Any]:
    """Start Chromium; without a graphics card, the 3D view is drawn by the processor."""
    from playwright.sync_api import sync_playwright

    program = next(filter(None, map(shutil.which, PROGRAMS)))
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=program, args=BROWSER_OPTIONS)
        yield browser
        browser.close()


def on_the_page(browser: Any, url: str, points: Points, runs: int) -> dict[str, list[float]]:
    """Draw a loop by hand, and return the milliseconds from pointer-up to the verdict and to the painted surface."""
    taken: dict[str, list[float]] = {"asked": [], "verdict": [], "painted": []}
    is_disk = pf.bounds_disk(points) and bool(pf.find_layering(next(pf.immersions(points))))
    page = browser.new_context(viewport={"width": 1280, "height": 800}).new_page()
    page.add_init_script(WATCH)
    page.goto(url)
    rng = np.random.default_rng(0)
    page.wait_for_timeout(500)
    for run in range(-1, runs):
        _draw(page, moved(points, rng))
        for name in taken if is_disk else ("asked", "verdict"):
            milliseconds = _waited_for(page, name)
            if run >= 0:  # the first surface waits for three.js
                taken[name].append(milliseconds)
        page.wait_for_timeout(200)
        page.keyboard.press("Control+z")
        page.wait_for_timeout(200)
    page.context.close()
    return taken


def _waited_for(page: Any, name: str) -> float:
    """Return the milliseconds from pointer-up to what is noted under a name, once it is."""
    end = time.monotonic() + 20
    while time.monotonic() < end:
        if page.evaluate(f"seen.{name}"):
            return float(page.evaluate(f"seen.{name} - seen.up"))
        time.sleep(0.02)
    raise TimeoutError(f"the page shows no {name}: {page.inner_text('#verdict')!r}")


def _draw(page: Any, points: Points) -> None:
    """Move the pen along the loop and back to its start, in the middle of the drawing, y down."""
    box = page.locator("#drawing").bounding_box()
    middle = np.array([box["x"] + box["width"] / 2, box["y"] + box["height"] / 2])
    size = 0.7 * min(box["width"], box["height"]) / 400
    places = (middle + size * (points - 200) * (1, -1)).tolist()
    page.mouse.move(*places[0])
    page.mouse.down()
    for place in [*places[1:], places[0]]:
        page.mouse.move(*place)
    page.mouse.up()


def row(cells: list[str]) -> str:
    return "| " + " | ".join(cells) + " |"


def shown(milliseconds: list[float]) -> str:
    """Return the least and the median."""
    return f"{min(milliseconds):.0f} / {statistics.median(milliseconds):.0f}" if milliseconds else ""


def table(names: list[str], measure: Callable[[Points], dict[str, list[float]]]) -> None:
    print(row(["sketch", "points", "crossings", *names]))
    print(row(["---", *["--:"] * (2 + len(names))]))
    for sketch, points in sketches().items():
        taken = measure(points)
        crossings = pf.arrange(points).n_crossings
        print(row([sketch, str(len(points)), str(crossings), *(shown(taken[name]) for name in names)]), flush=True)


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--no-page", action="store_true", help="only the server")
    parser.add_argument("--runs", type=int, default=10)
    options = parser.parse_args()
    with server() as url:
        print("From question to answer, least / median of", options.runs, "in ms\n")
        table(["look alone", "look", "lie", "surface"], lambda points: through_http(url, points, options.runs))
        if not options.no_page:
            print("\nIn the page, from pointer-up, least / median of", options.runs, "in ms\n")
            with chromium() as browser:
                table(["asked", "verdict", "painted"], lambda points: on_the_page(browser, url, points, options.runs))


if __name__ == "__main__":
    main()
