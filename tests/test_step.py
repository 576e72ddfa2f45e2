"""What a step minimises: the sum of all its terms, its derivatives, its matrix, its limits."""

import numpy as np
import pytest

from kernels import bend, contact, damp, fold, friction, stretch
from sweep.params import Case, Contact, Damping, Lattice, Loading, Material, Solver
from sweep.scene import build_scene
from tests.figures import MATERIAL
from tests.solving import WHOLE, assembled, limit, reduction, whole
from tests.terms import derivative_error, gradient_of, hessian_of

DT = 1e-3
RAYLEIGH = Damping(model="rayleigh", mass=300.0, stiffness=1e-3)
VISCOUS = Damping(model="kelvin_voigt", relaxation_time=1e-3)
DAMPINGS = pytest.mark.parametrize(
    "damping", [RAYLEIGH, VISCOUS], ids=lambda damping: damping.model
)
CURVE, STIFF = Material(name="ninjaflex"), MATERIAL.model_copy(update={"modulus": 12e15})
SIZE = 12.5e-3
GRIP = Contact(friction=0.3, slip_speed=0.1)  # smoothed below 0.1 mm in a step
SLIDE = Contact(friction=0.3, slip_speed=1e-4)


def loaded(elements=3, platen="contact", damping=RAYLEIGH, size=1.0, **tables):
    """A 2 x 2 grid, ``size`` times as large as the usual one, under as much stress as by 3 N."""
    lattice = Lattice(
        cells_x=2, cells_y=2, nodes_per_wall=elements - 1, width=size * SIZE, height=size * SIZE,
        depth=size * 12e-3, wall_thickness=size * 1.2e-3,
    )  # fmt: skip
    loading = Loading(force=3.0 * size**2, platen=platen, duration=0.01)
    chosen = {"material": CURVE, "contact": GRIP, "solver": Solver(time_step=DT)} | tables
    return build_scene(Case(lattice=lattice, loading=loading, damping=damping, **chosen))


def driven(platen, elements=3):
    """The same grid, pressed quasi-statically."""
    return build_scene(
        Case(
            lattice=Lattice(cells_x=2, cells_y=2, nodes_per_wall=elements - 1),
            loading=Loading(mode="displacement", strain=0.5, platen=platen),
            material=CURVE,
        )
    )


def unit(scene):
    """Size of a coordinate (n,): the length of an element, 1 rad."""
    size = np.full(scene.x_rest.size, scene.mesh.rest_length.mean())
    size[2 * len(scene.mesh.points) : -2] = 1.0
    return size


def nodes(scene, x):
    """View of the nodes (n, 2) of a state."""
    return x[: 2 * len(scene.mesh.points)].reshape(-1, 2)


def shaken(scene, x, seed, amount):
    """State ``x`` with all but the platens moved at random, in units of each coordinate."""
    move = amount * np.random.default_rng(seed).uniform(-1, 1, x.size)
    move[-2:] = 0.0
    return x + unit(scene) * move


def bent(scene, seed=0):
    return pressed(scene, shaken(scene, scene.x_rest, seed, 0.2))


def pinched(scene, seed=0):
    """The side walls of the lower left cell bulge inwards until they touch; platens press."""
    x, t = scene.x_rest.copy(), scene.mesh.thickness[0]
    points = nodes(scene, x)
    size = np.ptp(points, axis=0)
    for side, way in ((0.0, 1.0), (0.5, -1.0)):
        high = points[:, 1] / size[1]
        inner = (abs(points[:, 0] / size[0] - side) < 0.05) & (high > 0.1) & (high < 0.4)
        points[inner, 0] += way * (0.25 * size[0] - 0.35 * t)
    return pressed(scene, shaken(scene, x, seed, 0.03))


def leaning(scene, seed=0):
    """Cells sheared until their corners open by 11 degrees: folds act, and walls touch."""
    x = scene.x_rest.copy()
    points, lean = nodes(scene, x), np.radians(79.0)
    points[:] = np.column_stack(
        [points[:, 0] + points[:, 1] * np.sin(lean), points[:, 1] * np.cos(lean)]
    )
    return pressed(scene, shaken(scene, x, seed, 0.02))


def pressed(scene, x):
    """The platens moved to where they touch the outer nodes."""
    y, t = nodes(scene, x)[:, 1], scene.mesh.thickness[0]
    x[-2:] = y.min() - 0.3 * t, y.max() + 0.3 * t
    return x


