"""One mutant in a copy of the repository: which test turns red, and how soon.

The tests of its file run first, as plain Python, which starts at once. If none turns red, or if
they take too long, the tests of all kernels and of the physics run too, compiled. A test that turns
red is run once more on the unchanged copy, where it must be green.
"""

import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import NamedTuple

from tests.studies.mutants.flips import ROOT, Mutant, mutated

LEFT = (".*", "__pycache__", "build", "results")  # out of a copy
WIDER = ("tests/kernels", "tests/physics")
PLAIN = {"NUMBA_DISABLE_JIT": "1"}
# Where machine code divides by zero in silence, plain Python warns.
PYTEST = ("-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", "-W", "ignore::RuntimeWarning")
SOON, WAIT = 60.0, 900.0  # s for tests as plain Python, and compiled
RED = re.compile(r"^(?:FAILED|ERROR) (tests/.*?\.py(?:::.*?)?)(?: - |$)", re.MULTILINE)
ALL_GREEN = 0  # exit status of pytest
ENDLESS = "no end"


class StudyError(Exception):
    """A test is red, or does not run, without a mutant too."""


class Verdict(NamedTuple):
    """The outcome of a mutant: the first test that is red, if any, and after how many seconds."""

    mutant: Mutant
    red: str | None
    seconds: float
    compiled: bool


class Copy:
    """A copy of the repository in ``folder``, in which tests run."""

    def __init__(self, folder):
        self.folder = Path(folder)
        shutil.copytree(ROOT, folder, ignore=shutil.ignore_patterns(*LEFT))

    def first_red(self, tests, plain):
        """The first test that is red, `ENDLESS` if time is up, None if all are green."""
        # No bytecode: a sign that is flipped changes neither the length of a file nor, within a
        # second, its time, and Python would not notice. A process of several would compile first.
        alone = {k: v for k, v in os.environ.items() if not k.startswith("PYTEST_")}
        quiet = {"PYTHONDONTWRITEBYTECODE": "1", "CRUMPLE_CACHE_DIR": str(self.folder / "cache")}
        try:
            done = subprocess.run(
                [sys.executable, *PYTEST, *tests],
                cwd=self.folder,
                env=alone | quiet | (PLAIN if plain else {}),
                capture_output=True,
                text=True,
                timeout=SOON if plain else WAIT,
                check=False,
            )
        except subprocess.TimeoutExpired:
            return ENDLESS
        if done.returncode == ALL_GREEN:
            return None
        red = RED.search(done.stdout)
        return red[1] if red else tests[0]  # not even collected, or killed by a signal

    def tried(self, mutant):
        """The outcome of a mutant."""
        path = self.folder / mutant.path
        source, started = path.read_text("utf-8"), time.perf_counter()
        path.write_text(mutated(source, mutant), "utf-8")
        red, plain = self.first_red((mutant.own_tests,), True), True
        if red in (None, ENDLESS):
            red, plain = self.first_red((mutant.own_tests, *WIDER), False), False
        seconds = time.perf_counter() - started
        path.write_text(source, "utf-8")
        if red not in (None, ENDLESS) and self.first_red((red,), plain):
            raise StudyError(f"{red} is red without a mutant too")
        return Verdict(mutant, red, seconds, not plain)
