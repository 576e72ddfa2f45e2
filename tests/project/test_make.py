"""The Makefile, with a program in place of Python that prints its arguments."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PROGRAM = """#!/bin/sh
case "$*" in
    *" run "*) touch results.h5; echo ranking;;
    *" rank "*--out*) echo files;;
    *" rank "*) echo ranking;;
esac
"""


@pytest.fixture
def checkout(tmp_path):
    """A folder with the Makefile, set up."""
    shutil.copy(ROOT / "Makefile", tmp_path)
    (tmp_path / ".ci").mkdir()
    for name in ("requirements.lock", "pyproject.toml", ".ci/setup", "stamp", "program"):
        (tmp_path / name).touch()
    (tmp_path / "program").write_text(PROGRAM)
    (tmp_path / "program").chmod(0o755)
    return tmp_path


def test_rank_prints_one_ranking_with_results_and_without(checkout):
    told = ["PYTHON=./program", "STAMP=stamp", "RESULTS=results.h5"]
    command = ["make", "--no-print-directory", "rank", *told]
    quiet = {key: value for key, value in os.environ.items() if not key.startswith("MAKE")}
    for _ in range(2):
        done = subprocess.run(
            command, cwd=checkout, env=quiet, capture_output=True, text=True, check=True
        )
        assert done.stdout.split() == ["ranking", "files"]


def test_what_targets_run_finds_all_that_it_imports(checkout):
    targets = ["validate", "bench", "stability", "continuum", "mutants"]
    words = ["make", "-n", *targets, f"PYTHON={sys.executable}", "STAMP=stamp"]
    told = subprocess.run(words, cwd=checkout, capture_output=True, text=True, check=True).stdout
    programs = re.findall(r"-m (tests\.[\w.]+) ", told)
    assert len(programs) == len(targets)
    script = "; ".join(f"import {program}.__main__" for program in programs)
    usual = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    words = [sys.executable, "-c", script]
    done = subprocess.run(words, cwd=ROOT, env=usual, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
