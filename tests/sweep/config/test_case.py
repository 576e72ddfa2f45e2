"""Parameters of a case: the defaults, and when two cases are the same."""

import pytest
from pydantic import ValidationError

from sweep.config.case import Case
from sweep.config.kinds.table import RefusedError


def test_id_is_stable_and_ignores_labels_and_rounding():
    labelled = Case.of(axes={"lattice.cells": 3})
    rounded = Case.of(lattice=dict(wall_thickness=0.8e-3 * (1 + 1e-15)))
    assert labelled.case_id == rounded.case_id == Case.of().case_id == "4a3ea630c1f43441"
    assert hash(labelled) == hash(Case.of())
    assert len({Case.of(), labelled}) == 2


def test_a_case_cannot_be_changed():
    with pytest.raises(ValidationError, match="frozen"):
        Case.of().lattice.width = 1.0


@pytest.mark.parametrize(
    ("tables", "line"),
    [
        (dict(latice={}), "latice"),
        (dict(lattice="square"), "lattice = square"),
        (dict(loading=dict(mode="shear")), 'loading.mode = shear; allowed: "force", '),
        (dict(contact=dict(model="x")), "contact.model = x; allowed: 'barrier' or 'none'"),
    ],
)
def test_what_no_case_has_is_refused(tables, line):
    for make in (Case.of, Case.of().changed):
        with pytest.raises(RefusedError, match=line):
            make(**tables)


@pytest.mark.parametrize(
    ("table", "key", "value"),
    [
        ("loading", "strain", "half"),
        ("loading", "strain", [0.5]),
        ("lattice", "width", {"mm": 1}),
        ("lattice", "width", "9 mm"),
        ("lattice", "cells_x", 2.5),
        ("material", "name", ["cheetah"]),
        ("loading", "allowed_forces", 5.0),
    ],
)
def test_a_value_of_another_type_is_refused(table, key, value):
    for make in (Case.of, Case.of().changed):
        with pytest.raises(RefusedError) as refused:
            make(**{table: {key: value}})
        assert (refused.value.key, refused.value.value) == (f"{table}.{key}", value)


def test_a_copy_with_another_table_has_another_id():
    case = Case.of(lattice=dict(cells_x=3))
    known = case.case_id
    relabelled = case.model_copy(update={"axes": {"lattice.cells_x": 3}})
    lattice = case.lattice.model_copy(update={"cells_x": 4})
    assert relabelled.case_id == known
    assert relabelled == relabelled.model_copy(deep=True)
    other = case.model_copy(update={"lattice": lattice})
    assert other.case_id == Case.of(lattice=dict(lattice)).case_id != known
