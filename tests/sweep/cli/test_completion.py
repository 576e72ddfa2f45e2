"""The words that a shell offers after the present ones."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from sweep.cli.completion import SHELLS, script
from sweep.columns import COLUMNS
from tests.support.command import crumple
from tests.support.results.specimens import summary, write

ROOT = Path(__file__).parents[3]


@pytest.fixture
def offered(tmp_path):
    """The words offered for the last word of a line."""

    def words(line):
        answer = tmp_path / "answer"
        asked = {"COMP_LINE": line, "COMP_POINT": str(len(line)), "_ARGCOMPLETE": "1"}
        asked |= {"_ARGCOMPLETE_STDOUT_FILENAME": str(answer), "_ARGCOMPLETE_IFS": "\n"}
        asked |= {"PYTHONPATH": str(ROOT)}
        program = [sys.executable, "-m", "crumple"]
        subprocess.run(program, env=os.environ | asked, cwd=tmp_path, check=True)
        return {word.strip() for word in answer.read_text().splitlines()}

    return words


def test_verbs_and_options(offered):
    assert {"run", "rank", "new", "completion"} <= offered("crumple ")
    assert offered("crumple run --dry") == {"--dry-run"}
    assert offered("crumple new --kind ") == {"crush", "drop", "load"}


def test_examples_and_own_files(offered, tmp_path):
    (tmp_path / "small.toml").touch()
    (tmp_path / "small.csv").touch()
    assert offered("crumple run sm") == {"smoke", "small.toml"}


def test_ids_and_columns(offered, tmp_path):
    file = Path(write(tmp_path / "trial.h5", summary({"case_id": "ab12"}, {"case_id": "cd"})))
    assert offered("crumple show tr") == {"trial.h5"}
    assert offered(f"crumple show {file.name} a") == {"ab12"}
    assert offered("crumple show none.h5 a") == set()
    found = offered("crumple rank trial.h5 --by peak_force")
    assert found == {name for name in COLUMNS if name.startswith("peak_force")}
    assert "ninjaflex" in offered("crumple materials ni")


@pytest.mark.parametrize("shell", SHELLS)
def test_script_is_all_that_is_printed(capsys, shell):
    assert crumple(capsys, "completion", shell) == (0, f"{script(shell)}\n", "")
    if shutil.which(shell):
        subprocess.run([shell, "-n"], input=script(shell), text=True, check=True)


@pytest.mark.skipif(not shutil.which("bash"), reason="there is no bash")
def test_bash_completes(tmp_path):
    program = tmp_path / "crumple"
    program.write_text(f'#!/bin/sh\nPYTHONPATH={ROOT} exec {sys.executable} -m crumple "$@"\n')
    program.chmod(0o755)
    variables = "COMP_LINE='crumple status --js' COMP_POINT=19 COMP_TYPE=9 COMP_CWORD=2"
    words = "COMP_WORDS=(crumple status --js)"
    call = "_python_argcomplete crumple --js status; echo ${COMPREPLY[@]}"
    text = "\n".join([script("bash"), f"export {variables}", words, call])
    path = f"{tmp_path}:{os.environ['PATH']}"
    done = subprocess.run(
        ["bash"],
        input=text,
        env=os.environ | {"PATH": path},
        text=True,
        capture_output=True,
        check=True,
    )
    assert done.stdout.split() == ["--json"]
