"""The server as a client meets it: what it answers, whom it refuses, and that nothing slow stands in the way."""

import json
import os
import signal
import socket
import threading
from base64 import b64encode
from dataclasses import dataclass
from hashlib import sha256
from urllib.parse import urlsplit

import numpy as np
import pytest

from plyfold.sketch.answers import json_reply
from plyfold.sketch.opening import start
from plyfold.sketch.pages import _policy
from plyfold.sketch.server import SketchServer
from plyfold.sketch.workers import Workers
from sketch.by_hand import LIMIT, wait_until
from sketch.conftest import Server

RAMP = [[0, 0], [9, 0], [9, 6], [3, 6], [3, -3], [4, -3], [4, 5], [8, 5], [8, 1], [0, 1]]
# Three million crossings: many seconds of work, whatever the machine.
SLOW = json.dumps({"version": 3, "points": np.random.default_rng(1).random((5000, 2)).tolist()}).encode()


def error(reply):
    assert set(reply.data) == {"version", "error"}
    assert set(reply.data["error"]) == {"kind", "sentence", "where", "hint"}
    assert "Traceback" not in reply.body.decode()
    return reply.data["error"]


# ---- what is answered ------------------------------------------------------------------------------------------------


def test_a_ramp_is_a_disk(server):
    answer = server.post("look", {"points": RAMP})
    assert answer.status == 200
    assert answer.data["verdict"]["immersible"] is True
    assert answer.data["verdict"]["immersions"] == "1"
    assert sorted(map(tuple, answer.data["crossings"])) == [(3, 0), (3, 1), (4, 0), (4, 1)]


def test_every_answer_says_its_version(server):
    for name in ("look", "offers", "ribbon", "lie", "surface"):
        assert server.post(name, {"points": RAMP, "width": 1, "triangles": 200}).data["version"] == 3
    for name in ("gallery", "start"):
        assert server.get(f"/api/v3/{name}").data["version"] == 3


def test_files_of_the_3d_page_are_served(server):
    reply = server.get("/draw/viewer.js")
    assert reply.status == 200
    assert reply.headers["Content-Type"].startswith("text/javascript")
    assert b"export function show" in reply.body


def test_head_has_no_body(server):
    reply = server.request("HEAD", "/draw/viewer.js")
    assert (reply.status, reply.body) == (200, b"")
    assert int(reply.headers["Content-Length"]) > 1000


def test_one_connection_serves_many_questions(server):
    connection = server.connection()
    for _ in range(5):
        body = json.dumps({"version": 3, "points": RAMP})
        connection.request("POST", "/api/v3/look", body, {"Content-Type": "application/json"})
        assert json.loads(connection.getresponse().read())["turning_numbers"] == [1]
    connection.close()


@pytest.mark.parametrize("path", ["/draw/viewer.js", "/nowhere", "/api/v3/start"])
def test_every_answer_has_the_headers_that_keep_the_page_to_itself(server, path):
    headers = server.get(path).headers
    assert "default-src 'self'" in headers["Content-Security-Policy"]
    assert "frame-ancestors 'none'" in headers["Content-Security-Policy"]
    assert headers["X-Content-Type-Options"] == "nosniff"
    assert headers["Cross-Origin-Resource-Policy"] == "same-origin"
    assert "Access-Control-Allow-Origin" not in headers


def test_inline_scripts_are_allowed_by_their_hashes_and_no_others():
    page = b"<script src='a.js'></script><script>let a = 1;\n</script><p><script type='importmap'>{}</script>"
    first, second = (b64encode(sha256(text).digest()).decode() for text in (b"let a = 1;\n", b"{}"))
    assert f"script-src 'self' 'sha256-{first}' 'sha256-{second}';" in _policy(page)
    assert "script-src 'self';" in _policy(b"<script src='a.js'></script>")


def test_the_page_is_served_with_the_policy_for_its_own_scripts(server):
    reply = server.get("/")
    assert reply.headers["Content-Type"].startswith("text/html")
    assert reply.headers["Content-Security-Policy"] == _policy(reply.body)


# ---- who is refused --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("origin", ["https://evil.example", "null", "http://127.0.0.1:1", "https://127.0.0.1"])
def test_other_sites_are_refused(server, origin):
    reply = server.post("look", {"points": RAMP}, Origin=origin)
    assert reply.status == 403
    assert "another site" in error(reply)["sentence"]


def test_the_page_itself_is_not_refused(server):
    origin = server.url.rstrip("/")
    headers = {"Origin": origin, "Sec_Fetch_Site": "same-origin", "Sec_Fetch_Mode": "cors"}
    assert server.post("look", {"points": RAMP}, **headers).status == 200


