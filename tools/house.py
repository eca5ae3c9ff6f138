"""The shape of the code, measured: ``python tools/house.py`` prints the table, ``--check`` holds the rules.

The rules: every file reads rooms before its own alone, but for the lines named in :data:`EXCEPTIONS`; no imports go
round in circles; the checkers of ``certify`` read nothing but errors; a public name is in one module alone, but for the
same thing, see :data:`SAME_THINGS`; other projects' libraries are imported at the top of a file, but for those that
are :data:`LATE` with a reason.
"""

from __future__ import annotations

import argparse
import ast
import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from statistics import median
from typing import NamedTuple

SOURCE = Path(__file__).resolve().parent.parent / "src" / "plyfold"

# The rooms from the ground floor up, each a package or a module that stands alone; those on one line do not read each
# other.
ORDER = [
    ["arrays", "errors", "wording"],
    ["obstruction"],
    ["options", "clock", "colours", "ragged", "loading", "memory", "mistaken", "certify"],
    ["predicates", "halfedges", "matrices", "sat"],
    ["core"],
    ["graphs"],
    ["outline"],
    ["io"],
    ["tables"],
    ["arrangement"],
    ["immersion"],
    ["layering"],
    ["mesh"],
    ["flat"],
    ["offers"],
    ["disk"],
    ["homotopy"],
    ["surface"],
    ["hard", "paper"],
    ["gallery"],
    ["report"],
    ["draw"],
    ["sketch", "census", "many"],
    ["plyfold"],
    ["cli"],
]

# A value makes its picture or its page when it is asked for one: (file, what it reads): the reason.
EXCEPTIONS = {
    ("plyfold.arrangement.arrangement", "plyfold.draw.svg"): "_repr_svg_ of an arrangement",
    ("plyfold.arrangement.gauss", "plyfold.draw.svg"): "_repr_svg_ of a Gauss code",
    ("plyfold.immersion.immersion", "plyfold.draw.svg"): "_repr_svg_ of an immersion",
    ("plyfold.layering.layering", "plyfold.draw.over_under_files"): "_repr_svg_ of a layering",
    ("plyfold.outline.curve", "plyfold.draw.svg"): "_repr_svg_ of a curve",
    ("plyfold.outline.curve", "plyfold.arrangement.tidying"): "methods of a curve that keep its code",
    ("plyfold.obstruction", "plyfold.draw.notebook"): "_repr_png_ of an obstruction",
    ("plyfold.immersion.immersion", "plyfold.draw.notebook"): "_repr_png_ of an immersion that is no disk",
    ("plyfold.immersion.immersion", "plyfold.flat.settle"): "touches: where the triangles of an immersion are cut",
    ("plyfold.disk.unwrap", "plyfold.draw.notebook"): "_repr_png_ of an unwound disk",
    ("plyfold.surface.thicken", "plyfold.draw.notebook"): "_repr_png_ of a solid",
    ("plyfold.surface.thicken", "plyfold.draw.viewer"): "export of a solid to .html",
    ("plyfold.surface.lift", "plyfold.draw.film"): "export to .gif and .mp4",
    ("plyfold.surface.lift", "plyfold.draw.viewer"): "export to .html, show, and _repr_html_ of a surface",
}

# Public names that several modules define, for they are the same thing: the reason to define them again.
SAME_THINGS = {
    "Bools": "certify shares nothing with what it checks",
    "Floats": "certify shares nothing with what it checks",
    "Ints": "certify shares nothing with what it checks",
    "Signs": "certify shares nothing with what it checks",
    "find_immersion": "the exact one, and that of the paper as pf.paper.find_immersion",
    "find_layering": "the exact one, and that of the paper as pf.paper.find_layering",
    "ribbon": "a line with a width, and one whose normals are guessed from its points as pf.gallery.ribbon",
    "save": "an outline, and a figure as pf.draw.save",
}

