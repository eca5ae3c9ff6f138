"""Errors carry places and obstructions, also from one process to another."""

import ast
import builtins
import pickle
from pathlib import Path

import pytest

import plyfold as pf
from plyfold.errors import CurveError, InputError, NotEmbeddableError, NotImmersibleError, PlyfoldError
from reference.random_curves import BENNEQUIN_LIKE


def test_errors_survive_pickling():
    with pytest.raises(NotImmersibleError) as caught:
        pf.lift([(0, 0), (2, 2), (2, 0), (0, 2)])
    again = pickle.loads(pickle.dumps(caught.value))
    assert again.obstruction == caught.value.obstruction
    assert str(again) == str(caught.value)
    with pytest.raises(CurveError) as caught:
        pf.Curve([(0, 0), (1, float("nan")), (0, 1)])
    again = pickle.loads(pickle.dumps(caught.value))
    assert (again.where, again.hint, str(again)) == (caught.value.where, caught.value.hint, str(caught.value))


def test_every_error_has_the_one_root():
    for name in pf.errors.__all__:
        assert issubclass(getattr(pf.errors, name), PlyfoldError)


def test_many_places_are_shortened():
    error = PlyfoldError("here", where=[(i, i) for i in range(9)])
    assert len(error.where) == 9
    assert str(error).endswith("(4, 4) and 4 more")


def test_an_obstruction_handed_on_says_why():
    nothing = pf.find_immersion([(0, 0), (2, 2), (2, 0), (0, 2)])
    for use in (pf.find_layering, pf.count_layerings, pf.lift, lambda found: pf.flip_distance(found, found)):
        with pytest.raises(NotImmersibleError, match="turns 0 times"):
            use(nothing)
    unliftable = (found for found in map(pf.find_layering, pf.immersions(BENNEQUIN_LIKE)) if not found)
    with pytest.raises(NotEmbeddableError):
        pf.lift(next(unliftable))
    with pytest.raises(InputError, match="no immersion"):
        pf.find_layering("a curve")


# Errors of Python that are raised by name, in some modules or in any: the reason.
OTHERS = {
    ("*", "TimeoutError"): "within the library: whoever hands a clock on catches it",
    ("*", "AssertionError"): "cannot happen",
    ("io/saving", "FileExistsError"): "what Python says of such files, as documented",
    ("io/saving", "IsADirectoryError"): "what Python says of such files",
    ("io/saving", "OSError"): "what the system says, with the name of the file and not that of its draft",
    ("io/flat_meshes", "ValueError"): "as Python raises of words that are no numbers; refused in one place",
    ("io/svg", "ValueError"): "as svgelements raises of other numbers that are none; refused in one place",
    ("core/lowering", "IndexError"): "within the library: what compiled loops check for each index is checked once",
    ("immersion/grouping", "IndexError"): "within the library: the caller knows how many there are",
    ("layering/orders/search", "ValueError"): "cannot happen",
    ("cli/sketch", "KeyboardInterrupt"): "a signal that asks the server to end is an interrupt",
}


def raised_by_name(path):
    """The exceptions that lines of a module raise by their names, classes of Python's own or of the module."""
    tree = ast.parse(path.read_text())
    made = {node.name for node in tree.body if isinstance(node, ast.ClassDef)}
    raised = [node.exc for node in ast.walk(tree) if isinstance(node, ast.Raise)]
    named = {name.id for error in raised if isinstance(name := getattr(error, "func", error), ast.Name)}
    return {name for name in named - made if isinstance(getattr(builtins, name, None), type)}


def test_what_is_raised_on_purpose_is_of_the_tree():
    source = Path(pf.__file__).parent
    paths = {path.relative_to(source).with_suffix("").as_posix(): path for path in source.rglob("*.py")}
    found = {(name, error) for name, path in paths.items() for error in raised_by_name(path)}
    assert {(name, error) for name, error in found if ("*", error) not in OTHERS} <= OTHERS.keys()


@pytest.mark.parametrize("kind", [getattr(pf.errors, name) for name in pf.errors.__all__])
@pytest.mark.parametrize("where", [[], [(1, 2)], [(i, i) for i in range(9)]])
@pytest.mark.parametrize("hint", ["", "move one of them"])
@pytest.mark.parametrize("message", ["two strands touch", "Two strands touch.", "They touch. No disk does that."])
def test_message_place_and_hint_are_joined_as_sentences_are(kind, where, hint, message):
    obstructed = issubclass(kind, NotImmersibleError | NotEmbeddableError)
    error = kind(pf.Obstruction("touching", message, tuple(where)), hint) if obstructed else kind(message, where, hint)
    sentence, _, last = str(error).partition("\n  hint: ")
    assert last == hint
    assert sentence.startswith(message.rstrip("."))
    assert ".," not in sentence
    assert sentence.count(", at (") == bool(where)
    assert sentence == message or where
    assert error.message == message
