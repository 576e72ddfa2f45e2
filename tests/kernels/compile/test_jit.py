"""Compilation options, and a cache that is never stale and never trusted blindly."""

import errno
import math
import os
import pickle
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numba
import numpy as np
import pytest

from kernels.compile import cache as kept
from kernels.compile.cache import SealedFiles, fingerprint, open_cache, prune, seal
from kernels.compile.jit import jit, jit_exact, jit_owning
from tests.support import packages

DAMAGE = {
    "empty": lambda content: b"",
    "garbage": lambda content: b"\x80\x04garbage" * 50,
    "truncated": lambda content: content[: len(content) // 2],
    "last byte lost": lambda content: content[:-1],
    "one bit flipped": lambda c: (
        c[: len(c) // 2] + bytes([c[len(c) // 2] ^ 1]) + c[len(c) // 2 + 1 :]
    ),
    "sealed nonsense": lambda content: pickle.dumps(42) + seal(pickle.dumps(42)),
}


def plus_one(x):
    return x + 1.0


def rounding_error(a, b):
    total = a + b
    shift = total - a
    return (a - (total - shift)) + (b - shift)


@pytest.fixture
def cache(tmp_path, monkeypatch):
    """Folder that kernels decorated from here on are kept in."""
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path))
    return tmp_path


@pytest.fixture
def package(tmp_path):
    """Folder with a package `kernels` of a caller and its callee in another file."""
    return packages.make(
        tmp_path,
        callee="from kernels.compile.jit import jit\n\n\n"
        "@jit\ndef offset(x):\n    return x + 1.0\n",
        caller="from kernels.callee import offset\nfrom kernels.compile.jit import jit\n\n\n"
        "@jit\ndef value(x):\n    return offset(x) + 0.5\n",
    )


VALUE = (
    "from kernels.caller import value; "
    "print(value(1.0), value.entry.stats.cache_hits.total() "
    "if hasattr(value, 'entry') else 'plain')"
)


def run(package, script=VALUE, **environment):
    """What a new process prints: the value at 1, and how often its code came from the cache."""
    return packages.run(package, script, **environment)


def test_edited_callee_and_damaged_files_never_give_an_old_or_wrong_value(package):
    assert run(package) == ["2.5", "0"]
    assert run(package) == ["2.5", "1"]

    for number, path in enumerate(sorted((package.parent / "cache").rglob("*.nb[ci]"))):
        path.write_bytes(list(DAMAGE.values())[number % len(DAMAGE)](path.read_bytes()))
    assert run(package) == ["2.5", "0"]
    assert run(package) == ["2.5", "1"]

    callee = package / "callee.py"
    callee.write_text(callee.read_text().replace("1.0", "7.0"))
    assert run(package) == ["8.5", "0"]


def test_kernels_run_as_plain_python_when_numba_is_told_so(package):
    assert run(package, NUMBA_DISABLE_JIT="1") == ["2.5", "plain"]


@pytest.mark.parametrize("damage", DAMAGE)
@pytest.mark.parametrize("suffix", ["nbi", "nbc"])
def test_damaged_file_costs_one_compilation(cache, suffix, damage):
    assert jit(plus_one)(1.0) == 2.0
    (path,) = cache.rglob(f"*.{suffix}")
    path.write_bytes(DAMAGE[damage](path.read_bytes()))

    again, healed = jit(plus_one), jit(plus_one)
    assert again(1.0) == 2.0
    assert again.entry.stats.cache_misses.total() == 1
    assert healed(1.0) == 2.0
    assert healed.entry.stats.cache_hits.total() == 1


def test_missing_data_file_costs_one_compilation(cache):
    assert jit(plus_one)(1.0) == 2.0
    for path in cache.rglob("*.nbc"):
        path.unlink()
    assert jit(plus_one)(1.0) == 2.0


def test_full_disk_costs_no_result(cache, monkeypatch):
    def refuse(self, path):
        raise OSError(errno.ENOSPC, "No space left on device", path)

    monkeypatch.setattr(SealedFiles, "_open_for_write", refuse)
    assert jit(plus_one)(1.0) == 2.0
    assert list(cache.rglob("*.nbc")) == []


def test_two_processes_that_start_together_never_swap_signatures(cache, monkeypatch):
    first, second = (SealedFiles(str(cache), "kernel", "stamp") for _ in range(2))
    with monkeypatch.context() as before_the_other_wrote:
        before_the_other_wrote.setattr(SealedFiles, "_load_index", lambda self: {})
        second.save("float", "code for floats")
        index = Path(second._index_path).read_bytes()
        first.save("int", "code for ints")
    Path(second._index_path).write_bytes(index)
    assert second.load("float") == "code for floats"
    assert second.load("int") is None