@pytest.mark.parametrize("site", ["cross-site", "same-site"])
def test_what_a_browser_calls_cross_site_is_refused(server, site):
    assert server.post("look", {"points": RAMP}, Sec_Fetch_Site=site).status == 403
    assert server.get("/api/v3/gallery", **{"Sec-Fetch-Site": site}).status == 403


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:80", "127.0.0.1.evil.example", "", "[", "localhost@evil"]
)
def test_strange_names_are_refused(server, host):
    """A site whose name was made to point at this machine shows that name."""
    for method, path in (("GET", "/draw/viewer.js"), ("GET", "/api/v3/start"), ("POST", "/api/v3/look")):
        reply = server.request(method, path, b"{}", {"Host": host, "Content-Type": "application/json"})
        assert reply.status == 403
        assert error(reply)["kind"] == "refused"


@pytest.mark.parametrize("host", ["localhost", "127.0.0.1", "[::1]", "LOCALHOST"])
def test_names_of_this_machine_are_not_refused(server, host):
    port = urlsplit(server.url).port
    assert server.get("/api/v3/start", Host=f"{host}:{port}").status == 200


def test_forms_are_refused(server):
    """A page elsewhere can make a browser send a form without asking first; it cannot send JSON so."""
    reply = server.post("look", {"points": RAMP}, Content_Type="text/plain")
    assert reply.status == 415
    assert error(reply)["kind"] == "input"


@pytest.mark.parametrize(
    "path",
    [
        "/../pyproject.toml",
        "/draw/../viewer.py",
        "/draw/%2e%2e/viewer.py",
        "/..%2f..%2fetc/passwd",
        "//etc/passwd",
        "/draw//etc/passwd",
        "/draw/..\\viewer.py",
        "/__init__.py",
        "/static/index.html",
        "/draw/",
        "/draw/viewer.js/",
        "/\x7f",
    ],
)
def test_no_path_leads_out_of_the_pages_folders(server, path):
    with socket.create_connection(server.host.split(":")) as line:
        line.sendall(f"GET {path} HTTP/1.1\r\nHost: {server.host}\r\nConnection: close\r\n\r\n".encode())
        said = b"".join(iter(lambda: line.recv(4096), b""))
    assert said.startswith(b"HTTP/1.1 404")


# ---- what is too much or no question ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "body",
    [
        b"",
        b"{",
        b"\xff\xfe",
        b"[]",
        b"null",
        b"{}",
        b'{"version": 2, "points": []}',
        b'{"version": 3}',
        b'{"version": 3, "points": [], "strokes": []}',
        b'{"version": 3, "points": [[0, NaN], [1, 0], [0, 1]]}',
        b'{"version": 3, "points": [[0, -Infinity], [1, 0], [0, 1]]}',
        b'{"version": 3, "points": [[0, 1e999], [1, 0], [0, 1]]}',
        b'{"version": 3, "points": [[0, ' + b"9" * 400 + b"], [1, 0], [0, 1]]}",
        b'{"version": 3, "points": [[0, ' + b"9" * 9000 + b"], [1, 0], [0, 1]]}",
        b'{"version": 3, "points": [[0], [1, 0], [0, 1]]}',
        b'{"version": 3, "points": [[0, "1"], [1, 0], [0, 1]]}',
        b'{"version": 3, "points": [[0, true], [1, 0], [0, 1]]}',
        b'{"version": 3, "points": {"0": [0, 0]}}',
        b'{"version": 3, "points": "' + b"[" * 100 + b'"}',
        b"[" * 100_000,
        b'{"version": 3, "strokes": [[[0, 0]], 5]}',
        b'{"version": 3, "strokes": [{"points": [[0, 0]], "closed": 1}]}',
        b'{"version": 3, "loops": [{"points": [[0, 0], [1, 0], [0, 1]], "cusps": {"3": 1}}]}',
        b'{"version": 3, "loops": [{"points": [[0, 0], [1, 0], [0, 1]], "cusps": {"-1": 1}}]}',
        b'{"version": 3, "loops": [{"points": [[0, 0], [1, 0], [0, 1]], "cusps": {"0": 0.5}}]}',
        b'{"version": 3, "loops": [{"points": [[0, 0], [1, 0], [0, 1]], "cusps": [1, 0, 0]}]}',
    ],
)
def test_what_is_no_question_is_refused_in_a_sentence(server, body):
    reply = server.post("look", body)
    assert reply.status == 400
    assert error(reply)["kind"] == "input"
    assert len(error(reply)["sentence"]) > 10


@pytest.mark.parametrize(
    "options",
    [
        {"immersion": 1.5},
        {"immersion": "one"},
        {"immersion": True},
        {"layering": "1" * 5000},
        {"gap": "wide"},
        {"gap": 0},
        {"gap": -1},
        {"gap": 1e300},
        {"triangles": 0},
        {"triangles": 10**9},
        {"triangles": 3.5},
        {"allow_intersections": "yes"},
    ],
)
def test_bad_options_are_refused(server, options):
    reply = server.post("surface", {"points": RAMP} | options)
    assert reply.status == 400
    assert error(reply)["kind"] == "input"


