"""The solid of `make continuum`: energy, elements, contact; and the network beside it."""

import numpy as np
import pytest
from skfem import MeshQuad

from tests.studies.continuum.arms import ARMS, Joint
from tests.studies.continuum.grid import Grid
from tests.studies.continuum.joint import coefficients, spared
from tests.studies.continuum.lattices import Lattice, from_table, placed, table
from tests.studies.continuum.network import Network, thick_law
from tests.studies.continuum.openings import KINDS, Star, Yield, rows
from tests.studies.continuum.press import Press, StuckError, factor
from tests.studies.continuum.rubber import DeepRubber, Rubber
from tests.studies.continuum.solid import Solid
from tests.studies.continuum.strip import energy, moment, softening

RUBBER = Rubber(12.0, 0.48)
RNG = np.random.default_rng(5)


def beam(length, along, across):
    """A wall of thickness 1 along x."""
    lines = np.linspace(0.0, length, along + 1), np.linspace(-0.5, 0.5, across + 1)
    return Solid(MeshQuad.init_tensor(*lines), RUBBER, 1.0)


def affine(solid, slope):
    return (solid.points @ np.array(slope).T).ravel()


def slope_of(energy, u, step):
    """Central difference in a random direction, and the direction."""
    way = RNG.standard_normal(u.size)
    return (energy(u + step * way) - energy(u - step * way)) / (2.0 * step), way


@pytest.mark.parametrize("poisson", [0.0, 0.3, 0.48])
def test_rubber_is_free_across_and_its_slopes_are_derivatives(poisson):
    rubber, logs = Rubber(12.0, poisson), np.linspace(-2.0, 2.0, 9)
    s = rubber.across(logs)
    log_j = logs + 0.5 * np.log(s)
    assert rubber.mu * (s - 1.0) + rubber.lame * log_j == pytest.approx(np.zeros(9), abs=1e-12)
    step = 1e-5
    p, second = rubber.pressure(logs)
    ahead, behind = rubber.energy(2.0, logs + step), rubber.energy(2.0, logs - step)
    assert (ahead - behind) / (2.0 * step) == pytest.approx(p, rel=1e-7)
    ahead, behind = rubber.pressure(logs + step)[0], rubber.pressure(logs - step)[0]
    assert (ahead - behind) / (2.0 * step) == pytest.approx(second, rel=1e-6, abs=1e-9)


def test_deep_rubber_has_slopes_that_are_derivatives_and_the_modulus_of_plane_strain():
    rubber, logs, step = DeepRubber(12.0, 0.3), np.linspace(-1.0, 1.0, 5), 1e-5
    p, second = rubber.pressure(logs)
    ahead, behind = rubber.energy(2.0, logs + step), rubber.energy(2.0, logs - step)
    assert (ahead - behind) / (2.0 * step) == pytest.approx(p, rel=1e-7)
    ahead, behind = rubber.pressure(logs + step)[0], rubber.pressure(logs - step)[0]
    assert (ahead - behind) / (2.0 * step) == pytest.approx(second)
    strain = 1e-4
    along, beside = 1.0 + strain, 1.0 - strain * 0.3 / 0.7
    stored = rubber.energy(along**2 + beside**2, np.log(along * beside))
    assert stored == pytest.approx(0.5 * 12.0 / (1.0 - 0.3**2) * strain**2, rel=1e-3)


def test_rubber_is_hooke_at_small_strain():
    solid, strain = beam(1.0, 1, 1), 1e-4
    stretched = affine(solid, [[strain, 0.0], [0.0, -RUBBER.poisson * strain]])
    assert solid.energy(stretched) == pytest.approx(0.5 * 12.0 * strain**2, rel=1e-3)
    sheared = affine(solid, [[0.0, strain], [0.0, 0.0]])
    assert solid.energy(sheared) == pytest.approx(0.5 * RUBBER.mu * strain**2, rel=1e-3)


