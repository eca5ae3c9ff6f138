"""The files of the page, with the colours of the palette, and the headers that keep it to itself."""

from __future__ import annotations

import base64
import hashlib
import re
from importlib.resources import files
from importlib.resources.abc import Traversable

from plyfold.colours import CLOTH_LOW, PAPER, page_style
from plyfold.sketch.answers import Reply

__all__ = ["SECURITY_HEADERS", "page_file"]

_FOLDERS = {"": files("plyfold.sketch") / "static", "draw/": files("plyfold.draw") / "static"}
_TYPES = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".svg": "image/svg+xml",
    ".png": "image/png",
    ".ico": "image/x-icon",
    ".json": "application/json",
    ".webmanifest": "application/manifest+json",
    ".txt": "text/plain; charset=utf-8",
}
_INLINE_SCRIPT = re.compile(rb"<script(?![^>]*\bsrc\b)[^>]*>(.*?)</script>", re.DOTALL)
_POLICY = (
    "default-src 'self'; script-src 'self'{}; img-src 'self' data: blob:; object-src 'none'; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'"
)

SECURITY_HEADERS = {
    "Content-Security-Policy": _POLICY.format(""),
    "Cache-Control": "no-store",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
}
"""With every answer: nothing is loaded from elsewhere, shown in a frame of, or read by, another site, or guessed."""


def page_file(path: str) -> Reply | None:
    """Return a file of the page, or None if there is no such file.

    Parameters
    ----------
    path : str
        As it stands in the address: ``"/"``, ``"/sketch.js"``, ``"/draw/viewer.js"``.

    Returns
    -------
    Reply or None
        The colours as a style sheet are made. Only what is listed in the page's two folders is ever opened, so no path
        leads out of them.

    Examples
    --------
    >>> page_file("/draw/viewer.js").content_type
    'text/javascript; charset=utf-8'
    >>> page_file("/colours.css").content_type
    'text/css; charset=utf-8'
    >>> page_file("/draw/../viewer.py"), page_file("/draw/%2e%2e/viewer.py")
    (None, None)
    """
    name = path.removeprefix("/") or "index.html"
    content = _content(name)
    if content is None:
        return None
    kind = _TYPES["." + name.rpartition(".")[2]]
    policy = {"Content-Security-Policy": _policy(content)} if kind.startswith("text/html") else {}
    return Reply(200, kind, content, policy)


def _content(name: str) -> bytes | None:
    """Return what stands at an address: the palette as a style sheet, or a file, pictures in its colours."""
    if name == "colours.css":
        return page_style().encode()
    file = _listed().get(name)
    if file is None:
        return None
    content = file.read_bytes()
    return _coloured(content) if name.endswith(".svg") else content


def _coloured(picture: bytes) -> bytes:
    """Put the page's colours where a picture has their names: it cannot read the style sheet."""
    return picture.replace(b"{{strong}}", CLOTH_LOW.encode()).replace(b"{{on-strong}}", PAPER.encode())


def _listed() -> dict[str, Traversable]:
    """Return the files by address. They are listed anew each time, so that a page in the making can be reloaded."""
    return {
        f"{folder}{name}": file
        for folder, root in _FOLDERS.items()
        if root.is_dir()
        for name, file in _files_in(root)
        if "." + name.rpartition(".")[2] in _TYPES
    }


def _files_in(folder: Traversable, name: str = "") -> list[tuple[str, Traversable]]:
    found = []
    for entry in folder.iterdir():
        inner = f"{name}{entry.name}"
        found += _files_in(entry, f"{inner}/") if entry.is_dir() else [(inner, entry)]
    return found


def _policy(page: bytes) -> str:
    """Return the policy that allows the inline scripts of a page, by their hashes, and no others."""
    hashes = (hashlib.sha256(script).digest() for script in _INLINE_SCRIPT.findall(page))
    return _POLICY.format("".join(f" 'sha256-{base64.b64encode(value).decode()}'" for value in hashes))
