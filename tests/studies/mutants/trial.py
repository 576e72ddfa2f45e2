"""One mutant in a copy of the repository: which test turns red, and how soon.

The tests of its file, or quicker ones, run first, as plain Python, which starts at once. If none
turns red, or if they take too long, those of all kernels and of the physics run too, compiled. A
test that turns red is run once more on the unchanged copy, where it must be green.
"""

import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[3]
LEFT = (".*", "__pycache__", "build", "results")  # out of a copy
WIDER = ("tests/kernels", "tests/physics")
PLAIN = {"NUMBA_DISABLE_JIT": "1"}
# Where machine code divides by zero in silence, plain Python warns.
PYTEST = ("-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", "-W", "ignore::RuntimeWarning")
SOON, WAIT = 60.0, 900.0  # s for tests as plain Python, and compiled
RED = re.compile(r"^(?:FAILED|ERROR) (tests/.*?\.py::.*?)(?: - |$)", re.MULTILINE)
ALL_GREEN, SOME_RED = 0, 1  # exit status of pytest


class StudyError(Exception):
    """The study cannot tell anything until the list of mutants or the tests are put right."""


class Verdict(NamedTuple):
    """What became of a mutant: the first test that is red, if any, and after how many seconds."""

    mutant: object
    red: str | None
    seconds: float
    compiled: bool


def mutated(source, mutant):
    """The text of the file with its mutant."""
    found = source.count(mutant.snippet)
    if found != 1:
        raise StudyError(
            f"{mutant.name}: {mutant.path} has {found} x {mutant.snippet!r}; it must be there once"
        )
    return source.replace(mutant.snippet, mutant.wrong)


def check(mutants):
    """Stop if a snippet is not found exactly once, or a file of tests is missing."""
    for mutant in mutants:
        mutated((ROOT / mutant.path).read_text("utf-8"), mutant)
        file, _, test = mutant.tests.partition("::")
        if not (ROOT / file).exists() or f"def {test}" not in (ROOT / file).read_text("utf-8"):
            raise StudyError(f"{mutant.name}: {mutant.tests} does not exist")


class Copy:
    """A copy of the repository in ``folder``, in which tests run."""

    def __init__(self, folder):
        self.folder = folder
        shutil.copytree(ROOT, folder, ignore=shutil.ignore_patterns(*LEFT))

    def first_red(self, tests, plain):
        """The first test that is red, None if all are green or time is up."""
        # No bytecode: a sign that is flipped changes neither the length of a file nor, within a
        # second, its time, and Python would not notice.
        quiet = {"PYTHONDONTWRITEBYTECODE": "1", "CRUMPLE_CACHE_DIR": str(self.folder / "cache")}
        try:
            done = subprocess.run(
                [sys.executable, *PYTEST, *tests],
                cwd=self.folder,
                env=os.environ | quiet | (PLAIN if plain else {}),
                capture_output=True,
                text=True,
                timeout=SOON if plain else WAIT,
                check=False,
            )
        except subprocess.TimeoutExpired:
            return None
        red = RED.search(done.stdout)
        if done.returncode == ALL_GREEN:
            return None
        if done.returncode != SOME_RED or not red:
            raise StudyError(f"{' '.join(tests)}:\n{done.stdout}{done.stderr}")
        return red[1]

    def tried(self, mutant):
        """What becomes of a mutant."""
        path = self.folder / mutant.path
        source = path.read_text("utf-8")
        path.write_text(mutated(source, mutant), "utf-8")
        started, red = time.perf_counter(), None
        for tests, plain in ((mutant.tests,), True), ((mutant.tests, *WIDER), False):
            red = red or self.first_red(tests, plain)
            if red:
                break
        seconds = time.perf_counter() - started
        path.write_text(source, "utf-8")
        if red and self.first_red((red,), plain):
            raise StudyError(f"{red} is red without a mutant too")
        return Verdict(mutant, red, seconds, not plain)
