"""Contact in space: surfaces that count once at any mesh, derivatives, platens."""

import itertools

import numpy as np
import pytest

from kernels.geometry.space import near
from kernels.geometry.space.vectors import SIZE
from kernels.laws.barrier import barrier
from kernels.plates.contacts import admissible, contact, touching
from tests.support.kernels.surfaces import (
    Sheet,
    between_platens,
    contact_of,
    pairs_of,
    placed,
    positions,
    term_of,
    two_sheets,
    two_triangles,
    wavy,
)
from tests.support.kernels.terms import derivative_error, least_share

T = 1.0
MESHES = [(2, 2), (2, 3), (3, 3), (4, 4), (7, 5)]


def phi(d, t=T):
    """Energy per area of two walls at distance ``d`` with a stiffness of 1."""
    return t * barrier(d / t)[0]


def without_edges(listed):
    """Pairs without contact of edges."""
    return listed._replace(edge_contact=0.0 * listed.edge_contact)


def of_nodes(x, touch):
    return term_of(x, touch, without_edges(pairs_of(x, touch)))


def scaled(touch, length):
    """Contact of a surface in other units of length."""
    return touch._replace(
        reach=length * touch.reach, widths=length * touch.widths, area=length**2 * touch.area,
        thickness=length * touch.thickness, rest_thickness=length * touch.rest_thickness,
        rest=length * touch.rest, low_rest=length * touch.low_rest,
        high_rest=length * touch.high_rest,
    )  # fmt: skip


