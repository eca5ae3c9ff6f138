"""The README and the documents say nothing that does not work: all their commands and Python lines run, in order.

Each document has a folder of its own with ``examples`` in it and a drawing ``loop.svg``, and its Python lines share
their names from block to block. Blocks of Python and shell are run, and so is what stands in single backquotes in the
text and is a command or a call. A comment behind an expression that is a Python literal, or begins with one and a
colon, is what it must give.
"""

import ast
import os
import pkgutil
import re
import shutil
import signal
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
DOCUMENTS = [
    "README.md",
    "CONTRIBUTING.md",
    "CONVENTIONS.md",
    *sorted(f"docs/{p.name}" for p in ROOT.glob("docs/*.md")),
]

NO_LITERAL = object()

# What is not run, why, and what is done with it instead.
EXCEPTIONS = {
    "make ": "sets up an environment of its own or takes minutes: make must know how to",
    "pip install ": "loads packages from the network: the extras must exist",
    "python -m pytest ": "runs the slow tests, which make test-slow runs: its files must exist",
    "python docs/": "draws for minutes, and make pictures runs it: its file must exist",
    "python tools/": "measures the source, and tests/test_house.py does it: its file must exist",
    "python benchmarks/": "measures for minutes, and the tests of the benchmarks run it: its file must exist",
    "plyfold sketch": "serves until it is interrupted: it is interrupted when it has said where",
}
FILMED = 'surface.export("ramp.gif")'  # takes seconds, and tests/draw/test_film.py does it

_PIECE = re.compile(
    r"^```(?P<language>\w+)\n(?P<block>.*?)^```$|(?<!`)`(?P<span>[^`]+)`(?!`)", re.DOTALL | re.MULTILINE
)
_COMMAND = re.compile(r"(\.venv/bin/)?(plyfold|python|make|pip)\s")
_NAME = re.compile(r"plyfold(\.\w+)+")


@dataclass(frozen=True)
class Step:
    """A piece of a document: lines of shell, lines of Python, a call in the text, or a name."""

    kind: str
    code: str
    line: int


def steps(text):
    found = []
    for match in _PIECE.finditer(text):
        line = text.count("\n", 0, match.start()) + 1
        if match["language"]:
            found.append(Step(match["language"], match["block"], line + 1))
        elif kind := kind_of(span := " ".join(match["span"].split())):
            found.append(Step(kind, span, line))
    return found


def kind_of(span):
    """Return what a piece of code in the text is; an empty string if it is a fragment."""
    if _COMMAND.match(span):
        return "sh"
    if _NAME.fullmatch(span):
        return "name"
    return "call" if re.match(r"(pf|surface|disk)\.\w", span) else ""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder in which the documents' commands find what they name."""
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    shutil.copy(ROOT / "examples" / "ramp.svg", tmp_path / "loop.svg")
    for name in ("benchmarks", "docs", "tests", "src", "Makefile", "pyproject.toml"):
        (tmp_path / name).symlink_to(ROOT / name)
    (tmp_path / ".venv").mkdir()
    (tmp_path / ".venv" / "bin").symlink_to(Path(sys.executable).parent)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PATH", f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}")
    monkeypatch.setenv("BROWSER", "true")
    return tmp_path


@pytest.mark.parametrize("document", DOCUMENTS)
def test_all_that_a_document_says_runs(document, folder):
    names = {}
    for step in steps((ROOT / document).read_text(encoding="utf-8")):
        try:
            RUN[step.kind](step.code, names)
        except Exception as error:
            raise AssertionError(f"{document}, line {step.line}: {step.code.strip()}") from error


def run_shell(code, _):
    for line in filter(None, map(str.strip, code.splitlines())):
        run_command(line)


