"""The choice of the compiler, and the parts of Numba that each one needs."""

import ast
import os
import subprocess
import sys
from pathlib import Path

import pytest

from kernels.compile.choice import FAST, KNOWN, STOCK, VARIABLE, CompilerError, choose

ROOT = Path(__file__).parents[3]
HOME = ROOT / "kernels" / "compile"
FEW = ("geometry/test_ccd.py::test_first_shrink", "laws/test_elastic.py", "terms/test_spring.py")

# What the modules that both compilers share import of Numba beside `numba.extending`: what it
# documents, or needs in what it documents; older than what is allowed. `DefaultOptions` is only
# asked whether it has `_nrt`.
FAST_ONLY = {"linking.py", "sealed.py"}
PUBLIC = {
    "numba", "numba.typeof", "numba.types", "numba.core.cgutils", "numba.core.typing.signature",
    "numba.core.imputils.impl_ret_borrowed", "numba.core.options.DefaultOptions",
    "numba.np.arrayobj.make_array",
    "numba.core.typing.templates.AbstractTemplate",
    "numba.core.typing.templates.AttributeTemplate",
    "numba.core.typing.templates.make_intrinsic_template",
    "llvmlite", "llvmlite.binding", "llvmlite.ir",
}  # fmt: skip
LOADED = """
import sys
import sweep.simulation.simulate
print(*[name for name in sys.modules if name.endswith(("compile.linking", "compile.sealed"))])
"""
TREE = """
import importlib.metadata, os, subprocess, sys
importlib.metadata.version = lambda package: {"numba": "9.1.2"}.get(package, "0.50.0")
from kernels.compile.choice import compiler
print(compiler(), compiler(), flush=True)
if "again" not in sys.argv:
    subprocess.run([sys.executable, __file__, "again"], check=True)
"""


def run(*command, **environment):
    """A new process."""
    unset = {name: value for name, value in os.environ.items() if name != VARIABLE}
    return subprocess.run(
        [sys.executable, *command],
        cwd=ROOT,
        env=unset | {"PYTHONPATH": str(ROOT)} | environment,
        capture_output=True,
        text=True,
        check=False,
    )


def test_what_does_not_exist_is_refused():
    done = run("-m", "sweep", "warm", **{VARIABLE: "quick"})
    assert done.returncode == 2
    assert done.stderr == "crumple warm: CRUMPLE_COMPILER = 'quick'; allowed: fast, stock\n"
    with pytest.raises(CompilerError, match=r"CRUMPLE_COMPILER = 'Fast'; allowed: fast, stock"):
        choose("Fast", "0.68.1", "0.50.0")


def test_what_is_asked_for_is_taken_else_numba_decides():
    for asked in (FAST, STOCK):
        assert choose(asked, "0.1", "0.1") == (asked, None)
    for numba, llvmlite in KNOWN:
        assert choose("", f"{numba}.3", f"{llvmlite}.0rc1") == (FAST, None)


@pytest.mark.parametrize("llvmlite", ["0.50.0", "0.5.0", "unknown"])
@pytest.mark.parametrize("numba", ["0.67.0", "0.69.0", "0.6.8", "1.0", "unknown"])
def test_numba_that_is_not_known_gets_the_stock_compiler_and_a_sentence(numba, llvmlite):
    chosen, notice = choose("", numba, llvmlite)
    assert chosen == STOCK
    for part in (f"Numba {numba} with llvmlite {llvmlite} is not 0.68.x", "results are the same"):
        assert part in notice


def test_a_tree_of_processes_tells_its_choice_once(tmp_path):
    (tmp_path / "tree.py").write_text(TREE)
    done = run(str(tmp_path / "tree.py"))
    assert done.stdout.split() == [STOCK] * 4
    assert done.stderr.count("\n") == 1
    assert "Numba 9.1.2" in done.stderr


def test_plain_python_has_no_compiler():
    script = "from sweep.running.provenance import describe_run as d; print(d('')['compiler'])"
    assert run("-c", script, NUMBA_DISABLE_JIT="1").stdout == "none\n"
    assert run("-c", script, **{VARIABLE: STOCK}).stdout == "stock\n"


def test_the_stock_compiler_loads_nothing_of_the_fast_one():
    assert run("-c", LOADED, **{VARIABLE: FAST}).stdout.split()
    done = run("-c", LOADED, **{VARIABLE: STOCK})
    assert (done.stdout.split(), done.stderr) == ([], "")


def imported(path):
    """Names that a module imports, each with its module."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def test_what_the_stock_compiler_needs_of_numba_is_public():
    names = {
        name for path in HOME.glob("*.py") if path.name not in FAST_ONLY for name in imported(path)
    }
    theirs = {name for name in names if name.split(".")[0] in {"numba", "llvmlite"}}
    assert "numba.extending.unbox" in theirs
    assert {name for name in theirs if not name.startswith("numba.extending.")} <= PUBLIC


def test_kernels_are_right_by_the_stock_compiler_too():
    """A few, as it takes long; `make stock` runs all tests so."""
    files = [f"tests/kernels/{name}" for name in FEW]
    done = run("-m", "pytest", "-q", *files, **{VARIABLE: STOCK})
    assert done.returncode == 0, done.stdout
