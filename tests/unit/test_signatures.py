"""Public functions say what types they take, which ruff would ask of private functions too."""

import ast
from pathlib import Path

import pytest

import branchcrush

PACKAGE = Path(branchcrush.__file__).parent
FILES = sorted(PACKAGE.rglob("*.py"))


def is_public(name):
    return not name.startswith("_") or name.startswith("__")


def public_functions(body):
    """Yield the public functions among statements, and those of public classes."""
    for statement in body:
        if isinstance(statement, ast.FunctionDef) and is_public(statement.name):
            yield statement
        elif isinstance(statement, ast.ClassDef) and is_public(statement.name):
            yield from public_functions(statement.body)


def parameters_without_type(function):
    taken = function.args
    every = [*taken.posonlyargs, *taken.args, taken.vararg, *taken.kwonlyargs, taken.kwarg]
    named = [parameter for parameter in every if parameter and parameter.arg not in ("self", "cls")]
    return [parameter.arg for parameter in named if parameter.annotation is None]


def signatures_without_types(source):
    functions = public_functions(ast.parse(source).body)
    missing = [(function.name, parameters_without_type(function)) for function in functions]
    return [(name, parameters) for name, parameters in missing if parameters]


@pytest.mark.parametrize("file", FILES, ids=lambda file: str(file.relative_to(PACKAGE)))
def test_public_functions_say_what_they_take(file):
    assert signatures_without_types(file.read_text(encoding="utf-8")) == []


def test_what_is_private_or_inside_a_function_is_free():
    assert signatures_without_types("def _a(x): pass\ndef b():\n    def c(x): pass") == []
    assert signatures_without_types("class _A:\n    def b(self, x): pass") == []


def test_every_kind_of_parameter_is_asked():
    source = "def a(b, /, c: int, d, *e, f, **g): pass\nclass H:\n    def i(self, j): pass"
    assert signatures_without_types(source) == [("a", [*"bdefg"]), ("i", ["j"])]
