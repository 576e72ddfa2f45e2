"""Compiles kernels anew; features of the fast compiler are tested only where it is in use."""

import numba
import pytest

from kernels.compile.choice import FAST, compiler
from tests.support.kernels import packages

PRIVATE = ("test_linking.py", "test_sealed.py")


class Skipped(pytest.Module):
    """A file of tests that is not even imported."""

    def collect(self):
        """Skip it."""
        pytest.skip("of the fast compiler, which is not in use")


def pytest_pycollect_makemodule(module_path, parent):
    """Leave a file to pytest, or skip it."""
    if compiler() == FAST or module_path.name not in PRIVATE:
        return None
    return Skipped.from_parent(parent, path=module_path)


@pytest.fixture(autouse=True)
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


@pytest.fixture
def run(package):
    """Output of a new process: the value at 1, and how often its code came from the cache."""
    value = (
        "from kernels.caller import value; "
        "print(value(1.0), value.entry.stats.cache_hits.total() "
        "if hasattr(value, 'entry') else 'plain')"
    )
    return lambda script=value, **environment: packages.run(package, script, **environment)
