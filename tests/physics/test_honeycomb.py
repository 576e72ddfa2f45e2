"""Small-strain moduli of the families: of an endless lattice, and of a block with free sides."""

import numpy as np
import pytest

from sweep.simulation.simulate import simulate
from tests.support.designs.slender import DEPTH, LENGTH, MODULUS, slender

ROOT3 = 3**0.5
STRAIN = 1e-6


def pressed(case, strain=STRAIN, steps=1):
    """The result of a case without imperfections."""
    lattice, loading, solver = {"imperfection": 0.0}, {"strain": strain}, {"load_steps": steps}
    result = simulate(case.changed(lattice=lattice, loading=loading, solver=solver))
    assert result.status == "converged"
    return result


def modulus(*lattice):
    """Young's modulus of the endless lattice in y over that of its walls."""
    result = pressed(slender(*lattice))
    area = result.summary["width_m"] * DEPTH
    return result.history["reaction_top_N"][-1] / area / STRAIN / MODULUS


def honeycomb(t):
    return 4 / ROOT3 * t**3 / (1 + 3 * t**2)


@pytest.mark.parametrize("slenderness", [0.05, 0.1])
@pytest.mark.parametrize("way", ["pointy", "flat"])
def test_regular_honeycomb_is_as_stiff_as_its_closed_form(way, slenderness):
    """The modulus in both directions is 4/sqrt(3) (t/L)^3 / (1 + 3 (t/L)^2) Y."""
    found = modulus("hex", slenderness, (2, 2), way)
    assert found == pytest.approx(honeycomb(slenderness), rel=2e-4)


@pytest.mark.parametrize("slenderness", [0.05, 0.1])
@pytest.mark.parametrize("way", ["pointy", "flat"])
def test_regular_honeycomb_widens_as_its_closed_form(way, slenderness):
    """Poisson's ratio (1 - (t/L)^2) / (1 + 3 (t/L)^2): the width of the period is free."""
    frames = pressed(slender("hex", slenderness, way=way), 1e-4).frames
    rest, last = frames["position_m"][[0, -1]]
    apart = rest[:, None] - rest[None]
    period = np.array([2 * ROOT3, 3.0] if way == "pointy" else [3.0, 2 * ROOT3]) * LENGTH
    one, other = np.argwhere(np.all(np.abs(apart - period * [1, 0]) < 1e-6 * LENGTH, axis=2))[0]
    widened = (last[one] - last[other]) / period[0] - [1.0, 0.0]
    square = slenderness**2
    assert widened[0] == pytest.approx(1e-4 * (1 - square) / (1 + 3 * square), rel=2e-3)
    assert abs(widened[1]) < 1e-12


@pytest.mark.parametrize("cells", [(1, 1), (1, 2), (3, 2)])
def test_square_grid_is_as_stiff_as_its_walls(cells):
    assert modulus("square", 0.1, cells) == pytest.approx(0.1, rel=1e-6)


@pytest.mark.parametrize(("kind", "share"), [("triangle", 2 / ROOT3), ("kagome", 1 / ROOT3)])
def test_triangles_are_as_stiff_as_their_walls_stretch(kind, share):
    """Y t/L times 2/sqrt(3), 1/sqrt(3): a third of the relative density; bending adds (t/L)^2."""
    assert modulus(kind, 0.02) == pytest.approx(0.02 * share, rel=1e-3)


def block(cells, t):
    """Tangent modulus of a regular block between loose platens without friction, sides free."""
    width, height = (cells + 0.5) * ROOT3 * LENGTH, (1.5 * cells + 0.5) * LENGTH
    lattice = {"width": width, "height": height, "boundary": "free", "nodes_per_wall": 0}
    platens = {"loading": {"platen": "contact"}, "contact": {"friction": 0.0}}
    case = slender("hex", t, (cells, cells)).changed(lattice=lattice, **platens)
    force = pressed(case, 1e-4, 2).history["reaction_top_N"]
    return (force[-1] - force[-2]) / (width * DEPTH) / 0.5e-4 / MODULUS


@pytest.mark.parametrize("slenderness", [0.05, 0.1])
def test_a_block_tends_to_the_endless_honeycomb_as_it_grows(slenderness):
    """Its free edges are soft, and their share falls as 1 / cells: two sizes give the limit."""
    small, large = (block(cells, slenderness) for cells in (8, 16))
    assert small < large < honeycomb(slenderness)
    assert 2 * large - small == pytest.approx(honeycomb(slenderness), rel=5e-3)
