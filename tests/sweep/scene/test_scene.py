"""The terms of a scene: masses, data for the solver, plane stress, damping, friction."""

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.design.network import mass
from sweep.scene.beams import plane_factors
from sweep.scene.lattice import build_scene
from tests.studies.verify import MATERIAL
from tests.support.designs.grids import DEPTH, LOADINGS, THICKNESS, WALL, scene_of
from tests.support.designs.tables import material_with


@pytest.mark.parametrize("platen", LOADINGS)
@pytest.mark.parametrize("elements", [1, 4])
def test_masses_sum_to_the_printed_mass_in_each_direction(elements, platen):
    scene = scene_of(elements, platen)
    nodes = 2 * len(scene.mesh.points)
    expected = mass(scene.network, DEPTH, MATERIAL.density)
    printed = (12.5e-3 + THICKNESS) ** 2 - 9 * (WALL - THICKNESS) ** 2
    assert expected == pytest.approx(printed * DEPTH * MATERIAL.density, rel=1e-9)
    x, y = scene.terms.coordinates.mass[:nodes].reshape(-1, 2).T
    np.testing.assert_array_equal(x, y)
    assert x.sum() == pytest.approx(expected, rel=1e-12)
    assert x.min() > 0.0
    assert not scene.terms.coordinates.mass[nodes:].any()


def test_a_move_is_at_most_a_quarter_of_a_cell():
    """However unlike its two sizes are, and the numbers of cells."""
    lattice = dict(cells_x=2, cells_y=8, width=0.03, height=0.16, wall_thickness=4e-4)
    assert build_scene(Case.of(lattice=lattice)).terms.coordinates.cap == pytest.approx(
        0.25 * 0.015
    )


def test_rotations_are_scaled_by_the_length_of_an_element():
    scene = scene_of(3)
    scale, n = scene.terms.coordinates.scale, len(scene.mesh.points)
    np.testing.assert_allclose(scale[2 * n : 3 * n], WALL / 3, rtol=1e-12)
    np.testing.assert_array_equal(np.delete(scale, np.arange(2 * n, 3 * n)), 1.0)
    np.testing.assert_allclose(scene.terms.coordinates.lever * scale, 1.0, rtol=1e-15)


def curve_of(terms):
    """The curve of stretching."""
    return terms.law.relaxing.elastic.curve


@pytest.mark.parametrize(
    ("plane", "in_stretch", "in_bend"),
    [("stress", 1.0, 1.0), ("strain", 1 / 0.84, 1 / 0.84), ("strain_bending", 1.0, 1 / 0.84)],
)
def test_plane_factors(plane, in_stretch, in_bend):
    """Y' = Y / (1 - nu^2) in stretching and contact, and in bending."""
    material = material_with(modulus=12e6, density=1190.0, poisson=0.4, plane=plane)
    assert plane_factors(material) == pytest.approx((in_stretch, in_bend))
    flat, plain = scene_of(material=material).terms, scene_of().terms
    for found, expected, factor in (
        (curve_of(flat).coefficients, curve_of(plain).coefficients, in_stretch),
        (curve_of(flat).energy, curve_of(plain).energy, in_stretch),
        (flat.law.modulus, plain.law.modulus, in_stretch),
        (flat.contact.stiffness, plain.contact.stiffness, in_stretch),
        (flat.bend.stiffness, plain.bend.stiffness, in_bend),
        (flat.fold.stiffness, plain.fold.stiffness, in_bend),
    ):
        np.testing.assert_allclose(found, factor * expected, rtol=1e-12)


@pytest.mark.parametrize(
    ("damping", "expected"),
    [
        (dict(model="none"), (0.0, 0.0, 0.0)),
        (dict(model="rayleigh", mass=7.0, stiffness=3e-4), (7.0, 3e-4, 0.0)),
        (dict(model="kelvin_voigt", relaxation_time=2e-4), (0.0, 0.0, 2e-4)),
    ],
)
def test_damping_is_that_of_its_model_and_none_without_time(damping, expected):
    assert scene_of(damping=damping).terms.damp == expected
    still = scene_of(platen="driven, glued", damping={"model": damping["model"]})
    assert still.terms.damp == (0.0, 0.0, 0.0)


def test_smoothing_of_friction():
    """A speed, whatever the time step; without time a share of the wall thickness in all steps."""
    rubbing = scene_of(contact=dict(friction=0.4, slip_speed=0.02), solver=dict(time_step=1e-3))
    assert rubbing.terms.friction == pytest.approx((0.4, 0.02))
    for steps in (200, 50):
        still = scene_of(platen="driven, glued", solver=dict(load_steps=steps))
        assert still.terms.friction == pytest.approx((0.3, 0.2 * THICKNESS / steps))
