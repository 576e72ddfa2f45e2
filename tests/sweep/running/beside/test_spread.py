"""Corners of the best designs: which cases they are, and that none runs twice."""

import pytest

from sweep.config.case import Case
from sweep.running.beside.run_beside import file_beside
from sweep.running.beside.spread import (
    FRICTION,
    SEEDS,
    corners,
    corners_of,
    run_corners,
)
from sweep.store.read import read_summary
from tests.support.materials.records import HEADER
from tests.support.results.standin import cases, simulate, write

PRESSED = dict(mode="displacement", strain=0.3)
FRICTIONS = [f"friction {value:g}" for value in FRICTION]


def named(**tables):
    """The corners of a pressed lattice by their names."""
    design = Case.of(loading=PRESSED, **tables)
    return design, {corner.name: corner.case for corner in corners(design)}


def test_one_number_at_a_time_is_at_an_end():
    design, found = named(material=dict(name="ultimaker_tpu95a"))
    assert list(found) == ["poisson low", "modulus low", "modulus high", *FRICTIONS]
    soft = found["modulus low"].material
    assert soft.modulus == 61e6
    scaled = [61.0 / 67.0 * stress for stress in design.material.curve_stress]
    assert soft.curve_stress == pytest.approx(scaled)
    assert soft.poisson == design.material.poisson
    assert found["poisson low"].material.poisson == 0.45
    assert [found[name].contact.friction for name in FRICTIONS] == [0.2, 0.9]
    assert all(found[name].material == design.material for name in FRICTIONS)


def test_numbers_that_the_config_gives_are_certain():
    _, found = named(material=dict(modulus=12e6, density=1190.0))
    assert list(found) == FRICTIONS
    _, found = named(material=dict(name="cheetah", modulus=80e6, poisson=0.45))
    assert list(found) == FRICTIONS


def test_numbers_without_effect_have_no_corner():
    _, found = named(material=dict(plane="stress"), contact=dict(model="none"))
    assert list(found) == ["modulus low", "modulus high", "density high"]


def test_friction_that_the_sweep_varies_stays():
    design = Case.of(loading=PRESSED, axes={"contact.friction": 0.3})
    assert not {corner.name for corner in corners(design)} & set(FRICTIONS)


def test_friction_of_a_frictionless_motion_has_a_slip_speed():
    moving = dict(mode="displacement", strain=0.3, speed=0.1)
    design = Case.of(loading=moving, contact=dict(friction=0.0))
    found = {corner.name: corner.case for corner in corners(design)}
    assert found["friction 0.9"].contact.slip_speed == pytest.approx(1e-3)


def test_density_changes_the_mass_and_not_the_walls():
    design, found = named(lattice=dict(mass=2e-3))
    assert found["density high"].lattice.wall_thickness == design.lattice.wall_thickness
    assert found["density high"].material.density == 1200.0


def test_measured_loss_with_a_range_has_corners(own_record):
    text = "# loss: 0.3 +- 0.05\n" + HEADER + "0.01,2e4\n0.05,1e5\n"
    name = str(own_record(text))
    _, found = named(material=dict(name=name, memory="measured"))
    assert found["loss low"].material.loss == pytest.approx(0.25)
    assert "loss low" not in named(material=dict(name=name))[1]


def test_only_missing_corners_of_the_best_run(tmp_path):
    out, log = tmp_path / "trial.h5", []

    def logged(case, control):
        log.append(case.case_id)
        return simulate(case)

    designs = cases(3)
    found = corners_of(designs, [designs[1].case_id], out)
    assert list(found) == [designs[1].case_id]
    ids = {corner.case_id for corner in found[designs[1].case_id]}
    for _ in range(2):
        run_corners(found, out, simulate=logged)
    assert sorted(log) == sorted(ids)
    summary = read_summary(file_beside(out, "spread"))
    assert file_beside(out, "spread").name == "trial.spread.h5"
    assert set(summary["case_id"]) == ids
    assert set(summary["contact.friction"].dropna()) == set(FRICTION)


def test_a_design_of_another_config_is_read_and_one_of_this_keeps_its_time_limit(tmp_path):
    out, (other, own) = tmp_path / "trial.h5", cases(2)
    write(out, [other, own], fold=True)
    patient = own.model_copy(update={"solver": own.solver.model_copy(update={"time_limit": 1e4})})
    found = corners_of([patient], [other.case_id, own.case_id], out)
    assert found[other.case_id] == corners(other)
    assert {corner.case.solver.time_limit for corner in found[own.case_id]} == {1e4}


def test_lattices_fold_along_their_cells_in_other_ways():
    loading = dict(direction="out_of_plane", strain=0.3)
    found = {c.name: c.case for c in corners(Case.of(loading=loading))}
    seeds = {f"imperfection {seed}": seed for seed in SEEDS}
    assert list(found) == ["modulus low", "modulus high", "density high", *FRICTIONS, *seeds]
    assert {n: found[n].lattice.imperfection_seed for n in seeds} == seeds
    assert found["imperfection 1"].axes == {"lattice.imperfection_seed": 1}
    straight = Case.of(loading=loading, lattice=dict(imperfection=0.0))
    assert not {c.name for c in corners(straight)} & set(seeds)
