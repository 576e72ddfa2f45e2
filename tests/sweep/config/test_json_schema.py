"""The schema for editors accepts what the reader accepts, and marks what it refuses."""

import json
import tomllib

import pytest

from sweep.config.json_schema import json_schema
from sweep.config.keys import case_keys
from sweep.config.reading.examples import FOLDER

SCHEMA = json_schema()
TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "integer": int}
TYPES |= {"number": (int, float)}


def faults(value, schema, at=""):
    """Places in a document that break a schema; the part of the language that `SCHEMA` uses."""
    if "$ref" in schema:
        schema = SCHEMA["definitions"][schema["$ref"].rpartition("/")[2]]
    if "anyOf" in schema:
        found = [faults(value, option, at) for option in schema["anyOf"]]
        return [] if [] in found else found[0]
    if "const" in schema:
        return [] if value == schema["const"] else [at]
    kinds = [schema["type"]] if isinstance(schema["type"], str) else schema["type"]
    is_bool = isinstance(value, bool)
    if not any(isinstance(value, TYPES[k]) and is_bool == (k == "boolean") for k in kinds):
        return [at]
    if value not in schema.get("enum", [value]):
        return [at]
    if "integer" in kinds and value < schema.get("minimum", value):
        return [at]
    if isinstance(value, list):
        return [fault for item in value for fault in faults(item, schema["items"], at)]
    if isinstance(value, dict):
        known = schema["properties"]
        missing = [f"{at}.{name}" for name in schema.get("required", ()) if name not in value]
        strange = [f"{at}.{name}" for name in value if name not in known]
        inner = [(value[name], known[name], f"{at}.{name}") for name in value if name in known]
        return missing + strange + [fault for part in inner for fault in faults(*part)]
    return []


@pytest.mark.parametrize("path", sorted(FOLDER.rglob("*.toml")), ids=lambda path: path.stem)
def test_every_example_fits(path):
    assert faults(tomllib.loads(path.read_text("utf-8")), SCHEMA) == []


def test_every_key_has_its_values_in_words():
    assert SCHEMA["definitions"].keys() >= case_keys().keys()
    assert all(one["description"] for one in SCHEMA["definitions"].values())
    text = json.dumps(SCHEMA)
    assert "null" not in text
    assert '"square"' in json.dumps(SCHEMA["definitions"]["lattice.kind"]["enum"])


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ('[lattice]\nkindd = "hex"', ".lattice.kindd"),
        ('[lattice]\nkind = "hexx"', ".lattice.kind"),
        ("[lattice]\nwidth = 12", ".lattice.width"),
        ("[lattice]\ncells = 0", ".lattice.cells"),
        ("[lattice]\ncells = true", ".lattice.cells"),
        ('[grid]\n"lattice.kind" = "hex"', ".grid.lattice.kind"),
        ('[grid]\nlattice.kind = ["hexx"]', ".grid.lattice.kind"),
        ('[search]\n"lattice.cells_x" = {from = 2}', ".search.lattice.cells_x"),
        ('[rank]\nbudgets = "25 g"', ".rank.budgets"),
        ("[elsewhere]", ".elsewhere"),
    ],
)
def test_what_is_refused_is_marked(text, place):
    assert faults(tomllib.loads(text), SCHEMA) == [place]


def test_a_share_may_be_a_number_and_a_default_stands_in_a_grid():
    text = '[loading]\nstrain = 0.5\n[grid]\n"lattice.orientation" = ["", "flat"]'
    assert faults(tomllib.loads(text), SCHEMA) == []
