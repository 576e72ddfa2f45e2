"""Corners of the best designs: which cases they are, and that none runs twice."""

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.running.beside.run_beside import How, file_beside
from sweep.running.beside.spread import (
    FRICTION,
    SEEDS,
    corners,
    corners_of,
    run_corners,
)
from sweep.scene.material import stress_law
from sweep.store.read import read_summary
from tests.support.materials.records import HEADER
from tests.support.results.standin import Logged, cases, simulate, write

PRESSED = dict(mode="displacement", strain=0.3)
FRICTIONS = [f"friction {value:g}" for value in FRICTION]
COMPRESSION = ["compression low", "compression high"]


def named(**tables):
    """The corners of a pressed lattice by their names."""
    design = Case.of(loading=PRESSED, **tables)
    return design, corners(design)


def test_one_number_at_a_time_is_at_an_end():
    design, found = named(material=dict(name="ultimaker_tpu95a"))
    assert list(found) == ["poisson low", "modulus low", "modulus high", *COMPRESSION, *FRICTIONS]
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
    assert list(found) == [*COMPRESSION, *FRICTIONS]


def test_numbers_without_effect_have_no_corner():
    _, found = named(material=dict(plane="stress"), contact=dict(model="none"))
    assert list(found) == ["modulus low", "modulus high", "density high", *COMPRESSION]


def test_a_compression_that_is_not_measured_goes_by_either_rule():
    """Stress odd in nominal strain is the least, Cauchy stress odd in log strain the greatest."""
    design, found = named()
    given, low, high = (
        stress_law(case.material) for case in (design, *map(found.get, COMPRESSION))
    )
    pulled, pressed = np.array([0.05, 0.2, 0.4]), -np.array([0.05, 0.2, 0.4])
    for law in (low, high):
        np.testing.assert_array_equal(law.at(pulled), given.at(pulled))
    np.testing.assert_allclose(low.at(pressed), -given.at(pulled), rtol=1e-3)
    odd = -given.at(1 / (1 + pressed) - 1) / (1 + pressed) ** 2
    np.testing.assert_allclose(high.at(pressed), odd, rtol=1e-2)
    np.testing.assert_allclose(0.7 * low.at(pressed) + 0.3 * odd, given.at(pressed), rtol=1e-3)


STRAINS = np.array([0.05, 0.1, 0.2])
PUCK = (
    "-0.2,-3e5\n-0.1,-1.2e5\n-0.05,-5.5e4\n-0.01,-1e4\n0.01,1e4\n0.05,4.9e4\n0.1,9e4\n0.2,1.8e5\n"
)


@pytest.mark.parametrize("says", [True, False])
def test_a_tension_that_is_not_measured_goes_by_either_rule(own_record, says):
    """A file with both branches has corners if it calls one of them an assumption."""
    text = ("# Tension [A]: derived from compression.\n" if says else "") + HEADER + PUCK
    design, found = named(material=dict(name=str(own_record(text))))
    ends = ["tension low", "tension high"]
    assert set(ends) & set(found) == (set(ends) if says else set())
    if not says:
        return
    given, low, high = (stress_law(case.material) for case in (design, *map(found.get, ends)))
    for law in (low, high):
        np.testing.assert_allclose(law.at(-STRAINS), given.at(-STRAINS), rtol=1e-12)
    np.testing.assert_allclose(high.at(STRAINS), -given.at(-STRAINS), rtol=1e-12)
    assert np.all(low.at(STRAINS) < given.at(STRAINS))
    assert np.all(given.at(STRAINS) < high.at(STRAINS))


def test_friction_that_the_sweep_varies_stays():
    design = Case.of(loading=PRESSED, axes={"contact.friction": 0.3})
    assert not corners(design).keys() & set(FRICTIONS)


def test_friction_of_a_frictionless_motion_has_a_slip_speed():
    moving = dict(mode="displacement", strain=0.3, speed=0.1)
    design = Case.of(loading=moving, contact=dict(friction=0.0))
    found = corners(design)
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
    out, logged = tmp_path / "trial.h5", Logged(simulate)
    designs = cases(3)
    found = corners_of(designs, [designs[1].case_id], out)
    assert list(found) == [designs[1].case_id]
    ids = {corner.case_id for corner in found[designs[1].case_id].values()}
    for _ in range(2):
        run_corners(found, out, How(simulate=logged))
    assert sorted(logged) == sorted(ids)
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
    assert {corner.solver.time_limit for corner in found[own.case_id].values()} == {1e4}


def test_lattices_fold_along_their_cells_in_other_ways():
    loading = dict(direction="out_of_plane", strain=0.3)
    found = corners(Case.of(loading=loading))
    seeds = {f"imperfection {seed}": seed for seed in SEEDS}
    numbers = ["modulus low", "modulus high", "density high", *COMPRESSION, *FRICTIONS]
    assert list(found) == [*numbers, *seeds]
    assert {n: found[n].lattice.imperfection_seed for n in seeds} == seeds
    assert found["imperfection 1"].axes == {"lattice.imperfection_seed": 1}
    straight = Case.of(loading=loading, lattice=dict(imperfection=0.0))
    assert not corners(straight).keys() & set(seeds)
