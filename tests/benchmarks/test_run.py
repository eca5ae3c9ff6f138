"""The command of the benchmarks: its tables, its growth exponents, other programs, the page in the docs."""

import subprocess
import sys
from pathlib import Path

import pytest
import run
import tables
from peers import Peer, verdict

COMMAND = [sys.executable, str(Path(run.__file__))]


def rows(power=1.3, family="ribbon"):
    """Measurements that grow with a known power."""
    made = []
    for n in (100, 1_000, 10_000, 100_000):
        row = tables.Row(family, n, facts={"k": n, "w": 2}, verdicts={"plyfold": True})
        row.seconds = {"arrangement": 1e-6 * (2 * n) ** power, "sheets": 2e-6 * (2 * n) ** power, "GEOS": 1e-6 * n}
        made.append(row)
    return made


class TestCommand:
    @pytest.fixture(scope="class")
    @staticmethod
    def printed():
        says_no = f"no-sayer={sys.executable} -c print('no') {{file}}"
        options = ["--families", "chain", "--sizes", "200", "--reference-up-to", "0", "--peer", says_no]
        return subprocess.run([*COMMAND, *options], capture_output=True, text=True, check=True)

    def test_table(self, printed):
        (line,) = (line for line in printed.stdout.splitlines() if line.startswith("| chain | 200 | 16 |"))
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        assert cells[3:5] == ["2", "disk"]
        assert all(float(cells[column]) > 0 for column in (5, 6, 8, 9, 10))

    def test_peer_and_lift(self, printed):
        assert "| no-sayer | chain | 200 |" in printed.stdout
        assert "| chain | 200 |" in printed.stdout.split("### Layering and lifting")[1]

    def test_progress_goes_to_standard_error(self, printed):
        assert "chain 200: k = 16" in printed.stderr

    def test_budget(self):
        options = ["--families", "chain", "--sizes", "200", "400", "--budget", "0"]
        done = subprocess.run([*COMMAND, *options], capture_output=True, text=True, check=True)
        assert done.stdout.count("chain, n = 200 and more: over 0 s, the family's budget") == 1


class TestExponent:
    @pytest.mark.parametrize("power", [0.9, 1.0, 1.3, 3.0])
    def test_of_a_power(self, power):
        assert tables.exponent(rows(power), tables.VERDICT) == pytest.approx(power)

    def test_only_the_last_two_decades_count(self):
        spoiled = rows()
        spoiled[0].seconds["arrangement"] = 100.0
        assert tables.exponent(spoiled, tables.VERDICT) == pytest.approx(1.3)

    def test_none_without_a_decade_or_large_curves(self):
        assert tables.exponent(rows()[:1], tables.VERDICT) is None
        assert tables.exponent(rows()[:2] + rows()[1:2], tables.VERDICT) is None
        assert tables.exponent(rows(), tables.TRIANGULATED) is None


class TestAims:
    def test_met_and_missed(self):
        text = tables.bars_table([*rows(1.1, "ribbon"), *rows(1.3, "coil")])
        assert "| ribbon: growth exponent | 1.15 | 1.10 | yes |" in text
        assert "| coil: growth exponent | 1.15 | 1.30 | no |" in text
        assert "| ribbon, n = 60,000: all sheets / GEOS | 1 | – | – |" in text


@pytest.mark.parametrize(
    ("value", "written"), [(0.0123, "0.012"), (1.26, "1.3"), (12.6, "13"), (1260.0, "1,260"), (0.0, "0"), (None, "–")]
)
def test_numbers(value, written):
    assert tables.number(value) == written


@pytest.mark.parametrize(
    ("printed", "code", "answer"),
    [("yes\n", 0, True), ("verdict: No.\n", 0, False), ("", 0, True), ("", 1, False), ("", 139, None), ("1", 3, True)],
)
def test_verdicts_of_peers(printed, code, answer):
    assert verdict(printed, code) == answer


def test_peers_need_a_file():
    assert Peer.parse("mine=check {file} --fast") == Peer("mine", "check {file} --fast")
    with pytest.raises(ValueError, match="name=command"):
        Peer.parse("mine=check")


def test_docs_keep_what_is_outside_the_marks(tmp_path, monkeypatch):
    monkeypatch.setattr(run, "DOCS", tmp_path)
    (tmp_path / "images").mkdir()
    page = tmp_path / "benchmarks.md"
    page.write_text(f"before\n{run.BEGIN}\nold\n{run.END}\nafter\n")
    run.write_docs("new", rows())
    assert page.read_text() == f"before\n{run.BEGIN}\n\nnew\n\n{run.END}\nafter\n"
    assert (tmp_path / "images" / "benchmark.png").stat().st_size > 10_000
