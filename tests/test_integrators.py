"""Integrators in time: their orders, what becomes of the energy, and steps chosen by their error."""

import numpy as np
import pytest

from sweep.params import Case, Contact, Damping, Lattice, Loading, Solver
from sweep.simulate import simulate
from tests.figures import MATERIAL
from tests.scenes import SEED, STORED, UNDAMPED, VISCOUS, pressed, run, slopes, summed, unbalanced
from tests.structures import APART, GRAVITY, LENGTH, MM, set_off, structure

ORDERS = {"backward_euler": 1, "bdf2": 2, "newmark": 2}
INTEGRATORS = pytest.mark.parametrize("integrator", ORDERS)
HIGHER = pytest.mark.parametrize("integrator", ["bdf2", "newmark"])
NAMES = ["none", "drag", "rayleigh", "viscous"]
DRAG = Damping(model="rayleigh", mass=100.0, stiffness=0.0)
STIFF = Damping(model="rayleigh", mass=0.0, stiffness=5e-4)
CREEP = Damping(model="kelvin_voigt", relaxation_time=5e-4)
SOFT = Damping(model="rayleigh", mass=300.0, stiffness=3e-5)
TIMES = 25  # at which runs are compared


def moving(parts, duration, steps, integrator, damping=UNDAMPED, material=MATERIAL):
    """A structure that moves for a while, s."""
    return Case(
        lattice=Lattice(kind="custom", structure=structure(**parts)),
        material=material,
        loading=Loading(duration=duration),
        contact=APART,
        damping=damping,
        solver=Solver(time_step=duration / steps, integrator=integrator),
    )


def loaded(duration, steps, integrator, damping, platen="none", release=0.5, **loading):
    """A grid under a dead load, let go after a share of the duration; friction on a platen."""
    loads = Loading(platen=platen, duration=duration, release_time=release * duration, **loading)
    touch = {"none": APART, "contact": Contact(friction=0.3, slip_speed=0.5)}[platen]
    solver = Solver(time_step=duration / steps, integrator=integrator, tolerance=1e-10)
    return Case(
        material=MATERIAL, loading=loads, contact=touch, damping=damping, solver=solver
    )  # fmt: skip


def struck(integrator, steps, duration, friction=None, damping=SOFT, **loading):
    """A grid that 50 g hit, glued where there is no friction."""
    touch = APART if friction is None else Contact(friction=friction)
    loads = Loading(striker_mass=0.05, duration=duration, **loading)
    solver = Solver(time_step=duration / steps, integrator=integrator)
    return Case(material=MATERIAL, loading=loads, contact=touch, damping=damping, solver=solver)


def orders(cases, column):
    """Slopes of the differences of runs with 1, 2, 4... times as many steps, rms over time."""
    results = [run(case) for case in cases]
    assert {result.status for result in results} == {"converged"}
    values = [result.history[column] for result in results]
    seen = [column[:: (len(column) - 1) // TIMES] for column in values]
    return slopes([np.sqrt(np.mean((b - a) ** 2)) for a, b in zip(seen, seen[1:], strict=False)])


def check_orders(case, integrator, steps, columns):
    """case(steps): as many as ``steps`` and 2 and 4 times as many, or 8 times of first order."""
    finer = 4 // ORDERS[integrator]
    cases = [case(n * steps * finer) for n in (1, 2, 4)]
    for column in columns:
        found = orders(cases, column)
        np.testing.assert_allclose(found, ORDERS[integrator], atol=0.15, err_msg=column)


MOTION = ["probe_3_x_m", "probe_3_y_m", "probe_3_rotation_rad"]
ENERGIES = ["stretch_J", "bend_J", "kinetic_J", "dissipated_integrator_J"]


@INTEGRATORS
@pytest.mark.parametrize("damping", [UNDAMPED, DRAG, STIFF, CREEP], ids=NAMES)
def test_orders_of_a_beam_that_swings_far(damping, integrator):
    """A quarter of a period of a beam so thick that its steps resolve its length's too."""
    period, parts = set_off(3, 0.2, 20.0)

    def case(steps):
        return moving(parts, 0.25 * period, steps, integrator, damping)

    lost = ["dissipated_material_J"] if damping != UNDAMPED else []
    check_orders(case, integrator, 200, [*MOTION, *ENERGIES, *lost])


@INTEGRATORS
def test_orders_of_a_load_that_comes_and_goes_at_once(integrator):
    columns = ["strain", *ENERGIES, "work_in_J", "reaction_bottom_N"]
    check_orders(
        lambda steps: loaded(4e-4, steps, integrator, SOFT, force=5.0), integrator, 200, columns
    )


@INTEGRATORS
def test_orders_of_a_strike(integrator):
    """Until the striker turns, with what it carries along and without."""
    columns = ["strain", "striker_speed_m_per_s", "stretch_J", "bend_J", "kinetic_J"]
    check_orders(
        lambda steps: struck(integrator, steps, 2.5e-3, striker_speed=0.5), integrator, 100, columns
    )


@HIGHER
def test_orders_of_contact_and_friction(integrator):
    """A plate lies on the grid, which creeps under it."""
    damping = Damping(model="rayleigh", mass=300.0, stiffness=3e-4)
    columns = ["strain", "contact_J", "work_in_J", "dissipated_friction_J"]
    for c in columns:
        print(c, orders([loaded(5e-3, n, integrator, damping, "contact", 1.0, force=3.0) for n in (400,800,1600)],c))


@HIGHER
def test_orders_of_a_platen_that_moves(integrator):
    """It has its speed at once."""
    def case(steps):
        numerics = {"integrator": integrator, "tolerance": 1e-10}
        return pressed(3, 0.01, steps, speed=0.1, damping=SOFT, contact="none", solver=numerics)

    columns = ["reaction_top_N", "reaction_bottom_N", "stretch_J", "kinetic_J", "work_in_J"]
    for c in columns:
        print(c, orders([case(n) for n in (400,800,1600)],c))
