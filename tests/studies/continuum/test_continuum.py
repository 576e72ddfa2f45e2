"""The solid of `make continuum`: energy, elements, contact; and the network for comparison."""

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar
from skfem import MeshQuad

from sweep.scene.beams import contraction, plane_factors
from sweep.scene.joint_kinds import on_glued_rows
from sweep.scene.material import law_of_section
from tests.studies.continuum import pixels
from tests.studies.continuum.arms import ARMS, Joint
from tests.studies.continuum.grid import Grid
from tests.studies.continuum.joint_compliance import (
    ENTRIES,
    GLUED,
    KINDS,
    Star,
    Yield,
    on_glued_row,
    rows,
)
from tests.studies.continuum.lattices import Lattice, exact, from_table, placed, table
from tests.studies.continuum.network import MPA, material
from tests.studies.continuum.press import Press, StuckError, factor
from tests.studies.continuum.rubber import RUBBERS, DeepRubber, Rubber
from tests.studies.continuum.solid import Solid
from tests.studies.continuum.solids import PACKED, PAIRS, Crush, crushed
from tests.studies.continuum.strip import energy, moment, softening
from tests.studies.continuum.study import APART, POINTS, WATCHED, Side, networks, stored
from tests.studies.continuum.touch import Touch
from tests.support.kernels.terms import NO_MEMORY

OUTER = 0.5 * 0.6**0.5  # place of the outer fibres of a section of thickness 1
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


def check_slopes(rubber, logs, step=1e-5):
    """Pressure and its slope are the derivatives of the energy by the logarithm of J."""
    p, second = rubber.pressure(logs)
    ahead, behind = rubber.energy(2.0, logs + step), rubber.energy(2.0, logs - step)
    assert (ahead - behind) / (2.0 * step) == pytest.approx(p, rel=1e-7)
    ahead, behind = rubber.pressure(logs + step)[0], rubber.pressure(logs - step)[0]
    assert (ahead - behind) / (2.0 * step) == pytest.approx(second, rel=1e-6, abs=1e-9)


@pytest.mark.parametrize("poisson", [0.0, 0.3, 0.48])
def test_rubber_is_free_across_and_its_slopes_are_derivatives(poisson):
    rubber, logs = Rubber(12.0, poisson), np.linspace(-2.0, 2.0, 9)
    s = rubber.across(logs)
    log_j = logs + 0.5 * np.log(s)
    assert rubber.mu * (s - 1.0) + rubber.lame * log_j == pytest.approx(np.zeros(9), abs=1e-12)
    check_slopes(rubber, logs)


def test_deep_rubber_has_slopes_that_are_derivatives_and_the_modulus_of_plane_strain():
    rubber = DeepRubber(12.0, 0.3)
    check_slopes(rubber, np.linspace(-1.0, 1.0, 5))
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
    grid = Grid(cells=1, width=10.0, thickness=2.0, across=1)
    solid = Solid(grid.mesh(), RUBBER, 12.0)
    contact = Touch(solid, 0.1, 12.0 * 12.0)
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
    """In units of the own thickness: C at a point off the centre, less the beam up to there."""
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


@pytest.mark.parametrize(
    ("kind", "ratio", "within", "equal"),
    [
        ("square", 1.5, 4.0, -9.7),
        ("square", 1.0 / 3.0, 4.0, -31.7),
        ("brick", 2.0, 2.0, -12.0),
        ("brick", 2.0 / 3.0, 3.0, -11.3),
    ],
)
def test_joints_of_unequal_lines_are_near_the_solid(kind, ratio, within, equal):
    """They are nearer than C of equal arms, whose worst error of three is the last number."""
    lattice = Lattice(kind, 1.0, 0.2 / max(ratio, 1.0), ratio)
    errors = lattice.errors(0.48, lattice.of_scene(0.48))
    assert np.abs(errors).max() < within
    worst = lattice.errors(0.48, from_table)
    assert worst[np.abs(worst).argmax()] == pytest.approx(equal, abs=0.2)


def test_a_rectangle_of_pixels_bends_and_stretches_as_hooke_says():
    a, b, poisson = 2.0, 0.5, 0.3
    one = pixels.rectangle(a, b, poisson)
    along = np.array([(x * a, -poisson * y * b) for x, y in pixels.CORNERS]).ravel()
    assert along @ one @ along == pytest.approx(a * b)
    bent = np.array([((x - 0.5) * (y - 0.5) * a * b, 0.0) for x, y in pixels.CORNERS]).ravel()
    assert bent @ one @ bent == pytest.approx(a * b**3 / 12.0)
    assert one @ np.tile([1.0, -2.0], 4) == pytest.approx(0.0, abs=1e-12)


def test_a_solid_of_pixels_is_as_stiff_as_the_exact_joints():
    lattice = Lattice("square", 1.0, 0.2)
    found = pixels.solid(lattice.network, 100, 0.48)
    assert found == pytest.approx(np.diag(lattice.yields(0.48, exact)), rel=0.015)
    share = pixels.covered(lattice.network, (100, 100)).mean()
    assert share == pytest.approx(1.0 - 0.8**2, rel=2e-3)


