"""Buckling of endless lattices: closed forms for the square grid and the honeycomb."""

from dataclasses import replace

import numpy as np
import pytest

from sweep.scene import periodic
from sweep.simulation.simulate import simulate
from tests.support.designs.periods import DEPTH, PLANE, L, follow, lattice_of, pressed
from tests.support.kernels.solving import whole

THIN = 0.02


def hinged(scene):
    """The scene whose walls have no moments at joints: free ends have 3 Y I / h and no k12."""
    bend, at_joint = scene.terms.bend, scene.mesh.n_joints > scene.mesh.edges.T
    k11, k12, k22 = bend.stiffness
    stiffness = np.stack([
        np.where(at_joint[0], 0.0, np.where(at_joint[1], 0.75 * k11, k11)),
        np.where(at_joint.any(axis=0), 0.0, k12),
        np.where(at_joint[1], 0.0, np.where(at_joint[0], 0.75 * k22, k22)),
    ])  # fmt: skip
    arc = np.where(at_joint.any(axis=0), 0.0, scene.terms.stretch.arc)  # of the chord: phi is held
    return replace(
        scene,
        terms=scene.terms._replace(
            bend=bend._replace(stiffness=stiffness), stretch=scene.terms.stretch._replace(arc=arc)
        ),
    )


def stability(case, held, pinned):
    """Least curvature of the straight square grid as a function of stress / (Y' (t/L)^3)."""
    scene = periodic.build_periodic(case)
    if pinned:
        scene = hinged(scene)
    nodes, joints = len(scene.mesh.points), np.arange(scene.mesh.n_joints)
    fixed = {"x": 2 * joints, "rotation": 2 * nodes + joints}
    follows = follow(scene)[:, :-1]
    for way in held:
        follows = follows[:, ~follows[fixed[way]].any(axis=0)]

    def least(stress):
        x, strain = scene.x_rest.copy(), stress * THIN**2
        x[1 : 2 * nodes : 2] *= 1.0 - strain
        x[-1] *= 1.0 - strain
        curvature = follows.T @ whole(scene, x).hessian(x) @ follows
        return np.linalg.eigvalsh(curvature)[0]

    return least


def grid(cells, nodes_per_wall):
    lattice = lattice_of("square", cells, THIN, imperfection=0.0, nodes_per_wall=nodes_per_wall)
    return pressed(lattice, strain=2.0 * THIN**2, steps=200, model="none")


@pytest.mark.parametrize(
    ("cells", "expected", "held", "pinned"),
    [
        ((2, 2), 0.822, [], False),  # rows sway against one another: joints do not turn
        ((2, 2), 1.372, ["x"], False),
        ((1, 1), 0.822, ["x", "rotation"], True),
        ((1, 1), 3.29, ["x", "rotation"], False),
    ],
    ids=["alternate sway", "no sway", "hinged walls", "clamped row"],
)
def test_square_grid_buckles_as_its_closed_forms(cells, expected, held, pinned):
    straight = stability(grid(cells, 5), held, pinned)
    assert straight(0.98 * expected) > 0.0 > straight(1.02 * expected)


def dispersion(rho, rows):
    """Zero at the load rho (EI / L^2) of a sway whose wave is so many rows long.

    Stability functions s and c of columns; beams turn alike at both ends.
    """
    k, q = np.sqrt(rho), 2 * np.pi / rows
    below = 2 - 2 * np.cos(k) - k * np.sin(k)
    s, sc = k * (np.sin(k) - k * np.cos(k)) / below, k * (k - np.sin(k)) / below
    joint, row = 12 + 2 * s + 2 * sc * np.cos(q), 2 * (s + sc) - rho
    return joint * row - (2 * (s + sc) * np.cos(q / 2)) ** 2


@pytest.mark.parametrize("rows", [2, 4, 8, 24])
def test_a_crush_meets_the_longest_sway_that_the_period_has_room_for(rows):
    """The mean shear is held at zero: the longer the period, the lower the load, 0.474 in the
    limit.
    """
    result = simulate(grid((1, rows), 3))
    history = result.history
    bent = np.flatnonzero(history["bend_J"] > 1e-6 * history["stretch_J"].max())[0]
    found = history["reaction_top_N"][bent] / (L * DEPTH * PLANE * THIN**3)
    rho = np.linspace(1.0, 12.0, 2000)
    expected = rho[np.flatnonzero(np.diff(np.sign(dispersion(rho, rows))))[0]] / 12
    assert found == pytest.approx(expected, rel=0.02)
    assert rows < 24 or found == pytest.approx(0.474, rel=0.02)


def test_honeycomb_collapses_as_its_closed_form():
    """Elastic collapse stress 0.226 (t/L)^3 Y'; it rises a little as cells fold."""
    side = 0.6 * L
    lattice = lattice_of("hex", (2, 4), THIN * 0.6)
    result = simulate(pressed(lattice, strain=0.25, model="none"))
    stress = result.history["reaction_top_N"] / (lattice.width * DEPTH * PLANE * THIN**3)
    folding = result.history["strain"] > 0.12
    assert side * THIN == pytest.approx(lattice.wall_thickness)
    assert np.mean(stress[folding]) == pytest.approx(0.226, rel=0.05)
