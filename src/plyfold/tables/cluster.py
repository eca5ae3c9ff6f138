"""Parts of a table made by a Dask cluster."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, TypeVar

from plyfold.errors import InputError

if TYPE_CHECKING:
    from distributed import Client

_Answer = TypeVar("_Answer")

_Given = TypeVar("_Given")

__all__ = ["connected", "in_order", "on_cluster"]

# How often a part is begun again if the machine that makes it is lost.
_RETRIES = 3


@contextmanager
def connected(address: str | None) -> Iterator[Client | None]:
    """Give the client of a cluster, or None without an address."""
    if address is None:
        yield None
        return
    try:
        from distributed import Client
    except ImportError as error:
        raise InputError("clusters need Dask", hint='pip install "plyfold[cluster]"') from error
    try:
        client = Client(address)
    except (OSError, ValueError, TimeoutError) as error:
        raise InputError(f"there is no Dask scheduler at {address}: {error}") from error
    with client:
        yield client


def on_cluster(client: Client, call: Callable[[_Given], _Answer], given: Iterable[_Given]) -> Iterator[_Answer]:
    """Call a function for all that is given, and yield what comes back as it comes."""
    from distributed import as_completed

    # The function is not pure: what counts is the file that it writes.
    futures = client.map(call, list(given), pure=False, retries=_RETRIES)
    for future in as_completed(futures):
        yield future.result()


def in_order(client: Client, call: Callable[[_Given], _Answer], given: Iterable[_Given]) -> Iterator[_Answer]:
    """Call a function for all that is given, and yield what comes back in the same order.

    What is given goes with each call, so that nothing is lost with a machine.
    """
    waiting = deque(client.submit(call, one, pure=False, retries=_RETRIES) for one in given)
    while waiting:
        yield waiting.popleft().result()
