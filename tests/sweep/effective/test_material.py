"""Effective materials: their parts, and their descriptions."""

from math import pi

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.effective.material import card
from tests.support.designs.slender import MODULUS, slender

BOX = {"width": 0.06, "height": 0.06}


def laid(angle, pattern="grid", infill=0.2):
    lattice = {"slicer": "prusa", "pattern": pattern, "infill": infill, "fill_angle": angle}
    return card(Case.of(lattice=BOX | lattice, loading={"mode": "displacement", "strain": 0.3}))


def test_constants_are_those_of_the_stiffness():
    made = card(slender("hex"))
    compliance = np.linalg.inv(made.stiffness)
    assert made.modulus_1 == pytest.approx(1 / compliance[0, 0])
    assert made.modulus_2 == pytest.approx(1 / compliance[1, 1])
    assert made.shear_12 == pytest.approx(1 / compliance[2, 2])
    assert made.poisson_12 / made.modulus_1 == pytest.approx(-compliance[0, 1])
    assert made.poisson_13 / made.modulus_1 == pytest.approx(0.3 / made.modulus_3)
    assert made.poisson_23 / made.modulus_2 == pytest.approx(0.3 / made.modulus_3)


def test_along_the_walls_the_filled_share_counts():
    made = card(slender("square", 0.05))
    assert made.relative_density == pytest.approx(1 - 0.95**2)
    assert made.modulus_3 == pytest.approx(made.relative_density * MODULUS)
    assert made.density == pytest.approx(made.relative_density * 1200.0)


@pytest.mark.parametrize("kind", ["square", "hex", "triangle"])
def test_the_constants_make_a_stable_material(kind):
    """The compliance of the nine constants is positive definite."""
    made = card(slender(kind, 0.05))
    one, two, three = made.modulus_1, made.modulus_2, made.modulus_3
    compliance = np.diag([1 / one, 1 / two, 1 / three])
    compliance[0, 1] = compliance[1, 0] = -made.poisson_12 / one
    compliance[0, 2] = compliance[2, 0] = -made.poisson_13 / one
    compliance[1, 2] = compliance[2, 1] = -made.poisson_23 / two
    assert np.linalg.eigvalsh(compliance)[0] > 0.0
    assert min(made.shear_12, made.shear_13, made.shear_23) > 0.0


def test_a_grid_at_an_angle_is_the_same_material_turned():
    straight, turned = laid(0.0), laid(0.25 * pi)
    assert turned.modulus_1 == pytest.approx(straight.modulus_1)
    assert turned.angle == pytest.approx(0.25 * pi)
    assert straight.modulus_x == pytest.approx(straight.modulus_1)
    shear = 1 / straight.shear_12
    diagonal = 0.25 * (2 * (1 - straight.poisson_12) / straight.modulus_1 + shear)
    assert 1 / turned.modulus_x == pytest.approx(diagonal)
    assert turned.modulus_y == pytest.approx(turned.modulus_x)


def test_triangles_are_alike_in_all_directions():
    made = laid(0.3, "triangles")
    values = [made.modulus_at(angle) for angle in np.linspace(0, pi, 7)]
    assert values == pytest.approx([made.modulus_1] * 7, rel=1e-6)


def test_it_shows_itself_in_a_line_and_as_a_row():
    made = card(slender("square"))
    assert repr(made) == "<EffectiveMaterial square of by numbers: E1 1e+04 Pa, E2 1e+04 Pa>"
    row = made.row()
    assert row["modulus_1_Pa"] == made.modulus_1
    assert row["period_1_m"] == pytest.approx(0.01)
    assert all(isinstance(value, str | float) for value in row.values())
