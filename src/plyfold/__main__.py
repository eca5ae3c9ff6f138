"""``python -m plyfold`` is the same as ``plyfold``."""

import sys

from plyfold.cli import main

if __name__ == "__main__":
    sys.exit(main())
