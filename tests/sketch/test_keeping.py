"""No work is lost: what the browser keeps, what it cannot keep, and what is saved, at every scale and in two tabs."""

import json

import numpy as np
import pytest

from plyfold.sketch.look import look_at
from plyfold.sketch.opening import open_file
from plyfold.sketch.schema import Look
from sketch.by_hand import (
    WORD,
    draw,
    draw_by_pen,
    eight,
    figure,
    named,
    pen,
    places,
    saved,
    settled,
    touch,
    verdict,
    wait_until,
)

pytest.importorskip("playwright")

TOLD = "() => !document.getElementById('unkept').hidden"
KEPT = """() => Object.entries(localStorage).filter(([key]) => key.startsWith('plyfold.drawing.'))
    .map(([key, text]) => JSON.parse(text).document)"""
# Drawings of 50,000 letters, each another, until there is room for no more.
FILL = """async () => {
    const room = "x".repeat(50000);
    for (let i = 0; ; i++) {
        const strokes = [{ points: [[0, 0], [9, i], [5, 9]], closed: true }];
        const document = { plyfold: 1, strokes, image: null, view: { room } };
        try {
            localStorage.setItem(`plyfold.drawing.full${i}`, JSON.stringify({ saved: i, name: `full ${i}`, document }));
        } catch {
            try {
                for (let text = ""; ; text += "x".repeat(60)) localStorage.setItem("plyfold.full", text);
            } catch {
                return i;
            }
        }
    }
}"""


@pytest.fixture(scope="module")
def large_picture(tmp_path_factory):
    """A picture that no way of packing makes smaller than four million bytes."""
    from PIL import Image

    file = tmp_path_factory.mktemp("pictures") / "photograph.png"
    Image.fromarray(np.random.default_rng(1).integers(0, 256, (1180, 1180, 3), dtype=np.uint8)).save(file)
    assert file.stat().st_size > 4_000_000
    return file


def placed(page):
    """Wait until the picture has its place."""
    page.wait_for_function("() => document.getElementById('notice').textContent.includes('after the picture')")


def reloaded(page):
    page.reload()
    page.wait_for_selector("html[data-ready]")


def has_picture(page):
    """Whether the paper has the grey noise of the picture."""
    script = """() => new Promise((resolve) => requestAnimationFrame(() => {
        const canvas = document.getElementById("drawing");
        const { data } = canvas.getContext("2d").getImageData(canvas.width / 2 - 50, canvas.height / 2 - 50, 100, 100);
        resolve(new Set(data).size);
    }))"""
    return page.evaluate(script) > 60


@pytest.mark.slow
def test_a_large_picture_is_kept_and_so_is_every_drawing(sketch, large_picture):
    for size in (200, 300, 400):
        draw(sketch, named("exit-ramp", size))
        sketch.keyboard.press("n")
    before = sketch.evaluate(KEPT)
    sketch.set_input_files("#file", large_picture)
    placed(sketch)
    wait_until(lambda: has_picture(sketch), "the picture is seen")
    draw(sketch, eight())
    verdict(sketch, WORD["none"])
    assert all(drawing in sketch.evaluate(KEPT) for drawing in before)
    reloaded(sketch)
    wait_until(lambda: has_picture(sketch), "the picture is seen again")
    assert len(saved(sketch)["strokes"]) == 1
    sketch.keyboard.press("n")
    sketch.click("[data-action=back]")
    wait_until(lambda: has_picture(sketch), "the picture is seen after going back")


def test_a_picture_that_cannot_be_kept_says_so_before_it_is_used(sketch, large_picture):
    session = sketch.context.new_cdp_session(sketch)
    session.send("Storage.overrideQuotaForOrigin", {"origin": sketch.url.rstrip("/"), "quotaSize": 1_000_000})
    draw(sketch, eight())
    for choice in ("Leave the picture", "Use it all the same"):
        sketch.set_input_files("#file", large_picture)
        sketch.wait_for_selector("dialog[open] :text('no room')")
        assert saved(sketch)["image"] is None
        sketch.click(f"dialog button:has-text('{choice}')")
    placed(sketch)
    sketch.wait_for_function(TOLD)
    session.send("Storage.overrideQuotaForOrigin", {"origin": sketch.url.rstrip("/")})
    draw(sketch, eight() / 2)
    sketch.wait_for_function("() => document.getElementById('unkept').hidden")


def test_the_sixty_first_drawing_takes_no_other(sketch):
    sketch.evaluate(
        """() => {
            for (let i = 0; i < 60; i++) {
                const strokes = [{ points: [[0, 0], [9, i], [5, 9]], closed: true }];
                const document = { plyfold: 1, strokes, image: null, view: {} };
                localStorage.setItem(`plyfold.drawing.${i}`, JSON.stringify({ saved: i, name: null, document }));
            }
        }"""
    )
    draw(sketch, eight())
    verdict(sketch, WORD["none"])
    assert len(sketch.evaluate(KEPT)) == 61
    sketch.keyboard.press("Shift+G")
    assert sketch.locator("dialog .card").count() == 60


