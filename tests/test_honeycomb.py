"""Small-strain moduli of the families: of a periodic cell, exactly, and of a block with free sides.

The cell is cut out of a larger drawing; points a period apart are tied, but for the mean strain.
"""

from unittest.mock import patch

import numpy as np
import pytest

from sweep.lattice import Network, build_network
from sweep.params import Case, Contact, Lattice, Loading, Material, Solver
from sweep.scene import build_scene
from sweep.simulate import simulate
from tests.solving import whole

Y, NU, DEPTH, SIDE = 12e6, 0.3, 10e-3, 1e-3
PLANE = Y / (1 - NU**2)
MATERIAL = Material(modulus=Y, density=1e3, poisson=NU)
ROOT3 = 3**0.5

CELLS = {  # pitch of a cell / length of a wall, and where the cells of (4, 4) end
    "hex": ((ROOT3, 1.5), (4.5 * ROOT3, 6.5)),
    "square": ((1.0, 1.0), (4.0, 4.0)),
    "triangle": ((1.0, ROOT3 / 2), (4.0, 2 * ROOT3)),
    "kagome": ((2.0, ROOT3), (9.0 - 1.0, 4 * ROOT3)),
}


def lattice_of(kind, way, slenderness, **changes):
    size = [SIDE * length for length in CELLS[kind][1]]
    cells = {"cells_x": 4, "cells_y": 4, "wall_thickness": slenderness * SIDE, "imperfection": 0.0}
    if way == "flat":
        size.reverse()
    oriented = {"orientation": way} if kind == "hex" else {}
    box = {"width": size[0], "height": size[1], "depth": DEPTH}
    return Lattice(kind=kind, **(oriented | cells | box | changes))


def periodic(network, period):
    """The walls with their middles in one period of the inside, and the joints that they have."""
    middle = network.points[network.walls].mean(axis=1)
    low = 0.5 * np.ptp(network.points, axis=0) - 0.5 * period + [0.013 * SIDE, 0.017 * SIDE]
    inside = np.all((middle >= low) & (middle < low + period), axis=1)
    joints, walls = np.unique(network.walls[inside], return_inverse=True)
    ends = np.array([0])
    return Network(
        network.points[joints], walls.reshape(-1, 2), network.wall_thickness[inside], ends, ends
    )


def moduli(kind, way, slenderness):
    """Young's moduli in x and y (Pa) of the endless lattice."""
    lattice = lattice_of(kind, way, slenderness)
    period = SIDE * np.array(CELLS[kind][0]) * [1, 2]
    period = period[::-1] if way == "flat" else period
    cell = periodic(build_network(lattice), period)
    case = Case(
        lattice=lattice,
        material=MATERIAL,
        loading=Loading(force=1.0),
        contact=Contact(model="none"),
    )
    with patch("sweep.scene.build_network", lambda _: cell):
        scene = build_scene(case)
    hessian = whole(scene, scene.x_rest).hessian(scene.x_rest)
    points, n_joints = scene.mesh.points, scene.mesh.n_joints
    phase = np.round(np.mod(points / period + 0.01, 1.0), 6)
    _, first, image = np.unique(phase, axis=0, return_index=True, return_inverse=True)
    n, k = len(points), len(first)
    follow = np.zeros((len(hessian), 3 * k + 3))  # of u, v and phi of the images, and the strains
    nodes, image = np.arange(n), image.ravel()
    for axis in range(2):
        follow[2 * nodes + axis, axis * k + image] = 1.0
        follow[2 * nodes + axis, 3 * k + axis] = points[:, axis]
    follow[2 * nodes, 3 * k + 2] = points[:, 1]
    follow[2 * n + np.arange(n_joints), 2 * k + image[:n_joints]] = 1.0
    stiffness = follow.T @ hessian @ follow
    inner, mean = stiffness[: 3 * k, : 3 * k], stiffness[: 3 * k, 3 * k :]
    relaxed = stiffness[3 * k :, 3 * k :] - mean.T @ np.linalg.pinv(inner, rcond=1e-12) @ mean
    compliance = np.linalg.inv(relaxed / (DEPTH * period.prod()))
    return 1.0 / np.diag(compliance)[:2]


def honeycomb(t):
    return 4 / ROOT3 * t**3 / (1 + 3 * t**2) * PLANE


@pytest.mark.parametrize("slenderness", [0.05, 0.1])
@pytest.mark.parametrize("way", ["pointy", "flat"])
def test_regular_honeycomb_is_as_stiff_as_its_closed_form(way, slenderness):
    """In both directions: 4/sqrt(3) (t/L)^3 / (1 + 3 (t/L)^2) Y'."""
    found = moduli("hex", way, slenderness)
    np.testing.assert_allclose(found, honeycomb(slenderness), rtol=1e-6)


def test_square_grid_is_as_stiff_as_its_walls():
    np.testing.assert_allclose(moduli("square", None, 0.1), 0.1 * PLANE, rtol=1e-6)


@pytest.mark.parametrize(("kind", "share"), [("triangle", 2 / ROOT3), ("kagome", 1 / ROOT3)])
def test_triangles_are_as_stiff_as_their_walls_stretch(kind, share):
    """Y' t/L times 2/sqrt(3), 1/sqrt(3): a third of the relative density; bending adds (t/L)^2."""
    np.testing.assert_allclose(moduli(kind, None, 0.02), 0.02 * share * PLANE, rtol=1e-3)


def block(cells, t):
    """Tangent modulus of a regular block between loose platens without friction, sides free."""
    lattice = lattice_of("hex", "pointy", t, cells_x=cells, cells_y=cells, nodes_per_wall=0)
    width, height = (cells + 0.5) * ROOT3 * SIDE, (1.5 * cells + 0.5) * SIDE
    result = simulate(
        Case(
            lattice=lattice.model_copy(update={"width": width, "height": height}),
            material=MATERIAL,
            loading=Loading(mode="displacement", strain=1e-4, unload=False, platen="contact"),
            contact=Contact(model="none", friction=0.0),
            solver=Solver(load_steps=2),
        )
    )
    assert result.status == "converged"
    force = result.history["reaction_top_N"]
    return (force[-1] - force[-2]) / (width * DEPTH) / 0.5e-4


@pytest.mark.parametrize("slenderness", [0.05, 0.1])
def test_a_block_tends_to_the_endless_honeycomb_as_it_grows(slenderness):
    """Its free edges are soft, and their share falls as 1 / cells: two sizes give the limit."""
    small, large = (block(cells, slenderness) for cells in (8, 16))
    assert small < large < honeycomb(slenderness)
    assert 2 * large - small == pytest.approx(honeycomb(slenderness), rel=5e-3)
