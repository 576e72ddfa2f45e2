"""Ids of cases never change: they name the rows of every results file."""

import json
from hashlib import blake2b
from pathlib import Path

import pytest

from sweep.config.grid import Config
from sweep.config.reading.reader import Reader
from sweep.config.units import in_si, load_config

FOLDER = Path(__file__).parent / "ids"
FROZEN = [json.loads(line) for line in (FOLDER / "configs.jsonl").read_text("utf-8").splitlines()]
EXAMPLES = json.loads((FOLDER / "examples.json").read_text("utf-8"))


def config(tables: dict[str, dict[str, object]]) -> Config:
    """The config of tables; names of files are relative to the folder of the frozen ids."""
    lists = {name: [table] if name == "exclude" else table for name, table in tables.items()}
    reader = Reader(FOLDER, in_si)
    found = reader.config(lists, FOLDER / "frozen.toml")
    assert reader.faults == []
    return found


@pytest.mark.parametrize("row", FROZEN, ids=lambda row: row["ids"][0])
def test_the_ids_of_a_config_are_frozen(row):
    assert [case.case_id for case in config(row["config"]).cases] == row["ids"]


@pytest.mark.parametrize("name", EXAMPLES)
def test_the_ids_of_an_example_are_frozen(name):
    ids = [case.case_id for case in load_config(name).cases]
    digest = blake2b(" ".join(ids).encode(), digest_size=8).hexdigest()
    assert [len(ids), digest] == EXAMPLES[name]
