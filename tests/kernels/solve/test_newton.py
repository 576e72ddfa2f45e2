"""Newton: it ends at a minimum and nowhere else, or says why not."""

import numpy as np
import pytest

from kernels.solve import newton, outcomes
from kernels.solve.problem import HELD
from kernels.solve.residual import Tolerance, allowed, allowed_decrement, loosened
from sweep.config.case import Case
from sweep.scene.lattice import build_scene
from sweep.scene.loading import tolerances
from tests.support.converged import converged
from tests.support.designs.scenes import grid, pressed, run, slopes
from tests.support.designs.tables import MATERIAL
from tests.support.kernels.solving import descend, ramp, reduction, residual, shaken, whole

HEIGHT = 12.5e-3
ROUND_OFF = 1e-9  # N
BUCKLED = 0.03  # strain, above buckling of a clamped wall, (2 pi)^2 / 12 (t / H)^2 = 0.0135


def column():
    """One cell of perfectly straight walls between glued platens."""
    return Case.of(
        lattice=dict(cells_x=1, cells_y=1, nodes_per_wall=5, imperfection=0.0),
        material=MATERIAL,
        loading=dict(mode="displacement", strain=BUCKLED),
        contact=dict(model="none"),
        solver=dict(joints="points"),
    )


def straight(strain):
    """The column, its scene, and its state compressed evenly: an equilibrium at any strain."""
    case = column()
    scene = build_scene(case)
    x = scene.x_rest.copy()
    x[1 : 2 * len(scene.mesh.points) : 2] *= 1.0 - strain
    x[-1] -= strain * HEIGHT
    return case, scene, x


def loaded(force=2.0, *args):
    """A grid under a dead load, its scene, and a step from rest."""
    case = grid(force, *args)
    scene = build_scene(case)
    return case, scene, whole(scene, scene.x_rest)


def is_minimum(case, scene, x, dt, args):
    """Balanced, and with no negative curvature in any direction; both from pairs found anew."""
    R = reduction(scene)
    curvature = np.linalg.eigvalsh(R.T @ args.hessian(x) @ R)
    allowed = tolerances(case, scene, ramp(scene, 1, dt)).force
    balanced = np.abs(residual(scene, x, args)).max() <= allowed
    return balanced and curvature[0] > -1e-9 * curvature[-1]


def test_a_straight_column_is_left_once_it_buckles():
    """Every force is balanced there: only the negative pivot tells."""
    case, scene, start = straight(BUCKLED)
    args = whole(scene, start)
    assert np.abs(residual(scene, start, args)).max() < 1e-9
    assert not is_minimum(case, scene, start, np.inf, args)
    found = descend(case, scene, start, args)
    assert found.outcome == outcomes.CONVERGED
    assert is_minimum(case, scene, found.x, np.inf, args)
    assert np.abs(found.x - start)[: 2 * len(scene.mesh.points)].max() > 1e-3
    assert args.energy(found.x) < 0.75 * args.energy(start)
    start[::2] += 1e-4 * np.linspace(0.0, 1.0, start[::2].size)
    anew, on = (descend(case, scene, start, args, evaluated=known) for known in (False, True))
    assert (on.outcome, on.iterations) == (outcomes.CONVERGED, anew.iterations)
    np.testing.assert_array_equal(on.x, anew.x)


def test_a_straight_column_stays_straight_before_it_buckles():
    """The platen ends exactly at its target."""
    case, scene, start = straight(0.01)
    found = descend(case, scene, start, whole(scene, start))
    assert (found.outcome, found.iterations) == (outcomes.CONVERGED, 0)
    np.testing.assert_array_equal(found.x, start)
    _, _, end = straight(0.012)
    found = descend(case, scene, start, whole(scene, start), end[-1])
    assert (found.outcome, found.x[-1]) == (outcomes.CONVERGED, end[-1])
    np.testing.assert_allclose(found.x, end, rtol=0, atol=1e-9 * HEIGHT)


@pytest.mark.parametrize("thickness", [4e-4, 8e-4, 8.5e-4, 9e-4, 1e-3])
@pytest.mark.parametrize("cells_y", [3, 4])
def test_a_loose_lattice_at_rest_is_not_unstable(cells_y, thickness):
    """It may slide and rock: pivots are zero, up to the round-off of stiff walls."""
    case = Case.of(
        lattice=dict(cells_x=3, cells_y=cells_y, wall_thickness=thickness),
        loading=dict(mode="displacement", strain=0.1, platen="contact"),
    )
    scene = build_scene(case)
    args = whole(scene, scene.x_rest)
    negative, _, missing = args.factor(scene.x_rest)
    assert (negative, missing) == (False, False)