def test_gradient_and_hessian_are_derivatives():
    solid = beam(3.0, 3, 2)
    u = affine(solid, [[0.3, 0.5], [-0.4, -0.2]]) + 0.02 * RNG.standard_normal(solid.size)
    found, way = slope_of(solid.energy, u, 1e-6)
    assert found == pytest.approx(solid.gradient(u) @ way, rel=1e-6)
    found, way = slope_of(solid.gradient, u, 1e-6)
    assert found == pytest.approx(solid.hessian(u) @ way, rel=1e-5, abs=1e-5)


def test_rotation_costs_nothing():
    solid, angle = beam(3.0, 3, 2), 2.0
    co, si = np.cos(angle), np.sin(angle)
    turned = affine(solid, [[co - 1.0, -si], [si, co - 1.0]])
    assert solid.energy(turned) == pytest.approx(0.0, abs=1e-10)
    assert solid.gradient(turned) == pytest.approx(np.zeros(solid.size), abs=1e-10)


def test_inside_out_is_infinite():
    solid = beam(1.0, 1, 1)
    assert solid.energy(affine(solid, [[-2.0, 0.0], [0.0, 0.0]])) == np.inf


def test_patch_of_distorted_elements_holds_a_constant_stress():
    mesh = MeshQuad().refined(2)
    inside = np.setdiff1d(np.arange(mesh.p.shape[1]), mesh.boundary_nodes())
    moved = mesh.p.copy()
    moved[:, inside] += 0.05 * RNG.standard_normal((2, len(inside)))
    solid = Solid(MeshQuad(moved, mesh.t), RUBBER, 1.0)
    at_rim = np.any(np.isclose(solid.points, 0.0) | np.isclose(solid.points, 1.0), axis=1)
    force = solid.gradient(affine(solid, [[0.2, 0.4], [-0.1, -0.3]])).reshape(-1, 2)
    assert force[~at_rim] == pytest.approx(0.0, abs=1e-12)
    assert np.abs(force[at_rim]).max() > 0.1


@pytest.mark.parametrize(("across", "within"), [(1, 2e-3), (2, 1e-3)])
def test_clamped_wall_bends_like_a_beam(across, within):
    """Timoshenko: 1 / k = L^3 / 3 Y I + 6 L / 5 G A."""
    length = 20.0
    solid = beam(length, 10 * across, across)
    x = solid.points[:, 0]
    root, tip = np.flatnonzero(np.isclose(x, 0.0)), np.flatnonzero(np.isclose(x, length))
    middle = root[np.isclose(solid.points[root, 1], 0.0)]  # the section may become narrower
    held = np.concatenate([2 * root, 2 * middle + 1, 2 * tip + 1])
    free = np.setdiff1d(np.arange(solid.size), held)
    matrix, u = solid.hessian(np.zeros(solid.size)), np.zeros(solid.size)
    u[2 * tip + 1] = 1.0
    u[free] = -factor(matrix[free][:, free]).solve((matrix @ u)[free])
    yields = length**3 * 12.0 / (3.0 * 12.0) + 1.2 * length / RUBBER.mu
    assert u @ (matrix @ u) == pytest.approx(1.0 / yields, rel=within)


def test_grid_covers_what_is_printed():
    grid = Grid(cells=2, width=10.0, thickness=1.0)
    area = 3 * 2 * 11.0 - 9
    assert Solid(grid.mesh(), RUBBER, 2.0).weight.sum() == pytest.approx(2.0 * area)


def test_factor_knows_what_is_definite():
    solid = beam(2.0, 2, 1)
    matrix = solid.hessian(np.zeros(solid.size))
    free = np.arange(4, solid.size)
    assert factor(matrix[free][:, free]) is not None
    assert factor(-matrix[free][:, free]) is None


def test_press_finds_a_stable_shape_and_its_force_is_the_slope_of_its_energy():
    grid = Grid(cells=1, width=10.0, thickness=1.0)
    press = Press(Solid(grid.mesh(), RUBBER, 12.0), grid.width)
    strains = np.array([0.06, 0.07, 0.08])
    curve = press.crush(strains)
    force, energy = curve.at(strains)
    assert force[1] == pytest.approx((energy[2] - energy[0]) / (0.02 * grid.width), rel=1e-3)
    inner = press.hessian(curve.shape)[press.free][:, press.free]
    assert factor(inner) is not None
    assert np.abs(press.gradient(curve.shape)[press.free]).max() < 1e-7
    with pytest.raises(ValueError, match=r"ended at a strain of 0\.08"):
        curve.at(0.1)


