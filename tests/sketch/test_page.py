"""The sketching page in a real browser: drawn with real pointer events, and by keyboard alone."""

import re

import numpy as np
import pytest

from plyfold import gallery
from sketch.by_hand import (
    WORD,
    dense,
    drag,
    draw,
    draw_by_finger,
    eight,
    figure,
    named,
    places,
    saved,
    settled,
    verdict,
    wait_until,
)

pytest.importorskip("playwright")


def blue_pixels(page):
    """Return how many pixels of the drawing have a cell's colours."""
    script = """() => {
        const canvas = document.getElementById("drawing");
        const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
        let blue = 0;
        for (let i = 0; i < data.length; i += 4) if (data[i + 3] && data[i + 2] - data[i] > 20) blue += 1;
        return blue;
    }"""
    return page.evaluate(script)


def painted(page):
    return page.evaluate("document.getElementById('drawing').toDataURL()")


def height(document):
    points = np.concatenate([stroke["points"] for stroke in document["strokes"]])
    return np.ptp(points[:, 1])


def red_pixels_near(page, place, reach=14):
    script = """([x, y, reach]) => {
        const canvas = document.getElementById("drawing");
        const box = canvas.getBoundingClientRect();
        const corner = [x - box.x - reach, y - box.y - reach];
        const { data } = canvas.getContext("2d").getImageData(...corner, 2 * reach, 2 * reach);
        let red = 0;
        for (let i = 0; i < data.length; i += 4) if (data[i] > 150 && data[i + 1] < 70 && data[i + 2] < 90) red += 1;
        return red;
    }"""
    return page.evaluate(script, [*place, reach])


def test_a_ramp_is_drawn_and_lifted(sketch):
    draw(sketch, named("exit-ramp"))
    assert verdict(sketch, WORD["immersible"])
    assert figure(sketch, "crossings") == "4"
    assert figure(sketch, "turning number") == "1"
    assert figure(sketch, "immersions") == "1"
    settled(sketch)
    assert sketch.locator("#surface.empty").count() == 0
    sketch.wait_for_function("() => document.querySelector('#surface canvas').width > 300")
    points = gallery.CURVES["exit-ramp"].draw(40)
    x, y = ((points - points.min(axis=0)) * 380 / np.ptp(points, axis=0).max()).T
    doubled = abs(float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))) / 2
    # The cloth's area, less where it lies double.
    wait_until(lambda: 0.75 * doubled < blue_pixels(sketch) < 1.05 * doubled, "the cells are painted")


def test_milnors_curve_lies_in_two_ways(sketch):
    draw(sketch, named("milnor", 520))
    assert "2 ways" in verdict(sketch, "A disk of cloth, in 2 ways")
    settled(sketch)
    assert sketch.inner_text("#immersion-text") == "immersion 1 of 2"
    sketch.keyboard.press("ArrowRight")
    sketch.wait_for_function("() => document.getElementById('immersion-text').textContent === 'immersion 2 of 2'")
    sketch.keyboard.press("ArrowRight")
    sketch.wait_for_function("() => document.getElementById('immersion-text').textContent === 'immersion 1 of 2'")
    settled(sketch)
    sketch.keyboard.press("ArrowUp")
    sketch.wait_for_function("() => document.getElementById('layering-text').textContent.startsWith('layering 2 of')")
    sketch.keyboard.press("v")
    assert sketch.locator("#layout .border").count() == 12


def test_a_figure_eight_is_kept_with_a_red_cross_where_a_lobe_turns_the_wrong_way(sketch):
    draw(sketch, eight())
    assert "turns 0 times" in verdict(sketch, WORD["none"])
    assert len(saved(sketch)["strokes"]) == 1
    assert sketch.locator("#surface.empty").count() == 1
    marked = places(sketch, [[0, 0], [120, 0], [-120, 0]])
    wait_until(lambda: max(red_pixels_near(sketch, place) for place in marked) > 20, "the cross is painted")


