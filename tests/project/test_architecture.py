"""The shape of the code: who may import what, and where each library has its home."""

import ast
import graphlib
import re
import subprocess
import sys
from functools import cache
from pathlib import Path

from tests.support.results.specimens import summary, write

ROOT = Path(__file__).parents[2]
SOURCES = {
    ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__"): path
    for package in ("sweep", "kernels", "tests")
    for path in sorted((ROOT / package).rglob("*.py"))
} | {"crumple": ROOT / "crumple.py"}
PROGRAM = [module for module in SOURCES if not module.startswith("tests")]
KERNELS = [module for module in PROGRAM if module.startswith("kernels")]

# From the ground up: a package imports those before it and itself, inside of functions too.
FLOORS = [
    "kernels.compile", "kernels.arrays", "kernels.solve", "kernels.linear", "kernels.geometry",
    "kernels.laws", "kernels.shared", "kernels.terms", "kernels.planar", "kernels.plates",
    "sweep.version", "sweep.constants", "sweep.array_types", "sweep.numbers", "sweep.plain_text",
    "sweep.whole_file", "sweep.loading_modes",
    "sweep.design", "sweep.config", "sweep.argument_types", "sweep.columns", "sweep.result",
    "sweep.scene", "sweep.effective", "sweep.coupon", "sweep.simulation", "sweep.store",
    "sweep.ranking", "sweep.report", "sweep.export", "sweep.results", "sweep.running",
    "sweep.published", "sweep.cli", "sweep.__main__",
]  # fmt: skip
HOMES = {
    "numba": "kernels.compile",
    "llvmlite": "kernels.compile",
    "dask": "sweep.running",
    "distributed": "sweep.running.cluster sweep.running.dask_graph",
    "dask_jobqueue": "sweep.running.cluster",
    "h5py": "sweep.store.sealed_file sweep.store.hdf5 sweep.export.shapes",
    "matplotlib": "sweep.report.figures.case_plots",
    "manifold3d": "sweep.export.solid",
    "ezdxf": "sweep.export.dxf sweep.config.drawings.dxf",
    "svgelements": "sweep.config.drawings.svg",
    "PIL": "sweep.report.figures.animation",
}
# What reads results, and so must run where nothing is installed that simulates.
READERS = [m for m in PROGRAM if m.startswith(("sweep.store", "sweep.ranking", "sweep.report"))]
READERS += ["sweep.results", "sweep.cli.verbs"]
ABSENT = ["kernels", "numba", "llvmlite", "dask", "distributed", "pydantic", "scipy"]
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
from matplotlib.figure import Figure
from sweep.__main__ import main