def test_first_calls_from_many_threads(cache):
    kernel = jit(plus_one)
    with ThreadPoolExecutor(8) as pool:
        values = list(pool.map(kernel, np.arange(64.0)))
    assert values == list(np.arange(1.0, 65.0))
    assert len(kernel.entry.signatures) == 1


def test_fingerprint_follows_every_source(package):
    before = fingerprint(package)
    assert fingerprint(package) == before

    (package / "caller.py").rename(package / "renamed.py")
    renamed = fingerprint(package)
    (package / "callee.py").write_text("")
    assert len({before, renamed, fingerprint(package)}) == 3


def test_cache_folder_is_where_it_was_asked_for(package, monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "xdg"))
    monkeypatch.delenv("CRUMPLE_CACHE_DIR", raising=False)
    assert open_cache(package).parent == tmp_path / "xdg" / "crumple"
    monkeypatch.setenv("CRUMPLE_CACHE_DIR", str(tmp_path / "chosen"))
    assert open_cache(package).parent == tmp_path / "chosen"


def test_cache_folder_is_temporary_where_none_can_be_written(package, monkeypatch, tmp_path):
    (tmp_path / "file").touch()
    monkeypatch.setenv("CRUMPLE_CACHE_DIR", str(tmp_path / "file"))
    folder = open_cache(package)
    assert folder.is_dir()
    assert tmp_path not in folder.parents
    folder.rmdir()


def test_prune_keeps_what_is_new_or_in_use(tmp_path):
    ages = {f"kernels-{days:02d}": days for days in range(12)} | {"other": 99}
    for name, days in ages.items():
        (tmp_path / name).mkdir()
        os.utime(tmp_path / name, (time.time() - 86400 * days - 60,) * 2)
    prune(tmp_path)
    stay = [f"kernels-{days:02d}" for days in range(kept.FOLDERS_KEPT)] + ["other"]
    assert sorted(path.name for path in tmp_path.iterdir()) == stay

    for number in range(kept.FOLDERS_KEPT):
        (tmp_path / f"kernels-just-used-{number}").mkdir()
    prune(tmp_path)
    assert not (tmp_path / "kernels-07").exists()
    assert (tmp_path / "kernels-06").exists()


def test_exact_kernels_keep_every_rounding(cache):
    assert jit_exact(rounding_error)(1.0e16, 1.0) == rounding_error(1.0e16, 1.0) == 1.0


@pytest.mark.parametrize("decorator", [jit, jit_exact])
def test_kernels_see_nan_divide_like_numpy_and_release_the_lock(cache, decorator):
    @decorator
    def ratio_is_nan(a, b):
        return math.isnan(a / b)

    assert ratio_is_nan(0.0, 0.0)
    assert not ratio_is_nan(1.0, 0.0)
    assert ratio_is_nan.entry.targetoptions["nogil"] is True


def test_a_kernel_called_by_kernels_can_be_called_from_python_too(package):
    """Both versions of its code are kept: neither is taken for the other."""
    script = (
        "from kernels.caller import value; from kernels.callee import offset; "
        "print(value(1.0), offset(1.0), offset.entry.stats.cache_hits.total())"
    )
    assert [run(package, script) for _ in range(2)] == [["2.5", "2.0", "0"], ["2.5", "2.0", "1"]]
    only = "from kernels.callee import offset; print(offset(1.0), *offset.signatures)"
    assert run(package, only) == ["2.0"]


def test_a_constant_argument_makes_no_new_version(cache):
    times = jit(product)

    @jit
    def sixfold(x):
        return times(x, 2) + times(x, 3) + times(x, 1)

    assert sixfold(1.5) == 9.0
    assert len(times.signatures) == 1
    assert times.entry.signatures == []


def product(x, n):
    return x * n


def test_a_kernel_that_does_not_compile_says_where(cache):
    """Which operation, of which types, in which function, called by which; and again next time."""
    times = jit(product)

    @jit
    def nonsense(x):
        return times(x, None)

    for _ in range(2):
        with pytest.raises(numba.TypingError) as failure:
            nonsense(1.5)
        for part in ("mul(float64, none)", "def product(x, n)", "def nonsense(x)"):
            assert part in str(failure.value)
    assert times(1.5, 2) == 3.0


def test_only_an_owning_kernel_may_make_an_array(cache):
    def total(n):
        return np.ones(n).sum()

    for decorator in (jit, jit_exact):
        with pytest.raises(numba.TypingError, match=r"No implementation of function .*ones"):
            decorator(total)(3)
    assert jit_owning(total)(3) == 3.0
