import base64
import json
import shutil
import subprocess
from html.parser import HTMLParser
from itertools import pairwise
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import plyfold as pf
from coarse import CURVES
from plyfold.draw.viewer import frame, mesh_data, page
from plyfold.errors import PrecisionError


def small_surface(scale=1.0, shift=0.0):
    """Two triangles on two levels, far from the origin if asked."""
    plane = np.array([(0, 0, 0), (4, 0, 0), (4, 3, 0.5), (0, 3, 0.5)]) * scale + shift
    return SimpleNamespace(
        vertices=plane,
        faces=np.array([(0, 1, 2), (0, 2, 3)]),
        sheet=np.array([0, 1]),
        boundary=np.array([0, 1, 2, 3]),
        cusps=np.empty(0, dtype=int),
        gap=1.0,
        intersections=(),
        n_layers=2,
        is_disk=True,
        layering=SimpleNamespace(level=np.array([1, 2]), immersion=SimpleNamespace(sheet_cell=np.array([1, 2]))),
        unwrap=no_disk,
    )


def no_disk():
    raise PrecisionError("doubles cannot hold the disk")


RAMP = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]


class Page(HTMLParser):
    """Collects the scripts, and every address that the page would load."""

    def __init__(self, text):
        super().__init__()
        self.scripts, self.addresses, self.open = {}, [], []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.addresses += [value for name, value in attrs if name in {"src", "href", "action", "poster", "data"}]
        if tag not in {"meta", "link", "input", "br"}:
            self.open.append((tag, attributes))

    def handle_endtag(self, tag):
        opened, attributes = self.open.pop()
        assert opened == tag
        if tag == "script":
            self.scripts[attributes.get("id") or attributes.get("type") or "plain"] = self.text

    def handle_data(self, data):
        self.text = data


def decoded(data, name, kind):
    return np.frombuffer(base64.b64decode(data[name]), kind)


@pytest.fixture(scope="module")
def written():
    return page(small_surface(), title="Ramp & co", figures={"crossings": 4, "<b>": "x"})


def test_page_loads_nothing(written):
    assert Page(written).addresses == []
    assert "@import" not in written
    assert "url(" not in written.split("</style>")[0]


def test_page_closes_every_element_and_holds_five_scripts(written):
    parsed = Page(written)
    assert parsed.open == []
    assert set(parsed.scripts) == {"surface", "three", "cloth", "plain", "module"}


def test_scripts_arrive_whole(written):
    """No closing tag inside a script cuts it short."""
    static = Path(__file__).parents[2] / "src/plyfold/draw/static"
    parsed = Page(written)
    assert parsed.scripts["three"] == (static / "three.min.js").read_text()
    assert parsed.scripts["cloth"] == (static / "cloth.js").read_text()
    assert (static / "viewer.js").read_text() in parsed.scripts["module"]


def test_title_and_figures_are_escaped(written):
    assert "<title>Ramp &amp; co</title>" in written
    assert "<dt>crossings</dt><dd>4</dd>" in written
    assert "<b>" not in written


def test_page_holds_the_mesh_of_the_surface(written):
    assert json.loads(Page(written).scripts["surface"]) == mesh_data(small_surface())


@pytest.mark.parametrize(("scale", "shift"), [(1.0, 0.0), (1e-8, 0.0), (1e8, 0.0), (1.0, 1e6), (1e-3, -1e4)])
def test_data_decode_to_the_mesh(scale, shift):
    surface = small_surface(scale, shift)
    surface.intersections = (surface.vertices[[0, 2]], surface.vertices[[1, 2, 3]])
    data = mesh_data(surface)
    vertices = np.array(data["centre"]) + data["scale"] * decoded(data, "vertices", "<f4").reshape(-1, 3).astype(float)
    assert np.abs(vertices - surface.vertices).max() < 1e-6 * 4 * scale
    assert (decoded(data, "faces", "<u4").reshape(-1, 3) == surface.faces).all()
    assert (decoded(data, "boundary", "<u4") == surface.boundary).all()
    assert (decoded(data, "sheet", "<u4") == surface.sheet).all()
    assert (decoded(data, "level", "<u4") == surface.layering.level).all()
    for stored, polyline in zip(data["intersections"], surface.intersections, strict=True):
        places = decoded({"polyline": stored}, "polyline", "<f4").reshape(-1, 3).astype(float)
        assert np.abs(np.array(data["centre"]) + data["scale"] * places - polyline).max() < 1e-6 * 4 * scale


