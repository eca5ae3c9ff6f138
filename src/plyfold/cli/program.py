"""The program ``plyfold``: Ctrl-C is looked after before the library is imported."""

from __future__ import annotations

import sys
from typing import NoReturn

from plyfold.cli.interrupts import end_at_interrupts

__all__ = ["main"]


def main() -> NoReturn:
    """Run the command line."""
    end_at_interrupts()
    from plyfold.cli.commands import main

    sys.exit(main())
