"""What the page writes and opens: drawings go through files and come back as they were, and bad files are refused."""

import base64
import io
import json
import struct
import zipfile
import zlib
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image as Picture

from plyfold.errors import InputError, NotEmbeddableError, NotImmersibleError, PlyfoldError
from plyfold.gallery import CURVES, OUTLINES
from plyfold.sketch.drawings import outline_of
from plyfold.sketch.export import FORMATS, export
from plyfold.sketch.opening import gallery, open_file, opened, start
from plyfold.sketch.pictures import png_document, png_with, svg_document, svg_with
from plyfold.sketch.schema import MOST_BYTES, Backdrop, Document, Export, Lift, Stroke, document_data, read_document

RAMP = Stroke(tuple(map(tuple, CURVES["exit-ramp"].curve.points.tolist())), closed=True)
UNFINISHED = Document((Stroke(((0.0, 0.0), (4.0, 0.1), (1e-300, 3.0))), Stroke(((7.0, 7.0),)), Stroke(())))
NASTY = {"</metadata><script>": "]]> & \u2028 é 🎈 \\ \" ' <!--", "number": -0.1, "none": None, "yes": True}


def picture(kind="PNG", size=(3, 2)):
    """A little picture in a format, and what stands in its pixels."""
    file = io.BytesIO()
    Picture.new("RGB", size, (200, 30, 40)).save(file, kind)
    return file.getvalue()


TRACING = Backdrop("data:image/png;base64," + base64.b64encode(picture()).decode(), (1.0, 2.0, 3.5, 4.0), 0.25)
DOCUMENTS = {
    "ramp": Document((RAMP,)),
    "empty": Document(()),
    "unfinished": UNFINISHED,
    "nasty": Document(UNFINISHED.strokes, TRACING, NASTY),
    "cusps": Document((replace(RAMP, cusps=((0, 1), (3, 2))), Stroke(((1, 1), (1, 2), (2, 1)), closed=True))),
    "no disk": Document((Stroke(((0, 0), (2, 2), (2, 0), (0, 2)), closed=True),)),
    "on a line": Document((Stroke(((0, 0), (1, 1), (2, 2)), closed=True),)),
    "unliftable": Document(
        (Stroke(tuple(map(tuple, CURVES["seven-flaps"].curve.points.tolist())), closed=True),), None, {}
    ),
}


def order(document, kind, **options):
    chosen = {"immersion": 0, "layering": 0, "gap": None, "triangles": 300} | options
    return Export(document, kind, Lift(document.strokes, **chosen))


def written(document, kind, **options):
    return export(order(document, kind, **options))[0]


# ---- documents through files -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["json", "svg", "png"])
@pytest.mark.parametrize("document", DOCUMENTS.values(), ids=DOCUMENTS.keys())
def test_documents_come_back_as_they_were(document, kind):
    assert open_file(f"drawing.{kind}", written(document, kind)) == document


def with_marks(stroke, marks):
    return replace(stroke, cusps=tuple(sorted((at, turns) for at, turns in marks.items() if at < len(stroke.points))))


finite = st.floats(allow_nan=False, allow_infinity=False)
strokes = st.builds(Stroke, st.lists(st.tuples(finite, finite), max_size=4).map(tuple), st.booleans())
strokes = st.builds(with_marks, strokes, st.dictionaries(st.integers(0, 3), st.integers(1, 3)))
documents = st.builds(
    Document,
    st.lists(strokes, max_size=3).map(tuple),
    st.none() | st.just(TRACING),
    st.dictionaries(st.text(max_size=9), st.text(max_size=20) | finite | st.booleans() | st.none(), max_size=4),
)


@given(documents)
@settings(max_examples=200, deadline=None)
def test_any_document_goes_through_json_svg_and_png(document):
    data = json.loads(json.dumps(document_data(document)))
    assert read_document(data) == document
    assert read_document(svg_document(svg_with(document, "<svg><g/></svg>").encode())) == document
    assert read_document(png_document(png_with(document, picture()))) == document


def test_the_text_in_a_png_is_where_other_readers_look_for_it():
    file = written(DOCUMENTS["nasty"], "png")
    with Picture.open(io.BytesIO(file)) as shown:
        shown.load()
        assert json.loads(shown.text["plyfold"]) == document_data(DOCUMENTS["nasty"])