@pytest.mark.parametrize(
    ("points", "sentence"),
    [
        ([], "no points"),
        ([[1, 1]], "only 1 different point"),
        ([[0, 0], [1, 1]], "only 2 different point"),
        ([[0, 0], [1, 1], [2, 2]], "on one line"),
        ([[0, 0], [1e200, 1], [2, 2]], "too large|beyond|1e\\+150"),
    ],
)
def test_drawings_that_bound_nothing_get_a_sentence(server, points, sentence):
    reply = server.post("look", {"points": points})
    assert reply.status == 200
    assert error(reply)["kind"] == "drawing"
    assert any(part.replace("\\", "") in error(reply)["sentence"] for part in sentence.split("|"))


def test_unfinished_strokes_name_the_ends(server):
    reply = server.post("look", {"strokes": [[[0, 0], [4, 0]], [[4, 3], [0, 3]]]})
    assert reply.status == 200
    assert error(reply)["kind"] == "unfinished"
    assert sorted(map(tuple, error(reply)["where"])) in ([(0, 0), (0, 3)], [(4, 0), (4, 3)])


def test_uploads_over_the_stated_size_are_refused_before_they_are_read(server):
    stated = server.get("/api/v3/start").data["limits"]["bytes"]
    reply = server.post("open", b"x" * (stated + 1))
    assert reply.status == 413
    assert "16 MiB" in error(reply)["sentence"]
    with socket.create_connection(server.host.split(":")) as line:  # and one that only says so is not waited for
        line.settimeout(LIMIT)
        start = f"POST /api/v3/open HTTP/1.1\r\nHost: {server.host}\r\nContent-Length: {10**15}\r\n\r\n"
        line.sendall(start.encode())
        assert line.recv(4096).startswith(b"HTTP/1.1 413")


@pytest.mark.parametrize("length", ["", "-1", "1e3", "\u0663", "9" * 40])
def test_a_question_says_how_long_it_is(server, length):
    with socket.create_connection(server.host.split(":")) as line:
        line.settimeout(LIMIT)
        start = f"POST /api/v3/open HTTP/1.1\r\nHost: {server.host}\r\nContent-Length: {length}\r\n\r\n"
        line.sendall(start.encode())
        assert line.recv(4096).startswith(b"HTTP/1.1 411")


def test_a_file_that_cannot_be_read_is_an_answer(server):
    reply = server.post("open", b"<svg nonsense", X_File_Name="broken.svg")
    assert reply.status == 200
    assert error(reply)["kind"] == "file"
    assert "broken.svg" in error(reply)["sentence"]


def test_too_many_points_are_refused(server):
    most = server.get("/api/v3/start").data["limits"]["points"]
    reply = server.post("look", {"points": [[0, 0]] * (most + 1)})
    assert reply.status == 400
    assert "points, more than" in error(reply)["sentence"]


@pytest.mark.parametrize(("method", "path", "status"), [("POST", "/api/v3/dance", 404), ("PUT", "/", 501)])
def test_other_addresses_and_methods_are_refused_in_a_sentence(server, method, path, status):
    reply = server.request(method, path, b"{}", {"Content-Type": "application/json"})
    assert reply.status == status
    assert error(reply)["sentence"]


def test_nonsense_on_the_line_is_answered_in_a_sentence(server):
    with socket.create_connection(server.host.split(":")) as line:
        line.settimeout(LIMIT)
        line.sendall(b"what? is this?\r\n\r\n")
        assert b'"sentence"' in line.recv(4096)


# ---- what is slow ----------------------------------------------------------------------------------------------------


def in_background(ask):
    """Ask in a thread; ``done()`` waits and gives what came back, ``done.found`` is empty until then."""
    found = []
    thread = threading.Thread(target=lambda: found.append(ask()))
    thread.start()

    def done():
        thread.join(LIMIT)
        return found[0]

    done.found = found
    return done


def children(process):
    with open(f"/proc/{process}/task/{process}/children") as file:  # noqa: PTH123
        return [int(child) for child in file.read().split()]


@dataclass
class Observed(Server):
    """A server in this process, whose workers can be watched."""

    workers: Workers

    def is_working_on(self, count):
        """Wait until so many questions are being answered."""
        wait_until(lambda: len(self.workers._working) == count, f"{count} questions have arrived")


@pytest.fixture
def observed():
    workers = Workers()
    serving = SketchServer("127.0.0.1", 0, workers, json_reply(start(None)))
    thread = threading.Thread(target=serving.serve_forever)
    thread.start()
    yield Observed(serving.address, None, None, workers)
    serving.shutdown()
    thread.join(LIMIT)
    serving.server_close()
    workers.close()


