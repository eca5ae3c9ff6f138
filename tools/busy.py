"""Run a command beside busy processes: ``python tools/busy.py 8 make test``. Its exit code is the command's."""

from __future__ import annotations

import subprocess
import sys


def main() -> int:
    """Start so many processes that only compute, run the command, and end them."""
    count, *command = sys.argv[1:]
    busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(int(count))]
    try:
        return subprocess.run(command, check=False).returncode
    finally:
        for process in busy:
            process.kill()


if __name__ == "__main__":
    sys.exit(main())
