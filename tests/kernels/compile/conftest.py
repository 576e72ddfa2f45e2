"""Compiles kernels anew; features of the fast compiler are tested only where it is in use."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numba
import pytest

import kernels.compile
from kernels.compile.choice import FAST, compiler

PRIVATE = ("test_linking.py", "test_sealed.py")
SOURCES = {
    "callee": "from kernels.compile.jit import jit\n\n\n@jit\ndef offset(x):\n    return x + 1.0\n",
    "caller": "from kernels.callee import offset\nfrom kernels.compile.jit import jit\n\n\n"
    "@jit\ndef value(x):\n    return offset(x) + 0.5\n",
}
VALUE = (
    "from kernels.caller import value; "
    "print(value(1.0), value.entry.stats.cache_hits.total() "
    "if hasattr(value, 'entry') else 'plain')"
)


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
    """Folder with a package `kernels` of a caller and its callee in another file, and with the
    product's compilation.
    """
    folder, here = tmp_path / "kernels", Path(kernels.compile.__file__).parent
    shutil.copytree(here, folder / "compile", ignore=shutil.ignore_patterns("__pycache__"))
    (folder / "__init__.py").touch()
    for name, source in SOURCES.items():
        (folder / f"{name}.py").write_text(source)
    return folder


@pytest.fixture
def run(package):
    """Output, as words, of a new process that keeps its code beside the package: by default the
    value at 1, and how often its code came from the cache.
    """
    own = {"CRUMPLE_CACHE_DIR": str(package.parent / "cache"), "PYTHONDONTWRITEBYTECODE": "1"}

    def output(script=VALUE, **environment):
        done = subprocess.run(
            [sys.executable, "-c", script],
            cwd=package.parent,
            env=os.environ | own | environment,
            capture_output=True,
            text=True,
            check=False,
        )
        assert (done.stderr, done.returncode) == ("", 0)
        return done.stdout.split()

    return output