_SMALL = "small drawings are arranged and decided before it is imported, or without it"
_STAGE = "its import is the stage that loads libraries, in which no other one's seconds are"
_OPTIONAL = "it need not be installed"
# Libraries that functions import when they are called: (file, library): the reason.
LATE = {
    ("plyfold.arrangement.noding", "shapely"): _SMALL,
    ("plyfold.arrangement.polylines", "shapely"): _SMALL,
    ("plyfold.disk.places", "scipy"): _STAGE,
    ("plyfold.disk.places", "shapely"): "the command line knows what files hold a disk before that stage",
    ("plyfold.draw.render", "scipy"): "the page's server and plain pictures do without it",
    ("plyfold.graphs", "scipy"): _SMALL,
    ("plyfold.io.outline_files", "shapely"): _SMALL,
    ("plyfold.io.pieces", "shapely"): "the command line knows what files hold polygons before that stage",
    ("plyfold.io.vector", "shapely"): _SMALL,
    ("plyfold.layering.orders.maxsat", "pysat"): _STAGE,
    ("plyfold.many.given", "shapely"): "arrays of points do without it",
    ("plyfold.matrices", "scipy"): _STAGE,
    ("plyfold.offers.cusps", "pysat"): _STAGE,
    ("plyfold.outline.direction", "shapely"): _SMALL,
    ("plyfold.outline.foreign", "matplotlib"): "whoever has a path of it has loaded it",
    ("plyfold.outline.given", "shapely"): _SMALL,
    ("plyfold.sat", "pysat"): _STAGE,
    ("plyfold.surface.files", "trimesh"): _OPTIONAL,
    ("plyfold.tables.cluster", "distributed"): _OPTIONAL,
    ("plyfold.tables.table", "pandas"): _OPTIONAL,
    ("plyfold.tables.table", "pyarrow"): _OPTIONAL,
    ("plyfold.surface.heights", "scipy"): _STAGE,
}

LIFT = """
import collections, sys
import plyfold as pf
ramp = pf.Curve([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)])
pf.lift(ramp)
seen = collections.defaultdict(set)
def profile(frame, event, argument):
    code = frame.f_code
    if event == "call" and "/plyfold/" in code.co_filename:
        seen[code.co_filename].add((code.co_name, code.co_firstlineno))
sys.setprofile(profile)
pf.lift(ramp)
sys.setprofile(None)
print(len(seen), sum(map(len, seen.values())))
"""


class Import(NamedTuple):
    """One module that a line of another one imports; ``at_top`` if that happens when the module is loaded."""

    module: str
    line: int
    target: str
    at_top: bool
    typing_only: bool


def modules() -> dict[str, ast.Module]:
    """Return the syntax trees of all modules by their dotted names."""
    found = {}
    for path in sorted(SOURCE.rglob("*.py")):
        parts = path.relative_to(SOURCE.parent).with_suffix("").parts
        found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = ast.parse(path.read_text())
    return found


def imports(trees: dict[str, ast.Module]) -> list[Import]:
    """Return every import of one module of plyfold by another."""
    return [found for name, tree in trees.items() for found in _imports_of(name, tree, trees)]


def _imports_of(name: str, tree: ast.Module, trees: dict[str, ast.Module]) -> Iterator[Import]:
    typing_only = _under_type_checking(tree)
    top = {id(node) for node in tree.body}
    for node in ast.walk(tree):
        for target in _targets(node, trees):
            if target != name:
                yield Import(name, node.lineno, target, id(node) in top, id(node) in typing_only)


def _under_type_checking(tree: ast.Module) -> set[int]:
    """Return the identities of all nodes that only type checkers see."""
    return {
        id(inner)
        for node in ast.walk(tree)
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"
        for inner in ast.walk(node)
    }


def _targets(node: ast.AST, trees: dict[str, ast.Module]) -> Iterator[str]:
    """Yield the modules that a node imports: for ``from package import name`` the module of that name, if it is one."""
    if isinstance(node, ast.Import):
        yield from (alias.name for alias in node.names if alias.name in trees)
    elif isinstance(node, ast.ImportFrom) and node.module in trees:
        for alias in node.names:
            inner = f"{node.module}.{alias.name}"
            yield inner if inner in trees else node.module


