"""The options of ``plyfold lift`` that say how the cloth lies: ``--stiffness``, ``--pin`` and ``--flat``."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from plyfold.surface.pins import PinKey

__all__ = ["add_height_options", "height_options"]


def add_height_options(command: argparse.ArgumentParser) -> None:
    """Give the options to a subcommand."""
    command.add_argument(
        "--stiffness",
        type=float,
        metavar="S",
        help="the length below which the cloth would rather slope than bend, by its mean width (default: 0.5)",
    )
    command.add_argument(
        "--pin",
        type=_pin,
        action="append",
        metavar="PLACE=Z",
        help="hold a sheet (--pin 3=0.5), a point (--pin=1.5,-2=0.5) or one of the sheets over a point "
        "(--pin=1.5,-2,3=0.5) at a height; as often as needed",
    )
    command.add_argument(
        "--flat",
        nargs="?",
        type=float,
        const=True,
        metavar="W",
        help="keep parts level that nothing overlaps: they are W times as stiff, 100 times if no number follows",
    )


def height_options(options: argparse.Namespace) -> dict[str, Any]:
    """Return the arguments of :func:`plyfold.lift` that were given."""
    pins = dict(options.pin) if options.pin else None
    given = {"stiffness": options.stiffness, "pins": pins, "flat": options.flat}
    return {name: value for name, value in given.items() if value is not None}


def _pin(text: str) -> tuple[PinKey, float]:
    """Read a pin.

    Examples
    --------
    >>> _pin("3=0.5"), _pin("1.5,-2=1"), _pin("1.5,-2,3=1")
    ((3, 0.5), ((1.5, -2.0), 1.0), ((1.5, -2.0, 3), 1.0))
    """
    place, _, height = text.rpartition("=")
    parts = place.split(",")
    try:
        if len(parts) == 1:
            return int(place), float(height)
        x, y = map(float, parts[:2])
        sheet = [int(part) for part in parts[2:]]
        return (x, y, *sheet), float(height)  # type: ignore[return-value]
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text} is no pin: SHEET=Z, X,Y=Z or X,Y,SHEET=Z") from None
