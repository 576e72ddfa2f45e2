"""A package `kernels` of its own, with the product's compilation, and processes that run it."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import kernels.compile

HOW = Path(kernels.compile.__file__).parent


def make(folder, **sources):
    """Write the package, with a module for each of the ``sources``; return its folder."""
    package = folder / "kernels"
    shutil.copytree(HOW, package / "compile", ignore=shutil.ignore_patterns("__pycache__"))
    (package / "__init__.py").touch()
    for name, source in sources.items():
        (package / f"{name}.py").write_text(source)
    return package


def run(package, script, **environment):
    """Output of a new process that keeps its code beside the package, as words."""
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
