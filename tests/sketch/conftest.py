"""A running server, and its page in a browser."""

import json
import os
import re
import signal
import subprocess
import sys
from contextlib import contextmanager
from dataclasses import dataclass
from http.client import HTTPConnection
from typing import Any
from urllib.parse import urlsplit

import pytest

from sketch.by_hand import LIMIT

LASTING = """
    const wait = window.setTimeout;
    window.setTimeout = (act, milliseconds, ...rest) => wait(act, milliseconds < 5000 ? milliseconds : 1e8, ...rest);
"""
"""What leaves the page by itself after some seconds stays: a busy machine may need them."""


@pytest.fixture(scope="session", autouse=True)
def patience():
    """Time limits a hundred times as long: no test depends on how fast the machine is."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(os.environ, "PLYFOLD_PATIENCE", "100")
        yield


@dataclass
class Reply:
    status: int
    headers: dict
    body: bytes

    @property
    def data(self):
        return json.loads(self.body)


@dataclass
class Server:
    url: str
    process: Any
    log: Any

    @property
    def host(self):
        return urlsplit(self.url).netloc

    def connection(self, timeout=LIMIT):
        return HTTPConnection(self.host, timeout=timeout)

    def request(self, method, path, body=None, headers=None):
        connection = self.connection()
        try:
            connection.request(method, path, body, headers or {})
            reply = connection.getresponse()
            return Reply(reply.status, dict(reply.getheaders()), reply.read())
        finally:
            connection.close()

    def get(self, path, **headers):
        return self.request("GET", path, None, headers)

    def post(self, name, body, **headers):
        """Send bytes, or a question as JSON; ``X_File_Name`` stands for ``X-File-Name``."""
        content = body if isinstance(body, bytes) else json.dumps({"version": 3} | body).encode()
        given = {key.replace("_", "-"): value for key, value in headers.items()}
        return self.request("POST", f"/api/v3/{name}", content, {"Content-Type": "application/json"} | given)


@contextmanager
def running_server(folder, *options):
    with (folder / "log.txt").open("w+") as log:
        command = [sys.executable, "-m", "plyfold", "sketch", "--no-browser", "--port", "0", *options]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=log, text=True)
        try:
            said = process.stdout.readline()
            yield Server(re.search(r"http://\S+", said)[0], process, folder / "log.txt")
        finally:
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=LIMIT)


@pytest.fixture
def start_server(tmp_path):
    """Start another server with options: ``with start_server("--port", "0") as server``."""
    return lambda *options: running_server(tmp_path, *options)


@pytest.fixture(scope="session")
def server(tmp_path_factory):
    """One server for all tests; it must have had nothing to complain about, and end at Ctrl-C."""
    with running_server(tmp_path_factory.mktemp("server")) as running:
        yield running
    assert running.process.returncode == 0
    assert "Traceback" not in running.log.read_text()


@pytest.fixture
def page(server, browser):
    """The page in a fresh browser profile; it must not complain, nor ask anything of anyone else."""
    context = browser.new_context(viewport={"width": 1280, "height": 800}, accept_downloads=True)
    context.set_default_timeout(1000 * LIMIT)
    context.add_init_script(LASTING)
    tab = context.new_page()
    tab.complaints, tab.asked = [], []
    tab.on("console", lambda message: tab.complaints.append(message.text) if message.type == "error" else None)
    tab.on("pageerror", lambda error: tab.complaints.append(str(error)))
    tab.on("request", lambda request: tab.asked.append(request.url))
    tab.goto(server.url)
    yield tab
    context.close()
    assert tab.complaints == []
    assert all(address.startswith((server.url, "data:", "blob:")) for address in tab.asked)


@pytest.fixture
def sketch(page):
    page.wait_for_selector("html[data-ready]")
    return page


@pytest.fixture(params=[(360, 740), (412, 915), (740, 360)], ids=lambda size: f"{size[0]}x{size[1]}")
def phone(request, browser, server):
    """The page on a phone, under a finger."""
    width, height = request.param
    context = browser.new_context(viewport={"width": width, "height": height}, has_touch=True, is_mobile=True)
    context.set_default_timeout(1000 * LIMIT)
    context.add_init_script(LASTING)
    tab = context.new_page()
    tab.goto(server.url)
    tab.wait_for_selector("html[data-ready]")
    yield tab
    context.close()
