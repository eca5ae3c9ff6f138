"""Numbers with their nouns."""

__all__ = ["counted"]


def counted(number: int, noun: str) -> str:
    """Return a number with its noun, which takes an s but for one.

    Examples
    --------
    >>> counted(1, "sheet"), counted(2, "sheet")
    ('1 sheet', '2 sheets')
    """
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"