def late_imports(trees: dict[str, ast.Module]) -> list[tuple[str, str, int]]:
    """Return (module, library, line) for every import of another project's library that is not at the top of a file."""
    found = []
    for module, tree in trees.items():
        above = {id(node) for node in tree.body} | _under_type_checking(tree)
        for node in ast.walk(tree):
            for library in _libraries(node) if id(node) not in above else ():
                found.append((module, library, node.lineno))  # type: ignore[attr-defined]
    return found


def _libraries(node: ast.AST) -> set[str]:
    """Return the libraries of other projects that a node imports."""
    names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
    names += [node.module or ""] if isinstance(node, ast.ImportFrom) else []
    return {name.partition(".")[0] for name in names} - sys.stdlib_module_names - {"plyfold", "plyfold_command"}


def room(module: str) -> str:
    """Return the room of a module; the package itself is the front door, and its ``__main__`` the command line."""
    parts = module.split(".")
    return {1: "plyfold"}.get(len(parts)) or {"__main__": "cli"}.get(parts[1], parts[1])


def against_the_order(found: list[Import]) -> list[Import]:
    """Return imports of a room that does not come before, types alone left out."""
    floor = {name: number for number, names in enumerate(ORDER) for name in names}
    return [
        line
        for line in found
        if not line.typing_only
        and room(line.module) != room(line.target)
        and floor[room(line.target)] >= floor[room(line.module)]
    ]


def unexplained(found: list[Import]) -> list[Import]:
    """Return the imports against the order that are not among the exceptions, or that are done on loading."""
    return [line for line in against_the_order(found) if line.at_top or (line.module, line.target) not in EXCEPTIONS]


def circles(found: list[Import]) -> list[list[str]]:
    """Return the groups of modules that import each other round, the exceptions and types left out (Tarjan)."""
    follows: dict[str, set[str]] = defaultdict(set)
    for line in found:
        if not line.typing_only and (line.module, line.target) not in EXCEPTIONS:
            follows[line.module].add(line.target)
    index: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    groups: list[list[str]] = []

    def visit(name: str) -> None:
        index[name] = low[name] = len(index)
        stack.append(name)
        for other in sorted(follows[name]):
            if other not in index:
                visit(other)
            if other in stack:
                low[name] = min(low[name], low[other])
        if low[name] == index[name]:
            at = stack.index(name)
            groups.append(stack[at:])
            del stack[at:]

    for name in sorted(follows):
        if name not in index:
            visit(name)
    return [group for group in groups if len(group) > 1]


def names_in_several_modules(trees: dict[str, ast.Module]) -> dict[str, list[str]]:
    """Return the functions, classes and constants that several modules define, with those modules."""
    homes: dict[str, list[str]] = defaultdict(list)
    for module, tree in trees.items():
        for name in {name for node in tree.body for name in _defined(node)}:
            if not name.startswith("__"):
                homes[name].append(module)
    return {name: where for name, where in sorted(homes.items()) if len(where) > 1}


def _defined(node: ast.stmt) -> list[str]:
    if isinstance(node, ast.FunctionDef | ast.ClassDef | ast.AsyncFunctionDef):
        return [node.name]
    targets = node.targets if isinstance(node, ast.Assign) else [node.target] if isinstance(node, ast.AnnAssign) else []
    return [target.id for target in targets if isinstance(target, ast.Name)]


def code_lines(tree: ast.Module) -> int:
    """Return how many lines hold code: blank lines, comments and docstrings do not count."""
    docstrings = {
        id(node.body[0])
        for node in ast.walk(tree)
        if isinstance(node, ast.Module | ast.FunctionDef | ast.ClassDef | ast.AsyncFunctionDef)
        and ast.get_docstring(node, clean=False) is not None
    }
    lines: set[int] = set()

    def mark(node: ast.AST) -> None:
        if id(node) in docstrings:
            return
        if (end := getattr(node, "end_lineno", None)) is not None and not list(ast.iter_child_nodes(node)):
            lines.update(range(node.lineno, end + 1))  # type: ignore[attr-defined]
        elif hasattr(node, "lineno"):
            lines.update((node.lineno, end))  # type: ignore[arg-type]
        for child in ast.iter_child_nodes(node):
            mark(child)

    mark(tree)
    return len(lines)