def test_a_small_kink_is_removed_by_a_button(sketch):
    corners = [[-150, -100], [150, -100], [150, 100], [-20, 100], [-20, 130], [0, 130], [0, 70], [-150, 70]]
    draw(sketch, dense(np.array(corners, dtype=float)))
    verdict(sketch, WORD["none"])
    sketch.click("text=Leave out a small loop")
    verdict(sketch, WORD["immersible"])
    assert figure(sketch, "crossings") == "0"
    sketch.keyboard.press("Control+z")
    verdict(sketch, WORD["none"])


@pytest.mark.parametrize("tool", ["draw", "points", "edit", "erase", "hand"])
def test_tools_are_chosen_by_the_mouse(sketch, tool):
    """At the very place where the button is seen, nothing lies over it."""
    button = sketch.locator(f".rail [data-action={tool}]")
    box = button.bounding_box()
    sketch.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    assert button.get_attribute("aria-pressed") == "true"


def test_half_a_figure_eight_is_no_small_kink(sketch):
    draw(sketch, eight())
    verdict(sketch, WORD["none"])
    sketch.wait_for_selector("[data-action=showPieces]:enabled")
    assert not sketch.locator("[data-action=repair]").is_visible()


def test_offers_are_seen_before_they_are_taken_and_undone_like_anything_else(sketch):
    """By pointer and by keyboard alike, right beside the cross."""
    draw(sketch, eight())
    verdict(sketch, WORD["none"])
    button = sketch.locator("[data-action=showPieces]:enabled")
    drawn, before = saved(sketch), painted(sketch)
    (cross,) = places(sketch, [[0, 0]])
    box = button.bounding_box()
    near = [np.clip(cross[0], box["x"], box["x"] + box["width"]), np.clip(cross[1], box["y"], box["y"] + box["height"])]
    assert np.hypot(*np.subtract(near, cross)) < 60
    button.hover()
    wait_until(lambda: painted(sketch) != before, "the pieces are shown")
    assert "2 simple polygons" in sketch.inner_text("#sentence")
    assert saved(sketch) == drawn
    sketch.mouse.move(5, 5)
    wait_until(lambda: painted(sketch) == before, "they are shown no more")
    button.focus()
    wait_until(lambda: painted(sketch) != before, "the keyboard shows them too")
    sketch.keyboard.press("Enter")
    verdict(sketch, "2 pieces of cloth: 2 disks")
    assert len(saved(sketch)["strokes"]) == 2
    sketch.click("#notice [data-action=undo]")
    verdict(sketch, WORD["none"])
    assert saved(sketch)["strokes"] == drawn["strokes"]
    sketch.wait_for_selector("[data-action=showPieces]:enabled")
    sketch.keyboard.press("Shift+I")
    verdict(sketch, "2 pieces of cloth: 2 disks")
    sketch.wait_for_selector("#notice [data-action=undo]")
    sketch.keyboard.press("Control+z")
    assert sketch.locator("#notice").is_hidden()
    assert saved(sketch)["strokes"] == drawn["strokes"]


def test_a_pen_stroke_becomes_a_ribbon_as_wide_as_the_slider_says(sketch):
    t = np.linspace(0, 1, 60)
    draw(sketch, np.c_[-220 + 440 * t, 60 * np.sin(6 * t)])
    assert "too far apart" in verdict(sketch, WORD["unfinished"])
    line, before = saved(sketch)["strokes"], painted(sketch)
    sketch.hover("[data-action=ribbon]")
    wait_until(lambda: painted(sketch) != before, "the ribbon is shown")
    assert saved(sketch)["strokes"] == line
    sketch.click("[data-action=ribbon]")
    verdict(sketch, WORD["immersible"])
    narrow = height(saved(sketch))
    sketch.locator("#width").focus()
    for _ in range(10):
        sketch.keyboard.press("ArrowRight")
    wait_until(lambda: height(saved(sketch)) > narrow + 20, "the ribbon is wider")
    verdict(sketch, WORD["immersible"])
    sketch.locator("#drawing").focus()
    sketch.keyboard.press("Control+z")
    verdict(sketch, WORD["unfinished"])
    assert saved(sketch)["strokes"] == line