def test_a_drawing_that_cannot_be_kept_says_so_and_is_not_left_without_a_question(sketch):
    count = sketch.evaluate(FILL)
    draw(sketch, eight())
    sketch.wait_for_function(TOLD)
    assert "no room" in sketch.inner_text("#unkept")
    assert len(sketch.evaluate(KEPT)) == count
    sketch.keyboard.press("n")
    sketch.wait_for_selector("dialog[open] :text('no room')")
    sketch.keyboard.press("Escape")
    verdict(sketch, WORD["none"])
    sketch.click("#unkept button:has-text('Drawings')")
    sketch.locator("dialog button:has-text('Discard')").first.click()
    sketch.keyboard.press("Escape")
    sketch.wait_for_function("() => document.getElementById('unkept').hidden")
    assert len(sketch.evaluate(KEPT)) == count
    assert len(saved(sketch)["strokes"]) == 1


def test_a_drawing_that_cannot_be_kept_can_be_left_behind_or_saved_as_a_file(sketch):
    count = sketch.evaluate(FILL)
    draw(sketch, eight())
    sketch.wait_for_function(TOLD)
    sketch.keyboard.press("n")
    with sketch.expect_download() as download:
        sketch.click("dialog button:has-text('Save it as a file')")
    assert len(open_file("drawing.json", download.value.path().read_bytes()).strokes) == 1
    sketch.wait_for_selector("#invitation", state="visible")
    draw(sketch, eight())
    sketch.wait_for_function(TOLD)
    sketch.keyboard.press("n")
    sketch.click("dialog button:has-text('Leave it behind')")
    sketch.wait_for_selector("#invitation", state="visible")
    assert len(sketch.evaluate(KEPT)) == count


@pytest.mark.slow
def test_a_page_with_work_that_is_not_kept_asks_before_it_closes(sketch):
    sketch.evaluate(FILL)
    draw(sketch, eight())
    sketch.wait_for_function(TOLD)
    asked = []
    sketch.on("dialog", lambda dialog: (asked.append(dialog.type), dialog.accept()))
    reloaded(sketch)
    assert asked == ["beforeunload"]
    sketch.evaluate("localStorage.clear()")
    sketch.keyboard.press("n")
    draw(sketch, eight())
    verdict(sketch, WORD["none"])
    reloaded(sketch)
    assert len(asked) == 1


# ---- every scale -----------------------------------------------------------------------------------------------------


def answers(document):
    told = look_at(Look(document.strokes))
    return told["gauss"], told["verdict"]["immersions"], told["turning_numbers"]


def opened_with(page, document, tmp_path):
    (tmp_path / "begun.json").write_text(json.dumps(document))
    page.set_input_files("#file", tmp_path / "begun.json")


@pytest.mark.parametrize("scale", [1e-12, 1e-5, 1e-2, 1e12])
def test_link_and_file_hold_the_drawing_at_every_scale(sketch, scale, tmp_path):
    points = (named("milnor", 1.0) * scale).tolist()
    document = {"plyfold": 1, "strokes": [{"points": points, "closed": True}]}
    begun = open_file("begun.json", json.dumps(document).encode())
    opened_with(sketch, document, tmp_path)
    verdict(sketch, "A disk of cloth, in 2 ways")
    sketch.keyboard.press("Control+s")
    with sketch.expect_download() as download:
        sketch.keyboard.press("Control+s")
    assert open_file("saved.json", download.value.path().read_bytes()).strokes == begun.strokes
    sketch.keyboard.press("Shift+S")
    sketch.wait_for_function("() => location.hash.startsWith('#d=')")
    link = sketch.url
    sketch.goto("about:blank")
    sketch.evaluate("() => 0")
    sketch.goto(link)
    sketch.wait_for_selector("html[data-ready]")
    verdict(sketch, "A disk of cloth, in 2 ways")
    back = sketch.evaluate("async () => (await (await import('/link.js')).decode(location.hash)).strokes")
    assert answers(open_file("link.json", json.dumps(document | {"strokes": back}).encode())) == answers(begun)


def test_a_long_drawing_still_fits_into_a_link_if_rounding_changes_no_answer(sketch, tmp_path):
    t = np.linspace(0, 2 * np.pi, 500, endpoint=False)
    points = 1e-7 * np.c_[np.sin(t) + 0.3 * np.sin(7 * t), np.cos(t) + 0.3 * np.cos(7 * t)]
    opened_with(sketch, {"plyfold": 1, "strokes": [{"points": points.tolist(), "closed": True}]}, tmp_path)
    verdict(sketch, "")
    sketch.wait_for_selector("#figures dd")
    code = figure(sketch, "Gauss code")
    sketch.keyboard.press("Shift+S")
    sketch.wait_for_function("() => location.hash.startsWith('#d=')")
    link = sketch.url
    sketch.goto("about:blank")
    sketch.goto(link)
    sketch.wait_for_selector("#figures dd")
    assert figure(sketch, "Gauss code") == code