STATES = {"bent": bent, "pinched": pinched, "leaning": leaning}


def step_to(scene, x, seed, dt=DT):
    """A step that ends in ``x``: from nearby, at a random velocity."""
    x0 = shaken(scene, x, 100 + seed, 0.02)
    x0[-2:] += 0.02 * unit(scene)[-2:]
    v = 200.0 * unit(scene) * np.random.default_rng(200 + seed).uniform(-1, 1, x.size)
    return whole(scene, x, x0, dt, v if np.isfinite(dt) else None, 0.7)


def error(scene, x, args, step=1e-5):
    return derivative_error(WHOLE, args, x, unit(scene), step)


@pytest.mark.parametrize("dt", [DT, np.inf])
@DAMPINGS
@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("seed", range(2))
def test_derivatives(seed, state, damping, dt):
    scene = loaded(damping=damping)
    x = STATES[state](scene, seed)
    assert error(scene, x, step_to(scene, x, seed, dt)) < 1e-9


@pytest.mark.parametrize("dt", [DT, np.inf])
@pytest.mark.parametrize("elements", [1, 3])
def test_derivatives_at_rest(elements, dt):
    """Of a linear material: a measured curve has a kink in its tangent there."""
    scene = loaded(elements, "none", material=MATERIAL)
    assert error(scene, scene.x_rest, whole(scene, scene.x_rest, dt=dt), 1e-4) < 1e-9


@pytest.mark.parametrize("measure", ["angle", "tangent"])
@DAMPINGS
@pytest.mark.parametrize("state", ["bent", "leaning"])
def test_derivatives_of_single_elements(state, damping, measure):
    scene = loaded(1, damping=damping, solver=Solver(time_step=DT, bend_measure=measure))
    x = STATES[state](scene)
    assert error(scene, x, step_to(scene, x, 0)) < 1e-9


@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize(("platen", "elements"), [("glued", 1), ("contact", 3)])
def test_derivatives_under_a_driven_platen(platen, elements, state):
    scene = driven(platen, elements)
    x = STATES[state](scene)
    assert error(scene, x, step_to(scene, x, 0, np.inf)) < 1e-9


@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize(
    ("size", "material"), [(1e3, CURVE), (1e-3, CURVE), (1.0, STIFF)], ids=["m", "um", "PPa"]
)
def test_derivatives_in_other_units(size, material, state):
    scene = loaded(size=size, material=material, damping=VISCOUS)
    x = STATES[state](scene)
    assert error(scene, x, step_to(scene, x, 0)) < 1e-9


def test_derivatives_while_walls_slide():
    """Beyond the smoothing only the size of friction is left: |u| has no curvature."""
    scene = loaded(contact=SLIDE)
    x = leaning(scene)
    assert error(scene, x, step_to(scene, x, 0)) < 1e-9


def potentials(x, terms, step, near):
    """The terms of the kernels with their arguments, by name."""
    found = {
        "stretch": (stretch, (terms.stretch, terms.law)),
        "bend": (bend, (terms.bend,)),
        "fold": (fold, (terms.fold,)),
        "contact": (contact, (terms.contact, near.pairs)),
        "friction": (friction, (step.x0, step.grips, terms.friction.slip)),
    }
    if np.isfinite(step.dt):
        found["damp"] = damp, (step.x0, terms, step.dt)
    return found


@pytest.mark.parametrize("dt", [DT, np.inf])
@DAMPINGS
def test_the_sum_has_all_terms_and_each_of_them_counts(damping, dt):
    scene = loaded(damping=damping)
    x = leaning(scene)
    args = step_to(scene, x, 0, dt)
    terms, step, _ = args
    found = potentials(x, *args)
    shares = {name: kernel.energy(x, *rest) for name, (kernel, rest) in found.items()}
    shares["load"] = -0.7 * terms.load @ (x - step.x0)
    force = {name: gradient_of(kernel, rest, x) for name, (kernel, rest) in found.items()}
    force["load"] = -0.7 * terms.load
    stiffness = [hessian_of(kernel, rest, x) for kernel, rest in found.values()]
    if np.isfinite(dt):
        off = x - step.x_pred
        shares["inertia"] = 0.5 * np.sum(terms.mass * off**2) / dt**2
        force["inertia"] = terms.mass * off / dt**2
        stiffness.append(np.diag(terms.mass) / dt**2)
    assert min(np.abs(list(shares.values()))) > 1e-5 * max(shares.values())
    assert WHOLE.energy(x, *args) == pytest.approx(sum(shares.values()), rel=1e-12)
    for found, expected in (
        (gradient_of(WHOLE, args, x), sum(force.values())),
        (hessian_of(WHOLE, args, x), sum(stiffness)),
    ):
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12 * np.abs(expected).max())