def test_undo_redo_and_reload_lose_nothing(sketch):
    draw(sketch, eight())
    verdict(sketch, WORD["none"])
    first = saved(sketch)
    sketch.click("[data-action=undo]")
    assert sketch.is_disabled("[data-action=undo]")
    sketch.keyboard.press("Control+y")
    verdict(sketch, WORD["none"])
    sketch.keyboard.press("Control+z")
    sketch.keyboard.press("Control+Shift+z")
    assert saved(sketch) == first
    sketch.reload()
    sketch.wait_for_selector("html[data-ready]")
    verdict(sketch, WORD["none"])
    assert saved(sketch) == first


def test_undo_waits_for_the_end_of_a_stroke(sketch):
    draw(sketch, eight())
    verdict(sketch, WORD["none"])
    way = places(sketch, [[-200, 200], [-150, 210], [-100, 200]])
    sketch.mouse.move(*way[0])
    sketch.mouse.down()
    sketch.mouse.move(*way[1])
    sketch.keyboard.press("Control+z")
    sketch.mouse.move(*way[2])
    sketch.mouse.up()
    assert len(saved(sketch)["strokes"]) == 2


def test_several_strokes_make_one_loop_and_joins_are_kept_apart_until_joined(sketch):
    t = np.linspace(0.04, np.pi - 0.04, 50)
    draw(sketch, np.c_[150 * np.cos(t), 150 * np.sin(t)])
    assert "too far apart" in verdict(sketch, WORD["unfinished"])
    draw(sketch, np.c_[150 * np.cos(t), -150 * np.sin(t)])
    verdict(sketch, WORD["immersible"])
    assert [stroke["closed"] for stroke in saved(sketch)["strokes"]] == [False, False]
    sketch.keyboard.press("j")
    verdict(sketch, WORD["immersible"])
    assert [stroke["closed"] for stroke in saved(sketch)["strokes"]] == [True]


def test_points_are_placed_dragged_inserted_and_deleted(sketch):
    sketch.keyboard.press("p")
    square = [[-100, -100], [100, -100], [100, 100], [-100, 100]]
    for place in places(sketch, [*square, square[0]]):
        sketch.mouse.click(*place)
    verdict(sketch, WORD["immersible"])
    assert len(saved(sketch)["strokes"][0]["points"]) == 4
    sketch.keyboard.press("e")
    (corner, beyond, edge, out) = places(sketch, [[100, 100], [-200, -30], [0, -100], [0, -160]])
    drag(sketch, edge, out)
    assert len(saved(sketch)["strokes"][0]["points"]) == 5
    sketch.keyboard.press("l")
    drag(sketch, corner, beyond)
    assert "Locked" in sketch.inner_text("#notice")
    sketch.keyboard.press("l")
    sketch.keyboard.press("Control+z")
    drag(sketch, corner, beyond)
    verdict(sketch, WORD["none"])
    sketch.keyboard.press("Delete")
    verdict(sketch, WORD["immersible"])
    assert len(saved(sketch)["strokes"][0]["points"]) == 4


def test_erasing_opens_a_loop_and_drawing_closes_it(sketch):
    t = np.linspace(0, 2 * np.pi, 100)
    draw(sketch, np.c_[150 * np.cos(t), 150 * np.sin(t)])
    verdict(sketch, WORD["immersible"])
    sketch.keyboard.press("x")
    u = np.linspace(-0.8, 0.8, 30)
    draw(sketch, np.c_[150 * np.cos(u), 150 * np.sin(u)])
    verdict(sketch, WORD["unfinished"])
    assert [stroke["closed"] for stroke in saved(sketch)["strokes"]] == [False]
    sketch.keyboard.press("d")
    draw(sketch, np.c_[170 * np.cos(u), 170 * np.sin(u)])
    verdict(sketch, WORD["immersible"])