def test_press_gives_up_aloud(monkeypatch):
    monkeypatch.setattr("tests.studies.continuum.press.ENOUGH", 1)
    press = Press(Solid(Grid(cells=1).mesh(), RUBBER, 12.0), 12.5)
    with pytest.raises(StuckError, match="no minimum"):
        press.crush([0.05])


def test_walls_touch_and_do_not_cross():
    """One cell with stout walls, at a strain at which they would cross."""
    touch = pytest.importorskip("tests.studies.continuum.touch", reason="ipctk is not installed")
    grid = Grid(cells=1, width=10.0, thickness=2.0, across=1)
    solid = Solid(grid.mesh(), RUBBER, 12.0)
    contact = touch.Touch(solid, 0.1, 12.0 * 12.0)
    strains = np.arange(1, 15) / 20.0
    through = Press(solid, grid.width).crush(strains)
    assert contact.crosses(through.shape)
    curve = Press(solid, grid.width, contact).crush(strains)
    assert not contact.crosses(curve.shape)
    assert contact.energy(curve.shape) > 0.0
    found, way = slope_of(contact.energy, curve.shape, 1e-8)
    assert found == pytest.approx(contact.gradient(curve.shape) @ way, rel=1e-4)
    found, way = slope_of(contact.gradient, curve.shape, 1e-8)
    assert found == pytest.approx(contact.hessian(curve.shape) @ way, rel=1e-3, abs=1e-2)


def test_elastic_joint_spares_the_same_whatever_poissons_ratio():
    """Stresses under forces at the rim do not depend on it, but the constant does."""
    rubber, cork = coefficients(4, 0.48), coefficients(4, 0.0)
    assert rubber[0] == pytest.approx(cork[0], rel=0.02)
    assert rubber[2] > cork[2] + 0.05
    assert spared(8, 0.48) == pytest.approx(0.515, rel=0.04)


@pytest.mark.parametrize(
    ("kind", "shears"), [("X", 1 / 2), ("T", 1 / 3), ("L", 0.0), ("Y", 3**-0.5)]
)
def test_arms_of_joints_are_linear_in_poissons_ratio(kind, shears):
    """The terms that hold it are integrals over the rim, hence round numbers."""
    cork, middle, rubber = (Joint(kind, 4, poisson).sway() for poisson in (0.0, 0.2, 0.4))
    assert middle == pytest.approx(0.5 * (cork + rubber), abs=4e-3)
    assert (rubber - cork) / 0.4 == pytest.approx([0.0, -1.2, shears], abs=0.02)


@pytest.mark.parametrize("kind", ARMS)
def test_arms_yield_the_same_however_long(kind, monkeypatch):
    short = Joint(kind, 4, 0.3).sway()
    monkeypatch.setattr("tests.studies.continuum.arms.LENGTH", 3.0)
    assert Joint(kind, 4, 0.3).sway() == pytest.approx(short, abs=0.02)


def test_arms_of_joints_are_as_measured():
    """Moment with moment, moment with shear, shear with shear; finer meshes agree to 0.01."""
    assert Joint("X", 8, 0.0).sway() == pytest.approx([-1.544, -1.689, 0.868], abs=0.02)
    assert Joint("T", 8, 0.0).sway() == pytest.approx([-1.757, -1.215, 0.286], abs=0.02)
    assert Joint("L", 8, 0.0).sway() == pytest.approx([-1.443, -1.182, 0.052], abs=0.02)
    assert Joint("Y", 8, 0.0).sway() == pytest.approx([-0.701, -0.981, 0.088], abs=0.02)


@pytest.mark.parametrize(("kind", "arms"), [("X", "X"), ("V", "L")])
def test_triangles_find_what_quadrilaterals_do(kind, arms):
    found = dict(Yield(Star(KINDS[kind][0](90)), 0.3).arms())["all"]
    assert found[:3] == pytest.approx(Joint(arms, 8, 0.3).sway(), abs=0.02)