def run_command(line):
    bare = line.removeprefix(".venv/bin/")
    exception = next(filter(bare.startswith, EXCEPTIONS), None)
    if exception is not None:
        instead_of(exception, bare)
        return
    done = subprocess.run(["bash", "-c", line], capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
    assert done.returncode == 0, done.stderr or done.stdout


def instead_of(exception, line):
    """Do what stands in for a command that is not run."""
    words = line.partition("#")[0].split()
    if exception == "plyfold sketch":
        serve_a_while(words)
    elif exception == "make ":
        subprocess.run(["bash", "-c", line.replace("make", "make -n", 1)], check=True, capture_output=True)
    elif exception == "pip install ":
        extras = re.findall(r"\[(\w+)\]", line)
        assert all(f"\n{extra} = [" in (ROOT / "pyproject.toml").read_text() for extra in extras)
        assert extras or "." in words
    else:
        files = [word for word in words if word.endswith(".py")]
        assert files
        assert all((ROOT / file).exists() for file in files)


def serve_a_while(words):
    command = [sys.executable, "-m", *words, "--port", "0"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as server:
        try:
            assert server.stdout.readline().startswith("Drawing at http")
        finally:
            server.send_signal(signal.SIGINT)
        server.communicate()
    assert server.returncode in (0, 130)


def run_python(code, names):
    for statement in ast.parse(code).body:
        source = ast.get_source_segment(code, statement)
        comment = code.splitlines()[statement.end_lineno - 1][len(last_line(statement, code)) :].strip(" #")
        if isinstance(statement, ast.Expr):
            compare(source, names, comment)
        else:
            exec(source, names)


def last_line(statement, code):
    return code.splitlines()[statement.end_lineno - 1].encode()[: statement.end_col_offset].decode()


def compare(source, names, comment):
    """Evaluate an expression, or what it prints, and compare it with the comment behind it, if that is a value."""
    printed = re.fullmatch(r"print\((.*)\)", source, re.DOTALL)
    found = eval(printed[1] if printed else source, names)
    for text in (comment, comment.partition(": ")[0]):
        if (shown := literal(text)) is not NO_LITERAL:
            assert found == shown
            return


def literal(text):
    try:
        return ast.literal_eval(text)
    except (SyntaxError, ValueError):
        return NO_LITERAL


def run_call(code, names):
    if code != FILMED:
        eval(code, names)


def run_name(code, _):
    pkgutil.resolve_name(code)


RUN = {"sh": run_shell, "python": run_python, "call": run_call, "name": run_name}


def test_every_block_is_of_a_language_that_is_run():
    for document in DOCUMENTS:
        fences = re.findall(r"^```(\w*)$", (ROOT / document).read_text(encoding="utf-8"), re.MULTILINE)
        assert set(fences[::2]) <= {"python", "sh"}
        assert set(fences[1::2]) <= {""}


def test_exceptions_are_needed():
    lines = [line for document in DOCUMENTS for line in shell_lines((ROOT / document).read_text(encoding="utf-8"))]
    assert all(any(line.startswith(exception) for line in lines) for exception in EXCEPTIONS)
    assert f"`{FILMED}`" in (ROOT / "docs" / "surface.md").read_text(encoding="utf-8")


def shell_lines(text):
    blocks = [step.code for step in steps(text) if step.kind == "sh"]
    return [line.strip().removeprefix(".venv/bin/") for block in blocks for line in block.splitlines()]


@pytest.mark.parametrize("code", ["1 + 1  # 3", "1 + 1  # 3: three", "print(2)  # 1", 'print("a")  # "b"'])
def test_a_wrong_value_is_seen(code):
    with pytest.raises(AssertionError):
        run_python(code, {})


@pytest.mark.parametrize("code", ["nothing", "import nothing", "for x in [1]:\n    y"])
def test_a_line_that_fails_is_seen(code):
    with pytest.raises((NameError, ImportError)):
        run_python(code, {})


def test_a_command_that_fails_is_seen(folder):
    with pytest.raises(AssertionError, match="no-such-file"):
        run_command("plyfold check no-such-file.svg")


def test_calls_and_commands_in_the_text_are_found():
    text = "See `pf.lift(curve)` and `plyfold\ncheck loop.svg`, `plyfold.hard`, `gap`.\n```python\nx = 1\n```\n"
    assert [(step.kind, step.code, step.line) for step in steps(text)] == [
        ("call", "pf.lift(curve)", 1),
        ("sh", "plyfold check loop.svg", 1),
        ("name", "plyfold.hard", 2),
        ("python", "x = 1\n", 4),
    ]
