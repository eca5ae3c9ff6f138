"""What is public is documented: names, signatures and docstrings in the style of numpydoc agree."""

import ast
import doctest
import inspect
import re
from functools import cached_property
from importlib import import_module
from pathlib import Path
from types import ModuleType

import pytest

import plyfold as pf

SOURCE = Path(pf.__file__).parent
STUBS = sorted(SOURCE.rglob("__init__.pyi"))
SECTION = re.compile(r"^(Parameters|Attributes|Returns|Yields|Raises|Notes|References|Examples)\n-+\n", re.MULTILINE)
SENTENCE = re.compile(r"[A-Z`:].*[.?]")


def package_of(stub):
    return ".".join(stub.relative_to(SOURCE.parent).parent.parts)


def public():
    """Every public name with what it stands for; modules that are public bring all of their names."""
    found = {}
    for stub in STUBS:
        package = import_module(package_of(stub))
        for name in package.__all__:
            value = getattr(package, name)
            inner = value.__all__ if isinstance(value, ModuleType) else ()
            found |= {f"{package.__name__}.{name}": value}
            found |= {f"{package.__name__}.{name}.{other}": getattr(value, other) for other in inner}
    return found


PUBLIC = public()
FUNCTIONS = {name: value for name, value in PUBLIC.items() if inspect.isfunction(value)}
CLASSES = {name: value for name, value in PUBLIC.items() if inspect.isclass(value)}
METHODS = {
    f"{name}.{attribute}": getattr(kind, attribute)
    for name, kind in CLASSES.items()
    for attribute, value in vars(kind).items()
    if not attribute.startswith("_") and isinstance(value, classmethod | staticmethod | type(public))
}
PROPERTIES = {
    f"{name}.{attribute}": value
    for name, kind in CLASSES.items()
    for attribute, value in vars(kind).items()
    if not attribute.startswith("_") and isinstance(value, property | cached_property)
}


def sections(value):
    """The parts of a docstring by their titles; the summary's title is empty."""
    title, parts = "", SECTION.split(inspect.cleandoc(value.__doc__))
    return {title: parts[0], **dict(zip(parts[1::2], parts[2::2], strict=True))}


def described(section):
    """The parameters that a section describes, each with what stands behind its colon."""
    lines = [line for line in section.splitlines() if line and not line.startswith(" ")]
    pairs = [(names.strip(), kind.strip()) for names, _, kind in (line.partition(" : ") for line in lines)]
    return {name.strip(): kind for names, kind in pairs for name in names.split(",")}


def parameters(function):
    """The parameters of a signature as their docstrings name them."""
    stars = {inspect.Parameter.VAR_POSITIONAL: "*", inspect.Parameter.VAR_KEYWORD: "**"}
    found = inspect.signature(function).parameters.values()
    return {stars.get(p.kind, "") + p.name: p for p in found if p.name not in ("self", "cls")}


def raised(function):
    """The classes that the lines of a function name after ``raise``."""
    tree = ast.parse(inspect.cleandoc("\n" + inspect.getsource(inspect.unwrap(function))))
    nodes = (node.exc for node in ast.walk(tree) if isinstance(node, ast.Raise))
    names = {getattr(node, "func", node) for node in nodes if node is not None}
    return {node.id for node in names if isinstance(node, ast.Name) and node.id.endswith("Error")}


def require_summary(value):
    first, _, rest = value.__doc__.partition("\n")
    assert SENTENCE.fullmatch(first), first
    assert not rest or rest.startswith("\n")


def require_parameters(function, section):
    assert list(described(section)) == list(parameters(function))


def require_optional(function, section):
    told = described(section)
    for name, parameter in parameters(function).items():
        has_default = parameter.default is not inspect.Parameter.empty
        assert ("optional" in told[name] or "{" in told[name]) == has_default or name.startswith("*"), name


def require_all(function, parts):
    assert "Parameters" in parts or not parameters(function)
    require_parameters(function, parts.get("Parameters", ""))
    require_optional(function, parts.get("Parameters", ""))
    kind = inspect.signature(function).return_annotation
    assert (kind in (None, "None", "NoReturn")) != bool({"Returns", "Yields"} & parts.keys())
    assert str(kind).startswith(("Iterator", "Generator")) == ("Yields" in parts)
    for error in raised(function):
        assert error in parts.get("Raises", ""), error


@pytest.mark.parametrize("stub", STUBS, ids=package_of)
def test_stubs_and_packages_have_the_same_names(stub):
    listed = [
        alias.asname
        for node in ast.parse(stub.read_text()).body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    ]
    package = import_module(package_of(stub))
    assert sorted(listed) == sorted(package.__all__)


@pytest.mark.parametrize("name", list(FUNCTIONS))
def test_functions(name):
    parts = sections(FUNCTIONS[name])
    require_summary(FUNCTIONS[name])
    require_all(FUNCTIONS[name], parts)
    assert doctest.DocTestParser().get_examples(parts["Examples"])


@pytest.mark.parametrize("name", list(CLASSES))
def test_classes(name):
    kind = CLASSES[name]
    require_summary(kind)
    if issubclass(kind, Exception):
        return
    parts = sections(kind)
    require_parameters(kind, parts.get("Parameters", ""))
    assert doctest.DocTestParser().get_examples(parts["Examples"])


@pytest.mark.parametrize("name", list(METHODS))
def test_methods(name):
    """A method may say in a few words what it returns and raises; one with parameters describes them all, or none."""
    parts = sections(METHODS[name])
    require_summary(METHODS[name])
    if "Parameters" in parts:
        require_all(METHODS[name], parts)
    for error in raised(METHODS[name]):
        assert error in METHODS[name].__doc__, error


@pytest.mark.parametrize("name", PROPERTIES)
def test_properties(name):
    require_summary(PROPERTIES[name])
