"""The page's server: thin, for this machine alone unless told otherwise. It checks who asks, and workers answer.

It is the standard library's threading server: each connection has a thread, which does nothing but wait for a worker
and watch whether the page is still there.
"""

from __future__ import annotations

import ipaddress
import socket
import sys
from collections.abc import Mapping
from email.message import Message
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from socketserver import TCPServer
from typing import Any
from urllib.parse import urlsplit

from plyfold.sketch.answers import Reply, error_reply
from plyfold.sketch.pages import SECURITY_HEADERS, page_file
from plyfold.sketch.patience import patient
from plyfold.sketch.schema import MOST_BYTES
from plyfold.sketch.workers import Question, Workers

__all__ = ["SketchServer", "objection"]

_API = "/api/v3/"
_SECONDS = {
    "gallery": 20.0,
    "look": 20.0,
    "offers": 20.0,
    "ribbon": 20.0,
    "lie": 20.0,
    "surface": 60.0,
    "export": 120.0,
    "open": 30.0,
}
_ASKED = ("look", "offers", "ribbon", "lie", "surface", "export", "open")
_SUPERSEDING = ("look", "offers", "ribbon", "lie", "surface")
_SECONDS_OF_SILENCE = 120
_LONGEST_NAME = 64
_PASSED_ON = ("X-File-Name",)
_MOST_SWALLOWED = 4 * MOST_BYTES
_LOCAL_NAMES = ("localhost", "localhost.localdomain")


