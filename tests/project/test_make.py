"""The Makefile, with a program in place of Python that prints its arguments."""

import os
import shutil
import subprocess
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