@pytest.mark.parametrize(("scale", "shift"), [(1.0, 0.0), (1e-8, 0.0), (1.0, 1e6)])
def test_frames_begin_with_the_round_disk_and_lead_to_the_drawing(scale, shift):
    surface = pf.lift(np.array(RAMP) * scale + shift, triangles=300)
    data = mesh_data(surface)
    frames = [decoded({"frame": stored}, "frame", "<f4").reshape(-1, 2).astype(float) for stored in data["frames"]]
    flat = (surface.vertices[:, :2] - data["centre"][:2]) / data["scale"]
    rim = frames[0][surface.boundary]
    assert np.ptp(np.hypot(*(rim - frames[0].mean(axis=0)).T)) < 0.5
    assert np.ptp(np.hypot(*(rim - (rim.max(axis=0) + rim.min(axis=0)) / 2).T)) < 1e-2
    steps = [np.abs(after - before).max() for before, after in pairwise([*frames, flat])]
    assert len(frames) >= 8
    assert max(steps) < 0.5 * np.abs(flat - frames[0]).max()
    assert data["sheetCell"] == surface.layering.immersion.sheet_cell.tolist()


def test_a_disk_that_doubles_cannot_hold_has_no_frames():
    assert mesh_data(small_surface())["frames"] == []


def test_there_is_a_colour_for_every_level():
    assert len(mesh_data(small_surface())["palette"]["layers"]) == 2


def test_frame_holds_the_page(written):
    class Frame(HTMLParser):
        def handle_starttag(self, tag, attrs):
            self.attributes = dict(attrs)

    parsed = Frame()
    parsed.feed(frame(small_surface(), title="Ramp", height=300))
    assert parsed.attributes["srcdoc"] == page(small_surface(), title="Ramp")
    assert "height:300px" in parsed.attributes["style"]