def test_the_text_in_an_svg_is_where_other_readers_look_for_it():
    root = ElementTree.fromstring(written(DOCUMENTS["nasty"], "svg"))
    (metadata,) = root.findall(".//{http://www.w3.org/2000/svg}metadata")
    assert metadata.get("id") == "plyfold"
    assert json.loads(metadata.text) == document_data(DOCUMENTS["nasty"])
    assert root.findall(".//{http://www.w3.org/2000/svg}script") == []


def test_an_svg_that_another_program_has_saved_again_still_opens():
    root = ElementTree.fromstring(written(DOCUMENTS["nasty"], "svg"))
    saved = ElementTree.tostring(root)  # with prefixes of its own for every name
    assert b"<svg:metadata" in saved or b":metadata" in saved
    assert open_file("drawing.svg", saved) == DOCUMENTS["nasty"]


def test_the_svg_of_an_unfinished_drawing_shows_its_strokes():
    document = Document((Stroke(((0, 0), (4, 0.5))), Stroke(((4, 9), (0, 3), (0, 7)), closed=True)))
    root = ElementTree.fromstring(written(document, "svg"))
    lines = [line.get("points") for line in root.iter("{http://www.w3.org/2000/svg}polyline")]
    shown = [[tuple(map(float, place.split(","))) for place in line.split()] for line in lines]
    assert shown == [[(0, 0), (4, -0.5)], [(4, -9), (0, -3), (0, -7), (4, -9)]]
    x, y, width, height = map(float, root.get("viewBox").split())
    assert (x < 0, y < -9, x + width > 4, y + height > 0) == (True,) * 4


# ---- files of the surface --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["glb", "obj", "stl", "ply", "3mf"])
def test_meshes_cover_what_the_loop_goes_round(kind):
    loaded = trimesh.load(io.BytesIO(written(Document((RAMP,)), kind)), file_type=kind, force="mesh", process=False)
    corners = loaded.triangles
    up = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    x, y = np.array(RAMP.points).T
    size = abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
    # Seen from above; in a GLB the height is the second coordinate.
    seen = np.abs(up[:, 1 if kind == "glb" else 2]).sum() / 2
    assert seen == pytest.approx(size, rel=1e-4)


def test_the_chosen_layering_is_written():
    first, second = (written(Document((RAMP,)), "obj", layering=number) for number in (0, 1))
    assert first != second


def test_the_page_and_the_picture_in_tex_are_written():
    assert b"<!doctype html>" in written(Document((RAMP,)), "html")
    assert rb"\begin{tikzpicture}" in written(Document((RAMP,)), "tikz")


@pytest.mark.parametrize("kind", sorted(set(FORMATS) - {"json", "svg", "png"}))
def test_files_of_a_surface_need_one(kind):
    for document, error in [
        (DOCUMENTS["no disk"], NotImmersibleError),
        (DOCUMENTS["unliftable"], NotEmbeddableError),
        (UNFINISHED, PlyfoldError),
    ]:
        with pytest.raises(error):
            export(order(document, kind))


def test_documents_of_version_1_are_read():
    old = json.dumps({"plyfold": 1, "strokes": [{"points": [[0, 0], [4, 0], [0, 3]], "closed": True}]}).encode()
    assert open_file("old.json", old) == Document(TRIANGLE)


def test_other_formats_are_refused():
    with pytest.raises(InputError, match="no format 'exe'"):
        export(order(Document((RAMP,)), "exe"))


# ---- opening ---------------------------------------------------------------------------------------------------------

TRIANGLE = (Stroke(((0.0, 0.0), (4.0, 0.0), (0.0, 3.0)), closed=True),)


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("loop.csv", b"x,y\n0,0\n4,0\n0,3\n"),
        ("loop.txt", b"0 0\n4 0\n0 3\n"),
        ("loop.json", b'{"points": [[0, 0], [4, 0], [0, 3]]}'),
        ("loop.json", b"\xef\xbb\xbf[[0, 0], [4, 0], [0, 3]]"),
        ("loop.json", b"[[[0, 0], [4, 0]], [[4, 0], [0, 3], [0, 0]]]"),
        ("loop.geojson", b'{"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [0, 3], [0, 0]]]}'),
        ("loop.wkt", b"POLYGON ((0 0, 4 0, 0 3, 0 0))"),
        ("loop.svg", b'<svg><polygon points="0,0 4,0 0,-3"/></svg>'),
        ("loop", b"<svg xmlns='http://www.w3.org/2000/svg'><polygon points='0,0 4,0 0,-3'/></svg>"),
        ("../../../loop.csv", b"0,0\n4,0\n0,3\n"),
        ("/etc/loop.csv", b"0,0\n4,0\n0,3\n"),
        ("..", b"0,0\n4,0\n0,3\n"),
        ("loop\0\n'$(x).csv", b"0,0\n4,0\n0,3\n"),
        ("é" * 300 + ".csv", b"0,0\n4,0\n0,3\n"),
    ],
)
def test_drawings_become_one_loop(name, content):
    assert open_file(name, content) == Document(TRIANGLE)


