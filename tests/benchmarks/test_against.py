"""Two source trees side by side: who is asked when, what counts, and the table."""

import subprocess
import sys
from pathlib import Path

import against
import run

TREE = Path(run.__file__).parents[1]


def test_trees_take_turns_and_the_least_time_counts():
    asked = []

    def measured(tree, contender):
        asked.append((tree.folder.name, contender))
        if contender == "plyfold":
            yield {"stage": "sheets", "seconds": (1.0 if tree.folder.name == "other" else 3.0) / len(asked)}
        yield {"failed": "no disk"}

    pair = against.Pair("coil", 400)
    against.measure(pair, Path("other"), 2, measured)
    ours = TREE.name
    assert [name for name, contender in asked if contender == "plyfold"] == [ours, "other", "other", ours]
    assert pair.theirs == {"sheets": 1.0 / 7}
    assert pair.ours == {"sheets": 3.0 / 8}


def test_table_has_ratios_and_their_means():
    pairs = [
        against.Pair("coil", 400, {"sheets": 0.001, "count": 1.0}, {"sheets": 0.002}),
        against.Pair("coil", 1600, {"sheets": 0.004}, {"sheets": 0.002}),
    ]
    head, _, *lines = [[cell.strip() for cell in line.split("|")[1:-1]] for line in against.table(pairs).splitlines()]
    column = head.index("sheets")
    assert [line[column] for line in lines] == ["2.00 (2.0 ms)", "0.50 (2.0 ms)", "1.00"]
    assert [line[head.index("count")] for line in lines] == ["–", "–", "–"]


def test_command_with_itself():
    options = ["--against", str(TREE), "--families", "chain", "--sizes", "100", "--rounds", "1"]
    words = [sys.executable, str(TREE / "benchmarks" / "run.py"), *options]
    printed = subprocess.run(words, capture_output=True, text=True, check=True).stdout
    (line,) = (line for line in printed.splitlines() if line.startswith("| chain | 100 |"))
    assert line.count(" ms)") == 6