@pytest.mark.skipif(shutil.which("node") is None, reason="node checks the syntax")
@pytest.mark.parametrize("script", ["three", "cloth", "plain", "module"])
def test_scripts_are_sound_javascript(written, script, tmp_path):
    file = tmp_path / "script.mjs"
    file.write_text(Page(written).scripts[script])
    done = subprocess.run(["node", "--check", file], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


# ---- in a real browser, where there is one ---------------------------------------------------------------------------


@pytest.fixture
def shown(browser, written, tmp_path):
    """The page opened from a file, with everything it complained about and asked for."""
    file = tmp_path / "page.html"
    file.write_text(written)
    tab = browser.new_page(viewport={"width": 700, "height": 500})
    tab.complaints, tab.asked = [], []
    tab.on("console", lambda message: tab.complaints.append(message.text))
    tab.on("pageerror", lambda error: tab.complaints.append(str(error)))
    tab.on("request", lambda request: tab.asked.append(request.url))
    tab.goto(file.as_uri())
    tab.get_by_role("button", name="Fit").wait_for()
    yield tab
    tab.close()


def picture(tab):
    """The colours of a screenshot, shape (height, width, 3), without heading, buttons and focus."""
    from io import BytesIO

    from PIL import Image

    bare = ".viewer :is(header, [role=toolbar]) { visibility: hidden } .viewer canvas { box-shadow: none !important }"
    hide = tab.add_style_tag(content=bare)
    tab.wait_for_timeout(300)
    shot = Image.open(BytesIO(tab.screenshot())).convert("RGB")
    hide.evaluate("style => style.remove()")
    return np.asarray(shot, dtype=int)


def colour_at(tab, x, y):
    """Red, green and blue of a pixel."""
    return picture(tab)[y, x]


def cloth(tab):
    """Which pixels are blue cloth, shape (height, width)."""
    red, _, blue = np.moveaxis(picture(tab), -1, 0)
    return blue > red + 40


def box(mask):
    """The first and last column, and the first and last row, of what is true."""
    columns, rows = (np.flatnonzero(mask.any(axis=axis)) for axis in (0, 1))
    return (columns[0], columns[-1]), (rows[0], rows[-1])


def test_browser_shows_the_surface_without_a_complaint_or_a_request(shown):
    red, _, blue = colour_at(shown, 350, 250)
    assert blue > red + 40
    # The test itself reads the picture back.
    assert [said for said in shown.complaints if "GPU stall due to ReadPixels" not in said] == []
    assert all(address.startswith(("file:", "blob:")) for address in shown.asked)


def test_keys_need_no_click_first(shown):
    shown.keyboard.press("x")
    shown.locator("[aria-keyshortcuts=X][aria-pressed=true]").wait_for()
    shown.locator("input[type=range]").first.focus()
    shown.keyboard.press("x")
    shown.locator("[aria-keyshortcuts=X][aria-pressed=false]").wait_for()


def test_top_view_equals_the_drawing(shown):
    shown.keyboard.press("Tab")
    shown.keyboard.press("t")
    assert shown.get_by_role("button", name="Top view").get_attribute("aria-pressed") == "true"
    mask = cloth(shown)
    (left, right), (top, bottom) = box(mask)
    pixels = (right - left) / 4  # the drawing is 4 wide and 3 tall
    assert (bottom - top) / pixels == pytest.approx(3, abs=0.05)
    assert mask[top:bottom, left:right].mean() > 0.97
    assert abs((left + right) / 2 - 350) < 3


def test_intersections_are_red_lines(browser, tmp_path):
    surface = small_surface()
    surface.intersections = (surface.vertices[[0, 2]],)
    file = tmp_path / "page.html"
    file.write_text(page(surface))
    tab = browser.new_page(viewport={"width": 700, "height": 500})
    tab.goto(file.as_uri())
    red, green, blue = np.moveaxis(picture(tab), -1, 0)
    assert (red > np.maximum(green, blue) + 100).sum() > 400
    tab.close()


def test_see_through_lets_light_through(shown):
    solid = colour_at(shown, 350, 250)
    shown.get_by_role("button", name="See-through").click()
    assert sum(colour_at(shown, 350, 250)) > sum(solid) + 60


def open_ramp(browser, tmp_path, curve=RAMP):
    file = tmp_path / "ramp.html"
    pf.lift(curve, triangles=800).export(file)
    tab = browser.new_page(viewport={"width": 700, "height": 700})
    tab.goto(file.as_uri())
    tab.get_by_role("button", name="Top view").click()
    return tab


def covered(tab):
    """The share of its box in the picture that cloth covers."""
    mask = cloth(tab)
    (left, right), (top, bottom) = box(mask)
    return float(mask[top : bottom + 1, left : right + 1].mean())


def test_the_slider_unwinds_the_surface_to_a_round_disk(browser, tmp_path):
    tab = open_ramp(browser, tmp_path)
    lifted = covered(tab)
    tab.get_by_label("Disk to surface").fill("0")
    assert covered(tab) == pytest.approx(np.pi / 4, abs=0.02) != lifted
    tab.get_by_label("Disk to surface").fill("2")
    assert covered(tab) == pytest.approx(lifted, abs=0.01)
    tab.close()


def test_the_sheet_under_the_pointer_lights_up_and_is_told(browser, tmp_path):
    tab = open_ramp(browser, tmp_path)
    tab.evaluate(
        "document.querySelector('.viewer').addEventListener('plyfold-hover', e => { window.told = e.detail; })"
    )
    tab.mouse.move(*place_on_screen(tab, (8.5, 3)))
    tab.wait_for_timeout(300)
    told = tab.evaluate("window.told")
    sheets = pf.find_immersion(RAMP)
    assert told["cell"] == sheets.sheet_cell[told["sheet"]]
    tab.mouse.move(3, 3)
    tab.wait_for_timeout(300)
    assert tab.evaluate("window.told") is None
    tab.close()


def place_on_screen(tab, point):
    """Where the top view shows a point of the ramp, whose box is from 0 to 9 and from -3 to 6."""
    (left, right), (top, bottom) = box(cloth(tab))
    return left + point[0] * (right - left) / 9, bottom - (point[1] + 3) * (bottom - top) / 9


# ---- layers torn apart -----------------------------------------------------------------------------------------------


def torn_edges(surface):
    """Directed edges of triangles that have none beside them, or one of another level: (rim, seams)."""
    level = surface.layering.level[surface.sheet]
    owner = {
        (a, b): level[t] for t, face in enumerate(surface.faces) for a, b in zip(face, np.roll(face, -1), strict=True)
    }
    rim = {edge for edge in owner if edge[::-1] not in owner}
    seams = {edge for edge, own in owner.items() if owner.get(edge[::-1], own) != own}
    return rim, seams


TEAR = """async () => {
  const { clothGeometry, decode, moveTo, openEdges } = await import("cloth");
  const surface = decode(JSON.parse(document.getElementById("surface").textContent));
  const geometry = clothGeometry(surface);
  const heights = (apart) => {
    moveTo(geometry, surface, surface.vertices, apart);
    return [...geometry.getAttribute("position").array].filter((_, i) => i % 3 === 2);
  };
  return { ...openEdges(surface), before: heights(0), after: heights(0.5) };
}"""


def test_each_layer_moves_as_a_piece_and_tears_at_its_borders(browser, tmp_path):
    surface = pf.lift(RAMP, triangles=300)
    (tmp_path / "ramp.html").write_text(page(surface))
    tab = browser.new_page()
    tab.goto((tmp_path / "ramp.html").as_uri())
    torn = tab.evaluate(TEAR)
    tab.close()
    level = surface.layering.level[surface.sheet]
    assert np.allclose(np.subtract(torn["after"], torn["before"]), np.repeat(0.5 * (level - 1.5), 3), atol=1e-6)
    ends = [(face[i], face[(i + 1) % 3]) for face in surface.faces for i in range(3)]
    rim, seams = torn_edges(surface)
    assert {ends[corner] for corner in torn["rim"]} == rim
    assert {ends[corner] for corner in torn["seams"]} == seams
    assert len(rim) == len(surface.boundary)
    assert len(seams) > 2


def test_exploding_parts_the_layers_and_the_whole_stays_in_sight(browser, tmp_path):
    tab = open_ramp(browser, tmp_path, CURVES["exit-ramp"].curve)
    tab.get_by_role("button", name="Perspective").click()
    tab.get_by_label("Explode layers").fill("1")
    (left, right), (top, bottom) = box(cloth(tab))
    assert 0 < left < right < 699
    assert 0 < top < bottom < 699
    tab.evaluate("document.querySelector('canvas').focus()")
    for _ in range(4):
        tab.keyboard.press("ArrowDown")  # to the height of the layers
    tab.keyboard.press("f")
    mask = cloth(tab)
    _, (top, bottom) = box(mask)
    assert not mask[top:bottom].any(axis=1).all()  # there is nothing between two layers
    tab.close()


# ---- windows, fingers and keys ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("view", ["p", "t"])
@pytest.mark.parametrize("window", [(360, 740), (800, 560), (740, 360), (1280, 800)])
def test_the_whole_surface_is_seen_between_heading_and_buttons(browser, tmp_path, window, view):
    tab = open_ramp(browser, tmp_path)
    tab.keyboard.press(view)
    tab.set_viewport_size({"width": window[0], "height": window[1]})
    tab.wait_for_timeout(200)
    (left, right), (top, bottom) = box(cloth(tab))
    heading = tab.locator("header").bounding_box()
    bar = tab.get_by_role("toolbar").bounding_box()
    free = bar["y"] - heading["y"] - heading["height"]
    assert heading["y"] + heading["height"] < top < bottom < bar["y"]
    assert 0 < left < right < window[0] - 1
    assert (bottom - top) / free > 0.75 or (right - left) / window[0] > 0.75
    assert (top + bottom) / 2 == pytest.approx(bar["y"] - free / 2, abs=0.06 * free)
    assert (left + right) / 2 == pytest.approx(window[0] / 2, abs=0.04 * window[0])
    tab.close()


def test_fingers_have_room(browser, tmp_path, written):
    (tmp_path / "page.html").write_text(written)
    context = browser.new_context(viewport={"width": 360, "height": 740}, has_touch=True, is_mobile=True)
    tab = context.new_page()
    tab.goto((tmp_path / "page.html").as_uri())
    for control in tab.locator(".viewer :is(button, input)").all():
        room = control.bounding_box()
        assert min(room["width"], room["height"]) >= 40
        assert room["x"] >= 0
        assert room["x"] + room["width"] <= 360
    context.close()


def test_a_chosen_colour_leaves_the_keys_free(shown):
    shown.get_by_role("group", name="Colour").get_by_role("button", name="Sheets").click()
    shown.keyboard.press("x")
    shown.locator("[aria-keyshortcuts=X][aria-pressed=true]").wait_for()
    shown.keyboard.press("2")
    assert shown.get_by_role("button", name="Layers").get_attribute("aria-pressed") == "true"
    assert shown.get_by_role("button", name="Sheets").get_attribute("aria-pressed") == "false"


def test_the_back_of_a_sheet_has_a_darker_shade_of_its_colour(shown):
    """Sheet 1 is orange; from below it is further to the right and behind."""

    def orange():
        red, green, blue = np.moveaxis(picture(shown), -1, 0)
        of_sheet = (red > 1.2 * green) & (green > 1.2 * blue)
        return picture(shown)[of_sheet]

    shown.keyboard.press("3")
    above = orange()
    for _ in range(20):
        shown.keyboard.press("ArrowDown")
    below = orange()
    assert min(len(above), len(below)) > 2000
    assert np.median(below, axis=0)[0] < 0.85 * np.median(above, axis=0)[0]
    red, _, blue = np.moveaxis(picture(shown), -1, 0)
    assert (blue > red + 40).sum() > 2000  # sheet 0 is blue on both sides
