"""Ids name the rows of every results file: they change with the meaning of a case alone."""

import json
from hashlib import blake2b
from itertools import chain
from pathlib import Path

import pytest

from sweep.config.case import Case
from sweep.config.grid import expanded
from sweep.config.load import load_config
from sweep.config.reading.examples import examples
from sweep.config.reading.reader import Reader

FOLDER = Path(__file__).parent / "ids"
FROZEN = [json.loads(line) for line in (FOLDER / "configs.jsonl").read_text("utf-8").splitlines()]
EXAMPLES = json.loads((FOLDER / "examples.json").read_text("utf-8"))


def cases(tables):
    """The cases of a config; names of files in it are relative to the folder of the frozen ids."""
    lists = {name: [table] if name == "exclude" else table for name, table in tables.items()}
    reader = Reader(FOLDER)
    found = reader.config(lists, FOLDER / "frozen.toml")
    assert reader.faults == []
    return expanded(found.recipe)[0]


def test_the_ids_of_configs_are_frozen_and_their_cases_kept_as_text():
    assert len(FROZEN) == 297
    made = [cases(row["config"]) for row in FROZEN]
    ids = [[case.case_id for case in of_one] for of_one in made]
    assert [row for row, own in zip(FROZEN, ids, strict=True) if row["ids"] != own] == []
    for case in chain(*made):
        read = Case.from_json(case.to_json())
        assert (read, read.to_json()) == (case, case.to_json())


@pytest.mark.parametrize("name", EXAMPLES)
def test_the_ids_of_an_example_are_frozen(name):
    config = load_config(name)
    own = [case.case_id for case in config.cases]
    assert (config.name, len({*own})) == (Path(name).name, len(own))
    digest = blake2b(" ".join(own).encode(), digest_size=8).hexdigest()
    assert [len(own), digest] == EXAMPLES[name]


def test_the_ids_of_all_examples_are_frozen():
    """But of searches, which have none, and of those that are stored with their predictions."""
    others = {name for name in examples() if name == "search" or name.startswith("published/")}
    assert EXAMPLES.keys() == {*examples()} - others