def test_by_keyboard_alone(sketch):
    sketch.keyboard.press("k")
    for keys in (["ArrowRight"] * 12, ["ArrowUp"] * 12, ["ArrowLeft"] * 12):
        sketch.keyboard.press("Enter")
        for key in keys:
            sketch.keyboard.press(key)
    sketch.keyboard.press("Enter")
    sketch.keyboard.press("c")
    verdict(sketch, WORD["immersible"])
    points = saved(sketch)["strokes"][0]["points"]
    assert np.allclose(np.ptp(points, axis=0), 120)
    sketch.keyboard.press("e")
    sketch.keyboard.press("]")
    for key in ("Enter", "ArrowDown", "ArrowDown", "Enter", "Escape"):
        sketch.keyboard.press(key)
    assert saved(sketch)["strokes"][0]["points"][0] != points[0]
    sketch.keyboard.press("?")
    assert sketch.locator("dialog kbd").count() > 30
    sketch.keyboard.press("Escape")
    sketch.keyboard.press("Tab")
    assert sketch.evaluate("document.activeElement.tagName") in {"BUTTON", "CANVAS"}


def test_a_link_holds_the_drawing_and_overwrites_nothing(sketch, server):
    draw(sketch, named("milnor", 500))
    verdict(sketch, "A disk of cloth, in 2 ways")
    sketch.keyboard.press("Shift+S")
    sketch.wait_for_function("() => location.hash.startsWith('#d=')")
    link = sketch.url
    drawing = saved(sketch)
    sketch.keyboard.press("n")
    draw(sketch, eight())
    verdict(sketch, WORD["none"])
    work = saved(sketch)
    sketch.goto("about:blank")
    sketch.goto(link)
    sketch.wait_for_selector("html[data-ready]")
    verdict(sketch, "A disk of cloth, in 2 ways")
    shared = sketch.evaluate(
        "Object.values(localStorage).filter((v) => v.startsWith('{')).map((v) => JSON.parse(v).document.strokes)"
    )
    assert work["strokes"] in shared
    assert drawing["strokes"] in shared
    sketch.click("[data-action=back]")
    verdict(sketch, WORD["none"])


def test_the_gallery_opens_a_curve(sketch):
    draw(sketch, eight())
    verdict(sketch, WORD["none"])
    sketch.keyboard.press("g")
    sketch.click("dialog .card:has-text('woven')")
    verdict(sketch, WORD["immersible"])
    sketch.click("#notice button")
    verdict(sketch, WORD["none"])


@pytest.mark.parametrize("format", [pytest.param("svg", marks=pytest.mark.slow), "png", "json"])
def test_exports_open_again(sketch, format, tmp_path):
    draw(sketch, named("exit-ramp"))
    verdict(sketch, WORD["immersible"])
    drawing = saved(sketch)
    sketch.keyboard.press("Control+e")
    action = "saveFile" if format == "json" else f"export-{format}"
    with sketch.expect_download() as download:
        sketch.click(f"dialog [data-action={action}]")
    file = tmp_path / download.value.suggested_filename
    download.value.save_as(file)
    assert file.suffix == f".{format}"
    sketch.keyboard.press("n")
    sketch.set_input_files("#file", file)
    verdict(sketch, WORD["immersible"])
    assert np.allclose(saved(sketch)["strokes"][0]["points"], drawing["strokes"][0]["points"], atol=1e-3)


def test_a_sheet_that_cannot_be_lifted_says_why(sketch):
    sketch.keyboard.press("g")
    sketch.click("dialog .card:has-text('cannot be lifted')")
    verdict(sketch, "A disk of cloth, in 2 ways")
    seen = []
    for number in (2, 1):
        settled(sketch)
        sketch.keyboard.press("ArrowRight")
        sketch.wait_for_selector(f"#immersion-text:text-is('immersion {number} of 2')")
        seen.append(sketch.inner_text("#verdict"))
    assert sum("cannot be lifted" in text for text in seen) == 1


# The box of an element, without what scrolls out of sight.
IN_SIGHT = """element => new Promise((resolve) => new IntersectionObserver(([{ intersectionRect }]) =>
    resolve([intersectionRect.width, intersectionRect.height])).observe(element))"""


