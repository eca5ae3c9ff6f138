"""Any other program on the same polygon: a command that reads a text file with one line ``x y`` per vertex.

The command says whether the polygon bounds a disk: it prints a word for yes or no last, or else exits with 0 for yes
and 1 for no. Time is that of the command less what the same command needs for a triangle, so its start is not counted.
"""

from __future__ import annotations

import shlex
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

YES = frozenset({"1", "yes", "true", "valid", "immersible", "self-overlapping"})
NO = frozenset({"0", "no", "false", "invalid", "none"})
TRIANGLE = "0 0\n1000 0\n0 1000\n"


@dataclass(frozen=True)
class Peer:
    """A program to compare with; `command` holds ``{file}`` where the name of the polygon's file goes."""

    name: str
    command: str

    @classmethod
    def parse(cls, text: str) -> Peer:
        """Read ``name=command {file}``."""
        name, equals, command = text.partition("=")
        if not (name and equals and "{file}" in command):
            raise ValueError(f"a peer is given as name=command with {{file}} in it, and this is {text!r}")
        return cls(name, command)

    def run(self, file: Path, limit: float) -> tuple[float, bool | None]:
        """Return the seconds of the command on a file, and its verdict; None if it gives none."""
        words = [word.replace("{file}", str(file)) for word in shlex.split(self.command)]
        start = time.perf_counter()
        done = subprocess.run(words, capture_output=True, text=True, timeout=limit, check=False)
        return time.perf_counter() - start, verdict(done.stdout, done.returncode)

    def measure(self, file: Path, limit: float) -> dict[str, Any]:
        """Return the line of this peer for a polygon, as the other contenders print theirs."""
        triangle = file.with_name("triangle.txt")
        triangle.write_text(TRIANGLE)
        try:
            idle = min(self.run(triangle, limit)[0] for _ in range(2))
            seconds, answer = self.run(file, limit)
        except subprocess.TimeoutExpired:
            return {"failed": f"more than {limit:.0f} s"}
        except OSError as error:
            return {"failed": str(error)}
        return {"stage": self.name, "seconds": max(seconds - idle, 0.0), "disk": answer}


def verdict(printed: str, code: int) -> bool | None:
    """Tell yes from no by the last word printed, else by the exit code."""
    *_, last = ["", *printed.lower().split()]
    last = last.strip(".:,")
    if last in YES | NO:
        return last in YES
    return {0: True, 1: False}.get(code)
