"""The words that a shell offers after the present ones."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from sweep.cli.completion import SHELLS, script
from sweep.cli.verbs import VERBS
from sweep.columns import COLUMNS
from tests.support.command import crumple
from tests.support.results.specimens import summary, write

ROOT = Path(__file__).parents[3]


@pytest.mark.parametrize("shell", SHELLS)
def test_script_is_all_that_is_printed(capsys, shell):
    assert crumple(capsys, "completion", shell) == (0, f"{script(shell)}\n", "")
    if shutil.which(shell):
        subprocess.run([shell, "-n"], input=script(shell), text=True, check=True)


GENERAL = {"-h", "--help", "--version"}
PEAKS = {name for name in COLUMNS if name.startswith("peak_force")}


@pytest.mark.parametrize(
    ("line", "offered"),
    [
        ("", {*VERBS}),
        ("run --dry", {"--dry-run"}),
        ("new --kind ", {"crush", "drop", "load"}),
        ("run sm", {"smoke", "small.toml"}),
        ("show tr", {"trial.h5"}),
        ("show trial.h5 a", {"ab12"}),
        ("show none.h5 a", set()),
        ("rank trial.h5 --by peak_force", PEAKS),
        ("materials ninjaf", {"ninjaflex"}),
    ],
)
def test_words_that_are_offered_for_the_last_one(tmp_path, line, offered):
    write(tmp_path / "trial.h5", summary({"case_id": "ab12"}, {"case_id": "cd"}))
    for name in ("small.toml", "small.csv"):
        (tmp_path / name).touch()
    line, answer = f"crumple {line}", tmp_path / "answer"
    asked = {"COMP_LINE": line, "COMP_POINT": str(len(line)), "_ARGCOMPLETE": "1"}
    asked |= {"_ARGCOMPLETE_STDOUT_FILENAME": str(answer), "_ARGCOMPLETE_IFS": "\n"}
    environment = os.environ | asked | {"PYTHONPATH": str(ROOT)}
    subprocess.run([sys.executable, "-m", "crumple"], env=environment, cwd=tmp_path, check=True)
    assert {word.strip() for word in answer.read_text().splitlines()} - GENERAL == offered


@pytest.mark.skipif(not shutil.which("bash"), reason="there is no bash")
def test_bash_completes(tmp_path):
    program = tmp_path / "crumple"
    program.write_text(f'#!/bin/sh\nPYTHONPATH={ROOT} exec {sys.executable} -m crumple "$@"\n')
    program.chmod(0o755)
    variables = "COMP_LINE='crumple status --js' COMP_POINT=19 COMP_TYPE=9 COMP_CWORD=2"
    words = "COMP_WORDS=(crumple status --js)"
    call = "_python_argcomplete crumple --js status; echo ${COMPREPLY[@]}"
    text = "\n".join([script("bash"), f"export {variables}", words, call])
    path = os.environ | {"PATH": f"{tmp_path}:{os.environ['PATH']}"}
    done = subprocess.run(
        ["bash"], input=text, env=path, text=True, capture_output=True, check=True
    )
    assert done.stdout.split() == ["--json"]
