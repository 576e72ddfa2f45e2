"""Collision detection: the first contact is never late, never missed and never invented."""

import numpy as np
import pytest

from kernels.geometry import ccd

SAMPLES = np.linspace(0.0, 1.0, 301)
LENGTHS = [1.0, 1e-3, 1e3]


def along_path(x, dx, s):
    """Cross product and position along segment 1-2 of node 0, at shares ``s`` of the steps (k,)."""
    at = (x[:, None] + s[:, None] * dx[:, None]).reshape(len(x), len(s), 3, 2)
    u, w = at[:, :, 2] - at[:, :, 1], at[:, :, 0] - at[:, :, 1]
    cross = u[..., 0] * w[..., 1] - u[..., 1] * w[..., 0]
    return cross, np.sum(u * w, axis=-1), np.sum(u * u, axis=-1)


def contacts(x, dx):
    return np.array([ccd.first_contact(a, b, 0, 1, 2) for a, b in zip(x, dx, strict=True)])


def sampled(x, dx):
    """Share by which each motion has surely crossed the inside of the segment, else infinity."""
    cross, along, l2 = along_path(x, dx, SAMPLES)
    inside = (along > 0) & (along < l2)
    crossed = (np.sign(cross[:, 1:]) * np.sign(cross[:, :-1]) < 0) & inside[:, 1:] & inside[:, :-1]
    return np.where(crossed.any(axis=1), SAMPLES[1:][np.argmax(crossed, axis=1)], np.inf)


def distance(x, dx, s):
    """Distance of node 0 from segment 1-2 at one share of each motion, relative to the segment."""
    at = (x + s[:, None] * dx).reshape(-1, 3, 2)
    u, w = at[:, 2] - at[:, 1], at[:, 0] - at[:, 1]
    l2 = np.sum(u * u, axis=1)
    tau = np.clip(np.sum(u * w, axis=1) / l2, 0.0, 1.0)
    return np.linalg.norm(w - tau[:, None] * u, axis=1) / np.sqrt(l2)


@pytest.mark.parametrize("length", LENGTHS)
@pytest.mark.parametrize("speed", [0.2, 1.0, 5.0])
def test_first_contact_of_random_motions(speed, length):
    rng = np.random.default_rng(int(10 * speed))
    x = length * rng.uniform(-1, 1, (3000, 6))
    dx = speed * length * rng.uniform(-1, 1, (3000, 6))
    first, known = contacts(x, dx), sampled(x, dx)
    hit = first <= 1.0
    assert 80 < hit.sum() < 2900
    assert np.all(first <= known)
    assert distance(x[hit], dx[hit], first[hit]).max() < 1e-8


def touching(x, dx, s):
    """Whether node 0 lies on segment 1-2 to within round-off, where the segment has a length."""
    cross, along, l2 = (v[:, 0] for v in along_path(x, dx, np.array([s])))
    return (abs(cross) < 1e-13) & (along > -1e-13) & (along < l2 + 1e-13) & (l2 > 1e-3)


@pytest.mark.parametrize("seed", range(3))
def test_small_integers_meet_every_degenerate_case(seed):
    """Nodes on a 3 x 3 raster pass through ends, and move along the line of the segment."""
    rng = np.random.default_rng(seed)
    x, dx = rng.integers(-1, 2, (3000, 6)) * 1.0, rng.integers(-2, 3, (3000, 6)) * 1.0
    kept = np.any(x[:, 2:4] != x[:, 4:], axis=1) & ~touching(x, dx, 0.0)
    x, dx = x[kept], dx[kept]
    first = contacts(x, dx)
    assert np.sum(first <= 1.0) > 500
    assert np.all(first <= sampled(x, dx))
    met = 0
    for s in np.arange(1, 61) / 60.0:
        touches = touching(x, dx, s)
        met += touches.sum()
        assert np.all(first[touches] <= s * (1 + 1e-12))
    assert met > 300


@pytest.mark.parametrize("bearing", [0.0, 0.3, 1.7])
@pytest.mark.parametrize(
    ("start", "move", "expected"),
    [
        ((3.0, 0.0), (-4.0, 0.0), 0.5),  # head-on, along the line of the segment
        ((-1.0, 0.0), (2.0, 0.0), 0.5),
        ((3.0, 0.0), (4.0, 0.0), np.inf),
        ((3.0, 0.0), (0.0, 0.0), np.inf),
        ((1.0, 1.0), (0.0, -2.0), 0.5),  # through an end
        ((0.0, 1.0), (0.0, -2.0), 0.5),
        ((0.5, 1.0), (1.0, -2.0), 0.5),
        ((0.5, 1.0), (0.0, -1 / 1.9), 1.9),  # after the step
        ((1.0 + 1e-6, 1.0), (0.0, -2.0), np.inf),  # just past an end
        ((0.5, 1.0), (5.0, 0.0), np.inf),  # parallel
        ((0.5, 1.0), (0.0, 0.0), np.inf),  # at rest
        ((0.5, 0.0), (0.3, 1.0), 0.0),  # in touch
        ((0.5, 1.0), (0.2, 3.0), np.inf),  # leaving
    ],
)
def test_first_contact_with_a_segment_at_rest(start, move, expected, bearing):
    turn = np.array([[np.cos(bearing), -np.sin(bearing)], [np.sin(bearing), np.cos(bearing)]])
    x = np.array([start, (0.0, 0.0), (1.0, 0.0)]) @ turn.T
    dx = np.array([move, (0.0, 0.0), (0.0, 0.0)]) @ turn.T
    assert ccd.first_contact(x.ravel(), dx.ravel(), 0, 1, 2) == pytest.approx(expected, abs=1e-9)