@pytest.mark.parametrize("platen", ["none", "contact"])
@pytest.mark.parametrize("elements", [1, 3, 6])
def test_at_rest_there_is_nothing_but_the_load(elements, platen):
    scene = loaded(elements, platen)
    args = whole(scene, scene.x_rest, dt=DT)
    assert abs(WHOLE.energy(scene.x_rest, *args)) < 1e-15
    np.testing.assert_allclose(
        gradient_of(WHOLE, args, scene.x_rest), -scene.terms.load, rtol=0, atol=1e-9
    )


SCENES = {
    "untouched": lambda: loaded(platen="none", contact=Contact(model="none")),
    "single elements": lambda: loaded(1, "none", contact=Contact(model="none")),
    "free top": lambda: loaded(platen="none"),
    "loose platen": loaded,
    "driven and glued": lambda: driven("glued"),
    "driven and loose": lambda: driven("contact"),
}


@pytest.mark.parametrize("projected", [False, True])
@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("name", SCENES)
def test_the_matrix_has_room_for_all_that_is_free(name, state, projected):
    """R^T H R: rows that move together are one, rows that are held have gone."""
    scene = SCENES[name]()
    x = STATES[state](scene)
    args = step_to(scene, x, 0, np.inf)
    R = reduction(scene)
    expected = R.T @ hessian_of(WHOLE, args, x, projected) @ R
    np.testing.assert_allclose(
        assembled(x, args, projected), expected, rtol=0, atol=1e-12 * np.abs(expected).max()
    )


@pytest.mark.parametrize("dt", [DT, np.inf])
@DAMPINGS
@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("seed", range(3))
def test_projected_hessian_is_semi_definite(seed, state, damping, dt):
    scene = loaded(damping=damping)
    x = STATES[state](scene, seed)
    args, size = step_to(scene, x, seed, dt), unit(scene)
    exact, projected = (
        hessian_of(WHOLE, args, x, how) * np.outer(size, size) for how in (False, True)
    )
    values = np.linalg.eigvalsh(projected)
    assert values[0] > -1e-12 * values[-1]
    assert np.abs(exact - projected).max() > 1e-6 * values[-1]


def moving(scene, which, by):
    """A move of one node by (dx, dy), or of the upper platen by dy."""
    dx = np.zeros(scene.x_rest.size)
    moved = dx[-1:] if which is None else nodes(scene, dx)[which]
    moved[:] = by
    return dx


def node_at(scene, x, y):
    return np.argmin(np.linalg.norm(scene.mesh.points - (x, y), axis=1))


def one_cell(platen):
    """A cell of 10 mm with walls of two elements; without a platen, without contact."""
    return build_scene(
        Case(
            lattice=Lattice(
                cells_x=1, cells_y=1, nodes_per_wall=1, width=0.01, height=0.01, imperfection=0.0
            ),
            loading=Loading(platen=platen),
            contact=Contact(model="none" if platen == "none" else "barrier"),
        )
    )


@pytest.mark.parametrize(
    ("platen", "start", "by", "share"),
    [
        ("contact", (0.0, 5e-3), (1e-3, 0.0), 1.0),  # nothing in the way
        ("contact", (0.0, 5e-3), (20e-3, 0.0), 0.9 * 0.5),  # to the opposite wall
        ("none", (0.0, 5e-3), (20e-3, 0.0), 1.0),  # through it
        ("none", (0.0, 5e-3), (0.0, 10e-3), 0.9 * 0.5),  # along its wall: a tenth is left
        ("none", (0.0, 5e-3), (10e-3, -10e-3), 0.9 * 0.5),  # until a corner closes
        ("contact", (5e-3, 0.0), (0.0, -8e-4), 0.9 * 0.5),  # through the lower platen
        ("contact", None, -8e-4, 0.9 * 0.5),  # the upper platen through a wall
    ],
)
def test_limits_of_a_step(platen, start, by, share):
    scene = one_cell(platen)
    which = None if start is None else node_at(scene, *start)
    found = limit(scene, scene.x_rest, moving(scene, which, by))
    assert found == pytest.approx(share, rel=1e-9)
