"""A case as text: written and read without any file, and refused with a sentence if it is none."""

import json

import pytest

from sweep.config.case import Case
from sweep.config.load import load_config
from sweep.config.materials import material_file
from sweep.config.structures import structure_file

CUSTOM = load_config("custom").cases[0]


def test_no_file_is_read(monkeypatch, tmp_path):
    texts = [CUSTOM.to_json(), Case.of(material=dict(name="cheetah")).to_json()]
    monkeypatch.setattr(material_file, "FOLDER", tmp_path)
    monkeypatch.setattr(structure_file, "read_structure", None)
    monkeypatch.chdir(tmp_path)
    assert [Case.from_json(text).to_json() for text in texts] == texts


FAR = json.loads(CUSTOM.to_json())["lattice"]["structure"] | {"probes": [99]}


def assert_refused(text, line):
    with pytest.raises(ValueError, match=line) as refused:
        Case.from_json(text)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("", "EOF"),
        ("[" * 10_000, "recursion limit"),
        ("[]", "should be an object"),
        ('{"lattice": 1, "material": {}}', "lattice: Input should be an object"),
    ],
)
def test_other_texts_are_refused_with_a_line(text, line):
    assert_refused(text, line)


@pytest.mark.parametrize(
    ("case", "table", "values", "line"),
    [
        (Case.of(), "lattice", {"cells_x": 0}, "cells_x: .*greater than or equal to 1"),
        (Case.of(), "lattice", {"cells": 3}, "lattice.cells: "),
        (Case.of(), "lattice", {"mass": "heavy"}, "lattice.mass: .*valid number"),
        (Case.of(), "lattice", {"wall_thickness": 3e-3}, "narrowest cell"),
        (Case.of(), "lattice", {"nodes_per_wall": 1000, "cells_x": 90}, "at most 60,000"),
        (Case.of(), "lattice", {"kind": "custom"}, "path of a .json file"),
        (Case.of(), "lattice", {"structure": FAR}, "lattice.structure: Extra"),
        (Case.of(), "loading", {"force": float("nan")}, "finite|expected value"),
        (Case.of(), "loading", {"mode": "displacement"}, "loading.displacement"),
        (Case.of(), "material", {"curve_strain": None}, "as no curve is given"),
        (CUSTOM, "lattice", {"structure": FAR}, r"probes\[0\] = 99: no such node"),
        (CUSTOM, "lattice", {"structure": None}, "structure: .*should be an object|Field required"),
    ],
)
def test_other_values_are_refused_with_a_line(case, table, values, line):
    tables = json.loads(case.to_json())
    tables[table] |= values
    for key, value in values.items():
        if value is None:
            del tables[table][key]
    assert_refused(json.dumps(tables), line)
