"""CONTRIBUTING.md: everything it names exists."""

import re
from pathlib import Path

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


def test_files_and_the_folders_of_new_files_are_there():
    places = {path: (ROOT / path).parent if "NAME" in path else ROOT / path for path in PATHS}
    assert [path for path, place in places.items() if not place.exists()] == []


def test_names_are_in_the_files_of_their_steps():
    texts = {path: (ROOT / path).read_text("utf-8") for path, _ in NAMES}
    parts = [(path, part) for path, name in NAMES for part in name.split(".")]
    assert [one for one in parts if not re.search(rf"\b{one[1]}\b", texts[one[0]])] == []


def test_every_kind_of_addition_is_told():
    """Files, names and titles are found by the patterns above."""
    assert len(re.findall(r"^## Add ", TEXT, re.MULTILINE)) == 15
    assert len(PATHS) > 40
    assert len(NAMES) > 20
