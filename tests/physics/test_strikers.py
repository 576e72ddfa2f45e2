"""Strikers and ribs: exact beams, wide strikers as platens, momentum, walls that never pass."""

from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from shapely import Polygon

from kernels.solve import integrators
from kernels.solve.outcomes import CONVERGED
from kernels.terms import profile, stretch
from sweep.config.case import Case
from sweep.design.profile import circle
from sweep.scene.lattice import build_scene
from sweep.scene.loading import stages
from tests.studies.continuum.indented import MESHES, PLACES, network, stored
from tests.support.converged import converged
from tests.support.kernels.frames import bend_of, fibre_of, frame, linear_law, stretch_of, walls_of
from tests.support.kernels.profiles import below
from tests.support.kernels.solving import go_on
from tests.support.kernels.terms import NO_MEMORY, bending_of, of_points, of_walls

PANEL = dict(cells_x=6, cells_y=3, width=25e-3, height=12.5e-3)
STATIC = dict(mode="displacement", platen="contact", strain=0.3, unload=False)
NONE = dict(model="none")
STORED = ("stretch", "bend", "contact")


def curve(**loading):
    """Strain and force of a crush of the panel, of squares by default."""
    kind, friction = loading.pop("kind", "square"), loading.pop("friction", 0.3)
    case = Case.of(
        lattice=PANEL | dict(kind=kind),
        loading=STATIC | loading,
        contact=dict(friction=friction),
        solver=dict(load_steps=100),
    )
    history = converged(case).history
    return history["strain"], history["reaction_top_N"]


@pytest.mark.parametrize("kind", ["hex", "square"])
def test_a_striker_as_wide_as_the_panel_is_a_platen(kind):
    """A punch that ends beside the outer walls, and a circle of ten metres."""
    strain, flat = curve(kind=kind)
    _, wide = curve(kind=kind, striker="punch", striker_width=28e-3, striker_tip=0.5e-3)
    _, huge = curve(kind=kind, striker="round", striker_radius=10.0)
    np.testing.assert_allclose(wide, flat, atol=1e-3 * flat.max())
    late = 25e-3**2 / (8.0 * 10.0) / 12.5e-3  # strain until the circle touches the sides
    assert np.all(
        np.abs(huge - flat) < late * np.abs(np.gradient(flat, strain)) + 2e-3 * flat.max()
    )


class Beam:
    """A wall with clamped ends that may come nearer to each other, under one profile or on two.

    Lengths in mm, forces in N; half: half its length. It is put together from terms, and solved by
    Newton's method, apart from the solver of a run.
    """

    half = 10.0

    def __init__(self, shape, pieces=40, thickness=0.2):
        self.of = frame([(-self.half, 0.0), (self.half, 0.0)], [(0, 1)], pieces, thickness)
        law, walls = fibre_of(linear_law(self.of.modulus)), walls_of(self.of)
        self.rigidity, touch = float(self.of.rigidity[0]), below(self.of, shape)
        self.profiles, n = touch.profiles, len(self.of.points)

        def along(shape, resultants, projected):
            return stretch.evaluate(
                stretch_of(self.of), law, NO_MEMORY, shape, resultants, projected
            )

        def pushed(x, g):
            return profile.evaluate(x, self.profiles, touch.stiffness, g)

        def second(x, matrix):
            profile.hessian(x, self.profiles, touch.stiffness, matrix)

        self.terms = [
            of_walls(walls, along, self.of.rest),
            bending_of(walls, bend_of(self.of), self.of.rest),
        ]
        self.terms.append(of_points(pushed, second))
        middle = int(np.argmin(np.abs(self.of.points[:, 0])))
        held = [2 * middle, 1, 3, 2 * n, 2 * n + 1, 3 * n, 3 * n + 1]
        self.free = np.setdiff1d(np.arange(self.of.rest.size), held)

    def settled(self, x, tip):
        """Equilibrium with the tip of the profile at a height, from ``x``, in small steps."""
        for height in np.linspace(x[-1], tip, 20)[1:]:
            x = x.copy()
            x[-1] = height
            for _ in range(60):
                g = sum(term.gradient(x) for term in self.terms)
                h = sum(term.hessian(x) for term in self.terms)
                move = np.zeros_like(x)
                move[self.free] = -np.linalg.solve(h[np.ix_(self.free, self.free)], g[self.free])
                x = x + profile.step_limit(x, move, self.profiles) * move
                if np.abs(move).max() < 1e-10:
                    break
            assert np.abs(g[self.free]).max() < 1e-7
        return x

    def force(self, x):
        """Force of the striker, N."""
        return -self.terms[-1].gradient(x)[-1]


