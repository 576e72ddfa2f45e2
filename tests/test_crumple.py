"""The names for users: loaded when used, and known to completion, help and type checkers."""

import ast
import pydoc
import re
import subprocess
import sys
import tomllib
from importlib import import_module
from inspect import unwrap
from pathlib import Path

import pytest

import crumple
import sweep

ROOT = Path(crumple.__file__).parent


def typed():
    """Names that type checkers see, each with its module."""
    tree = ast.parse(Path(sweep.__file__).read_text("utf-8"))
    (block,) = [node for node in tree.body if isinstance(node, ast.If)]
    return {alias.name: node.module for node in block.body for alias in node.names}


def test_names_are_those_of_sweep_and_their_types_are_known():
    assert dir(crumple) == dir(sweep) == sorted(crumple.__all__)
    assert set(typed()) == set(crumple.__all__)
    for name, module in typed().items():
        own = getattr(import_module(module), name)
        assert getattr(crumple, name) is getattr(sweep, name)
        assert unwrap(getattr(crumple, name)) is own


def test_unknown_name_is_answered_with_the_known_ones():
    with pytest.raises(AttributeError, match=r"no 'simulat'; it has Case, .*, simulate, spread$"):
        _ = crumple.simulat


def test_help_teaches_by_an_example_that_uses_only_what_is_there():
    text = pydoc.plain(pydoc.render_doc(crumple))
    assert "simulate(case: " in text
    used = set(re.findall(r"crumple\.(\w+)", crumple.__doc__))
    assert len(used) >= 5
    assert used <= set(crumple.__all__)


def test_version_is_that_of_the_project():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    cited = re.search(r"^version: (.*)$", (ROOT / "CITATION.cff").read_text("utf-8"), re.MULTILINE)
    assert crumple.__version__ == project["version"] == cited[1]


def test_import_alone_loads_nothing():
    script = "import sys; before = {*sys.modules}; import crumple; print(*{*sys.modules} - before)"
    words = [sys.executable, "-c", script]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=True)
    loaded = {name.split(".")[0] for name in done.stdout.split()}
    assert loaded - sys.stdlib_module_names == {"crumple", "sweep"}
