"""A package `kernels` of its own, with the product's compilation, and processes that run it."""

import os
import shutil
import subprocess
import sys

from kernels.compile import precompile as ahead, cache, abi as calling, jit, linking, outlined as separate

HOW = (ahead, cache, calling, jit, linking, separate)


def make(folder, **sources):
    """Write the package, with a module for each of the ``sources``; return its folder."""
    package = folder / "kernels"
    package.mkdir()
    for module in HOW:
        shutil.copy(module.__file__, package)
    (package / "__init__.py").touch()
    for name, source in sources.items():
        (package / f"{name}.py").write_text(source)
    return package


def run(package, script, **environment):
    """What a new process that keeps its code beside the package prints, as words."""
    done = subprocess.run(
        [sys.executable, "-c", script],
        cwd=package.parent,
        env=os.environ
        | {"CRUMPLE_CACHE_DIR": str(package.parent / "cache"), "PYTHONDONTWRITEBYTECODE": "1"}
        | environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stderr == ""
    assert done.returncode == 0
    return done.stdout.split()