def test_joints_that_fill_most_of_their_walls_are_near_the_solid():
    lattice = Lattice("hex", 1.0, 0.7)
    assert lattice.filled() == pytest.approx(0.84, abs=0.01)
    truth = pixels.solid(lattice.network, 100, 0.48)
    stiff = np.diag(lattice.yields(0.48, lattice.of_scene(0.48)))
    assert 100.0 * (truth / stiff - 1.0) == pytest.approx([-8.0, 2.0, 2.5], abs=1.0)


@pytest.mark.parametrize("plane", RUBBERS)
@pytest.mark.parametrize("poisson", [0.0, 0.3, 0.48])
def test_bar_of_rubber_is_free_across(plane, poisson):
    """Its stress is the slope of the least energy over the stretches across."""
    rubber, stretch, step = RUBBERS[plane](12.0, poisson), np.array([0.4, 0.9, 1.0, 1.6]), 1e-4

    def least(a):
        def of(b):
            return rubber.energy(a * a + b * b, np.log(a * b))

        return minimize_scalar(of, bracket=(0.8, 1.2), tol=1e-12).fun

    slope = [(least(a + step) - least(a - step)) / (2.0 * step) for a in stretch]
    assert rubber.uniaxial(stretch) == pytest.approx(slope, abs=1e-5)
    assert slope[0] < -1.0
    assert slope[3] > 1.0


def test_strip_is_a_beam_at_small_curvature():
    rubber = Rubber(12.0, 0.0)
    assert energy(rubber, 0.02) == pytest.approx(0.5 * 1.0 * 0.02**2, rel=2e-3)
    assert moment(rubber, 0.1) == pytest.approx(0.1, rel=4e-3)


def moment_of_law(rubber, plane, kappa):
    """Moment of a section of thickness 1 without axial force, by the law of the network."""
    bent = material(rubber, plane, "section")
    law = law_of_section(bent, plane_factors(bent)[1], contraction(bent))

    def respond(e):
        """Force and moment; both of the outer points weigh 5/18, and both ends are counted."""
        theta = kappa * OUTER
        _, (by_e, by_theta, _), _ = law.respond((e, theta, theta), NO_MEMORY, 0)
        along = law.curve.respond(e, NO_MEMORY, 0)[1]
        return along + 5.0 / 36.0 * by_e, 5.0 / 18.0 * OUTER * by_theta

    e = brentq(lambda e: respond(e)[0], -0.2, 0.2, xtol=1e-12)
    return respond(e)[1] / MPA


@pytest.mark.parametrize(
    ("plane", "kappa", "within"),
    [("stress", 0.4, 0.1), ("stress", 0.8, 0.1), ("strain", 0.4, 0.1), ("strain", 0.8, 0.25)],
)
def test_sections_soften_like_a_strip(plane, kappa, within):
    rubber = RUBBERS[plane](12.0, 0.48)
    stiffness = 12.0 / (1.0 - 0.48**2 if plane == "strain" else 1.0) / 12.0
    soft = softening(rubber, stiffness, kappa)
    assert 0.15 < soft / kappa**2 < 0.31
    assert 1.0 - moment_of_law(rubber, plane, kappa) / (stiffness * kappa) == (
        pytest.approx(soft, rel=within)
    )


def test_stored_solids_are_as_computed():
    case = Crush(0.1, "stress", 2, 0.02)
    strain, force, energy = stored()[case[:3]][:, 1:3]
    rows = np.array(crushed(case))[1:].T
    assert rows[0] == pytest.approx(strain)
    assert rows[1:] == pytest.approx(np.array([force, energy]), rel=1e-5)


@pytest.mark.parametrize("case", [fine for _, fine in PAIRS], ids=lambda case: f"{case[:2]}")
def test_network_comes_to_the_solid(case):
    """Forces within 5 % and energies within 3 %; with joints that are points it is too soft."""
    strains = [min(strain, case.strain) for strain in APART]
    truth = Side("", stored()[case[:3]]).at(strains)
    models = ("default", 3, {}), POINTS
    default, points = (side.at(strains) / truth - 1.0 for side in networks(case, models, "none"))
    assert np.abs(default[: len(strains)]).max() < 0.05
    assert np.abs(default[len(strains) :]).max() < 0.03
    assert points[-1] < -0.02


def test_crush_with_contact_comes_to_the_solid():
    truth = Side("", stored()[PACKED[-1][:3]]).at(WATCHED)
    (default,) = networks(PACKED[-1], [("default", 3, {})], "barrier")
    force, energy = np.split(default.at(WATCHED) / truth - 1.0, 2)
    assert np.abs(force).max() < 0.1
    assert np.abs(energy).max() < 0.05


@pytest.mark.parametrize("openings", GLUED)
def test_arms_on_glued_rows_are_as_in_the_table(openings):
    for nu, close in ((0.0, 6e-3), (0.5, 0.015)):
        found = on_glued_row(openings, nu)
        values = [found[i, j] for i, j, _ in ENTRIES.values()]
        assert values == pytest.approx(on_glued_rows()[openings] @ nu ** np.arange(3), abs=close)
