"""Files in and out, one module per format."""

from plyfold.io.reading import SIZE_LIMIT, read

__all__ = ["SIZE_LIMIT", "read"]
