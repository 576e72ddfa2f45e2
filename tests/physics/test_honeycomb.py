"""Small-strain moduli of the families: of an endless lattice, and of a block with free sides."""

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.simulation.simulate import simulate
from tests.support.designs.tables import material_with

Y, NU, DEPTH, SIDE = 12e6, 0.3, 10e-3, 1e-3
PLANE = Y / (1 - NU**2)
MATERIAL = material_with(modulus=Y, density=1e3, poisson=NU)
ROOT3 = 3**0.5
STRAIN = 1e-6

PITCH = {  # of a cell / length of a wall
    "hex": (ROOT3, 1.5),
    "square": (1.0, 1.0),
    "triangle": (1.0, ROOT3 / 2),
    "kagome": (2.0, ROOT3),
}


def endless(kind, way, slenderness, cells=(2, 2), strain=STRAIN, **chosen):
    """A period of so many cells, pressed; ``slenderness`` of its walls."""
    pitch = PITCH[kind][::-1] if way == "flat" else PITCH[kind]
    width, height = (SIDE * n * length for n, length in zip(cells, pitch, strict=True))
    lattice = dict(
        kind=kind, orientation=way, boundary="periodic", cells_x=cells[0], cells_y=cells[1],
        width=width, height=height, depth=DEPTH, wall_thickness=slenderness * SIDE,
        imperfection=0.0,
    )  # fmt: skip
    return simulate(
        Case.of(
            lattice=lattice,
            material=MATERIAL,
            loading=dict(mode="displacement", strain=strain, unload=False),
            solver=dict(load_steps=1, joints="points"),
            **chosen,
        )
    )


def modulus(kind, way, slenderness, **chosen):
    """Young's modulus (Pa) of the endless lattice in y: nothing holds it sideways."""
    result = endless(kind, way, slenderness, **chosen)
    assert result.status == "converged"
    area = result.summary["width_m"] * DEPTH
    return result.history["reaction_top_N"][-1] / area / STRAIN


def honeycomb(t):
    return 4 / ROOT3 * t**3 / (1 + 3 * t**2) * PLANE


@pytest.mark.parametrize("slenderness", [0.05, 0.1])
@pytest.mark.parametrize("way", ["pointy", "flat"])
def test_regular_honeycomb_is_as_stiff_as_its_closed_form(way, slenderness):
    """The modulus in both directions is 4/sqrt(3) (t/L)^3 / (1 + 3 (t/L)^2) Y'."""
    found = modulus("hex", way, slenderness)
    assert found == pytest.approx(honeycomb(slenderness), rel=2e-4)


@pytest.mark.parametrize("slenderness", [0.05, 0.1])
@pytest.mark.parametrize("way", ["pointy", "flat"])
def test_regular_honeycomb_widens_as_its_closed_form(way, slenderness):
    """Poisson's ratio (1 - (t/L)^2) / (1 + 3 (t/L)^2): the width of the period is free."""
    frames = endless("hex", way, slenderness, strain=1e-4).frames
    rest, last = frames["position_m"][[0, -1]]
    apart = rest[:, None] - rest[None]
    period = np.array([2 * ROOT3, 3.0] if way == "pointy" else [3.0, 2 * ROOT3]) * SIDE
    one, other = np.argwhere(np.all(np.abs(apart - period * [1, 0]) < 1e-6 * SIDE, axis=2))[0]
    widened = (last[one] - last[other]) / period[0] - [1.0, 0.0]
    square = slenderness**2
    assert widened[0] == pytest.approx(1e-4 * (1 - square) / (1 + 3 * square), rel=2e-3)
    assert abs(widened[1]) < 1e-12


@pytest.mark.parametrize("cells", [(1, 1), (1, 2), (3, 2)])
def test_square_grid_is_as_stiff_as_its_walls(cells):
    found = modulus("square", None, 0.1, cells=cells)
    assert found == pytest.approx(0.1 * PLANE, rel=1e-6)


@pytest.mark.parametrize(("kind", "share"), [("triangle", 2 / ROOT3), ("kagome", 1 / ROOT3)])
def test_triangles_are_as_stiff_as_their_walls_stretch(kind, share):
    """Y' t/L times 2/sqrt(3), 1/sqrt(3): a third of the relative density; bending adds (t/L)^2."""
    assert modulus(kind, None, 0.02) == pytest.approx(0.02 * share * PLANE, rel=1e-3)


def block(cells, t):
    """Tangent modulus of a regular block between loose platens without friction, sides free."""
    width, height = (cells + 0.5) * ROOT3 * SIDE, (1.5 * cells + 0.5) * SIDE
    lattice = dict(
        kind="hex", cells_x=cells, cells_y=cells, width=width, height=height, depth=DEPTH,
        wall_thickness=t * SIDE, imperfection=0.0, nodes_per_wall=0,
    )  # fmt: skip
    result = simulate(
        Case.of(
            lattice=lattice,
            material=MATERIAL,
            loading=dict(mode="displacement", strain=1e-4, unload=False, platen="contact"),
            contact=dict(model="none", friction=0.0),
            solver=dict(load_steps=2, joints="points"),
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