@pytest.mark.parametrize("seed", range(3))
def test_the_same_minimum_from_all_around(seed):
    """What is held does not move, and bears the load."""
    case, scene, args = loaded()
    expected = descend(case, scene, scene.x_rest, args)
    found = descend(case, scene, shaken(scene, scene.x_rest, seed, 0.1), args)
    assert found.outcome == expected.outcome == outcomes.CONVERGED
    np.testing.assert_allclose(found.x, expected.x, rtol=0, atol=1e-6 * HEIGHT)
    assert np.abs(expected.x - scene.x_rest).max() > 1e-4 * HEIGHT
    held = scene.terms.coordinates.role == HELD
    assert held.sum() > 10
    np.testing.assert_array_equal(found.x[held], scene.x_rest[held])
    assert args.gradient(found.x)[scene.bottom].sum() == pytest.approx(2.0, rel=1e-6)


@pytest.mark.parametrize("loose", ["force", "decrement"])
def test_either_tolerance_alone_brings_it_to_the_minimum(loose):
    """A residual below a large force is not enough if a small one would still move walls far."""
    case, scene, args = loaded()
    expected = descend(case, scene, scene.x_rest, args, force=1e-9, decrement=1e-20)
    tight = {"force": 1e-9, "decrement": 1e-20} | {loose: 1e9}
    found = descend(case, scene, scene.x_rest, args, **tight)
    assert found.outcome == outcomes.CONVERGED
    np.testing.assert_allclose(found.x, expected.x, rtol=0, atol=1e-7 * HEIGHT)


@pytest.mark.parametrize(("share", "settled"), [(0.9, False), (1.1, True)])
def test_a_moment_counts_as_the_force_that_it_is_over_an_element(share, settled):
    """A joint that is turned: the moment on it is larger, so measured, than all forces."""
    case, scene, _ = loaded()
    x = scene.x_rest.copy()
    x[2 * len(scene.mesh.points) + 4] += 1e-3  # the joint in the middle
    args = whole(scene, x, factor=0.0)
    lever = reduction(scene).T @ scene.terms.coordinates.lever
    sizes = np.abs(residual(scene, x, args))
    assert lever[np.argmax(sizes)] == pytest.approx(1.0 / scene.mesh.rest_length.mean())
    allowed = share * sizes.max()
    assert sizes[lever == 1.0].max() < 0.5 * allowed
    found = descend(case, scene, x, args, force=allowed, decrement=1.0)
    assert found.outcome == outcomes.CONVERGED
    assert (found.iterations == 0) == settled


@pytest.mark.parametrize("model", [(-2.0, 0.0), (0.0, -8.0)], ids=["slope", "curvature"])
def test_a_step_must_fall_by_a_share_of_what_its_model_promises(model):
    """Half a step: the model promises 1 J, the search asks for `ARMIJO` of it."""
    start, asked = 1.0, newton.ARMIJO
    assert newton._decreases(start - 1.01 * asked, start, 0.5, model, 0.0)
    assert not newton._decreases(start - 0.99 * asked, start, 0.5, model, 0.0)
    assert newton._decreases(start + 1.9, start, 0.5, model, 2.0)  # round-off hides such a fall
    assert not newton._decreases(start + 2.1, start, 0.5, model, 2.0)


@pytest.mark.parametrize("dt", [1e-3, np.inf])
@pytest.mark.parametrize("seed", range(2))
def test_no_iteration_raises_the_energy(seed, dt):
    """It starts from a crumpled lattice, between platens and with contact."""
    case = grid(5.0, "contact", "barrier")
    scene = build_scene(case)
    args = whole(scene, scene.x_rest, dt=dt)
    x = shaken(scene, scene.x_rest, seed, 0.3)
    x[[-2, -1]] += -1e-3, 1e-3
    energies, outcome = [whole(scene, x, scene.x_rest, dt).energy(x)], outcomes.ITERATIONS
    while outcome == outcomes.ITERATIONS and len(energies) < 300:
        outcome, _, x = descend(case, scene, x, args, iterations=1)
        energies.append(whole(scene, x, scene.x_rest, dt).energy(x))
    assert outcome == outcomes.CONVERGED
    noise = 2.0 * newton.RESOLVED * np.abs(energies[:-1])
    assert np.all(np.diff(energies) <= noise + tolerances(case, scene, ramp(scene, 1, dt)).noise)
    assert is_minimum(case, scene, x, dt, whole(scene, x, scene.x_rest, dt))


