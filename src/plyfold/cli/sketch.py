"""``plyfold sketch``: the sketching page in the browser."""

from __future__ import annotations

import argparse
import signal
import threading
from typing import Any, NoReturn

from plyfold.cli.streams import complain
from plyfold.errors import InputError
from plyfold_command import raise_interrupts

__all__ = ["add_sketch_command"]

_PORT = 7594
_PORTS_TRIED = 10

_GUIDE = """\
The page and all that it does stay on this machine: nothing is loaded from or sent to anywhere else, and other web sites
cannot ask this server. With --host 0.0.0.0 everybody who can reach this machine can use it.

The browser keeps the drawing under the address of the page, so the same port finds it again.
"""


def add_sketch_command(commands: Any) -> None:
    """Add the subcommand to a parser."""
    sketch = commands.add_parser(
        "sketch",
        help="draw a loop in the browser and see how it lies",
        description="Open the sketching page: draw a loop, see at once whether it is a disk and how it lies, in 3D.",
        epilog=_GUIDE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    sketch.set_defaults(run=_sketch)
    sketch.add_argument("file", nargs="?", metavar="FILE", help="a drawing to begin with, or gallery:NAME")
    sketch.add_argument("--port", type=int, help=f"default: {_PORT}, or the next one that is free; 0 for any")
    sketch.add_argument("--host", default="127.0.0.1", help="where to listen; default: this machine alone")
    sketch.add_argument("--no-browser", action="store_true", help="only print the address")


def _sketch(options: argparse.Namespace) -> int:
    from plyfold.sketch.answers import json_reply
    from plyfold.sketch.opening import start
    from plyfold.sketch.workers import Workers

    beginning = json_reply(start(options.file))
    workers = Workers()
    try:
        raise_interrupts()
        signal.signal(signal.SIGTERM, _interrupt)
        server = _listening(options.host, options.port, workers, beginning)
        print(f"Drawing at {server.address}  (Ctrl-C ends it)", flush=True)
        if not options.no_browser:
            threading.Thread(target=_open_browser, args=(server.address,), daemon=True).start()
        _serve(server)
    finally:
        workers.close()
    return 0


def _open_browser(address: str) -> None:
    import webbrowser

    webbrowser.open(address)


def _serve(server: Any) -> None:
    try:
        server.serve_forever()
    except KeyboardInterrupt:
        complain("\nplyfold: the page is closed")
    finally:
        server.server_close()


def _listening(host: str, port: int | None, workers: Any, start: Any) -> Any:
    """Return a server at the port, or, if none was asked for, at the first one that is free."""
    from plyfold.sketch.server import SketchServer

    ports = [port] if port is not None else [*range(_PORT, _PORT + _PORTS_TRIED), 0]
    for tried in ports:
        try:
            return SketchServer(host, tried, workers, start)
        except (OSError, OverflowError) as error:
            trouble = error
    hint = "choose another one with --port, or --port 0 for any"
    raise InputError(f"the page cannot be served at {host}, port {port}: {trouble}", hint=hint) from trouble


def _interrupt(*_: object) -> NoReturn:
    raise KeyboardInterrupt
