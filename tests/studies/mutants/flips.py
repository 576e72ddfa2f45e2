"""Mutants of the kernels: one sign of one function flipped in the syntax tree.

A sign is a plus or a minus between two terms, before one, or in `+=` and `-=`. Signs in indices and
next to whole numbers are left out: they count.
"""

import ast
import random
from pathlib import Path
from typing import NamedTuple

from tests.project.test_architecture import TESTED_ELSEWHERE

ROOT = Path(__file__).parents[3]
LEFT_OUT = "kernels/compile/"  # how kernels become machine code
FLIPPED = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.USub: ast.UAdd}
SEED = 37


class Mutant(NamedTuple):
    """The sign with this number in a file of the repository: its function and line, and the
    change.
    """

    path: str
    number: int
    function: str
    line: int
    change: str

    @property
    def own_tests(self):
        """The file that tests the mutated one."""
        folder, _, name = self.path.removesuffix(".py").rpartition("/")
        mirror = f"tests/{folder}/test_{name}.py"
        if (ROOT / mirror).exists():
            return mirror
        return f"tests/{TESTED_ELSEWHERE[self.path.removesuffix('.py').replace('/', '.')]}"


def signs(tree):
    """Functions and nodes of all signs."""
    for function in tree.body:
        if isinstance(function, ast.FunctionDef):
            for node in _outside_indices(function):
                if type(getattr(node, "op", None)) in FLIPPED and not _counts(node):
                    yield function.name, node


def _outside_indices(node):
    for child in ast.iter_child_nodes(node):
        if not isinstance(child, ast.Subscript):
            yield child
            yield from _outside_indices(child)


def _counts(node):
    beside = (getattr(node, name, None) for name in ("left", "right", "value", "operand"))
    return any(type(getattr(part, "value", None)) is int for part in beside)


def flip(node):
    """Flip the sign of a node; return its text before and after."""
    before, node.op = ast.unparse(node), FLIPPED[type(node.op)]()
    return f"{before} -> {ast.unparse(node)}"


def mutants(path):
    """All mutants of a file."""
    found = signs(ast.parse((ROOT / path).read_text("utf-8")))
    for number, (function, node) in enumerate(found):
        yield Mutant(path, number, function, node.lineno, flip(node))


def mutated(source, mutant):
    """The text of the file with its mutant."""
    tree = ast.parse(source)
    flip([node for _, node in signs(tree)][mutant.number])
    return ast.unparse(tree)


def sample(each):
    """The same random mutants in every call, so many of every file of the kernels."""
    paths = (path.relative_to(ROOT).as_posix() for path in sorted((ROOT / "kernels").rglob("*.py")))
    for path in paths:
        found = [] if path.startswith(LEFT_OUT) else list(mutants(path))
        yield from random.Random(f"{SEED} {path}").sample(found, min(each, len(found)))