def test_too_few_iterations_are_a_failure():
    most = 2
    case, scene, start = straight(BUCKLED)
    start = shaken(scene, start, 0, 0.05)
    args = whole(scene, start)
    found = descend(case, scene, start, args, iterations=most)
    assert (found.outcome, found.iterations) == (outcomes.ITERATIONS, most)
    assert not is_minimum(case, scene, found.x, np.inf, args)
    on = descend(case, scene, found.x, args)
    whole_way = descend(case, scene, start, args)
    assert on.outcome == whole_way.outcome == outcomes.CONVERGED
    assert on.iterations + most == whole_way.iterations


def test_an_interruption_leaves_everything_where_it_is():
    case, scene, args = loaded()
    found = descend(case, scene, scene.x_rest, args, control=np.array([1, 0]))
    assert (found.outcome, found.iterations) == (outcomes.INTERRUPTED, 0)
    np.testing.assert_array_equal(found.x, scene.x_rest)


def test_nodes_in_one_place_leave_the_range_of_numbers():
    case, scene, args = loaded()
    one, two = scene.mesh.edges[-1]
    x = scene.x_rest.copy()
    x[2 * one : 2 * one + 2] = x[2 * two : 2 * two + 2]
    found = descend(case, scene, x, args)
    assert found.outcome == outcomes.NOT_FINITE


@pytest.mark.parametrize("platen", ["glued", "contact"])
def test_a_driven_platen_takes_the_others_along(platen):
    """They move to where the quadratic model is stationary: the residual falls with the square of
    the travel.
    """
    case = Case.of(
        lattice=dict(cells_x=2, cells_y=2),
        material=MATERIAL,
        loading=dict(mode="displacement", strain=0.1, platen=platen),
        contact=dict(friction=0.0),
    )
    scene = build_scene(case)
    start, left = descend(case, scene, scene.x_rest, whole(scene, scene.x_rest)), []
    for way in (4e-6, 2e-6, 1e-6):
        args = whole(scene, start.x)
        found = descend(case, scene, start.x, args, start.x[-1] - way, iterations=1)
        assert found.x[-1] == start.x[-1] - way
        left.append(np.abs(residual(scene, found.x, whole(scene, found.x))).max())
    np.testing.assert_allclose(slopes(left), 2.0, atol=0.2)


def test_a_soft_coordinate_is_not_excused_by_a_stiff_one():
    """The residual may be as large as round-off of the stiff one, but not the energy it can
    release.
    """
    tolerance = Tolerance(1e-9, 1e-12, 1e-15, 1e-16, 100)
    assert allowed(1e17, tolerance) == pytest.approx(10.0)
    assert allowed_decrement(1e17, tolerance, 92) == 1e-12
    assert allowed_decrement(1e20, tolerance, 92) == pytest.approx(9.2e-11)


def test_the_residual_and_its_energy_grow_with_the_largest_force():
    tolerance = Tolerance(1e-9, 1e-12, 1e-15, 1e-16, 100, share=1e-6)
    assert loosened(tolerance, 1e-3) == tolerance
    grown = loosened(tolerance, 2.0)
    assert (grown.force, grown.decrement) == pytest.approx((2e-6, 2e-9))
    assert grown._replace(force=1e-9, decrement=1e-12) == tolerance


@pytest.mark.parametrize("strain", [1e-4, 0.5])
def test_a_crush_is_balanced_to_a_millionth_of_its_force(strain):
    """At any strain, as tolerance and force go with each other."""
    history = run(pressed(3, strain, 10, "contact")).history
    force = history["reaction_top_N"]
    off = np.abs(force - history["reaction_bottom_N"])
    assert 1e-12 < off.max() / force.max() < 1e-5


def test_a_residual_that_positions_do_not_resolve_is_round_off():
    """Steel at rest: the residual is twice what the stiffest coordinate explains, and no step was
    short enough to end.
    """
    case = Case.of(
        lattice=dict(
            kind="hex", orientation="pointy", cells_x=11, cells_y=2, width=149e-3, height=18.6e-3,
            depth=7.12e-3, wall_thickness=0.258e-3, nodes_per_wall=2, imperfection=0.0,
        ),
        material=dict(modulus=141e9, density=3070.0, poisson=0.0, loss=0.561, reference_time=5850),
        loading=dict(mode="displacement", strain=0.0569, speed=3.06e-3),
        solver=dict(load_steps=25, retry=False, time_limit=60.0),
    )  # fmt: skip
    result = converged(case)
    assert result.summary["newton_iterations"] < 1000
