"""Who may ask: the page that this server has served, and programs on this machine, but no other web site."""

from __future__ import annotations

import ipaddress
from collections.abc import Mapping
from email.message import Message
from urllib.parse import urlsplit

__all__ = ["objection"]

_LOCAL_NAMES = ("localhost", "localhost.localdomain")


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