def function_lengths(trees: dict[str, ast.Module]) -> list[int]:
    """Return the lengths of all functions in lines, without their docstrings, in rising order."""
    lengths = []
    for tree in trees.values():
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                docstring = ast.get_docstring(node, clean=False)
                shown = 0 if docstring is None else len(docstring.splitlines())
                lengths.append(1 + (node.end_lineno or node.lineno) - node.lineno - shown)
    return sorted(lengths)


def import_ratio(tries: int = 9) -> float:
    """Return the time of ``import plyfold`` over that of ``import numpy``, each the least of some fresh processes."""
    least = {module: min(_import_microseconds(module) for _ in range(tries)) for module in ("numpy", "plyfold")}
    return least["plyfold"] / least["numpy"]


def _import_microseconds(module: str) -> int:
    program = f"import time; start = time.perf_counter_ns(); import {module}; print(time.perf_counter_ns() - start)"
    return int(_output(program)) // 1000


def _output(program: str) -> str:
    return subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True).stdout


def table() -> str:
    """Return the measures as a Markdown table."""
    trees = modules()
    found = imports(trees)
    files, functions = _output(LIFT).split()
    lengths = function_lengths(trees)
    largest = max((len(path.read_text().splitlines()), path.name) for path in SOURCE.rglob("*.py"))
    rows = [
        ("files on the way of `lift`", files),
        ("functions on the way of `lift`", functions),
        ("files", len(trees)),
        ("lines of code, without blanks, comments and docstrings", sum(map(code_lines, trees.values()))),
        ("longest file", f"{largest[0]} ({largest[1]})"),
        ("circles of imports", len(circles(found))),
        ("imports against the order, named exceptions", len(against_the_order(found)) - len(unexplained(found))),
        ("imports against the order, others", len(unexplained(found))),
        ("imports of libraries inside functions, all named", len(late_imports(trees))),
        ("names defined in several modules", len(names_in_several_modules(trees))),
        (
            "functions; median, nine tenths up to, longest",
            f"{len(lengths)}; {median(lengths):g}, {lengths[len(lengths) * 9 // 10]}, {lengths[-1]} lines",
        ),
        ("`import plyfold` over `import numpy`", f"{import_ratio():.2f}"),
    ]
    return "\n".join(["| measure | value |", "|---|---|", *(f"| {name} | {value} |" for name, value in rows)])


def broken_rules(trees: dict[str, ast.Module]) -> Iterator[str]:
    """Yield a sentence for every rule that is broken."""
    found = imports(trees)
    for line in unexplained(found):
        yield f"{line.module}, line {line.line}: reads {line.target}, which does not come before it"
    for group in circles(found):
        yield f"these read each other in a circle: {', '.join(group)}"
    used = {(line.module, line.target) for line in against_the_order(found)}
    for module, target in EXCEPTIONS.keys() - used:
        yield f"the exception for {module} to read {target} is not needed"
    for line in found:
        if room(line.module) == "certify" != room(line.target) and line.target != "plyfold.errors":
            yield f"{line.module}, line {line.line}: a checker reads {line.target}"
    late = {(module, library): line for module, library, line in late_imports(trees)}
    for module, library in late.keys() - LATE.keys():
        yield f"{module}, line {late[module, library]}: imports {library} inside a function"
    for module, library in LATE.keys() - late.keys():
        yield f"the reason for {module} to import {library} inside a function is not needed"
    several = {name: homes for name, homes in names_in_several_modules(trees).items() if not name.startswith("_")}
    for name in several.keys() - SAME_THINGS.keys():
        yield f"{name} names several things: in {', '.join(several[name])}"
    for name in SAME_THINGS.keys() - several.keys():
        yield f"the reason for {name} to be defined again is not needed"


def main() -> int:
    """Print the table, or what is broken."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="print the rules that are broken; exit 1 if there are any")
    if not parser.parse_args().check:
        print(table())
        return 0
    broken = sorted(broken_rules(modules()))
    print("\n".join(broken) if broken else "The house is in order.")
    return bool(broken)


if __name__ == "__main__":
    sys.exit(main())
