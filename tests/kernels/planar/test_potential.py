"""The potential of a step: the sum of all its terms, and its derivatives."""

import numpy as np
import pytest

from kernels.terms import fold, friction, stretch
from tests.support.designs.tables import MATERIAL
from tests.support.kernels.solving import whole
from tests.support.kernels.states import (
    DT,
    RAYLEIGH,
    SLIDE,
    STATES,
    VISCOUS,
    driven,
    leaning,
    loaded,
    step_to,
    struck,
    unit,
)
from tests.support.kernels.terms import (
    NO_MEMORY,
    bending_of,
    damping_of,
    derivative_error,
    of_points,
    of_walls,
    touch_of,
)

STIFF = MATERIAL.model_copy(update={"modulus": 12e15})
EACH = pytest.mark.parametrize(
    ("damping", "dt"),
    [(RAYLEIGH, DT), (VISCOUS, DT), (RAYLEIGH, np.inf)],  # static steps have no damping
    ids=["rayleigh", "viscous", "static"],
)


def error(scene, x, args, step=1e-5):
    return derivative_error(args, x, unit(scene), step)


def single(damping, measure):
    """Walls of one element."""
    solver = dict(time_step=DT, bend_measure=measure, joints="points")
    return loaded(1, damping=damping, solver=solver)


SCENES = {
    "rayleigh": (loaded, DT),
    "static": (loaded, np.inf),
    "viscous": (lambda: loaded(damping=VISCOUS), DT),
    "single": (lambda: single(RAYLEIGH, "angle"), DT),
    "single, viscous": (lambda: single(VISCOUS, "angle"), DT),
    "single, tangent, viscous": (lambda: single(VISCOUS, "tangent"), DT),
    "driven, glued, single": (lambda: driven("glued", 1), np.inf),
    "driven, loose": (lambda: driven("contact"), np.inf),
    "striker and target, glued": (lambda: struck("glued"), DT),
    "striker and target, loose": (lambda: struck("contact"), DT),
    "12 m": (lambda: loaded(size=1e3, damping=VISCOUS), DT),
    "12 um": (lambda: loaded(size=1e-3, damping=VISCOUS), DT),
    "12 PPa": (lambda: loaded(material=STIFF, damping=VISCOUS), DT),
    "sliding": (lambda: loaded(contact=SLIDE), DT),  # beyond the smoothing |u| has no curvature
}


@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("name", SCENES)
def test_derivatives(name, state):
    make, dt = SCENES[name]
    scene = make()
    x = STATES[state](scene, 1)
    assert error(scene, x, step_to(scene, x, 1, dt)) < 1e-9


@pytest.mark.parametrize("state", STATES)
def test_derivatives_with_solid_joints_and_sections(state):
    """The third derivative of a measured curve jumps at its knots."""
    scene = loaded(damping=VISCOUS, material={}, solver=dict(time_step=DT))
    x = STATES[state](scene)
    assert error(scene, x, step_to(scene, x, 0), 1e-6) < 1e-6


@pytest.mark.parametrize("dt", [DT, np.inf])
@pytest.mark.parametrize("elements", [1, 3])
def test_derivatives_at_rest(elements, dt):
    """The material is linear: a measured curve has a kink in its tangent there."""
    scene = loaded(elements, "none", material=MATERIAL)
    assert error(scene, scene.x_rest, whole(scene, scene.x_rest, dt=dt), 1e-4) < 1e-9


def potentials(args):
    """The terms of the kernels by name, each of them by itself."""
    terms, neighbours, x0, slip = args.terms, args.neighbours, args.step.x0, args.slip

    def stretching(shape, resultants, projected):
        return stretch.evaluate(terms.stretch, terms.law, NO_MEMORY, shape, resultants, projected)

    found = {
        "stretch": of_walls(terms.walls, stretching),
        "bend": bending_of(terms.walls, terms.bend, along=terms.stretch),
        "fold": of_points(
            lambda x, g: fold.evaluate(x, terms.fold, g)[0],
            lambda x, matrix: fold.hessian(x, terms.fold, matrix),
        ),
        "contact": touch_of(terms.contact, neighbours.pairs, neighbours.anchor),
        "friction": of_points(
            lambda x, g: friction.evaluate(neighbours.lagged_contacts, x - x0, slip, g),
            lambda x, matrix: friction.hessian(x - x0, neighbours.lagged_contacts, slip, matrix),
        ),
    }
    if args.step.dynamic:
        found["damp"] = damping_of(terms, x0, args.step.h)
    return found


@EACH
def test_the_sum_has_all_terms_and_each_of_them_counts(damping, dt):
    scene = loaded(damping=damping)
    x = leaning(scene)
    args = step_to(scene, x, 0, dt)
    one, load, mass = args.step, scene.terms.coordinates.load, scene.terms.coordinates.mass
    found = potentials(args)
    shares = {name: term.energy(x) for name, term in found.items()}
    shares["load"] = -0.7 * load @ (x - one.x0)
    force = {name: term.gradient(x) for name, term in found.items()}
    force["load"] = -0.7 * load
    stiffness = [term.hessian(x) for term in found.values()]
    if np.isfinite(dt):
        off = x - one.x_pred
        shares["inertia"] = 0.5 * np.sum(mass * off**2) / dt**2
        force["inertia"] = mass * off / dt**2
        stiffness.append(np.diag(mass) / dt**2)
    assert min(np.abs(list(shares.values()))) > 1e-5 * max(shares.values())
    assert args.energy(x) == pytest.approx(sum(shares.values()), rel=1e-12)
    for found, expected in (
        (args.gradient(x), sum(force.values())),
        (args.hessian(x), sum(stiffness)),
    ):
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12 * np.abs(expected).max())


@EACH
def test_what_evaluate_tells_the_book(damping, dt):
    """Stored energies, and the forces by their origin."""
    scene = loaded(damping=damping)
    x = leaning(scene)
    args = step_to(scene, x, 0, dt)
    found, (_, at) = potentials(args), args.found(x)
    stored = [
        found["stretch"].energy(x),
        found["bend"].energy(x) + found["fold"].energy(x),
        found["contact"].energy(x),
    ]
    np.testing.assert_allclose(at.stored, stored, rtol=1e-12)
    elastic = sum(found[name].gradient(x) for name in ("stretch", "bend", "fold", "contact"))
    material = found["damp"].gradient(x) if np.isfinite(dt) else np.zeros_like(x)
    for part, expected in (
        (at.elastic, elastic),
        (at.friction, found["friction"].gradient(x)),
        (at.material, material),
        (at.u, x - args.step.x0),
    ):
        np.testing.assert_allclose(part, expected, rtol=0, atol=1e-12 * np.abs(elastic).max())


@pytest.mark.parametrize("platen", ["none", "contact"])
@pytest.mark.parametrize("elements", [1, 3, 6])
def test_at_rest_there_is_nothing_but_the_load(elements, platen):
    scene = loaded(elements, platen)
    args = whole(scene, scene.x_rest, dt=DT)
    assert abs(args.energy(scene.x_rest)) < 1e-15
    np.testing.assert_allclose(
        args.gradient(scene.x_rest), -scene.terms.coordinates.load, rtol=0, atol=1e-9
    )