RING = (
    Stroke(((0.0, 0.0), (9.0, 0.0), (0.0, 9.0)), closed=True),
    Stroke(((1.0, 1.0), (1.0, 3.0), (3.0, 1.0)), closed=True),
)


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("ring.geojson", b'{"type": "Polygon", "coordinates": [[[0,0],[9,0],[0,9],[0,0]], [[1,1],[1,3],[3,1],[1,1]]]}'),
        ("ring.wkt", b"POLYGON ((0 0, 9 0, 0 9, 0 0), (1 1, 1 3, 3 1, 1 1))"),
        ("ring.json", b'{"version": 2, "loops": [[[0,0],[9,0],[0,9]], [[1,1],[1,3],[3,1]]]}'),
        ("ring.svg", b'<svg><path fill-rule="evenodd" d="M0 0H9L0-9ZM1-1V-3L3-1Z"/></svg>'),
    ],
)
def test_drawings_become_loops_with_holes(name, content):
    assert open_file(name, content) == Document(RING)
    assert opened(content, {"X-File-Name": name})["shapes"] == []


def test_cusps_of_a_file_are_those_of_the_drawing():
    document = open_file("a.json", b'{"loops": [[[0,0],[9,0],[0,9]]], "cusps": {"0:2": 2}}')
    assert document.strokes[0].cusps == ((2, 2),)


def test_the_shapes_of_a_file_are_told_one_by_one():
    shapes = b'<rect id="a" width="9" height="9"/><line x2="3"/><path d="M20 0h9v9z"/><path id="c" d="M0 30h9v9z"/>'
    answer = opened(b"<svg>%b</svg>" % shapes, {"X-File-Name": "three.svg"})
    assert [shape["name"] for shape in answer["shapes"]] == ["a", "", "c"]
    parts = [stroke for shape in answer["shapes"] for stroke in shape["document"]["strokes"]]
    whole = answer["document"]["strokes"]
    assert [stroke["points"] for stroke in whole] == [stroke["points"] for stroke in parts]
    assert [repair["kind"] for repair in answer["repairs"]] == ["open line left out"]
    assert not any(shape["repairs"] for shape in answer["shapes"])


@pytest.mark.parametrize(("kind", "name"), [("PNG", "png"), ("JPEG", "jpeg"), ("GIF", "gif"), ("WEBP", "webp")])
def test_pictures_become_what_is_drawn_after(kind, name):
    content = picture(kind)
    document = open_file("photo", content)
    start, data = document.image.href.split(",")
    assert (document.strokes, start) == ((), f"data:image/{name};base64")
    assert base64.b64decode(data) == content
    assert read_document(document_data(document)) == document


def test_the_names_of_files_come_as_the_browser_writes_them():
    answer = opened(b"0,0\n4,0\n0,3\n", {"X-File-Name": "%E2%98%83%20snow.csv"})
    assert answer["name"] == "☃ snow"


def bomb():
    """A PNG with a small chunk that unpacks to more than may be sent."""
    text = zlib.compress(b'{"plyfold": 1, "view": {"x": "' + b"0" * (MOST_BYTES + 100) + b'"}}', 9)
    content = b"plyfold\0\1\0\0\0" + text
    chunk = struct.pack(">I", len(content)) + b"iTXt" + content + struct.pack(">I", zlib.crc32(b"iTXt" + content))
    return picture()[:33] + chunk + picture()[33:]


def spoiled(kind):
    """A file whose document is cut short."""
    content = written(UNFINISHED, kind)
    if kind == "png":
        at = content.index(b"iTXt") + 40
        return content[:at] + b"\0" * 50 + content[at + 50 :]
    return content.replace(b'"closed"', b'"clo', 1)