def test_a_newer_question_of_a_page_ends_its_earlier_one(observed):
    slow = in_background(lambda: observed.post("look", SLOW, X_Plyfold_Page="a"))
    observed.is_working_on(1)
    quick = observed.post("look", {"points": RAMP}, X_Plyfold_Page="a")
    assert quick.data["turning_numbers"] == [1]
    ended = slow()
    assert ended.status == 200
    assert error(ended)["kind"] == "superseded"


def test_a_slow_question_does_not_keep_others_waiting(observed):
    slow = [in_background(lambda n=n: observed.post("look", SLOW, X_Plyfold_Page=f"slow{n}")) for n in range(3)]
    observed.is_working_on(3)
    assert observed.post("look", {"points": RAMP}, X_Plyfold_Page="quick").status == 200
    assert observed.post("lie", {"points": RAMP}, X_Plyfold_Page="slow0").status == 200
    assert not any(done.found for done in slow)
    for number, done in enumerate(slow):
        observed.post("look", {"points": RAMP}, X_Plyfold_Page=f"slow{number}")
        assert error(done())["kind"] == "superseded"


def test_a_page_that_goes_takes_its_question_with_it(observed):
    """More of them than may work at the same time: each must be ended for the next to be heard."""
    for _ in range(10):
        connection = observed.connection()
        connection.request("POST", "/api/v3/look", SLOW, {"Content-Type": "application/json"})
        observed.is_working_on(1)
        connection.close()
        observed.is_working_on(0)
    assert observed.post("look", {"points": RAMP}).status == 200


def test_too_many_questions_at_once_are_turned_away_in_a_sentence(observed):
    slow = [in_background(lambda n=n: observed.post("look", SLOW, X_Plyfold_Page=f"many{n}")) for n in range(8)]
    observed.is_working_on(8)
    reply = observed.post("look", {"points": RAMP})
    for number in range(8):
        observed.post("look", {"points": RAMP}, X_Plyfold_Page=f"many{number}")
    assert [error(done())["kind"] for done in slow] == ["superseded"] * 8
    assert reply.status == 503
    assert error(reply)["kind"] == "busy"


def test_a_worker_that_dies_is_replaced(observed):
    slow = in_background(lambda: observed.post("look", SLOW))
    observed.is_working_on(1)
    for worker in list(observed.workers._working):
        os.kill(worker.process.pid, signal.SIGKILL)
    died = slow()
    assert died.status == 500
    assert "died" in error(died)["sentence"]
    assert observed.post("look", {"points": RAMP}).status == 200


@pytest.mark.skipif(not os.path.exists("/proc/self/task"), reason="finds the workers in /proc")  # noqa: PTH110
def test_the_server_leaves_nobody_behind_and_the_page_can_come_back(start_server):
    with start_server() as first:
        port = urlsplit(first.url).port
        slow = in_background(lambda: ask_in_vain(first))
        wait_until(lambda: any(map(children, children(first.process.pid))), "the workers are there")
        helpers = children(first.process.pid)
        workers = [worker for helper in helpers for worker in children(helper)]
        first.process.kill()
        first.process.wait()
        slow()
    wait_until(lambda: not any(map(is_alive, [*helpers, *workers])), "all processes have ended")
    with start_server("--port", str(port)) as second:
        assert second.post("look", {"points": RAMP}).status == 200


def ask_in_vain(server):
    with pytest.raises(OSError):
        server.post("look", SLOW)


def is_alive(process):
    try:
        with open(f"/proc/{process}/stat") as file:  # noqa: PTH123
            return file.read().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


# ---- the command -----------------------------------------------------------------------------------------------------


def test_a_file_to_begin_with(start_server, tmp_path):
    (tmp_path / "loop.csv").write_text("0,0\n4,0\n0,3\n")
    with start_server(str(tmp_path / "loop.csv")) as server:
        answer = server.get("/api/v3/start").data
    assert answer["name"] == "loop"
    assert answer["document"]["strokes"] == [{"points": [[0, 0], [4, 0], [0, 3]], "closed": True}]
    assert server.process.returncode == 0


def test_a_port_that_is_taken_is_named(start_server, tmp_path, capsys):
    from plyfold.cli.commands import main

    with start_server() as server:
        port = urlsplit(server.url).port
        assert main(["sketch", "--no-browser", "--port", str(port)]) == 2
    assert f"port {port}" in capsys.readouterr().err


@pytest.mark.parametrize("file", ["nowhere.svg", "gallery:nothing"])
def test_what_cannot_be_opened_is_told_before_anything_is_served(file, capsys):
    from plyfold.cli.commands import main

    assert main(["sketch", "--no-browser", file]) == 2
    assert "Drawing at" not in capsys.readouterr().out
