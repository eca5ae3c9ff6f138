"""A real browser, where there is one: Debian's Chromium, driven by Playwright."""

import shutil

import pytest

PROGRAMS = ("chromium", "chromium-browser", "google-chrome")
WITHOUT_A_GRAPHICS_CARD = [
    *["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
    "--disable-gpu-compositing",  # else each move of the pointer paints the whole page by the slow software for 3D
]


@pytest.fixture(scope="session")
def browser():
    sync_api = pytest.importorskip("playwright.sync_api")
    program = next(filter(None, map(shutil.which, PROGRAMS)), None)
    if program is None:
        pytest.skip(f"none of {', '.join(PROGRAMS)} is installed; `make browser` does it on Debian")
    with sync_api.sync_playwright() as driver:
        running = driver.chromium.launch(executable_path=program, args=WITHOUT_A_GRAPHICS_CARD)
        yield running
        running.close()
