"""Which parts of walls may touch, from which distance, and with which weight."""

import numpy as np
import pytest

from kernels.plates.contacts import pairs, touching
from kernels.plates.contacts.pairs import FAR, LEAST_PATH, NEAR_SHARE, starts_at
from tests.support.kernels.surfaces import (
    Sheet,
    contact_of,
    pairs_of,
    placed,
    positions,
    term_of,
    two_sheets,
)

T = 0.7


def folded(angle, fine=6, length=9.0):
    """A wall of thickness `T` that turns by an ``angle`` half way."""
    sheet = Sheet(fine, 3, length, 3.0)
    s, z = sheet.points[:, 0] - 0.5 * length, sheet.points[:, 1]
    turn = np.where(s > 0, angle, 0.0)
    points = np.column_stack([s * np.cos(turn), s * np.sin(turn), z])
    return points, sheet.triangles, sheet.area


def test_contact_starts_below_the_distance_at_rest_and_at_the_thickness_far_away():
    for path in (1e-3, 0.3, 1.0, 4.99 * T):
        assert starts_at(path, T) == pytest.approx(T * path / np.hypot(path, T))
        assert starts_at(path, T) < min(path, T)
    assert starts_at(FAR * T, T) == T
    assert starts_at(0.0, T) == 0.0
    assert starts_at(-T, T) == NEAR_SHARE * starts_at(T, T)


def test_a_wall_bent_to_its_limit_does_not_touch_itself_within_two_thicknesses():
    """Parts of an arc of curvature 2 / t that are s apart along it."""
    s = np.linspace(1e-3, 2.0, 200) * T
    assert all(starts_at(p, T) < T * np.sin(p / T) for p in s)


@pytest.mark.parametrize("fine", [4, 24])
def test_a_crease_is_kept_open(fine):
    """A wall that is folded flat between two rows of nodes, whatever the size of the elements."""
    points, triangles, area = folded(0.0, fine)
    touch = contact_of(points, triangles, area, T)
    energies = []
    for angle in (3.0, 3.1, 3.13):
        x = placed(folded(angle, fine)[0])
        listed = pairs_of(x, touch)
        listed.edge_contact[:] = 0.0
        beside = np.abs(points[:, 0]) < 9.5 / fine
        alone = touch._replace(area=np.where(beside, area, 0.0))
        energies.append(term_of(x, alone, listed).energy(x))
    assert energies[0] < energies[1] < energies[2]
    assert energies[2] > 0.1


@pytest.mark.parametrize("fine", [4, 12])
@pytest.mark.parametrize("angle", [0.0, 1.0, 1.57, 2.0944, 2.6])
def test_walls_at_rest_are_free_of_stress(angle, fine):
    points, triangles, area = folded(angle, fine)
    touch = contact_of(points, triangles, area, T)
    x = placed(points)
    assert term_of(x, touch).energy(x) == 0.0


def test_near_parts_are_not_in_contact():
    points, triangles, area = folded(0.0, 18)
    touch = contact_of(points, triangles, area, T)
    x = placed(points)
    listed = pairs.find(x, touch, 4.0)
    centre = points[triangles].mean(axis=1)
    seen = 0
    for p in range(len(points)):
        for q in range(listed.start[p], listed.start[p + 1]):
            away = np.linalg.norm(centre[listed.triangle[q]] - points[p])
            assert (listed.path[q] > 0.0) == (away >= LEAST_PATH * T)
            share = 1.0 if listed.path[q] > 0.0 else NEAR_SHARE
            assert listed.d_contact[q] == share * starts_at(abs(listed.path[q]), T)
            seen += away < LEAST_PATH * T
    assert seen > 400
    apart = np.linalg.norm(
        np.diff(points[touch.edges[np.stack([listed.one, listed.two])]].mean(axis=2), axis=0)[0],
        axis=1,
    )
    np.testing.assert_array_equal(listed.edge_path > 0.0, apart >= LEAST_PATH * T)


def weights(x, touch, p):
    """Weights of the corners or sides that node ``p`` sees."""
    listed = pairs_of(x, touch)
    own = slice(listed.lower_start[p], listed.lower_start[p + 1])
    return dict(zip(listed.lower[own].tolist(), listed.lower_weight[own].tolist(), strict=True))


def test_weights_of_a_flat_sheet():
    """-1 for each inner side, 1 for each inner corner, none at the rim; all see one surface."""
    x, touch = two_sheets(0.1, Sheet(3, 2, 0.3, 0.2), Sheet(1, 1, 0.1, 0.1))
    found = weights(x, touch, 12)
    inner = {f: weight for f, weight in found.items() if f < len(touch.area)}
    assert inner == {5: 1.0, 6: 1.0}
    sides = [weight for f, weight in found.items() if f not in inner]
    assert sides == [-1.0] * 13


