"""The shape of the code: who may import what, and how long a thing may be."""

import ast
import graphlib
import subprocess
import sys
from pathlib import Path

from specimens import summary, write

ROOT = Path(__file__).parents[1]
SOURCES = {
    ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__"): path
    for package in ("sweep", "kernels", "tests")
    for path in sorted((ROOT / package).rglob("*.py"))
}
TREES = {module: ast.parse(path.read_text("utf-8")) for module, path in SOURCES.items()}
PROGRAM = [module for module in TREES if not module.startswith("tests")]
KERNELS = [module for module in PROGRAM if module.startswith("kernels")]

HOMES = {
    "numba": "kernels.jit kernels.linking kernels.calling kernels.separate kernels.ahead "
    "kernels.cache kernels.lanes kernels.quick",
    "llvmlite": "kernels.linking kernels.calling kernels.separate kernels.cache kernels.lanes",
    "dask": "sweep.running.dask_graph",
    "distributed": "sweep.running.dask_graph",
    "h5py": "sweep.store sweep.growing",
    "matplotlib": "sweep.report.case_plots",
    "pint": "sweep.config.units",
}
# What reads results, and so must run where nothing is installed that simulates.
READERS = ["store", "rank", "sheets", "accuracy", "precision", "plots", "publish", "verbs"]
READERS = [f"sweep.{name}" for name in READERS]
ABSENT = ["kernels", "numba", "llvmlite", "dask", "distributed", "pydantic", "pint", "scipy"]
ABSENT += ["pydantic_core", "shapely", "tornado"]
READING = """
import sys
from importlib import import_module

class Absent:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in {absent}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)

sys.meta_path.insert(0, Absent())
for name in {readers}:
    import_module(name)
from sweep.__main__ import main
print([main(words) for words in {calls}])
"""
HEAVY = ["numba", "kernels", "dask", "distributed", "scipy", "pandas", "matplotlib", "h5py"]

MAX_LINES_OF_FILE = 300
MAX_LINES_OF_FUNCTION = 80


