"""Kernels that others call where they are, and what several processes compile beforehand."""

import time
from pathlib import Path

import pytest

from kernels.compile.jit import jit_exact, separate
from tests.support.kernels import packages

CALLEE = """
from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit_exact, jit_owning, separate


class Pair(NamedTuple):
    first: np.ndarray
    second: np.ndarray


@separate
@jit_exact
def dot(pair, n):
    total = 0.0
    for k in range(n):
        total += pair.first[k] * pair.second[k, 1]
    return total


@separate
@jit_owning
def pair(n):
    return Pair(np.arange(float(n)), np.full((n, 2), 3.0))
"""
CALLER = """
from kernels.callee import dot, pair
from kernels.compile.jit import jit_owning


@jit_owning
def value(n):
    return dot(pair(n), n)


@jit_owning
def other(n):
    return 10.0 * dot(pair(n), n)
"""
COUNTS = """
from kernels import callee, caller

def loaded(dispatcher):
    return dispatcher.stats.cache_hits.total(), dispatcher.stats.cache_misses.total()

print(caller.value(4), *loaded(caller.value.entry))
print(*loaded(callee.dot.separated), *loaded(callee.pair.separated))
"""
DIRECT = "callee.dot(callee.pair(4), 4)"
AHEAD = """
import os
from kernels import caller
from kernels.compile.fast import precompile as ahead

os.sched_getaffinity = lambda _: {0, 1}  # processes even where there is one core
ahead.compile_ahead(lambda: print(caller.value(4), len(caller.value.entry.signatures)))
"""
MISTAKEN = """
from numba import types
from kernels import caller
from kernels.compile.fast import outlined as separate, precompile as ahead

versions = ahead.rehearse(lambda: caller.value(4))
returns = {"dot": types.%s}
separate.foreseen.set(
    {(v.module, v.name, v.args): returns.get(v.name, v.returns) for v in versions}
)
caller.value.compiled((types.int64,))
print(*sorted(v.name for v in versions))
"""


@pytest.fixture
def package(tmp_path):
    return packages.make(tmp_path, callee=CALLEE, caller=CALLER)


def test_a_separate_kernel_is_compiled_once_and_loaded_with_its_callers(package):
    assert packages.run(package, COUNTS) == ["18.0", "0", "1", "0", "1", "0", "1"]
    assert packages.run(package, COUNTS) == ["18.0", "1", "0", "1", "0", "1", "0"]
    other = COUNTS.replace("value", "other")
    assert packages.run(package, other) == ["180.0", "0", "1", "1", "0", "1", "0"]


def test_a_damaged_separate_kernel_is_compiled_again(package):
    packages.run(package, COUNTS)
    for path in (package.parent / "cache").rglob("*dot*separated*.nbc"):
        path.write_bytes(path.read_bytes()[:-9])
    assert packages.run(package, COUNTS) == ["18.0", "1", "0", "0", "1", "1", "0"]


def test_python_calls_the_code_of_a_separate_kernel_that_is_there(package):
    called = COUNTS.replace("caller.value(4), *loaded(caller.value.entry)", DIRECT)
    called = called.replace("import callee, caller", "import callee")
    assert packages.run(package, called) == ["18.0", "0", "1", "0", "1"]
    assert packages.run(package, COUNTS) == ["18.0", "0", "1", "1", "0", "1", "0"]


def test_what_is_compiled_ahead_is_all_that_the_run_needs(package):
    assert packages.run(package, AHEAD) == ["18.0", "0"]
    assert packages.run(package, COUNTS) == ["18.0", "1", "0", "1", "0", "1", "0"]


def test_plain_python_runs_separate_kernels_too(package):
    script = "from kernels.caller import value; print(value(4))"
    assert packages.run(package, script, NUMBA_DISABLE_JIT="1") == ["18.0"]


@pytest.mark.parametrize(("foreseen", "compiled"), [("float64", 0), ("int64", 1)])
def test_code_that_foresaw_another_type_is_not_used(package, foreseen, compiled):
    assert packages.run(package, MISTAKEN % foreseen) == ["dot", "pair", "value"]
    assert packages.run(package, COUNTS)[:3] == ["18.0", str(1 - compiled), str(compiled)]


CLASH = """
from typing import NamedTuple

import numpy as np

from kernels import callee
from kernels.compile.jit import jit_exact


class Pair(NamedTuple):
    second: np.ndarray
    first: np.ndarray


@jit_exact
def both(vector, matrix, n):
    return callee.dot(callee.Pair(vector, matrix), n), callee.dot(Pair(matrix, vector), n)
"""


def test_tuples_of_one_name_and_other_fields_are_not_taken_for_each_other(package):
    (package / "clash.py").write_text(CLASH)
    script = """
import numpy as np
from kernels.clash import both
print(*both(np.arange(4.0), np.full((4, 2), 3.0), 4))
"""
    assert packages.run(package, script) == ["18.0", "18.0"]
    assert packages.run(package, script) == ["18.0", "18.0"]


BROKEN = """
import subprocess
from kernels import caller
from kernels.compile.fast import precompile as ahead

{trouble}
ahead.compile_ahead(lambda: caller.value(4))
print(caller.value(4))
"""
TROUBLES = {
    "no second process": """
starts = iter([subprocess.Popen, None])
subprocess.Popen = lambda *given, **more: next(starts)(*given, **more)
""",
    "a rehearsal that fails": "ahead.Rehearsal.__call__ = None",
    "helpers that end": "ahead.PROGRAM = 'raise SystemExit'",
    "a helper that is told nonsense": "ahead.pickle.dumps = lambda what: b'.'",
}


@pytest.mark.parametrize("trouble", TROUBLES.values(), ids=TROUBLES)
def test_what_cannot_be_compiled_ahead_is_compiled_when_it_is_called(package, trouble):
    assert packages.run(package, BROKEN.format(trouble=trouble)) == ["18.0"]


ORPHANED = """
import os
from kernels.compile.fast import precompile as ahead

with ahead._helper() as process:
    print(process.pid, flush=True)
    os._exit(0)
"""


def test_a_helper_ends_with_whoever_started_it(package):
    (number,) = packages.run(package, ORPHANED)
    process, patience = Path(f"/proc/{number}"), time.monotonic() + 10.0
    while process.exists() and time.monotonic() < patience:
        time.sleep(0.05)
    assert not process.exists()


def test_kernels_that_cannot_be_imported_are_not_separate():
    @jit_exact
    def local(x):
        return x

    with pytest.raises(TypeError, match="allowed are kernels that can be imported"):
        separate(local)


def test_nothing_is_compiled_ahead_where_it_cannot_be_kept(package, tmp_path):
    (tmp_path / "file").touch()
    assert packages.run(package, AHEAD, CRUMPLE_CACHE_DIR=str(tmp_path / "file")) == []
