"""Outlines on the page, in a real browser: several loops on one sheet, holes, shapes of files, and cusps."""

import json
import zlib
from base64 import urlsafe_b64encode

import numpy as np
import pytest

import plyfold as pf
from sketch.by_hand import draw, figure, named, places, saved, settled, verdict

pytest.importorskip("playwright")

DISK, RING, TWO = "A disk of cloth", "A ring of cloth", "2 pieces of cloth: 2 disks"
SHAPES = """<svg xmlns="http://www.w3.org/2000/svg" fill-rule="evenodd"><rect id="plate" width="90" height="60"/>
    <path id="washer" d="M100 0h60v60h-60z M120 20h20v20h-20z"/><rect width="30" height="30" y="90"/>
    <path d="M50 90 l30 20"/></svg>"""


def circle(radius, direction=1):
    t = np.linspace(0, 2 * np.pi, 90)
    return radius * np.c_[np.cos(t), direction * np.sin(t)]


def limacon(page):
    """Draw a curve that turns twice; return its points, those of the inner loop and the rightmost one, in pixels."""
    points = named("limacon", 400)
    draw(page, points)
    verdict(page, "No disk")
    from_left = points[:, 0] - points[:, 0].min()
    inner = points[(np.abs(points[:, 1]) < 30) & (from_left < 200)]
    return places(page, inner[np.argmax(inner[:, 0])][None])[0], places(page, points[np.argmax(points[:, 0])][None])[0]


def cusps(page):
    return [list(stroke.get("cusps", {}).values()) for stroke in saved(page)["strokes"]]


def test_two_nested_loops_are_a_ring(sketch, tmp_path):
    draw(sketch, circle(180))
    verdict(sketch, DISK)
    draw(sketch, circle(90, -1))
    verdict(sketch, RING)
    assert figure(sketch, "turning numbers") == "1, −1"
    settled(sketch)
    assert sketch.locator("#surface.empty").count() == 0
    drawing = saved(sketch)
    sketch.keyboard.press("Control+z")
    verdict(sketch, DISK)
    sketch.keyboard.press("Control+y")
    sketch.reload()
    sketch.wait_for_selector("html[data-ready]")
    verdict(sketch, RING)
    assert saved(sketch)["strokes"] == drawing["strokes"]
    with sketch.expect_download() as download:
        sketch.keyboard.press("Control+s")
    download.value.save_as(tmp_path / "ring.json")
    assert pf.find_immersion(pf.read(tmp_path / "ring.json")).euler_characteristic == 0


def test_loops_are_turned_round_by_an_offer_or_one_by_one(sketch):
    draw(sketch, circle(180))
    draw(sketch, circle(90))
    verdict(sketch, TWO)
    sketch.click("text=Make holes")
    verdict(sketch, RING)
    assert not sketch.locator("text=Make holes").is_visible()
    sketch.keyboard.press("Control+z")
    verdict(sketch, TWO)
    before = saved(sketch)["strokes"]
    sketch.keyboard.press("e")
    sketch.keyboard.press("k")
    sketch.keyboard.press("[")
    sketch.keyboard.press("r")
    verdict(sketch, RING)
    after = saved(sketch)["strokes"]
    assert (after[0], after[1]["points"][1:]) == (before[0], before[1]["points"][:0:-1])


def test_a_shape_of_a_file_is_picked_or_all_of_them(sketch, tmp_path):
    (tmp_path / "three.svg").write_text(SHAPES)
    sketch.set_input_files("#file", tmp_path / "three.svg")
    sketch.wait_for_selector("dialog .card")
    cards = sketch.locator("dialog .card")
    assert [card.locator("strong").inner_text() for card in cards.all()] == [
        "All as one outline",
        "plate",
        "washer",
        "Shape 3",
    ]
    assert [card.locator("path").count() for card in cards.all()] == [4, 1, 2, 1]
    cards.nth(2).click()
    verdict(sketch, RING)
    sketch.set_input_files("#file", tmp_path / "three.svg")
    sketch.click("dialog .card:has-text('All as one')")
    assert "2 disks and a ring" in verdict(sketch, "3 pieces of cloth")
    assert "open line left out" in sketch.inner_text("#notice")