@pytest.mark.parametrize("gap", [0.05, 0.6])
@pytest.mark.parametrize("meshes", MESHES)
def test_parallel_sheets_count_once_at_any_mesh(meshes, gap):
    """Aligned and staggered nodes and diagonals: area x phi to round-off."""
    m, n = meshes
    x, touch = two_sheets(gap, Sheet(m, n, 4.0, 3.0), Sheet(n, m, 4.0, 3.0))
    term = of_nodes(x, touch)
    assert term.energy(x) == pytest.approx(12.0 * phi(gap), rel=1e-12)
    upper = (m + 1) * (n + 1)
    force = term.gradient(x)[:-2].reshape(-1, SIZE)[upper:, :3].sum(axis=0)
    np.testing.assert_allclose(force, [0, 0, 12.0 * barrier(gap)[1]], rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("shift", [(0.21, 0.0), (0.4, 0.33)])
def test_above_the_inside_of_a_sheet_one_contact_is_left_for_a_node(shift):
    """A small sheet over a large one: cancelling contacts leave the list, half the sum is exact."""
    x, touch = two_sheets(
        0.4, Sheet(6, 6, 6, 6), Sheet(2, 2, 2, 2, (2 + shift[0], 2 + shift[1], 0))
    )
    touch.area[:49] = 0.0
    listed = without_edges(pairs_of(x, touch))
    found = touching.no_contacts(touch, listed)
    energy = touching.detect(x, touch, listed, 0.0, found)
    assert energy == pytest.approx(0.5 * 4.0 * phi(0.4), rel=1e-12)
    per_node = np.bincount(found.nodes[: found.count[0], 0], minlength=58)
    assert (per_node[49:] == 1).all()


def hairpin(fine, gap, arm=6.0):
    """Coordinates and contact of a wall of width 3 that is bent back upon itself, flat at rest."""
    sheet = Sheet(fine, max(2, fine // 4), 2.0 * arm + 0.5 * np.pi * gap, 3.0)
    s, z = sheet.points[:, 0] - arm, sheet.points[:, 1]
    angle = np.clip(2.0 * s / gap, 0.0, np.pi)
    along = 0.5 * gap * np.sin(angle) + np.minimum(s, 0.0) - np.maximum(s - 0.5 * np.pi * gap, 0.0)
    x = placed(np.column_stack([along, z, 0.5 * gap * (1.0 - np.cos(angle))]))
    return x, contact_of(sheet.points, sheet.triangles, sheet.area, T)


@pytest.mark.parametrize(("gap", "share"), [(0.9, 0.774), (0.7, 0.865), (0.5, 0.892)])
def test_a_folded_wall_touches_itself_alike_at_any_mesh(gap, share):
    """Elements of 0.8 to 1.7 thicknesses. Near the fold contact starts later: a share of the arms
    is left, the same to a twentieth.
    """
    for fine in (8, 10, 12, 16):
        x, touch = hairpin(fine, gap)
        assert of_nodes(x, touch).energy(x) / (18.0 * phi(gap)) == pytest.approx(share, rel=0.055)


def strip(angles, fine, length=3.0):
    """Walls of unit width that share the z axis, at some angles: points, triangles, areas."""
    names, points, triangles = {}, [], []
    for angle in angles:
        sheet = Sheet(fine, 2 * fine, length, 6.0, (0.0, -3.0, 0.0))
        s, z = sheet.points[:, 0], sheet.points[:, 1]
        place = np.column_stack([s * np.cos(angle), s * np.sin(angle), z])
        found = [names.setdefault(tuple(np.round(q, 9) + 0.0), len(names)) for q in place]
        points += [q for n, q in zip(found, place, strict=True) if n >= len(points)]
        triangles.append(np.array(found)[sheet.triangles])
    return np.array(points), np.concatenate(triangles)


def energy_of_one(place, angles, fine, t=T):
    """Energy of one node of area 2 near walls that meet along a line."""
    surface, triangles = strip(angles, fine)
    points = np.vstack([surface, place])
    area = np.zeros(len(points))
    area[-1] = 2.0
    rest = points.copy()
    rest[-1] += 100.0
    touch = contact_of(points, triangles, area, t, rest)
    return of_nodes(placed(points), touch).energy(placed(points))


Y_JOINT = np.radians([90.0, 210.0, 330.0])
X_JOINT = np.radians([0.0, 90.0, 180.0, 270.0])
ANGLE = np.radians([0.0, 100.0])


@pytest.mark.parametrize("fine", [1, 5])
@pytest.mark.parametrize("along", [0.05, 0.61])
@pytest.mark.parametrize(
    ("angles", "place"),
    [(Y_JOINT, (0.4, 0.1)), (Y_JOINT, (0.1, 0.7)), (X_JOINT, (0.2, 0.5)), (ANGLE, (0.3, 0.2)),
     (ANGLE, (-0.2, -0.4)), (ANGLE, (-0.5, 0.3)), ([0.0, np.pi], (0.3, 0.4)), ([0.0], (-0.4, 0.3))],
)  # fmt: skip
def test_walls_that_meet_count_once_beyond_their_line(angles, place, fine, along):
    """Each wall counts; the line of k walls counts once, as it is subtracted k - 1 times."""
    expected = -(len(angles) - 1) * phi(np.hypot(*place))
    for angle in angles:
        u = np.array([np.cos(angle), np.sin(angle)])
        expected += phi(np.linalg.norm(np.array(place) - max(u @ place, 0.0) * u))
    assert energy_of_one((*place, along), angles, fine) == pytest.approx(expected, rel=1e-11)


@pytest.mark.parametrize("seed", range(3))
def test_derivatives_of_shaken_sheets(seed):
    x, touch = wavy(seed)
    listed = pairs_of(x, touch)
    found = touching.no_contacts(touch, listed)
    touching.detect(x, touch, listed, 0.0, found)
    sizes = found.size[: found.count[0]]
    assert {2, 3, 4} <= set(sizes.tolist())
    assert (found.pair[: found.count[0]] >= 0).sum() > 5
    assert derivative_error(term_of(x, touch, listed), x, 1.0, 5e-5) < 1e-7


@pytest.mark.parametrize("gap", [0.02, 0.3, 0.99])
@pytest.mark.parametrize("place", [(1.5, 1.5), (1.5, 1.2), (1.0 + 1e-3, 1e-3), (3.0, 1.1)])
def test_derivatives_above_corners_sides_and_the_rim(place, gap):
    """A small triangle with one corner just over special points of a sheet."""
    sheet = Sheet(2, 2, 3, 3)
    points = np.vstack([sheet.points, [(*place, gap), (place[0] + 0.3, 8, 9), (place[0], 9, 8)]])
    triangles = np.vstack([sheet.triangles, [(9, 10, 11)]])
    rest = points + np.outer(np.arange(12) > 8, [0, 0, 100.0])
    touch = contact_of(points, triangles, np.ones(12), T, rest)
    x = placed(points)
    off = 1e-3 * np.array([0.3, 0.7])
    for sign in itertools.product((-1, 1), repeat=2):
        y = x.copy()
        y[9 * SIZE : 9 * SIZE + 2] += off * sign
        step = 2e-5 * min(1.0, 10 * gap)
        assert derivative_error(term_of(y, touch), y, 1.0, step) < 1e-5


def test_the_gradient_is_continuous_over_corners_sides_and_the_rim():
    x, touch = two_sheets(0.35, Sheet(2, 2, 3, 3), Sheet(2, 2, 3, 3))
    term, slopes = term_of(x, touch), []
    for seed in range(6):
        move = 1e-9 * np.random.default_rng(seed).normal(size=x.size)
        slopes.append(term.gradient(x + move))
    assert np.abs(slopes[0]).max() > 0.5
    np.testing.assert_allclose(slopes, np.tile(slopes[0], (6, 1)), atol=1e-6)


def test_edges_that_cross_are_pushed_apart():
    """Two triangles with edges near each other and all nodes far."""
    points = np.array(
        [[-2, 0, 0], [2, 0, 0.1], [0.3, 0, -5], [0.2, -2, 0.2], [0, 2, 0.3], [0, 0, 5]]
    )
    triangles = np.array([(0, 1, 2), (3, 4, 5)])
    rest = points + np.outer([0, 0, 0, 1, 1, 1], [0, 0, 50.0])
    touch = contact_of(points.astype(float), triangles, np.ones(6), T, rest)
    x = placed(points)
    assert of_nodes(x, touch).energy(x) == 0.0
    term = term_of(x, touch)
    assert term.energy(x) > 0.1
    g = term.gradient(x)[:-2].reshape(-1, SIZE)[:, 2]
    assert g[:2].sum() == pytest.approx(-g[3:5].sum())
    assert g[:2].sum() > 0.1
    assert derivative_error(term, x, 1.0, 1e-4) < 1e-7


@pytest.mark.parametrize("tilt", [0.0, 1e-3, 0.03])
def test_derivatives_of_parallel_edges(tilt):
    lower = [[-2, 0, 0], [2, 0, 0], [0, 0, -5]]
    x, touch = two_triangles(lower, [[-1.9, -2 * tilt, 0.3], [2.1, 2 * tilt, 0.3], [0, 0, 5]])
    # Where edges are parallel the third derivative jumps.
    assert derivative_error(term_of(x, touch), x, 1.0, 1e-5) < (1e-4 if tilt == 0.0 else 1e-6)


@pytest.mark.parametrize("gap", [0.25, 0.4])
def test_contact_of_edges_is_second_to_that_of_nodes(gap):
    for meshes in MESHES:
        m, n = meshes
        x, touch = two_sheets(gap, Sheet(m, n, 4.0, 3.0), Sheet(n, m, 4.0, 3.0))
        share = term_of(x, touch).energy(x) / of_nodes(x, touch).energy(x)
        assert 1.0 <= share < 1.25


@pytest.mark.parametrize("seed", range(3))
def test_forces_have_no_resultant(seed):
    x, touch = wavy(seed)
    g = term_of(x, touch).gradient(x)[:-2].reshape(-1, SIZE)[:, :3]
    size = np.abs(g).sum()
    np.testing.assert_allclose(g.sum(axis=0), 0.0, atol=1e-13 * size)
    np.testing.assert_allclose(np.cross(positions(x), g).sum(axis=0), 0.0, atol=1e-12 * size)


def test_units_change_nothing():
    x, touch = wavy(0)
    metre = scaled(touch, 1e-3)
    assert term_of(1e-3 * x, metre).energy(1e-3 * x) == pytest.approx(
        1e-9 * term_of(x, touch).energy(x)
    )


@pytest.mark.parametrize("gap", [0.0, 1e-12])
@pytest.mark.parametrize("place", [(0.0, 0.0), (1.5, 1.5), (0.375, 0.75), (1.5, 0.75), (3.0, 0.75)])
def test_touching_surfaces_take_infinite_energy(place, gap):
    """The energy is infinite at corners and sides too, where the subtracted energy is infinite as
    well, and within the round-off of positions.
    """
    x, touch = two_sheets(0.5, Sheet(2, 2, 3, 3), Sheet(1, 1))
    x[9 * SIZE : 9 * SIZE + 3] = *place, gap
    assert term_of(x, touch).energy(x) == np.inf


def test_lists_with_a_margin_hold_while_nodes_move():
    x, touch = wavy(1)
    listed = pairs_of(x, touch)
    rng = np.random.default_rng(0)
    for _ in range(5):
        y = placed(positions(x) + rng.uniform(-0.3, 0.3, positions(x).shape))
        drift = near.farthest(y, x, len(touch.area))
        assert 2.0 * drift < touch.reach
        found, g = touching.no_contacts(touch, listed), np.zeros_like(y)
        energy = contact.evaluate(y, touch, listed, drift, found, g)
        expected = term_of(y, touch)
        assert energy == pytest.approx(expected.energy(y), rel=1e-12)
        np.testing.assert_allclose(g, expected.gradient(y), rtol=1e-9, atol=1e-12)
        gap = admissible.least_gap(y, touch, pairs_of(y, touch), 0.0)
        assert admissible.least_gap(y, touch, listed, drift) == pytest.approx(gap)


@pytest.mark.parametrize(("low", "high"), [(-0.05, 3.07), (-0.02, 3.2), (1.2, 1.8)])
def test_derivatives_against_platens(low, high):
    x, touch = between_platens(low, high)
    if low > 0:
        ends = np.flatnonzero(np.abs(positions(x)[:, 2] - 1.5) > 1)
        x[SIZE * ends + 2], x[SIZE * ends + 1] = 1.5, positions(x)[ends, 2] - 1.5
    term = term_of(x, touch)
    assert np.abs(term.gradient(x)[-2]) > 0.1
    assert derivative_error(term, x, 1.0, 2e-4) < 1e-6
    assert least_share(term, x) > -1e-13


def test_contact_with_platens_starts_at_rest_or_half_of_the_thickness():
    clearance, half = 0.08, 0.4
    x, touch = between_platens(-clearance * (1 + 1e-9), 3.0 + clearance * (1 + 1e-9))
    assert term_of(x, touch).energy(x) == 0.0
    x[-2] = -0.5 * clearance
    area = 9.0 / 4.0
    expected = area * phi(0.5 * clearance, clearance)
    assert term_of(x, touch).energy(x) == pytest.approx(expected)
    pressed = [contact.platen_block(x, touch, False, i)[1] for i in range(3)]
    assert sum(pressed) == pytest.approx(-area * barrier(0.5)[1])
    assert -term_of(x, touch).gradient(x)[-2] == pytest.approx(-sum(pressed))
    x[-2], x[SIZE * np.arange(3) + 1], x[SIZE * np.arange(3) + 2] = 1.5 - 0.3, 1.5, 2.0
    assert term_of(x, touch).energy(x) == pytest.approx(2.0 * area * phi(0.3, half))
