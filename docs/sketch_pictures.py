"""docs/images/sketch.png: the sketching page with a drawing, as a browser shows it. Needs playwright and chromium."""

import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

IMAGES = Path(__file__).parent / "images"
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
WEBGL = ("--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")


def served(drawing: str) -> tuple[subprocess.Popen[str], str]:
    """Start the page on a free port; return the process and the address."""
    command = [sys.executable, "-m", "plyfold", "sketch", drawing, "--no-browser", "--port", "0"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None
    said = process.stdout.readline()
    return process, next(word for word in said.split() if word.startswith("http"))


def photograph(browser: Any, address: str) -> None:
    """Open the page, wait for the surface, and save what is seen."""
    tab = browser.new_page(viewport={"width": 1360, "height": 860}, color_scheme="light")
    tab.goto(address)
    tab.get_by_text("layering 1 of").first.wait_for()
    tab.locator("#surface-tools button").first.wait_for()
    tab.wait_for_timeout(3000)
    tab.screenshot(path=IMAGES / "sketch.png")


def main() -> None:
    """Draw it, if there is a browser."""
    browser_path = next(filter(None, map(shutil.which, BROWSERS)), None)
    if browser_path is None:
        print("sketch.png is left as it is: there is no chromium", file=sys.stderr)
        return
    from playwright.sync_api import sync_playwright

    process, address = served("gallery:knotted-ribbon")
    try:
        with sync_playwright() as play:
            browser = play.chromium.launch(executable_path=browser_path, args=WEBGL)
            photograph(browser, address)
    finally:
        process.terminate()


if __name__ == "__main__":
    main()