def test_a_cusp_is_marked_by_clicks_and_refused_with_the_reason(sketch):
    inner, outer = limacon(sketch)
    sketch.keyboard.press("u")
    sketch.mouse.click(*inner)
    verdict(sketch, DISK)
    assert cusps(sketch) == [[1]]
    assert figure(sketch, "cusps") == "index 1"
    settled(sketch)
    assert sketch.locator("#surface.empty").count() == 0
    sketch.mouse.click(*inner)
    assert "needs 3 sheets" in verdict(sketch, "No surface")
    assert cusps(sketch) == [[2]]
    sketch.mouse.click(*inner)  # what is refused goes with the next click
    verdict(sketch, "No disk")
    assert cusps(sketch) == [[]]
    sketch.mouse.click(*outer)
    assert "needs 2 sheets on its left" in verdict(sketch, "No surface")
    assert "once more" in sketch.inner_text("#notice")


def test_cusps_are_offered_marked_and_undone_and_go_with_the_link(sketch):
    limacon(sketch)
    sketch.hover("text=A cusp here")
    sketch.wait_for_function("() => document.getElementById('sentence').textContent.includes('with a cusp as shown')")
    sketch.click("text=A cusp here")
    verdict(sketch, DISK)
    assert cusps(sketch) == [[1]]
    sketch.keyboard.press("Control+z")
    verdict(sketch, "No disk")
    sketch.wait_for_selector("[data-action=markCusps]:enabled")
    sketch.keyboard.press("Shift+U")
    verdict(sketch, DISK)
    sketch.keyboard.press("m")
    verdict(sketch, DISK)
    assert cusps(sketch) == [[1]]
    sketch.keyboard.press("Shift+S")
    sketch.wait_for_function("() => location.hash.startsWith('#d=')")
    link, strokes = sketch.url, saved(sketch)["strokes"]
    sketch.keyboard.press("n")
    sketch.goto("about:blank")
    sketch.goto(link)
    sketch.wait_for_selector("html[data-ready]")
    verdict(sketch, DISK)
    assert saved(sketch)["strokes"] == strokes


def test_a_cusp_is_marked_by_keyboard_alone(sketch):
    limacon(sketch)
    sketch.keyboard.press("u")
    sketch.keyboard.press("k")
    sketch.keyboard.press("]")
    sketch.keyboard.press("Enter")
    sketch.wait_for_function("() => document.getElementById('notice').textContent.startsWith('A cusp')")
    assert cusps(sketch) == [[1]]


def test_drawings_and_links_of_version_1_open(sketch):
    strokes = [{"points": [[0, 0], [200, 0], [0, 150]], "closed": True}]
    document = {"plyfold": 1, "strokes": strokes, "image": None, "view": {}}
    kept = json.dumps({"saved": 1, "name": "old", "document": document})
    sketch.evaluate("text => { sessionStorage.clear(); localStorage['plyfold.drawing.old'] = text }", kept)
    sketch.reload()
    sketch.wait_for_selector("html[data-ready]")
    verdict(sketch, DISK)
    packed = zlib.compressobj(wbits=-15)
    letters = packed.compress(json.dumps(document).encode()) + packed.flush()
    sketch.keyboard.press("n")
    sketch.evaluate("fragment => { location.hash = fragment }", f"#d={urlsafe_b64encode(letters).decode().rstrip('=')}")
    verdict(sketch, DISK)


PINCHED = [[-150, -100], [0, 0], [150, -100], [150, 100], [0, 0], [-150, 100]]


def test_an_outline_that_touches_itself_is_told_in_words_by_sign_and_by_a_mark(sketch):
    sketch.keyboard.press("s")
    sketch.keyboard.press("p")
    way = places(sketch, PINCHED)
    for place in [*way, way[0]]:
        sketch.mouse.click(*place)
    verdict(sketch, "A disk of cloth that touches itself")
    assert sketch.get_attribute(".verdict", "data-state") == "touching"
    sign = sketch.evaluate("getComputedStyle(document.getElementById('verdict'), '::before').content")
    assert "◆" in sign
    points = saved(sketch)["strokes"][0]["points"]
    assert points[1] == points[4]
    pinch = ", ".join(f"{x:.6g}".replace("-", "−") for x in points[1])
    assert figure(sketch, "touches itself at") == f"({pinch})"
    assert figure(sketch, "cut there") == "2 pieces of cloth: 2 disks"
    assert [figure(sketch, name) for name in ("crossings", "crossings when moved apart", "levels")] == ["0", "0", "1"]
    assert figure(sketch, "notes").startswith("points in contact at one place")
    settled(sketch)
    assert sketch.locator("#surface.empty").count() == 0
    sketch.keyboard.press("Control+z")
    assert sketch.get_attribute(".verdict", "data-state") == "empty"