def test_a_wall_that_turns_as_a_whole_never_meets_itself():
    x = np.array([3.0, 0, 0, 0, 1, 0])
    turned = np.array([0.0, 3.0, 0, 0, 0, 1.0])
    assert ccd.first_contact(x, turned - x, 0, 1, 2) >= 1.0
    assert ccd.first_contact(x, np.array([0.0, 3.0, 0, 0, 0, 1.0]), 0, 1, 2) == np.inf


@pytest.mark.parametrize(("one", "two"), [(0.5, 2.0), (1e-12, 1e3), (-1e-10, 1e5), (-1, -2)])
def test_roots_without_cancellation(one, two):
    found = sorted(ccd.roots(1e9 * one * two, -1e9 * (one + two), 1e9))
    np.testing.assert_allclose(found, sorted((one, two)), rtol=1e-13)


@pytest.mark.parametrize(
    ("coefficients", "expected"),
    [
        ((1.0, 0.0, 0.0), (np.inf, np.inf)),
        ((0.0, 0.0, 0.0), (np.inf, np.inf)),
        ((-3.0, 2.0, 0.0), (1.5, np.inf)),
        ((1.0, 0.0, 1.0), (np.inf, np.inf)),
        ((0.0625, -0.5, 1.0), (0.25, 0.25)),
        ((-4.0, 0.0, 1.0), (-2.0, 2.0)),
        ((0.0, -2.0, 1.0), (0.0, 2.0)),
        ((-1.0, 1.0, 1e-300), (1.0, -1e300)),
    ],
)
def test_roots_of_degenerate_quadratics(coefficients, expected):
    np.testing.assert_allclose(sorted(ccd.roots(*coefficients)), sorted(expected))


def openings(x, dx):
    """Angle from arm 1-0 to arm 1-2 along the step, unwrapped from its start in (0, 2 pi)."""
    at = (x + SAMPLES[:, None] * dx).reshape(-1, 3, 2)
    u, v = at[:, 0] - at[:, 1], at[:, 2] - at[:, 1]
    angle = np.arctan2(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0], np.sum(u * v, axis=1))
    angle = np.unwrap(angle, period=2 * np.pi)
    return angle + (2 * np.pi if angle[0] < 0 else 0.0)


def test_first_fold_of_random_motions():
    rng = np.random.default_rng(4)
    closed = 0
    for _ in range(2000):
        x, dx = rng.uniform(-1, 1, 6), rng.uniform(-1, 1, 6)
        angle = openings(x, dx)
        if np.abs(np.diff(angle)).max() > 0.5:  # an arm has passed through a length of nearly zero
            continue
        shut = (angle <= 0) | (angle >= 2 * np.pi)
        first = ccd.first_fold(x, dx, 0, 1, 2)
        if shut.any():
            closed += 1
            assert 0 < first <= SAMPLES[np.argmax(shut)]
            assert first >= SAMPLES[np.argmax(shut) - 1]
        else:
            assert first > 1.0
    assert closed > 100


@pytest.mark.parametrize("length", LENGTHS)
@pytest.mark.parametrize("share", [0.1, 0.5])
def test_first_shrink(share, length):
    rng = np.random.default_rng(5)
    short = 0
    for _ in range(1000):
        x, dx = length * rng.uniform(-1, 1, 4), 2 * length * rng.uniform(-1, 1, 4)
        u, du = x[2:] - x[:2], dx[2:] - dx[:2]
        first = ccd.first_shrink(x, dx, 0, 1, share)
        sizes = np.linalg.norm(u + SAMPLES[:, None] * du, axis=1) / np.linalg.norm(u)
        reached = sizes < share
        if reached.any():
            short += 1
            assert np.linalg.norm(u + first * du) == pytest.approx(share * np.linalg.norm(u))
            assert first <= SAMPLES[np.argmax(reached)]
        else:
            assert first > SAMPLES[-2] or sizes.min() < share + 1e-2
    assert short > 20


@pytest.mark.parametrize(
    ("arms", "move", "expected"),
    [
        ([-1.0, 0, 0, 0, 1, 0], [0.0, 0, 0, 0.5, 0, 0], np.inf),  # straight
        ([-1.0, 0, 0, 0, 1, 0], [0.0, 0, 0, 0, 0, 0], np.inf),
        ([-1.0, 1.0, 0, 0, 1.0, 1.0], [4.0, 0, 0, 0, -4.0, 0], 0.25),
        ([-1.0, 1.0, 0, 0, 1.0, 1.0], [1 / 1.9, 0, 0, 0, -1 / 1.9, 0], 1.9),  # after the step
    ],
)
def test_first_fold_by_hand(arms, move, expected):
    assert ccd.first_fold(np.array(arms), np.array(move), 0, 1, 2) == pytest.approx(expected)


def test_what_keeps_or_gains_length_never_shrinks():
    x = np.array([0.0, 0, 1.0, 0])
    assert ccd.first_shrink(x, np.zeros(4), 0, 1, 0.1) == np.inf
    assert ccd.first_shrink(x, np.array([0.0, 0, 3.0, 0]), 0, 1, 0.1) == np.inf
    assert ccd.first_shrink(x, np.array([0.0, 0, -1.0, 0]), 0, 1, 0.1) == pytest.approx(0.9)
