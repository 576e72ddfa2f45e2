"""Orders of accuracy, as slopes: the length of elements, steps in time, Newton."""

import numpy as np
import pytest

from kernels.solve import outcomes
from kernels.terms import friction
from sweep.config.case import Case
from sweep.scene.lattice import build_scene
from tests.support.designs.scenes import TIGHT, pressed, run, slopes
from tests.support.kernels.solving import descend, free_of, residual, whole

ROUND_OFF = 1e-11  # N


def buckled_force(elements, element):
    """Force (N) at 30 % without contact, far past buckling, where every wall bends."""
    case = pressed(elements, 0.3, 24, contact="none", solver={"element": element})
    return run(case).history["reaction_top_N"][-1]


@pytest.mark.parametrize(
    ("element", "meshes", "order", "atol"),
    [("cubic", (2, 4, 8), 4.4, 0.4), ("classical", (6, 12, 24), 2.0, 0.06)],
)
def test_elements_have_their_order(element, meshes, order, atol):
    coarse, fine = (buckled_force(n, "cubic") for n in (12, 24))
    converged = fine + (fine - coarse) / 15
    errors = [buckled_force(n, element) - converged for n in meshes]
    np.testing.assert_allclose(slopes(errors), order, atol=atol)


class Descent:
    """One step of a scene from rest, iteration by iteration; dt: its duration, infinite: static."""

    def __init__(self, case, dt=np.inf):
        self.case, self.dt, self.scene = case, dt, build_scene(case)
        self.x = self.scene.x_rest.copy()

    def whole(self):
        """The minimised potential, with new pairs and without friction."""
        found = whole(self.scene, self.x, self.scene.x_rest, self.dt)
        return found.lagging(friction.none())

    def residual(self):
        """Largest force out of balance, N."""
        return np.abs(residual(self.scene, self.x, self.whole())).max()

    def go_on(self, iterations, target=None):
        """Iterate and return the outcome; target: of the platen (m), where it is if None."""
        found = descend(self.case, self.scene, self.x, self.whole(), target, iterations=iterations)
        self.x = found.x
        return found.outcome

    def residuals(self, travel):
        """Residuals after each iteration of a step down by ``travel`` (m)."""
        target, left, outcome = self.x[-1] - travel, [], outcomes.ITERATIONS
        while outcome == outcomes.ITERATIONS:
            outcome = self.go_on(1, target)
            left.append(self.residual())
        return left


def crushed(**solver):
    """Glued, pressed to 40 %: buckled, and walls touch."""
    descent = Descent(pressed(3, 0.4, 1, solver=solver))
    height = descent.scene.x_rest[-1]
    for strain in np.linspace(0.0, 0.4, 41)[1:]:
        descent.go_on(400, height - 12.5e-3 * strain)
    return descent


def folded():
    """A measured curve under a dead load that its walls do not bear, in one step of 1 ms."""
    lattice, loading = dict(nodes_per_wall=2), dict(mode="force", force=20.0)
    return Descent(Case.of(lattice=lattice, loading=loading), 1e-3)


@pytest.mark.parametrize("scene", [crushed, folded])
def test_newton_is_quadratic_near_a_minimum(scene):
    """The disturbance left by one iteration falls with its square."""
    descent = scene()
    assert descent.go_on(100) == outcomes.CONVERGED
    minimum, left = descent.x.copy(), []
    free, scale = free_of(descent.scene), descent.scene.terms.coordinates.scale
    move = (np.random.default_rng(5).uniform(-1.0, 1.0, minimum.size) / scale)[free]
    for amount in (1e-7, 5e-8, 2.5e-8, 1.25e-8):
        descent.x = minimum.copy()
        descent.x[free] += amount * move
        descent.go_on(1)
        left.append(descent.residual())
    np.testing.assert_allclose(slopes(left), 2.0, atol=0.05)


def test_newton_ends_a_smooth_step_quadratically():
    """Order log(r'' / r') / log(r' / r) of the last residuals above round-off."""
    residuals = crushed().residuals(4e-4)
    falls = np.diff(np.log([size for size in residuals if size > ROUND_OFF]))
    assert residuals[-1] < 1e-9
    assert falls[-1] / falls[-2] == pytest.approx(2.0, abs=0.05)


def test_newton_with_the_tangent_modulus_is_of_first_order():
    """Its last residuals all fall by the same factor."""
    residuals = crushed(hessian="tangent_modulus").residuals(3e-4)[:-1]
    falls = np.diff(np.log(residuals))[-6:]
    np.testing.assert_allclose(falls[1:] / falls[:-1], 1.0, atol=0.02)
    assert 0.2 < np.exp(falls[-1]) < 0.8


def test_tangent_modulus_finds_the_same_minima_in_more_iterations():
    exact, tangent = (
        run(pressed(3, 0.4, 80, solver=TIGHT | {"hessian": hessian, "max_iterations": 400}))
        for hessian in ("exact", "tangent_modulus")
    )
    for name in ("reaction_top_N", "bend_J", "contact_J"):
        scale = np.abs(exact.history[name]).max()
        np.testing.assert_allclose(tangent.history[name], exact.history[name], atol=1e-6 * scale)
    iterations = [result.summary["newton_iterations"] for result in (exact, tangent)]
    assert 4 < iterations[1] / iterations[0] < 9
