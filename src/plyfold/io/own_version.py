"""The version of the files in plyfold's own formats, and the error where they are from the future."""

from __future__ import annotations

from plyfold.errors import FileFormatError

__all__ = ["OWN_VERSION", "SVG_MARK", "refuse_later_version"]

OWN_VERSION = 2
"""What is written: ``"version"`` in JSON. Version 1 had no number, and knew one curve: ``points`` or ``strokes``."""

SVG_MARK = "data-plyfold"
"""The attribute of an ``<svg>`` that plyfold has written, with the version: its numbers are those of the outline."""


def refuse_later_version(version: object) -> None:
    """Raise FileFormatError if a number, also as text, is that of a version to come.

    Examples
    --------
    >>> refuse_later_version(3)
    Traceback (most recent call last):
    plyfold.errors.FileFormatError: it is of version 3, and this plyfold reads versions up to 2
      hint: use a newer plyfold, or save it again in an older version
    """
    try:
        later = version is not None and float(str(version)) > OWN_VERSION
    except ValueError:
        raise FileFormatError(f"its version {str(version)[:40]!r} is no number", hint="save it again") from None
    if later:
        raise FileFormatError(
            f"it is of version {str(version)[:40]}, and this plyfold reads versions up to {OWN_VERSION}",
            hint="use a newer plyfold, or save it again in an older version",
        )