def test_drawing_verdict_and_surface_are_in_sight_together_on_a_phone(phone):
    box = phone.locator("#drawing").bounding_box()
    draw_by_finger(phone, named("exit-ramp", 0.7 * min(box["width"], box["height"])))
    verdict(phone, WORD["immersible"])
    phone.wait_for_selector("#surface:not(.empty)")
    for place, least in (("#drawing", 200), ("#surface canvas", 150), ("#verdict", 18), ("#sentence", 18)):
        width, height = phone.locator(place).evaluate(IN_SIGHT)
        assert min(width, height) >= least, place
    assert phone.locator(".verdict").bounding_box()["y"] + phone.locator(".verdict").bounding_box()["height"] <= (
        phone.locator(".scene").bounding_box()["y"] + 1
    )
    assert phone.evaluate("[document.documentElement.scrollWidth, innerWidth]") == [phone.viewport_size["width"]] * 2


def test_all_ways_to_change_a_drawing_are_in_sight_on_a_phone(phone):
    bar = phone.locator(".change")
    assert bar.evaluate("bar => bar.scrollWidth <= bar.clientWidth")
    phone.tap("[data-action=gallery]")
    first, second = (phone.locator("dialog .card").nth(i).bounding_box() for i in range(2))
    assert first["y"] == second["y"]


def test_buttons_are_large_enough_for_fingers(phone):
    draw_by_finger(phone, named("exit-ramp", 150))
    verdict(phone, WORD["immersible"])
    phone.wait_for_selector("#surface:not(.empty)")
    small = phone.evaluate(
        """() => [...document.querySelectorAll("button, input, select")].filter((element) => element.checkVisibility())
            .filter((element) => Math.min(element.offsetWidth, element.offsetHeight) < 44)
            .map((element) => element.outerHTML)"""
    )
    assert small == []


def test_all_actions_have_names_and_no_key_is_used_twice(sketch):
    actions = sketch.evaluate(
        "import('/actions.js').then(({ ACTIONS }) => ACTIONS.map((action) => JSON.parse(JSON.stringify(action))))"
    )
    keys = [key for action in actions for key in action["keys"]]
    assert len(keys) == len(set(keys))
    assert len({action["name"] for action in actions}) == len(actions)
    assert all(re.search(r"\w", action["label"]) and action["hint"] for action in actions)


def test_points_that_were_taken_back_come_again(sketch):
    sketch.keyboard.press("p")
    for place in places(sketch, [(-100, -80), (100, -80), (0, 120)]):
        sketch.mouse.click(*place)
    sketch.keyboard.press("Control+z")
    sketch.keyboard.press("Control+z")
    sketch.keyboard.press("Control+y")
    sketch.keyboard.press("Control+y")
    assert sketch.locator("[data-action=redo]").is_disabled()
    sketch.keyboard.press("Enter")
    assert verdict(sketch, WORD["immersible"])
    assert len(saved(sketch)["strokes"][0]["points"]) == 3


def test_escape_gives_up_a_stroke(sketch):
    way = places(sketch, named("exit-ramp"))
    sketch.mouse.move(*way[0])
    sketch.mouse.down()
    for place in way[1:20]:
        sketch.mouse.move(*place)
    sketch.keyboard.press("Escape")
    for place in way[20:40]:
        sketch.mouse.move(*place)
    sketch.mouse.up()
    assert sketch.locator("[data-action=undo]").is_disabled()


def test_help_begins_at_the_top(sketch):
    sketch.keyboard.press("?")
    assert sketch.locator("#dialog h3").first.is_visible()
    assert sketch.evaluate("document.getElementById('dialog').scrollTop") == 0


def test_a_loop_that_is_no_disk_has_no_surface_to_save(sketch):
    draw(sketch, eight())
    verdict(sketch, WORD["none"])
    assert "no surface" in sketch.locator("#surface [role=status]").inner_text()
    sketch.keyboard.press("Control+e")
    assert sketch.locator("[data-action=export-glb]").is_disabled()
    assert sketch.locator("[data-action=export-svg]").is_enabled()


def test_joining_keeps_the_direction(sketch):
    draw(sketch, [(-150, -100), (-150, 100), (150, 100)])
    draw(sketch, [(150, 90), (150, -100), (-140, -100)])
    verdict(sketch, WORD["immersible"])
    assert "clockwise" in figure(sketch, "turning number")
    sketch.keyboard.press("j")
    sketch.wait_for_function("() => document.querySelector('[data-action=join]').disabled")
    settled(sketch)
    assert "clockwise" in figure(sketch, "turning number")


