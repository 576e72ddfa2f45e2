"""Files of machine code that are damaged, or cannot be written: never a result is lost."""

import errno
import pickle
from pathlib import Path

import pytest

from kernels.compile.jit import jit
from kernels.compile.sealed import SealedFiles, seal

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


def test_damaged_files_never_give_a_wrong_value(package, run):
    assert run() == ["2.5", "0"]
    for number, path in enumerate(sorted((package.parent / "cache").rglob("*.nb[ci]"))):
        path.write_bytes(list(DAMAGE.values())[number % len(DAMAGE)](path.read_bytes()))
    assert run() == ["2.5", "0"]
    assert run() == ["2.5", "1"]


@pytest.mark.parametrize("damage", [*DAMAGE, "missing"])
@pytest.mark.parametrize("suffix", ["nbi", "nbc"])
def test_damaged_file_costs_one_compilation(cache, suffix, damage):
    assert jit(plus_one)(1.0) == 2.0
    (path,) = cache.rglob(f"*.{suffix}")
    if damage == "missing":
        path.unlink()
    else:
        path.write_bytes(DAMAGE[damage](path.read_bytes()))
    again, healed = jit(plus_one), jit(plus_one)
    assert again(1.0) == 2.0
    assert again.entry.stats.cache_misses.total() == 1
    assert healed(1.0) == 2.0
    assert healed.entry.stats.cache_hits.total() == 1


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
