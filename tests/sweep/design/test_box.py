"""The infill of a box: its outline, its grading, how wide its cells are open."""

import numpy as np
import pytest

from sweep.design.box import gradient, infill_walls, opening
from sweep.design.infill import families, trait
from sweep.design.lattice import build_network
from sweep.design.network import relative_density
from tests.support.designs.infills import lattice_of
from tests.support.designs.tables import lattice_with

T, W, H = 0.8e-3, 12.5e-3, 12.5e-3


@pytest.mark.parametrize(
    ("lines", "sides", "caps"),
    [
        ({"perimeters": 3}, 1.2e-3, 1.2e-3),
        ({"perimeters": 2, "line_width": 0.5e-3}, 1.0e-3, 1.0e-3),
        ({"solid_layers": 4}, T, 0.8e-3),
        ({"perimeters": 1, "solid_layers": 5, "layer_height": 0.3e-3}, 0.4e-3, 1.5e-3),
    ],
)
def test_an_outline_is_as_thick_as_its_lines(lines, sides, caps):
    """Outer box less the openings: openings at the sides lose half of the outline."""
    lattice = lattice_with(**lines)
    network, pitch = build_network(lattice.geometry), W / 3
    across = [pitch - 0.5 * (sides + T), pitch - T, pitch - 0.5 * (sides + T)]
    up = [pitch - 0.5 * (caps + T), pitch - T, pitch - 0.5 * (caps + T)]
    area = (W + sides) * (H + caps) - sum(across) * sum(up)
    assert network.printed_area == pytest.approx(area, rel=1e-12)
    box = (W + sides) * (H + caps)
    assert relative_density(network, lattice.outer_size) == pytest.approx(area / box, rel=1e-12)
    assert lattice.outer_size == pytest.approx((W + sides, H + caps))


@pytest.mark.parametrize("kind", families())
@pytest.mark.parametrize("ratio", [0.25, 1.0, 3.0])
def test_grading_is_linear_and_keeps_the_mean(kind, ratio):
    lattice = lattice_with(kind=kind, wall_thickness=0.3e-3, grading=ratio)
    network = build_network(lattice.geometry)
    length, height = infill_walls(lattice.geometry)
    thickness = network.wall_thickness
    assert thickness @ length == pytest.approx(0.3e-3 * length.sum(), rel=1e-12)
    slope, below = np.polyfit(height, thickness, 1)
    np.testing.assert_allclose(slope * height + below, thickness, rtol=1e-9)
    assert (below + slope) / below == pytest.approx(ratio)


def test_cells_are_as_wide_open_as_their_walls_are_apart():
    """Square cells are known without drawing; diamonds by Pythagoras; sides of hexagons."""
    assert trait("square", "opening")(5e-3, 4.5e-3) == 4.5e-3
    drawn = lattice_of("diamond", cells=(4, 4)).opening
    assert drawn == pytest.approx(5e-3 * 4.5e-3 / np.hypot(5e-3, 4.5e-3), rel=1e-5)
    side = 4e-3
    lattice = lattice_of("hex", width=3.5 * 3**0.5 * side, height=5 * side)
    assert opening(lattice.geometry) == pytest.approx(3**0.5 * side, rel=1e-5)


def test_without_grading_all_walls_are_as_thick_as_the_mean():
    np.testing.assert_allclose(gradient(lattice_of("hex").geometry), 1.0, rtol=1e-12)
