"""Parameters of a case: what is accepted, what is filled in, and when two cases are the same."""

import pickle

import pytest
from pydantic import ValidationError

from sweep.config.case import Case, Contact, Damping, Lattice, Loading, Material, Solver
from sweep.config.material_file import locate, read_record


def pressed(**loading):
    return Case(loading=Loading(mode="displacement", **loading))


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
    assert Case().case_id == "339ccf16674e879a"


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


def test_keys_that_the_mode_does_not_use_do_not_count():
    assert pressed(force=5.0, duration=3.0).case_id == pressed().case_id
    loaded = Loading(mode="force", stroke=1e-3, unload=False)
    assert Case(loading=loaded).case_id == Case().case_id
    undamped = Case(damping=Damping(model="none", mass=1.0, relaxation_time=2.0))
    assert undamped.case_id == Case(damping=Damping(model="none")).case_id


def test_displacement_defaults():
    case = pressed()
    assert case.loading.stroke == pytest.approx(0.6 * 12.5e-3)
    assert (case.loading.strain, case.loading.unload, case.loading.platen) == (0.6, True, "glued")
    assert (case.solver.integrator, case.solver.load_steps) == ("static", 200)
    assert case.solver.time_step is None
    assert case.damping.model == "none"


@pytest.mark.parametrize(
    "given",
    [{"strain": 0.5}, {"stroke": 5e-3}, {"speed": 1e-3}, {"quasi_static": True}, {"unload": False}],
)
def test_keys_of_a_platen_say_the_mode(given):
    assert Case(loading=Loading(**given)) == pressed(**given)


@pytest.mark.parametrize(
    "given", [{}, {"force": 5.0}, {"duration": 0.3, "strain": None}, {"platen": "contact"}]
)
def test_without_them_the_mode_is_a_force(given):
    assert Case(loading=Loading(**given)) == Case(loading=Loading(mode="force", **given))


def test_contact_by_itself_is_the_barrier():
    assert Contact().model == "auto"
    case = Case(contact=Contact(model="auto"))
    assert case.contact.model == "barrier"
    assert case.case_id == Case(contact=Contact(model="barrier")).case_id == Case().case_id


def test_slip_speed_without_friction_does_not_count():
    slow, fast = (
        pressed(speed=1e-3).model_copy(update={"contact": Contact(friction=0.0, slip_speed=v)})
        for v in (1e-5, 1e-3)
    )
    assert Case.model_validate(slow.model_dump()).case_id == (
        Case.model_validate(fast.model_dump()).case_id
    )


def test_strain_and_stroke_give_each_other():
    assert pressed(strain=0.5).loading.stroke == pytest.approx(6.25e-3)
    assert pressed(stroke=6.25e-3).loading.strain == pytest.approx(0.5)
    assert pressed(strain=0.5).case_id == pressed(stroke=6.25e-3).case_id


def test_a_speed_brings_time_back():
    case = pressed(speed=1e-3, strain=0.4)
    assert (case.solver.integrator, case.solver.load_steps) == ("backward_euler", 200)
    assert case.solver.time_step == pytest.approx(5e-3 / 1e-3 / 200)
    assert case.damping.model == "rayleigh"


def test_time_step_under_a_speed_makes_a_whole_number_of_steps():
    loading = Loading(mode="displacement", speed=1e-3, stroke=5e-3)
    case = Case(loading=loading, solver=Solver(time_step=0.03))
    assert case.solver.load_steps == 167
    assert case.solver.time_step == pytest.approx(5.0 / 167)
    assert Case(loading=loading, solver=Solver(time_step=0.02)).solver.load_steps == 250


@pytest.mark.parametrize(
    "case",
    [Case(), pressed(), pressed(speed=1e-3), pressed(platen="contact", stroke=4e-3)],
)
def test_resolving_twice_changes_nothing(case):
    again = Case.model_validate(case.model_dump())
    assert again == case
    assert Case.model_validate_json(case.model_dump_json()).case_id == case.case_id
    assert pickle.loads(pickle.dumps(case)) == case


def test_material_by_name_takes_the_numbers_of_its_record():
    record = read_record(locate("cheetah"))
    assert Material(name="cheetah").modulus == record.modulus
    softer = Material(name="cheetah", modulus=70e6)
    assert (softer.modulus, softer.density) == (70e6, record.density)


def test_linear_material_holds_no_curve():
    assert Material(stretch="linear").curve_strain == ()
    by_numbers = Material(modulus=12e6, density=1190.0)
    assert (by_numbers.stretch, by_numbers.poisson, by_numbers.curve_strain) == ("linear", 0.48, ())


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda: Lattice(wall_thickness=2.1e-3),
            "the narrowest cell, 0.002083 m",
        ),
        (lambda: Lattice(cells_x=True), "valid integer"),
        (lambda: Lattice(width=float("inf")), "finite"),
        (lambda: Lattice(colour=1), "not permitted"),
        (lambda: Material(name="chetah"), "allowed: .*cheetah, "),
        (lambda: Material(modulus=12e6), "a density, as no name is given"),
        (lambda: Material(modulus=12e6, density=1e3, stretch="nonlinear"), 'allowed: "linear"'),
        (lambda: Material(curve_strain=(0.0, 1.0), curve_stress=(0.0, 1e6)), "greater than 0"),
        (lambda: pressed(platen="none"), "contact"),
        (lambda: Loading(strain=0.5, force=5.0), "as loading.force needs the one and"),
        (lambda: pressed(strain=0.5, stroke=5e-3), "give one of them"),
        (lambda: pressed(stroke=12.5e-3), "below the height"),
        (lambda: pressed(quasi_static=False), "a speed if quasi_static is false"),
        (lambda: Case(loading=Loading(release_time=0.3)), "up to the duration, 0.2 s"),
        (lambda: Case(solver=Solver(integrator="static")), "backward_euler"),
    ],
)
def test_refused(make, message):
    with pytest.raises(ValidationError, match=message):
        make()


def test_a_case_cannot_be_changed():
    with pytest.raises(ValidationError, match="frozen"):
        Case().lattice.width = 1.0
