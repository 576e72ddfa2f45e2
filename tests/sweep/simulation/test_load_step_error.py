"""The estimated error of load steps: exact for simple curves, and beside finer steps of a crush."""

import math

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.simulation.load_step_error import load_step_error, peak_step_error
from tests.support.converged import converged
from tests.support.designs.scenes import pressed

CRUSH = pressed(2, 0.1, 5)


def rows(way, force, friction=0.0):
    lost = np.broadcast_to(friction, way.shape)
    both = dict.fromkeys(("reaction_top_N", "reaction_bottom_N"), force)
    return {"top_displacement_m": -way, "dissipated_friction_J": lost} | both


def test_it_is_exact_for_a_quadratic_curve():
    """The trapezoidal rule makes the same error in every step but the first, which has none yet."""
    way = np.linspace(0.0, 2e-3, 9)
    found = load_step_error(CRUSH, rows(way, way**2))
    exact, work = (2e-3) ** 3 / 3.0, np.trapezoid(way**2, way)
    assert found == pytest.approx(7 / 8 * (work - exact) / work, rel=1e-9)
    assert load_step_error(CRUSH, rows(way, way)) == pytest.approx(0.0, abs=1e-12)


def test_friction_that_changes_adds_up_as_the_root_of_squares():
    way, steps = np.linspace(0.0, 1e-3, 11), 10
    alternating = np.where(np.arange(steps) % 2, 1.0, 3.0)  # N
    lost = np.r_[0.0, np.cumsum(alternating)] * 1e-4
    found = load_step_error(CRUSH, rows(way, np.full(11, 5.0), lost))
    assert found == pytest.approx(math.sqrt(steps - 1) * 1e-4 / 5e-3, rel=1e-9)


def test_rows_in_which_the_platen_waits_change_nothing():
    way = np.linspace(0.0, 2e-3, 9)
    again = np.sort(np.r_[way, way[4], way[-1]])
    expected = load_step_error(CRUSH, rows(way, way**2))
    assert load_step_error(CRUSH, rows(again, again**2)) == expected


def test_other_loadings_and_too_few_steps_have_none():
    way = np.linspace(0.0, 2e-3, 9)
    for loading in ({"mode": "force", "force": 5.0}, {"mode": "displacement", "speed": 1.0}):
        assert math.isnan(load_step_error(Case.of(loading=loading), rows(way, way**2)))
    assert load_step_error(CRUSH, rows(way[:3], way[:3] ** 2)) == math.inf
    assert math.isnan(load_step_error(CRUSH, rows(way, np.zeros(9))))


def test_it_tells_steps_that_are_too_long():
    """Beside 400 steps, energies of 25 err by more than the limit of the mark, of 200 by less."""

    def crushed(steps):
        lattice = {"kind": "reentrant", "wall_thickness": 0.6e-3}
        case = Case.of(
            lattice=lattice | {"cells_x": 3, "cells_y": 3, "width": 16e-3, "height": 16e-3},
            material={"name": "cheetah"},
            loading={"mode": "displacement", "strain": 0.55, "unload": False},
            solver={"load_steps": steps},
        )
        return converged(case).summary

    right = crushed(400)["absorbed_energy_J"]
    coarse, fine = crushed(25), crushed(200)
    for row, is_marked in ((coarse, True), (fine, False)):
        assert (abs(row["absorbed_energy_J"] / right - 1.0) > 0.005) == is_marked
        assert (row["load_step_error"] > 0.005) == is_marked


@pytest.mark.parametrize(
    ("force", "missed"),
    [
        ([0.0, 8.0, 12.0, 11.0, 10.5], 2.0 / 12.0),  # twice the fall after it
        ([0.0, 8.0, 12.0, 6.0, 5.0], 4.0 / 12.0),  # the rise before it
        ([0.0, 11.9, 12.0, 6.0, 5.0], 0.1 / 12.0),  # a snap after a slow rise
        ([0.0, 8.0, 12.0, 12.0, 12.0], 0.0),  # an elastic plateau
        ([0.0, 3.0, 2.9, 8.0, 12.0], 0.2 / 3.0),  # an early peak counts, as a force may be allowed
        ([0.0, 8.0, 4.0, 5.0, 4.0], 1.0),  # a later one that is lower does not
        ([0.0, 1.0, 2.0, 3.0, 4.0], 0.0),
        ([-2.0, -1.0, 0.0, -1.0, -2.0], 0.0),  # glued walls that pull
        ([0.0, 1.0], 0.0),
    ],
)
def test_a_peak_between_rows_is_estimated_by_its_flanks(force, missed):
    way = 1e-4 * np.arange(len(force))
    assert peak_step_error(CRUSH, rows(way, np.array(force))) == pytest.approx(missed, abs=1e-12)
    fast = Case.of(loading={"mode": "displacement", "speed": 1.0})
    assert math.isnan(peak_step_error(fast, rows(way, np.array(force))))