@pytest.mark.parametrize("fragment", ["#%%%", "#d=broken", "#z=AAAA"])
def test_a_damaged_link_is_told_and_forgotten(sketch, fragment):
    sketch.evaluate("fragment => { location.hash = fragment }", fragment)
    sketch.wait_for_function("() => document.getElementById('notice').textContent.includes('not complete')")
    assert sketch.evaluate("location.hash") == ""


def test_a_dragged_point_of_a_smooth_loop_takes_its_neighbours_along(sketch):
    t = np.linspace(0, 2 * np.pi, 90, endpoint=False)
    draw(sketch, 150 * np.c_[np.cos(t), np.sin(t)])
    verdict(sketch, "A disk of cloth")
    before = np.array(saved(sketch)["strokes"][0]["points"])
    middle = (before.min(axis=0) + before.max(axis=0)) / 2
    top = before[np.argmax(before[:, 1])] - middle
    sketch.keyboard.press("e")

    def moved_points():
        drag(sketch, *places(sketch, [top, top + np.array([0, 40])]))
        return (np.array(saved(sketch)["strokes"][0]["points"]) != before).any(axis=1).sum()

    assert moved_points() > 4
    sketch.keyboard.press("Control+z")
    assert (np.array(saved(sketch)["strokes"][0]["points"]) == before).all()
    sketch.keyboard.down("Alt")
    assert moved_points() == 1
    sketch.keyboard.up("Alt")


@pytest.mark.slow
def test_kept_drawings_are_told_apart_by_picture_and_time(sketch):
    for points in (named("exit-ramp"), eight()):
        draw(sketch, points)
        settled(sketch)
        sketch.keyboard.press("n")
    draw(sketch, eight() / 2)
    sketch.keyboard.press("Shift+G")
    cards = sketch.locator("dialog .card")
    assert cards.count() == 2
    pictures = [cards.nth(i).locator("path").get_attribute("d") for i in range(2)]
    assert pictures[0] != pictures[1]
    assert all(cards.nth(i).locator("svg").bounding_box()["width"] > 100 for i in range(2))
    assert all(re.fullmatch(r"Loop\s+Today, .*\d.*", cards.nth(i).inner_text()) for i in range(2))
    cards.nth(1).click()
    verdict(sketch, WORD["immersible"])


def test_a_file_that_cannot_be_read_is_told_without_a_failed_request(sketch, tmp_path):
    (tmp_path / "broken.svg").write_text("<svg nonsense")
    sketch.set_input_files("#file", tmp_path / "broken.svg")
    sketch.wait_for_function("() => document.getElementById('notice').textContent.startsWith('broken.svg: ')")
    assert sketch.complaints == []


def test_negative_numbers_have_a_true_minus_sign(sketch):
    sketch.keyboard.press("p")
    for place in places(sketch, [(-150, 150), (150, 150), (150, -150), (0, 200), (-150, -150)]):
        sketch.mouse.click(*place)
    sketch.keyboard.press("Enter")
    assert "winds −1 times" in verdict(sketch, WORD["none"])


def test_empty_pictures_say_what_will_be_there(sketch):
    assert "appears here" in sketch.evaluate(
        "getComputedStyle(document.querySelector('#surface [role=status]'), '::after').content"
    )
    sketch.keyboard.press("v")
    assert "appears here" in sketch.locator("#layout").text_content()


def test_the_surface_keeps_its_place_whether_there_is_one_or_not(sketch):
    """A picture of another size would be painted anew, which takes longer than the verdict."""
    draw(sketch, named("exit-ramp"))
    verdict(sketch, WORD["immersible"])
    sketch.wait_for_selector("#surface-tools:not(.absent)")
    settled(sketch)
    place = sketch.locator(".scene").bounding_box()
    sketch.keyboard.press("Control+z")
    sketch.wait_for_selector("#surface-tools.absent", state="attached")
    assert sketch.locator(".scene").bounding_box() == place
    assert not sketch.locator("#surface-tools button").first.is_visible()
    draw(sketch, eight())
    verdict(sketch, WORD["none"])
    assert sketch.locator(".scene").bounding_box() == place
