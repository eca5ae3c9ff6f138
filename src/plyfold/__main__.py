"""``python -m plyfold`` is the same as ``plyfold``."""

from plyfold_command import main

if __name__ == "__main__":
    main()