def archive():
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as packed:
        packed.writestr("loop.csv", "0,0\n4,0\n0,3\n")
    return file.getvalue()


BAD = {
    "empty": ("loop.csv", b""),
    "words": ("loop.csv", b"this is no drawing"),
    "half a point": ("loop.json", b'{"points": [[0, 0], [1]]}'),
    "archive": ("loop.zip", archive()),
    "bomb": ("bomb.png", bomb()),
    "spoiled PNG": ("a.png", spoiled("png")),
    "spoiled SVG": ("a.svg", spoiled("svg")),
    "spoiled JSON": ("a.json", spoiled("json")),
    "document of tomorrow": ("a.json", b'{"plyfold": 3, "strokes": []}'),
    "document with a strange picture": (
        "a.json",
        b'{"plyfold": 1, "strokes": [], "image": {"href": "https://evil.example/a.png"}}',
    ),
    "document with a script": (
        "a.json",
        b'{"plyfold": 1, "strokes": [], "image": {"href": "data:image/svg+xml,<svg onload=alert(1)>"}}',
    ),
    "document with a tree of settings": ("a.json", b'{"plyfold": 1, "strokes": [], "view": {"a": {"b": 1}}}'),
    "entities": (
        "a.svg",
        b'<!DOCTYPE svg [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;">]><svg><text>&b;</text></svg>',
    ),
    "not text": ("a.csv", b"\xff\xfe\x00\x01"),
    "too large": ("a.csv", b"0,0\n" * (MOST_BYTES // 4 + 1)),
    "too many points": ("a.csv", "\n".join(f"{i},{i * i}" for i in range(60_000)).encode()),
}


@pytest.mark.parametrize(("name", "content"), BAD.values(), ids=BAD.keys())
def test_what_is_no_drawing_is_refused_in_a_sentence(name, content):
    with pytest.raises(InputError) as caught:
        open_file(name, content)
    assert len(caught.value.message) > 10
    assert "/tmp" not in str(caught.value)


def test_a_picture_cut_short_is_no_reason_to_fall_over():
    content = png_with(Document((RAMP,)), picture())
    for length in (8, 12, 40):
        assert open_file("cut.png", content[:length]).image is not None
    with pytest.raises(InputError, match="broken"):
        open_file("cut.png", content[: content.index(b"iTXt") + 40])


def test_what_the_page_begins_with(tmp_path):
    assert start(None)["document"] is None
    named = start("gallery:milnor")
    assert (named["name"], len(named["document"]["strokes"][0]["points"])) == ("milnor", 12)
    (tmp_path / "saved.json").write_bytes(written(DOCUMENTS["nasty"], "json"))
    saved = start(str(tmp_path / "saved.json"))
    assert (saved["name"], saved["document"]) == ("saved", document_data(DOCUMENTS["nasty"]))
    (tmp_path / "two.svg").write_text('<svg><rect id="a" width="9" height="9"/><path id="b" d="M0 30h9v9z"/></svg>')
    assert [shape["name"] for shape in start(str(tmp_path / "two.svg"))["shapes"]] == ["a", "b"]


def test_the_gallery_has_outlines_as_they_are_drawn():
    drawn = {curve["name"]: read_document(curve["document"]).strokes for curve in gallery()["curves"]}
    assert drawn.keys() == {**CURVES, **OUTLINES}.keys()
    for name, named in OUTLINES.items():
        outline = outline_of(drawn[name])
        assert [loop.tolist() for loop in outline.loops] == [loop.tolist() for loop in named.outline.loops]
        assert [index.tolist() for index in outline.cusps] == [index.tolist() for index in named.outline.cusps]
    assert any(stroke.cusps for strokes in drawn.values() for stroke in strokes)


@pytest.mark.parametrize("file", ["gallery:nothing", "no/such/file.svg", "."])
def test_what_cannot_be_opened_is_named(file):
    with pytest.raises(InputError, match=file.rpartition(":")[2].replace(".", r"\.")):
        start(file)


@pytest.mark.parametrize("content", [b'{"strokes": [[[0, 0], [4, 0], [4, 4]]]}', b"[[[0, 0], [4, 0], [4, 4]]]"])
def test_strokes_that_do_not_join_open_as_they_are(content):
    assert open_file("drawing.json", content).strokes == (Stroke(((0.0, 0.0), (4.0, 0.0), (4.0, 4.0)), closed=False),)