class SketchServer(ThreadingHTTPServer):
    """Serves the page and its questions until it is shut down.

    Parameters
    ----------
    host : str
        Where to listen; ``"127.0.0.1"`` for this machine alone.
    port : int
        0 for any that is free.
    start : dict, optional
        The answer to what the page should begin with.

    Raises
    ------
    OSError
        If the port is taken or the host is not this machine.
    """

    daemon_threads = True
    allow_reuse_address = sys.platform != "win32"  # there it would let two servers share a port

    def __init__(self, host: str, port: int, workers: Workers, start: Reply) -> None:
        self.workers, self.start, self.name = workers, start, host
        self.address_family = socket.AF_INET6 if ":" in host else socket.AF_INET
        super().__init__((host, port), _Handler)

    @property
    def address(self) -> str:
        """The page's address."""
        host = f"[{self.name}]" if ":" in self.name else self.name
        return f"http://{host}:{self.server_port}/"

    def server_bind(self) -> None:
        """Bind without asking the network what the host is called, as the parent class does."""
        TCPServer.server_bind(self)
        self.server_name, self.server_port = str(self.server_address[0]), int(self.server_address[1])

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Say nothing of pages that went away in the middle of a sentence; tell the terminal of anything else."""
        if not isinstance(sys.exception(), OSError):
            super().handle_error(request, client_address)


class _Handler(BaseHTTPRequestHandler):
    """One connection."""

    server: SketchServer
    protocol_version = "HTTP/1.1"
    server_version, sys_version = "plyfold", ""
    timeout = _SECONDS_OF_SILENCE
    disable_nagle_algorithm = True
    wbufsize = -1  # headers and body leave together

    def do_GET(self) -> None:
        self._reply(self._refusal() or self._got(urlsplit(self.path).path))

    def do_HEAD(self) -> None:
        self.do_GET()

    def do_POST(self) -> None:
        name = urlsplit(self.path).path.removeprefix(_API)
        refusal = self._refusal() or _refused_question(name, self.headers)
        self._reply(self._refused_unread(refusal) if refusal else self._asked(name))

    def send_error(self, code: int, message: str | None = None, explain: str | None = None) -> None:
        """Answer what is no proper request at all."""
        self.close_connection = True
        self._reply(error_reply("input", message or "this is no request that is understood", status=code))

    def log_message(self, format: str, *values: Any) -> None:
        """Keep the terminal quiet."""

    def _refusal(self) -> Reply | None:
        sentence = objection(self.headers, self.server.name)
        return error_reply("refused", sentence, hint="open the address that plyfold printed") if sentence else None

    def _got(self, path: str) -> Reply:
        if path == f"{_API}start":
            return self.server.start
        if path == f"{_API}gallery":
            return self._ask("gallery", b"")
        return page_file(path) or error_reply("not found", f"there is nothing at {path[:100]}")

    def _asked(self, name: str) -> Reply:
        body = self.rfile.read(int(self.headers["Content-Length"]))
        return self._ask(name, body)

    def _ask(self, name: str, body: bytes) -> Reply:
        page = self.headers.get("X-Plyfold-Page")
        place = (page, name) if page and name in _SUPERSEDING else None
        told = {key: self.headers[key] for key in _PASSED_ON if key in self.headers}
        return self.server.workers.ask(Question(name, body, told, patient(_SECONDS[name]), place), self.connection)

    def _refused_unread(self, refusal: Reply) -> Reply:
        """Swallow what was sent with a refused question, within reason: who is still talking does not hear."""
        length = _length(self.headers)
        if length is None or length > _MOST_SWALLOWED:
            self.close_connection = True
        else:
            while length > 0 and (piece := self.rfile.read(min(length, 2**16))):
                length -= len(piece)
        return refusal

    def _reply(self, answer: Reply) -> None:
        self.send_response(answer.status)
        lasting = {"Connection": "close"} if self.close_connection else {}
        about = {"Content-Type": answer.content_type, "Content-Length": str(len(answer.body))}
        for name, value in (SECURITY_HEADERS | about | lasting | dict(answer.headers)).items():
            self.send_header(name, value)
        self.end_headers()
        if self.command != "HEAD":
            self.wfile.write(answer.body)


def _refused_question(name: str, headers: Message) -> Reply | None:
    """Return why a question is not even read, or None."""
    if name not in _ASKED:
        return error_reply("not found", "there is no such question")
    if name != "open" and headers.get_content_type() != "application/json":
        return error_reply("input", "a question is sent as application/json", status=415)
    if len(headers.get("X-Plyfold-Page", "")) > _LONGEST_NAME:
        return error_reply("input", f"the name of the page is longer than {_LONGEST_NAME} letters")
    length = _length(headers)
    if length is None:
        return error_reply("too large", "the question does not say how long it is", status=411)
    if length > MOST_BYTES:
        return error_reply("too large", f"this is more than {MOST_BYTES // 2**20} MiB", hint="send less at once")
    return None


def _length(headers: Message) -> int | None:
    text = headers.get("Content-Length", "")
    return int(text) if text.isdecimal() and text.isascii() and len(text) < 20 else None


# ---- who may ask: the page that this server has served, and programs here, but no other web site ---------------------


def objection(headers: Message | Mapping[str, str], name: str) -> str | None:
    """Return why a request is refused, or None if it may be answered.

    Parameters
    ----------
    headers : Message or mapping of str to str
        Of the request.
    name : str
        The host name that the server was told to listen at.

    Returns
    -------
    str or None
        A browser says in ``Origin`` and ``Sec-Fetch-Site`` which site a script comes from. A site whose name is made to
        point here (DNS rebinding) shows that name in ``Host``; numbers cannot be made to point elsewhere.

    Examples
    --------
    >>> objection({"Host": "127.0.0.1:7594", "Origin": "http://127.0.0.1:7594"}, "127.0.0.1") is None
    True
    >>> objection({"Host": "evil.example:7594"}, "127.0.0.1")
    'this server does not go by the name of evil.example'
    >>> objection({"Host": "localhost:7594", "Origin": "https://evil.example"}, "127.0.0.1")
    'the question comes from another site, https://evil.example'
    """
    host = headers.get("Host") or ""
    known = _host_name(host)
    if not known or not (known in (*_LOCAL_NAMES, name.lower()) or _is_number(known)):
        return f"this server does not go by the name of {known[:100] or 'nobody'}"
    origin = headers.get("Origin")
    if origin is not None and origin.lower() != f"http://{host.lower()}":
        return f"the question comes from another site, {origin[:100]}"
    # To follow a link that leads here is harmless: the other site learns nothing of what the browser then shows.
    follows_link = headers.get("Sec-Fetch-Mode") == "navigate"
    site = headers.get("Sec-Fetch-Site", "none")
    return None if follows_link or site in ("none", "same-origin") else "the question comes from another site"


def _host_name(host: str) -> str:
    try:
        return (urlsplit(f"//{host}").hostname or "").lower()
    except ValueError:
        return ""


def _is_number(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True
