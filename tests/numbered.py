"""A table of numbers in parts, for tests of how tables are made: other processes must be able to import it."""

import time
from pathlib import Path

import numpy as np

from plyfold.tables.table import DataTable


def a_table(first=0, n=3):
    numbers = np.arange(first, first + n)
    return DataTable(
        {
            "number": numbers,
            "even": numbers % 2 == 0,
            "name": np.array([f"n{number}".encode() for number in numbers], dtype="S8"),
            "large": np.array([None if number % 2 else 2**80 + int(number) for number in numbers], dtype=object),
        }
    )


def make_part(folder, number):
    """Make a part of a table, and keep count of how often that happens."""
    with (Path(folder) / "made").open("a") as made:
        made.write(f"{number}\n")
    return a_table(3 * number), {"first": 3 * number}


def failing_part(folder, number):
    if number == 2 and not (Path(folder) / "mended").exists():
        raise ValueError("no part 2 yet")
    return make_part(folder, number)


def slow_part(folder, number):
    time.sleep(0.2)
    return make_part(folder, number)