def test_peaks_of_walls_that_relax_are_told_apart_from_those_of_elastic_ones():
    """Thin squares, whose peak is a tenth too low if walls relax, unless steps may be shorter."""

    def crushed(steps, **keys):
        case = Case.of(
            lattice={"cells_x": 4, "cells_y": 2, "width": 26e-3, "height": 13e-3}
            | {"wall_thickness": 0.4e-3, "nodes_per_wall": 3},
            material={"name": "ninjaflex"} | keys,
            loading={"mode": "displacement", "strain": 0.03, "unload": False},
            solver=steps,
        )
        return converged(case).summary["peak_step_error"]

    equal, default = {"load_steps": 20}, {"load_steps": 20, "accuracy": 1e-3}
    assert crushed(equal) < 0.02 < crushed(equal, loss=0.3)
    assert crushed(default, loss=0.3) < 0.02


def test_walls_that_relax_and_buckle_too_early_are_told_by_their_energies():
    """Before a smooth peak: the energy a^2 of bending, the slope of a jumps in the third step."""
    way = 1e-3 * np.arange(7.0)
    amplitude = np.array([0.0, 1.0, 2.0, 4.0, 6.0, 8.0, 10.0]) * 1e-2  # J^0.5
    force = np.array([0.0, 5.0, 10.0, 12.0, 13.0, 12.9, 12.8])
    none = dict.fromkeys(("stretch_J", "contact_J"), np.zeros(7))
    loading = rows(way, force) | none | {"bend_J": amplitude**2}
    relaxing = Case.of(loading={"mode": "displacement"}, material={"loss": 0.3})
    assert peak_step_error(CRUSH, loading) == pytest.approx(0.2 / 13.0)
    assert peak_step_error(relaxing, loading) == pytest.approx(1e-2 * 2e-2 / 1e-3 / 13.0)


def test_a_peak_in_the_first_row_is_judged_by_the_step_after_it():
    """Squares whose walls buckle in the second step: the slope of a jumps from 0 to 20 J^0.5/m."""
    way = 1e-3 * np.arange(5.0)
    none = dict.fromkeys(("stretch_J", "contact_J"), np.zeros(5))
    bending = np.array([0.0, 0.0, 2.0, 4.0, 6.0]) * 1e-2
    loading = rows(way, np.array([0.0, 13.0, 12.9, 12.8, 12.7])) | none | {"bend_J": bending**2}
    relaxing = Case.of(loading={"mode": "displacement"}, material={"loss": 0.3})
    assert peak_step_error(relaxing, loading) == pytest.approx(2e-2 * 2e-2 / 1e-3 / 13.0)


def test_walls_that_relax_buckle_at_the_right_force_by_default():
    """Thin squares, whose peak is a fifth too low in 400 equal steps, and hexagons, which then
    buckle at 2.1 in place of 2.6 % strain: beside steps eight times as short.
    """

    def crushed(lattice, **solver):
        case = Case.of(
            lattice=dict(nodes_per_wall=3, imperfection=0.02, **lattice),
            material=dict(name="cheetah", loss=0.3),
            loading=dict(mode="displacement", strain=0.04, unload=False, platen="glued"),
            solver=dict(joints="points", **solver),
        )
        return converged(case).summary["peak_force_N"]

    size = dict(width=20e-3, height=20e-3, cells_x=3, cells_y=3)
    hexagons = dict(kind="hex", width=8.3333e-3, height=12.5e-3, cell_size=4.1667e-3)
    for lattice in (
        dict(kind="square", wall_thickness=0.2e-3, **size),
        dict(wall_thickness=0.4e-3, sides="periodic", **hexagons),
    ):
        right = crushed(lattice, load_steps=8 * 27, accuracy=5e-4)  # 27: of 400 to 60 %
        assert crushed(lattice) == pytest.approx(right, rel=3e-3)
        assert crushed(lattice, load_steps=27) < 0.95 * right


def test_steps_are_long_where_a_platen_has_left_walls_that_recover():
    """Without a reaction there is no work that could err: a step is not as short as it may be."""
    size = dict(width=20e-3, height=20e-3, cells_x=2, cells_y=2, nodes_per_wall=3)
    case = Case.of(
        lattice=dict(kind="hex", wall_thickness=0.6e-3, **size),
        material=dict(name="ninjaflex", loss=0.3),
        loading=dict(mode="displacement", strain=0.2, platen="contact"),
    )
    history = converged(case).history
    travel, force = np.abs(history["top_displacement_m"]), history["reaction_top_N"]
    left = np.flatnonzero(force[:-1] < 1e-6 * force.max())
    left = left[left > travel.argmax()]
    shortest = case.loading.stroke / case.solver.load_steps / 32
    assert len(left) > 5
    assert np.median(-np.diff(travel)[left]) > 8.0 * shortest