# ---- two tabs, and hands ---------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_duplicated_tab_goes_on_with_a_drawing_of_its_own(sketch):
    draw(sketch, eight())
    verdict(sketch, WORD["none"])
    with sketch.context.expect_page() as opening:
        sketch.evaluate("void open(location.href)")  # as a duplicate it begins with what this tab knows
    twin = opening.value
    twin.wait_for_selector("html[data-ready]")
    assert twin.evaluate("sessionStorage['plyfold.id']") == sketch.evaluate("sessionStorage['plyfold.id']")
    sketch.bring_to_front()
    draw(sketch, eight() * 0.5)
    twin.bring_to_front()
    draw(twin, eight() * [0.3, 1.2])
    wait_until(lambda: len(saved(twin)["strokes"]) == 2, "the twin's stroke is kept")
    first, second = saved(sketch)["strokes"], saved(twin)["strokes"]
    assert len(first) == len(second) == 2
    assert first[0] == second[0]
    assert first[1] != second[1]
    reloaded(sketch)
    assert saved(sketch)["strokes"] == first


SLOW = pytest.mark.slow


@pytest.mark.parametrize("tool", ["erase", pytest.param("edit", marks=SLOW), pytest.param("hand", marks=SLOW)])
def test_after_new_something_can_be_drawn(sketch, tool):
    draw(sketch, named("exit-ramp"))
    verdict(sketch, WORD["immersible"])
    sketch.click(f".rail [data-action={tool}]")
    sketch.keyboard.press("n")
    draw(sketch, eight())
    verdict(sketch, WORD["none"])


def test_points_stay_chosen_for_a_new_drawing(sketch):
    draw(sketch, eight())
    sketch.keyboard.press("p")
    sketch.keyboard.press("n")
    assert sketch.locator(".rail [data-action=points]").get_attribute("aria-pressed") == "true"


@pytest.mark.slow
def test_the_gap_slider_shows_the_gap_that_is_kept(sketch):
    draw(sketch, named("exit-ramp"))
    verdict(sketch, WORD["immersible"])
    settled(sketch)
    sketch.focus("#gap")
    for _ in range(10):
        sketch.keyboard.press("ArrowRight")
    wait_until(lambda: saved(sketch)["view"].get("gap"), "the gap is kept")
    settled(sketch)
    shown = sketch.input_value("#gap"), sketch.inner_text("#gap-value")
    assert shown == ("1", "× 2.00")
    reloaded(sketch)
    verdict(sketch, WORD["immersible"])
    assert (sketch.input_value("#gap"), sketch.inner_text("#gap-value")) == shown
    sketch.keyboard.press("n")
    assert (sketch.input_value("#gap"), sketch.inner_text("#gap-value")) == ("0", "")
    sketch.click("[data-action=back]")
    assert (sketch.input_value("#gap"), sketch.inner_text("#gap-value")) == shown


def test_points_in_the_making_are_kept_when_another_drawing_is_opened(sketch):
    sketch.keyboard.press("p")
    for place in places(sketch, [(-100, -80), (100, -80), (0, 120)]):
        sketch.mouse.click(*place)
    sketch.keyboard.press("n")
    sketch.click("[data-action=back]")
    wait_until(lambda: verdict(sketch, WORD["unfinished"]), "the points are back")
    assert len(saved(sketch)["strokes"][0]["points"]) == 3


@pytest.mark.parametrize("palm", ["before", "during"])
def test_a_palm_on_the_screen_leaves_the_pens_stroke_alone(phone, palm):
    box = phone.locator("#drawing").bounding_box()
    size = 0.6 * min(box["width"], box["height"])
    rest = places(phone, [[0.1 * size, -0.5 * size]])[0]
    draw_by_pen(phone, named("exit-ramp", size), palm=(rest, palm))
    verdict(phone, WORD["immersible"])
    assert len(saved(phone)["strokes"]) == 1
    draw_by_pen(phone, named("exit-ramp", 0.4 * size), palm=None)
    wait_until(lambda: len(saved(phone)["strokes"]) == 2, "the pen draws again")


def test_a_palm_and_a_second_finger_take_no_points_away(phone):
    phone.tap("[data-action=points]")
    session = phone.context.new_cdp_session(phone)
    first, second, third, palm, *fingers = places(phone, [[-90, -60], [90, -60], [0, 60], [60, -90], [-9, 0], [40, 0]])
    for place in (first, second):
        touch(session, "touchStart", place)
        touch(session, "touchEnd")
    touch(session, "touchStart", fingers[0])
    touch(session, "touchStart", *fingers)
    touch(session, "touchEnd")
    touch(session, "touchStart", palm)
    pen(session, "mousePressed", third)
    pen(session, "mouseReleased", third)
    touch(session, "touchEnd")
    phone.keyboard.press("c")
    verdict(phone, WORD["immersible"])
    assert len(saved(phone)["strokes"][0]["points"]) == 3