def test_weights_where_walls_meet():
    """Three walls of one quad each at a line: two inner sides each shared by two, one by three."""
    points, triangles = [(0, 0, 0), (0, 0, 1)], []
    for angle in np.radians([0, 120, 240]):
        c, s, k = np.cos(angle), np.sin(angle), len(points)
        points += [(c, s, 0), (c, s, 1)]
        triangles += [(0, k, k + 1), (0, k + 1, 1)]
    points.append((0.1, 0.1, 0.5))
    area = np.zeros(9)
    area[8] = 1.0
    rest = np.array(points) + np.outer(np.arange(9) == 8, [100.0, 0, 0])
    touch = contact_of(np.array(points, float), np.array(triangles), area, 2.0, rest)
    x = placed(np.array(points, float))
    found = weights(x, touch, 8)
    assert sorted(found.values()) == [-2.0, -1.0, -1.0, -1.0]
    line = [e for e, (a, b) in enumerate(touch.edges.tolist()) if {a, b} == {0, 1}]
    assert found[9 + line[0]] == -2.0


@pytest.mark.parametrize("share", [0.5, 1.3])
def test_thickness_that_changes(share):
    """Contact starts at the present thickness; a pair has the mean thickness."""
    x, touch = two_sheets(0.4, Sheet(3, 3, 4, 4), Sheet(2, 2, 4, 4), T)
    listed = pairs_of(x, touch)
    upper = slice(16, None)
    touch.thickness[upper] *= share
    pairs.renew_distances(touch, listed)
    mean = 0.5 * T * (1.0 + share)
    between = [
        listed.d_contact[q]
        for p in range(16)
        for q in range(listed.start[p], listed.start[p + 1])
        if touch.triangles[listed.triangle[q], 0] >= 16
    ]
    np.testing.assert_allclose(between, mean, rtol=1e-12)
    fresh = pairs_of(x, touch)
    np.testing.assert_array_equal(listed.d_contact, fresh.d_contact)
    np.testing.assert_array_equal(listed.lower_contact, fresh.lower_contact)
    np.testing.assert_array_equal(listed.edge_contact, fresh.edge_contact)


def test_sides_take_the_least_distance_of_their_triangles():
    x, touch = two_sheets(0.3, Sheet(3, 3, 3, 3), Sheet(1, 1, 1, 1, (1, 1, 0)), T)
    touch.thickness[:16] *= np.linspace(0.5, 1.0, 16)
    listed = pairs_of(x, touch)
    p = 17
    own = range(listed.start[p], listed.start[p + 1])
    for j in range(listed.lower_start[p], listed.lower_start[p + 1]):
        f, nodes = listed.lower[j], None
        nodes = {f} if f < 20 else set(touch.edges[f - 20].tolist())
        shared = [
            listed.d_contact[q]
            for q in own
            if nodes <= set(touch.triangles[listed.triangle[q]].tolist())
        ]
        assert listed.lower_contact[j] == min(shared)
        assert nodes <= set(touch.triangles[listed.lower_triangle[j]].tolist())


def test_walls_of_different_thickness_never_attract():
    """Where t_c differs between triangles, no more is subtracted than there is."""
    x, touch = two_sheets(0.3, Sheet(4, 4, 3, 3), Sheet(2, 2, 2, 2, (0.4, 0.3, 0)), T)
    touch.thickness[:25] *= np.random.default_rng(0).uniform(0.4, 1.0, 25)
    for gap in (0.2, 0.35, 0.5, 0.6):
        y = x.copy()
        y[:-2].reshape(-1, 6)[25:, 2] = gap
        listed = pairs_of(y, touch)
        listed.edge_contact[:] = 0.0
        for p in range(25, 34):
            alone = touch._replace(area=np.where(np.arange(34) == p, 1.0, 0.0))
            assert term_of(y, alone, listed).energy(y) >= 0.0


def test_pairs_are_sorted_by_distance():
    x, touch = two_sheets(0.5, Sheet(3, 3, 3, 3), Sheet(2, 3, 3, 3))
    listed = pairs_of(x, touch)
    for p in range(len(touch.area)):
        own = listed.bound[listed.start[p] : listed.start[p + 1]]
        assert (np.diff(own) >= 0.0).all()
    assert (np.diff(listed.edge_bound) >= 0.0).all()
    assert pairs.edges_within(listed, 0.5) == (listed.edge_bound < 0.5).sum()
    assert pairs.edges_within(listed, np.inf) == len(listed.one)
    found = touching.no_contacts(touch, listed)
    assert found.distance.size == len(listed.triangle) + len(listed.lower) + len(listed.one)
    assert positions(x).shape == touch.rest.shape
