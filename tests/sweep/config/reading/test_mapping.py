"""Dicts of Python as configs: spellings of keys, values of NumPy and of paths."""

from pathlib import Path

import numpy as np
import pytest

from sweep.config.faults import ConfigError
from sweep.config.reading.mapping import document_of


def test_keys_by_dots_and_in_tables_are_the_same():
    tables = {"lattice": {"kind": "hex", "width": "25 mm"}, "rank": {"budgets": ["5 g"]}}
    dotted = {"lattice.kind": "hex", "lattice": {"width": "25 mm"}, "rank.budgets": ["5 g"]}
    assert document_of(dotted) == document_of(tables) == tables
    assert dotted["lattice"] == {"width": "25 mm"}  # left as it was


def test_values_are_those_of_a_file():
    given = {
        "lattice": {"file": Path("arch.json"), "cells_x": np.int64(3)},
        "grid": {"lattice.cells": range(2, 4), "loading.strain": np.array([0.5, 0.6])},
        "zip": ({"lattice.kind": ("hex", "square")},),
    }
    document = document_of(given)
    assert document == {
        "lattice": {"file": "arch.json", "cells_x": 3},
        "grid": {"lattice.cells": [2, 3], "loading.strain": [0.5, 0.6]},
        "zip": [{"lattice.kind": ["hex", "square"]}],
    }
    assert type(document["lattice"]["cells_x"]) is int
    assert type(document["grid"]["loading.strain"][0]) is float


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"lattice": {"kind": "hex"}, "lattice.kind": "square"}, "lattice.kind = .*: set twice"),
        ({3: 1}, "the name is no text"),
    ],
)
def test_what_no_file_could_say_is_refused(given, told):
    with pytest.raises(ConfigError, match=told):
        document_of(given)
