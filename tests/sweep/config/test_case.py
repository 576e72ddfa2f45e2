"""Parameters of a case: the defaults, and when two cases are the same."""

import pytest
from pydantic import ValidationError

from sweep.config.case import Case, Contact, Damping, Lattice, Loading, Material, Solver


def test_default_is_the_specimen_of_the_seed():
    case = Case()
    assert (case.lattice.cells_x, case.lattice.wall_thickness) == (3, 0.8e-3)
    assert (case.loading.force, case.loading.release_time, case.loading.duration) == (
        10,
        0.138,
        0.2,
    )
    assert (case.loading.platen, case.solver.time_step) == ("none", 1e-4)
    assert len(case.material.curve_strain) == 14
    assert case.material.curve_stress[0] == 0.248e6


def test_id_is_stable_between_versions():
    assert Case().case_id == "38f87c436f70d724"


def test_id_ignores_labels_and_rounding():
    labelled = Case(axes={"lattice.cells": 3})
    rounded = Case(lattice=Lattice(wall_thickness=0.8e-3 * (1 + 1e-15)))
    assert labelled.case_id == rounded.case_id == Case().case_id


@pytest.mark.parametrize(
    "other",
    [
        Case(lattice=Lattice(cells_x=2)),
        Case(material=Material(name="cheetah")),
        Case(loading=Loading(force=10.001)),
        Case(contact=Contact(friction=0.2)),
        Case(damping=Damping(mass=4.0)),
        Case(solver=Solver(tolerance=1e-9)),
    ],
)
def test_id_sees_every_table(other):
    assert other.case_id != Case().case_id


def test_a_changed_copy_has_an_id_of_its_own():
    case = Case()
    before = case.case_id
    lattice = case.lattice.model_copy(update={"cells_x": 2})
    assert case.model_copy(update={"lattice": lattice}).case_id != before
    assert case.case_id == before


def test_a_case_cannot_be_changed():
    with pytest.raises(ValidationError, match="frozen"):
        Case().lattice.width = 1.0


def test_changed_case_is_resolved_anew():
    case = Case(axes={"lattice.cells": 3})
    pressed = case.changed(loading=Loading(strain=0.5))
    assert pressed == Case(loading=Loading(strain=0.5), axes=case.axes)
    assert pressed.solver != case.solver
    assert case.changed() == case