@pytest.mark.parametrize("depth", [0.05, 0.25])
def test_a_clamped_wall_under_a_round_striker_is_an_exact_beam(depth):
    """With half a length a, in contact over 2 c, b = a - c: the beam follows the circle inside and
    bears 2 forces at its ends. F = 4 Y I a / (R b^2), indentation a^2 / (2 R) - a b / (3 R); with a
    shallow one c = 0, and F = 24 Y I d / a^3. R: to the centre line.
    """
    beam, radius = Beam(circle(0.0, 80.0)), 80.0
    x = beam.of.rest.copy()
    x[-1] = 0.1
    x = beam.settled(x, -depth)
    gap = profile.least_gap(x, beam.profiles)
    sunk, r, a = depth + gap, radius + gap, beam.half
    if sunk <= a**2 / (6.0 * r):
        exact = 24.0 * beam.rigidity * sunk / a**3
    else:
        b = 3.0 * r / a * (a**2 / (2.0 * r) - sunk)
        exact = 4.0 * beam.rigidity * a / (r * b**2)
    assert (sunk > 1.5 * a**2 / (6.0 * r)) == (depth > 0.2)
    assert beam.force(x) == pytest.approx(exact, rel=0.01)


def _impact(**loading):
    """Scene, rows, frames and the last state of the impact of a case, by backward Euler."""
    case = Case.of(
        lattice=PANEL | dict(kind="hex"),
        loading=dict(mode="impact", striker_speed=3.0, platen="contact") | loading,
        damping=NONE,
        solver=dict(integrator="backward_euler", time_step=1e-5, tolerance=1e-9),
    )
    scene, count = build_scene(case), 800
    stage = stages(case, scene)[0].stage._replace(steps=count, scheme=integrators.BACKWARD_EULER)
    state, frames = scene.at_rest(), np.zeros((count, scene.x_rest.size))
    state.v[:] = scene.velocity
    outcome, rows = go_on(case, scene, state, stage, frames=frames)
    assert (outcome, len(rows)) == (CONVERGED, count)
    return SimpleNamespace(case=case, scene=scene, rows=rows, frames=frames, v=state.v)


@pytest.mark.parametrize("loading", [
    dict(striker="round"), dict(striker="edge", striker_at=0.3, platen="glued"),
    dict(striker="punch", base="ribs", base_span=18e-3),
], ids=["round", "edge", "on ribs"])  # fmt: skip
def test_momentum_and_energy_of_an_impact(loading):
    """The impulse on the base is the change of the momentum of striker and lattice."""
    of = _impact(**loading)
    mass, n = of.scene.terms.coordinates.mass, 2 * len(of.scene.mesh.points)
    times = np.diff(of.rows["time"], prepend=0.0)
    gained = mass[1:n:2] @ of.v[1:n:2] + mass[-1] * (of.v[-1] - of.scene.velocity[-1])
    borne = times @ of.rows["reaction_bottom"]
    assert borne > 0.1
    assert gained == pytest.approx(borne, rel=1e-7)
    book = of.rows[-1]
    kinetic = 0.5 * mass @ of.v**2
    start = 0.5 * mass[-1] * of.scene.velocity[-1] ** 2
    spent = sum(book[k] for k in (*STORED, "friction", "integrator", "material"))
    assert start - kinetic == pytest.approx(spent, abs=1e-5 * start)


def inside(of) -> int:
    """How many elements of the frames are inside the striker, by polygons of its outline."""
    points = of.scene.network.points
    left, width, height = points[:, 0].min(), *np.ptp(points, axis=0)
    (shape,) = of.case.loading.profiles("striker", left, width, height)
    outline, n = shape.outline(), 2 * len(of.scene.mesh.points)
    count = 0
    for x in of.frames:
        body = Polygon(outline + np.array([0.0, x[-1]])).buffer(-1e-6)
        lines = shapely.linestrings(x[:n].reshape(-1, 2)[of.scene.mesh.edges])
        count += np.count_nonzero(shapely.intersects(lines, body))
    return count


@pytest.mark.parametrize("loading", [
    dict(striker="edge", striker_tip=0.0, striker_angle=0.4, striker_speed=12.0),
    dict(striker="edge", striker_tip=0.0, striker_angle=2.5, striker_at=0.07, striker_speed=8.0),
    dict(striker="punch", striker_tip=0.0, striker_width=2e-3, striker_at=0.62, striker_speed=10.0),
    dict(striker="round", striker_radius=0.3e-3, striker_at=0.55, striker_speed=6.0),
], ids=["sharp and fast", "oblique at the side", "corners", "thin"])  # fmt: skip
def test_no_wall_passes_through_a_striker(loading):
    of = _impact(**loading)
    assert of.rows["gap"].min() > 0.0
    assert inside(of) == 0
    assert of.frames[:, -1].min() < 0.7 * of.scene.x_rest[-1]  # it went deep


@pytest.mark.parametrize("at", PLACES)
def test_a_round_striker_against_plane_finite_elements(at):
    """Strikers beside a joint and between two; the coarser solid is within 2.5 % of the finer
    one.
    """
    strain, force = stored()[round(at, 4), MESHES[-1]]
    coarser = stored()[round(at, 4), MESHES[0]][1]
    np.testing.assert_allclose(coarser, force, atol=0.025 * force.max())
    ours = np.interp(strain, *network(at, 8))
    np.testing.assert_allclose(ours, force, atol=0.05 * force.max())


def test_ribs_carry_a_panel_that_bends_between_them():
    """A wider span is softer, by less than its third power, as the panel shears too."""
    soft = [
        np.interp(0.02, *curve(striker="round", base="ribs", base_span=span, strain=0.05))
        for span in (12e-3, 22e-3)
    ]
    assert soft[0] > 1.5 * soft[1]
