"""``python -m plyfold`` is the same as ``plyfold``."""

from plyfold.cli.program import main

if __name__ == "__main__":
    main()