Figure.savefig = lambda _, path, **how: open(path, "w").close()
print([main(words) for words in {calls}])
"""
# Modules without a test file at their place, or packages of them, and which file tests them.
TESTED_ELSEWHERE = {
    "kernels.compile.undisturbed": "kernels/compile/test_jit.py",
    "kernels.compile.reference": "kernels/solve/test_first_guess.py",
    "kernels.compile.verbs": "kernels/planar/test_potential.py",
    "kernels.geometry.intervals": "sweep/design/test_area.py",
    "kernels.geometry.scanline": "sweep/design/test_area.py",
    "kernels.geometry.slabs": "sweep/design/test_area.py",
    "kernels.geometry.space.vectors": "kernels/geometry/space/test_closest.py",
    "kernels.planar.problem": "kernels/planar/test_potential.py",
    "kernels.planar.steps": "physics/test_memories.py",
    "kernels.plates.assembly": "kernels/plates/test_factoring.py",
    "kernels.plates.couplings": "kernels/plates/test_factoring.py",
    "kernels.plates.problem": "kernels/plates/test_potential.py",
    "kernels.plates.steps": "kernels/plates/test_potential.py",
    "kernels.plates.element.axes": "kernels/plates/element/test_shell.py",
    "kernels.plates.element.bow": "kernels/plates/element/test_shell.py",
    "kernels.plates.contacts.touching": "kernels/plates/contacts/test_contact.py",
    "kernels.linear.pivots": "kernels/linear/condensed/test_block_ldlt.py",
    "kernels.linear.condensed.bundles": "kernels/linear/condensed/test_analysis.py",
    "kernels.linear.condensed.condense": "kernels/linear/condensed/test_system.py",
    "kernels.linear.condensed.periodic_images": "kernels/shared/test_followers.py",
    "kernels.linear.supernodal.dense": "kernels/linear/supernodal/test_factor.py",
    "kernels.linear.supernodal.symbolic": "kernels/linear/supernodal/test_factor.py",
    "kernels.linear.supernodal.fronts": "kernels/linear/supernodal/test_factor.py",
    "kernels.solve.history": "kernels/solve/test_chain.py",
    "kernels.solve.residual": "kernels/solve/test_newton.py",
    "kernels.solve.workspace": "kernels/solve/test_first_guess.py",
    "kernels.laws.law": "physics/test_memories.py",
    "kernels.shared.lagging": "kernels/plates/test_potential.py",
    "kernels.shared.moves": "kernels/planar/test_neighbour_lists.py",
    "kernels.shared.rows": "sweep/simulation/test_custom_history.py",
    "kernels.terms.kelvin_voigt": "kernels/terms/test_damping.py",
    "kernels.terms.rayleigh": "kernels/terms/test_damping.py",
    "sweep.__main__": "sweep/cli/test_verbs.py",
    "sweep.cli.arguments": "sweep/cli/test_verbs.py",
    "sweep.cli.parser": "sweep/cli/test_verbs.py",
    "sweep.config.kinds.contact": "sweep/config/kinds/test_completion.py",
    "sweep.config.kinds.crush": "sweep/config/kinds/test_completion.py",
    "sweep.config.kinds.damping": "sweep/config/kinds/test_relaxation.py",
    "sweep.config.kinds.direction": "sweep/config/kinds/test_upright.py",
    "sweep.config.kinds.impact": "sweep/config/kinds/test_completion.py",
    "sweep.config.kinds.lattice": "sweep/config/test_changes.py",
    "sweep.config.kinds.material": "sweep/config/kinds/test_memory.py",
    "sweep.config.kinds.mesh": "sweep/config/test_ids.py",
    "sweep.config.kinds.table": "sweep/config/test_case.py",
    "sweep.config.structures.structure": "sweep/config/structures/test_structure_file.py",
    "sweep.cli.question": "sweep/cli/test_verbs.py",
    "sweep.cli.refusals": "sweep/cli/test_verbs.py",
    "sweep.cli.run": "sweep/cli/test_verbs.py",
    "sweep.coupon.hyperelastic": "sweep/coupon/test_curve.py",
    "sweep.coupon.uncertainty": "sweep/coupon/test_fit.py",
    "sweep.design.infill": "sweep/design/test_infill.py",
    "sweep.design.lattice": "sweep/design/test_infill.py",
    "sweep.design.surfaces": "sweep/design/surfaces/test_nets.py",
    "sweep.published.quantity": "sweep/published/test_table.py",
    "sweep.running.applicable": "sweep/running/test_run.py",
    "sweep.running.beside.run_beside": "sweep/running/beside/test_spread.py",
    "sweep.running.provenance": "sweep/running/test_sweep.py",
    "sweep.running.writer_thread": "sweep/running/test_sweep.py",
    "sweep.simulation.base_load": "sweep/simulation/test_target.py",
    "sweep.simulation.warm_up": "sweep/running/test_warming.py",
    "sweep.store.batch": "sweep/store/test_read.py",
    "sweep.store.hdf5": "sweep/store/test_read.py",
    "sweep.store.parts": "sweep/store/test_read.py",
    "sweep.store.sealed_file": "sweep/store/test_damage.py",
    "sweep.version": "sweep/cli/test_verbs.py",
}
# Quantities are converted for people in `sweep.numbers`: elsewhere nothing is multiplied by these.
FACTORS = {1e-9, 1e-6, 1e-3, 1e2, 1e3, 1e6, 1e9}
SHOWING = ("sweep.ranking", "sweep.report", "sweep.running", "sweep.cli", "sweep.export")
SHOWING += ("sweep.published", "sweep.coupon", "sweep.simulation", "sweep.result", "sweep.store")
NO_UNIT = {"sweep.running.searching.search": "seeds", "sweep.export.slicer": "a key of a 3MF"}
# A function of a file, and its body; an assertion of its own, of numpy, pandas or pytest.
FUNCTION = re.compile(r"^def (\w+)(.*?)(?=^[^\s)]|\Z)", re.M | re.S)
ASSERTION = re.compile(r"^ +assert |\b(raises|warns|assert_(allclose|(array|frame)_equal))\(", re.M)
HEAVY = ["numba", "kernels", "dask", "distributed", "scipy", "pandas", "matplotlib", "h5py"]


@cache
def tree(module):
    return ast.parse(SOURCES[module].read_text("utf-8"))


@cache
def nodes(module):
    return [*ast.walk(tree(module))]


def docstrings(module):
    """Strings that stand alone: docstrings of functions, classes, modules and constants."""
    values = [node.value for node in nodes(module) if isinstance(node, ast.Expr)]
    return [value for value in values if isinstance(getattr(value, "value", None), str)]


def only_for_types(module):
    """Nodes that only a type checker sees."""
    blocks = [node for node in nodes(module) if isinstance(node, ast.If)]
    typed = [block for block in blocks if "TYPE_CHECKING" in ast.unparse(block.test)]
    return {node for block in typed for node in ast.walk(block)}


@cache
def imports(module, typed=False):
    """Dotted names that a module imports, inside of functions too; a name outside our modules is
    cut at its module. typed: also the names that only a type checker sees.
    """
    found, hidden = set(), set() if typed else only_for_types(module)
    for node in [node for node in nodes(module) if node not in hidden]:
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            base = "." * node.level + (node.module or "")
            dotted = {f"{base}.{alias.name}" for alias in node.names}
            found |= {name if name in SOURCES else base for name in dotted}
    return found


def packages(module):
    return {name.split(".")[0] for name in imports(module)}


def functions(module):
    return [n for n in nodes(module) if isinstance(n, ast.FunctionDef)]


def python(script):
    command = [sys.executable, "-c", script]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)


def test_imports_are_absolute():
    relative = {m for m in PROGRAM for name in imports(m) if name.startswith(".")}
    assert relative == set()


def floor(module):
    """Which of `FLOORS` a module stands on; None for the packages above them."""
    return next((k for k, name in enumerate(FLOORS) if is_within(module, name)), None)


def is_within(module, homes):
    """True for a module of one of the ``homes``, packages or modules, separated by spaces."""
    return any(module == home or module.startswith(f"{home}.") for home in homes.split())


def test_kernels_import_only_numpy_and_kernels():
    allowed = {"numpy", "math", "typing", "kernels"}
    outside = [m for m in KERNELS if not is_within(m, "kernels.compile")]
    strangers = {m: packages(m) - allowed for m in outside}
    assert {m: names for m, names in strangers.items() if names} == {}


def test_every_module_stands_on_a_floor():
    doors = {"crumple", "kernels", "sweep"}
    assert {m for m in PROGRAM if floor(m) is None} == doors


def test_imports_point_one_way():
    upward = [
        f"{m} -> {name}"
        for m in PROGRAM
        for name in imports(m) & set(PROGRAM)
        if floor(m) is not None and (floor(name) is None or floor(name) > floor(m))
    ]
    assert upward == []


def test_the_solver_and_the_physics_do_not_know_each_other():
    """Only a problem, `kernels.planar`, has both."""
    physics = "kernels.linear kernels.geometry kernels.laws kernels.terms"
    known = {m: imports(m) for m in KERNELS if is_within(m, f"kernels.solve {physics}")}
    meet = [
        f"{m} -> {name}"
        for m, names in known.items()
        for name in names
        if is_within(m, "kernels.solve") != is_within(name, "kernels.solve")
        and is_within(name, f"kernels.solve {physics}")
    ]
    assert meet == []


def strings(module):
    """Texts of a module that are no docstrings."""
    stated = {id(value) for value in docstrings(module)}
    constants = [n for n in nodes(module) if isinstance(n, ast.Constant) and id(n) not in stated]
    return [node.value for node in constants if isinstance(node.value, str)]


def test_only_imports_from_our_packages_name_them():
    """In a wheel they lie below `crumple`, and only `from` at the start of a line is rewritten on
    the way there.
    """
    named = re.compile(
        r"(?<![\w.])(sweep|kernels)\.\w|^(sweep|kernels)\.?$|\b(from|import) (sweep|kernels)\b"
    )
    assert {m: found for m in PROGRAM if (found := [*filter(named.search, strings(m))])} == {}
    bare = [n for m in PROGRAM for n in nodes(m) if isinstance(n, ast.Import)]
    names = {alias.name for node in bare for alias in node.names}
    assert {name for name in names if is_within(name, "sweep kernels")} == set()


def test_each_library_has_one_home():
    astray = [
        f"{module} -> {library}"
        for library, homes in HOMES.items()
        for module in PROGRAM
        if library in packages(module) and not is_within(module, homes)
    ]
    assert astray == []


def test_no_circular_imports():
    """Type checkers see none either."""
    ours = {m: imports(m, typed=True) & set(PROGRAM) - {m} for m in PROGRAM}
    order = list(graphlib.TopologicalSorter(ours).static_order())  # raises on a circle
    assert set(order) == set(PROGRAM)


def test_results_are_read_where_nothing_that_simulates_is_installed(tmp_path):
    file, folder = write(tmp_path / "trial.h5", summary({"case_id": "ab"})), str(tmp_path / "out")
    calls = [["status", file], ["rank", file], ["rank", file, "--csv"], ["show", file]]
    calls += [["rank", file, "--markdown"], ["rank", file, "--out", folder], ["show", file, "ab"]]
    calls += [["report", file], ["rank", file, "--budget", "25 g"]]
    done = python(READING.format(absent=ABSENT, readers=READERS, calls=calls))
    assert done.stderr == ""
    assert done.stdout.splitlines()[-1] == str([0] * len(calls))
    assert "the page has no files to print: No module named 'p" in done.stdout
    assert {path.name for path in tmp_path.rglob("*.png")} > {"force.png", "absorption.png"}
    assert (tmp_path / "trial.html").exists()


def test_names_say_what_a_thing_is():
    empty = ("compute_", "get_")
    names = [f"{m}.{f.name}" for m in PROGRAM for f in functions(m) if f.name.startswith(empty)]
    names += [m for m in SOURCES if m.split(".")[-1] in {"utils", "helpers", "common", "misc"}]
    assert names == []


def test_every_module_has_its_tests_at_its_place():
    """Every module with a public function: sweep/config/units.py, tests/sweep/config/test_units.py.

    An exception whose tests have come is to be struck out.
    """
    without = set()
    for module in PROGRAM:
        *package, name = module.split(".")
        defined = {n.name for n in tree(module).body if isinstance(n, ast.FunctionDef)}
        place = ROOT.joinpath("tests", *package, f"test_{name}.py")
        if any(name[0] != "_" for name in defined) and not place.exists():
            without.add(module)
    elsewhere = {m: [k for k in TESTED_ELSEWHERE if is_within(m, k)] for m in without}
    assert {m for m, found in elsewhere.items() if not found} == set()
    assert set(TESTED_ELSEWHERE) == {key for found in elsewhere.values() for key in found}
    assert {f for f in TESTED_ELSEWHERE.values() if not (ROOT / "tests" / f).exists()} == set()


def test_every_test_asserts():
    """Itself, or in a function of its file that it calls."""
    silent = []
    for module in (m for m in SOURCES if ".test_" in m):
        functions_of_file = dict(FUNCTION.findall(SOURCES[module].read_text("utf-8")))
        checks = {name for name, body in functions_of_file.items() if ASSERTION.search(body)}
        silent += [
            f"{module}.{name}"
            for name, body in functions_of_file.items()
            if name.startswith("test_") and not {name, *re.findall(r"(\w+)\(", body)} & checks
        ]
    assert silent == []


def test_help_and_a_refused_config_need_no_heavy_imports():
    light = "crumple, sweep.__main__, sweep.config.case, sweep.config.units"
    done = python(f"import sys, {light}; print(*[m for m in {HEAVY} if m in sys.modules])")
    assert (done.stdout.split(), done.stderr) == ([], "")


@cache
def defined(module):
    names = {"*"}
    for node in nodes(module):
        if isinstance(node, ast.FunctionDef | ast.ClassDef | ast.alias):
            names.add(getattr(node, "asname", None) or node.name)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            names.add(node.id)
    return names


def test_what_is_imported_of_our_own_is_there():
    """In programs of slow studies too, which no test runs; the imports of a test run with it."""
    unrun = [module for module in SOURCES if ".test_" not in module]
    froms = [(m, n) for m in unrun for n in nodes(m) if isinstance(n, ast.ImportFrom)]
    missing = [
        f"{module}: {node.module}.{alias.name}"
        for module, node in froms
        if node.module in SOURCES
        for alias in node.names
        if alias.name not in defined(node.module) and f"{node.module}.{alias.name}" not in SOURCES
    ]
    assert missing == []


def test_quantities_are_converted_for_people_in_one_place():
    found = {
        f"{module}:{node.lineno}"
        for module in PROGRAM
        if module.startswith(SHOWING) and module not in NO_UNIT
        for node in nodes(module)
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult | ast.Div)
        for side in (node.left, node.right)
        if isinstance(side, ast.Constant) and side.value in FACTORS
    }
    assert not found, "use in_unit, to_si or text_in of sweep.numbers"


def test_texts_are_written_as_a_whole():
    """A full disk leaves no half of one (`sweep.whole_file`)."""
    texts = {module: SOURCES[module].read_text("utf-8") for module in PROGRAM}
    halves = [module for module, text in texts.items() if ".write_text(" in text]
    assert halves == ["sweep.whole_file"]


def test_no_variable_is_a_participle():
    for module in PROGRAM:
        names = {getattr(n, "id", getattr(n, "arg", None)) for n in nodes(module)}
        assert not names & {"found", "known", "told", "held", "made", "asked"}, module


def test_docstrings_repeat_the_noun():
    riddle = re.compile(r"\b(that|those|as)\s+of\b|\bwhat\s+is\s+asked\b", re.IGNORECASE)
    texts = [(module, value) for module in PROGRAM for value in docstrings(module)]
    assert [f"{m}:{v.lineno}" for m, v in texts if riddle.search(v.value)] == []