def test_acute_openings_are_linear_in_poissons_ratio():
    """A coarse mesh at the re-entrant corner, or a slit between arms, would break it."""
    star = Star((35, 325))
    cork, rubber = (dict(Yield(star, poisson).arms())["all"] for poisson in (0.0, 0.4))
    assert (rubber - cork) / 0.4 == pytest.approx([0.0, -1.2, 0.0, 0.0, 0.0, 0.0], abs=1e-3)
    assert cork[:2] == pytest.approx([-12.030, 4.608], abs=2e-3)


def test_arms_of_unequal_crosses_yield_as_if_moved_to_the_side_of_the_other_line():
    """In own thicknesses: C at a point off the centre, less the beam up to there."""
    thickness = np.array([1.0, 1.25, 1.0, 1.25])
    form = Star((90,) * 4, tuple(thickness)).beyond(0.3)[:, 2, :, 2]
    moments = np.array([1.0, -1.0, 1.0, -1.0]) / thickness
    off = 0.5 * (thickness[::-1] / thickness - 1.0)
    assert moments @ form @ moments == pytest.approx(moments**2 @ (-1.541 - 12.0 * off), rel=0.012)
    assert moments @ form @ moments < 1.25 * moments**2 @ np.full(4, -1.541)


@pytest.mark.parametrize(("kind", "angle"), [("X", 60), ("Y", 110)])
def test_table_of_joints_is_as_computed(kind, angle):
    for arm, values in rows(kind, angle):
        lines = table()[kind, arm]
        assert lines[lines[:, 0] == angle, 1:] == pytest.approx(values[None], abs=2e-3)


@pytest.mark.parametrize("turn", [1, -1])
def test_arms_of_a_joint_are_found_in_the_table_either_way_round(turn):
    openings = (180.0, 60.0, 120.0)[::turn]
    kind, angle, order = placed(openings)
    assert (kind, angle, openings[order[0]]) == ("T", 60.0, 180.0)
    stem = {1: 2, -1: 1}[turn]  # between 60 and 120 degrees
    moments = from_table(openings, 0.0)[:, 2, 2]
    assert moments[stem] == moments.min() < np.delete(moments, stem).min()
    with pytest.raises(ValueError, match="no kind of joint"):
        placed((100.0, 130.0, 70.0, 60.0))


def test_hexagons_are_as_stiff_with_joints_of_the_table_as_if_solid():
    lattice = Lattice("hex", 1.0, 0.2)
    assert lattice.errors(0.48, from_table) == pytest.approx(0.0, abs=0.1)
    assert lattice.errors(0.48, None) == pytest.approx([-17.0, -16.1, -13.7], abs=0.2)


def test_thick_strip_softens_as_it_bends():
    rubber = Rubber(12.0, 0.0)
    assert energy(rubber, 0.02) == pytest.approx(0.5 * 1.0 * 0.02**2, rel=2e-3)
    assert moment(rubber, 0.1) == pytest.approx(0.1, rel=4e-3)
    soft = softening(rubber)
    assert soft == pytest.approx(0.17, abs=0.01)
    law = thick_law(soft)
    inside = law.coefficients[120, 0]  # at a surface strain of 0.4, kappa t = 0.8
    assert 2.0 * inside == pytest.approx(moment(rubber, 0.8), rel=5e-3)


def test_network_comes_to_the_solid_with_elastic_blocks_and_thick_sections():
    grid = Grid(cells=2, width=10.0, thickness=0.5, across=2)
    strains = np.array([0.02, 0.05, 0.1])
    solid, _ = Press(Solid(grid.mesh(), RUBBER, grid.depth), grid.width).crush(strains).at(0.1)
    plain = Network(grid, RUBBER)
    changed = Network(grid, RUBBER, spared=0.515, softening=0.19)
    assert plain.at(0.1, 50)[0] / solid == pytest.approx(0.96, abs=0.012)
    assert changed.at(0.1, 50)[0] / solid == pytest.approx(1.01, abs=0.012)
