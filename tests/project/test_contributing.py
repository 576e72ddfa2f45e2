"""CONTRIBUTING.md: what it names is there."""

import re
from pathlib import Path

import pytest

from tests.project.test_architecture import FLOORS

ROOT = Path(__file__).parents[2]
TEXT = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
QUOTED = re.findall(r"`([^`\n]+)`", TEXT)
PATHS = sorted({words for words in QUOTED if re.fullmatch(r"\.?[\w/]+/[\w.]+|\w+\.md", words)})
STEPS = re.findall(r"^\d\. `([\w./]+)`: (.+(?:\n   .+)*)", TEXT, re.MULTILINE)
NAMES = [
    (path, name)
    for path, said in STEPS
    if "NAME" not in path and not path.endswith(".md")
    for name in re.findall(r"`(_?[A-Za-z]\w*(?:\.\w+)?)`", said)
]


def test_the_plan_has_all_folders_in_the_order_of_their_imports():
    plan = re.search(r"```text\n(kernels/.*?)```", TEXT, re.DOTALL)[1]
    folders = [
        f"{top}.{name}"
        for top, lines in re.findall(r"^(kernels|sweep)/.*\n((?:  .*\n)+)", plan, re.MULTILINE)
        for line in lines.splitlines()
        for name in re.findall(r"(\w+)/(?=\s)", line[:23])
    ]
    assert folders == [name for name in FLOORS if (ROOT / name.replace(".", "/")).is_dir()]


@pytest.mark.parametrize("path", [path for path in PATHS if "NAME" not in path])
def test_files_are_there(path):
    assert (ROOT / path).exists()


@pytest.mark.parametrize("path", [path for path in PATHS if "NAME" in path])
def test_folders_of_new_files_are_there(path):
    assert (ROOT / path).parent.is_dir()


@pytest.mark.parametrize(("path", "name"), NAMES)
def test_names_are_in_the_files_of_their_steps(path, name):
    text = (ROOT / path).read_text("utf-8")
    assert all(re.search(rf"\b{part}\b", text) for part in name.split("."))


def test_every_kind_of_addition_is_told():
    """Files, names and titles are found by the patterns above."""
    assert len(re.findall(r"^## Add ", TEXT, re.MULTILINE)) == 13
    assert len(PATHS) > 40
    assert len(NAMES) > 20