def walk(node, lazy):
    """Nodes below this one but those for type checkers; without `lazy`, none inside functions."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.If) and "TYPE_CHECKING" in ast.unparse(child.test):
            continue
        yield child
        if lazy or not isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            yield from walk(child, lazy)


def imports(module, lazy=True):
    """Dotted names that a module imports; a name that is no module of ours is cut at its module."""
    found = set()
    for node in walk(TREES[module], lazy):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            base = "." * node.level + (node.module or "")
            dotted = {f"{base}.{alias.name}" for alias in node.names}
            found |= {name if name in SOURCES else base for name in dotted}
    return found


def packages(module):
    """First parts of the names that a module imports."""
    return {name.split(".")[0] for name in imports(module)}


def functions(module):
    return [n for n in ast.walk(TREES[module]) if isinstance(n, ast.FunctionDef)]


def called(function):
    """Last part of the name of everything that a function calls."""
    calls = (node.func for node in ast.walk(function) if isinstance(node, ast.Call))
    return {ast.unparse(callee).split(".")[-1] for callee in calls}


def python(script):
    """What a fresh interpreter makes of a script."""
    command = [sys.executable, "-c", script]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)


def asserts(function):
    """True if a function has an assertion of its own, of numpy or of pytest."""
    known = {"raises", "warns", "assert_allclose", "assert_array_equal", "assert_frame_equal"}
    return any(isinstance(n, ast.Assert) for n in ast.walk(function)) or called(function) & known


def test_imports_are_absolute():
    relative = {m for m in PROGRAM for name in imports(m) if name.startswith(".")}
    assert relative == set()


def test_kernels_import_only_numpy_and_kernels():
    allowed = {"numpy", "math", "typing", "kernels"}
    strangers = {m: packages(m) - allowed for m in KERNELS if m not in HOMES["numba"].split()}
    assert {m: names for m, names in strangers.items() if names} == {}


def test_kernels_never_import_sweep():
    assert [m for m in KERNELS if "sweep" in packages(m)] == []


def test_each_library_has_one_home():
    users = {library: [m for m in PROGRAM if library in packages(m)] for library in HOMES}
    astray = {lib: set(found) - set(HOMES[lib].split()) for lib, found in users.items()}
    assert {library: found for library, found in astray.items() if found} == {}


def test_no_circular_imports():
    ours = {m: imports(m, lazy=False) & set(PROGRAM) - {m} for m in PROGRAM}
    order = list(graphlib.TopologicalSorter(ours).static_order())  # raises on a circle
    assert set(order) == set(PROGRAM)


def test_results_are_read_where_nothing_that_simulates_is_installed(tmp_path):
    file, folder = write(tmp_path / "trial.h5", summary({"case_id": "ab"})), str(tmp_path / "out")
    calls = [["status", file], ["rank", file], ["rank", file, "--csv"], ["show", file]]
    calls += [["rank", file, "--markdown"], ["rank", file, "--out", folder], ["show", file, "ab"]]
    done = python(READING.format(absent=ABSENT, readers=READERS, calls=calls))
    assert done.stderr == ""
    assert done.stdout.splitlines()[-1] == str([0] * len(calls))
    assert {path.name for path in tmp_path.rglob("*.png")} > {"force.png", "absorption.png"}


def test_quantity_with_a_unit_says_which_package_it_needs(tmp_path):
    file = write(tmp_path / "trial.h5", summary({}))
    calls = [["rank", file, "--budget", "25 g"]]
    done = python(READING.format(absent=ABSENT, readers=READERS, calls=calls))
    assert done.stdout == "[2]\n"
    assert done.stderr == "crumple rank: No module named 'pydantic'\n"


def test_files_are_short():
    lengths = {m: len(path.read_text("utf-8").splitlines()) for m, path in SOURCES.items()}
    assert {m: n for m, n in lengths.items() if n > MAX_LINES_OF_FILE} == {}


def test_functions_are_short():
    lengths = {f"{m}.{f.name}": f.end_lineno - f.lineno + 1 for m in SOURCES for f in functions(m)}
    assert {name: n for name, n in lengths.items() if n > MAX_LINES_OF_FUNCTION} == {}


def test_names_say_what_a_thing_is():
    empty = ("compute_", "get_")
    modules = [m for m in SOURCES if m.split(".")[-1] in {"utils", "helpers", "common", "misc"}]
    names = [f"{m}.{f.name}" for m in PROGRAM for f in functions(m) if f.name.startswith(empty)]
    assert modules == []
    assert set(names) <= {"kernels.calling.get_argument_type"}  # as numba asks for it


def test_every_test_asserts():
    silent = []
    for module in (m for m in SOURCES if m.startswith("tests.test_")):
        checks = {f.name for f in functions(module) if asserts(f)}
        tests = [f for f in functions(module) if f.name.startswith("test_")]
        silent += [
            f"{module}.{f.name}" for f in tests if not (f.name in checks or called(f) & checks)
        ]
    assert silent == []


def test_help_and_a_refused_config_need_no_heavy_imports():
    light = "sweep.__main__, sweep.params, sweep.config"
    script = f"import sys, {light}; print(*[m for m in {HEAVY} if m in sys.modules])"
    done = python(script)
    assert done.stderr == ""
    assert done.stdout.split() == []


def defined(tree):
    """Names that a module binds at its top, in branches of it too."""
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            yield node.name
        elif isinstance(node, ast.Import | ast.ImportFrom):
            yield from (alias.asname or alias.name for alias in node.names)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id


def test_what_is_imported_of_our_own_is_there():
    """In the programs of slow studies too, which no test runs."""
    missing = [
        f"{module}: {node.module}.{alias.name}"
        for module, tree in TREES.items()
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and node.module in TREES
        for alias in node.names
        if alias.name not in {*defined(TREES[node.module])}
        and f"{node.module}.{alias.name}" not in TREES
    ]
    assert missing == []
