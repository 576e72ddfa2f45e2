"""Lines become a network that is the same however they are cut, doubled or drawn a little off."""

import numpy as np
import pytest

from sweep.design.meeting import MOST_JOINTS, NEAR, MeetingError, met

SIDE = 10.0
FRAME = [
    ((0, 0), (SIDE, 0)),
    ((SIDE, 0), (SIDE, SIDE)),
    ((SIDE, SIDE), (0, SIDE)),
    ((0, SIDE), (0, 0)),
]


def network(lines):
    """Joints, and walls by the places of their ends."""
    made = met(np.array(lines, float))
    return made, {tuple(map(tuple, made.joints[wall].round(6))) for wall in made.walls}


def test_lines_meet_where_they_cross_and_touch():
    made, walls = network([*FRAME, ((0, 4), (SIDE, 4)), ((6, 0), (6, SIDE)), ((0, 0), (6, 4))])
    assert len(made.joints) == 9
    assert walls == {
        ((0, 0), (6, 0)), ((6, 0), (10, 0)), ((0, 0), (0, 4)), ((0, 0), (6, 4)),
        ((6, 0), (6, 4)), ((10, 0), (10, 4)), ((0, 4), (6, 4)), ((6, 4), (10, 4)),
        ((0, 4), (0, 10)), ((6, 4), (6, 10)), ((10, 4), (10, 10)), ((0, 10), (6, 10)),
        ((6, 10), (10, 10)),
    }  # fmt: skip
    rows = made.joints[:, 1]
    assert np.all(np.diff(rows) >= 0.0)
    assert made.line[[tuple(w) == (0, 4) for w in made.walls]].tolist() == [6]


def test_gaps_and_overshoots_of_a_drawing_do_not_count():
    """Ends up to `NEAR` beside a line are on it, and the line stays straight."""
    off = 0.9 * NEAR * SIDE
    exact = [*FRAME, ((5, 0), (5, SIDE)), ((0, 5), (5, 5))]
    sloppy = [*FRAME, ((5, -off), (5, SIDE - off)), ((off, 5), (5 - off, 5 + off))]
    (one, _), (other, _) = network(exact), network(sloppy)
    np.testing.assert_array_equal(one.walls, other.walls)
    np.testing.assert_allclose(one.joints, other.joints - other.joints.min(axis=0), atol=2 * off)
    bottom = other.joints[np.abs(other.joints[:, 1]) < 2 * off]
    assert len(bottom) == 3
    assert np.ptp(bottom[:, 1]) == 0.0
    tilted, _ = network([*FRAME[:2], ((SIDE, SIDE), (0, SIDE - off)), ((0, SIDE - off), (0, 0))])
    assert np.unique(tilted.joints[:, 1]).tolist() == pytest.approx([0.0, SIDE])
    apart = network([*FRAME, ((5, 3 * off), (5, SIDE))])[0]
    assert np.bincount(apart.walls.ravel()).min() == 1


def test_walls_that_overlap_are_one_and_the_last_counts():
    """Common sides of hexagons that are drawn one by one overlap in this way."""
    made, walls = network([((0, 0), (6, 0)), ((4, 0), (9, 0)), ((9, 0), (4, 0)), ((0, 0), (0, 5))])
    assert walls == {((0, 0), (4, 0)), ((4, 0), (6, 0)), ((6, 0), (9, 0)), ((0, 0), (0, 5))}
    assert sorted(made.line) == [0, 2, 2, 3]
    turn = np.pi / 6 + np.arange(7) * np.pi / 3
    ring = np.column_stack([np.cos(turn), np.sin(turn)])
    rings = [ring + shift for shift in ([0.0, 0.0], [3**0.5, 0.0], [3**0.5 / 2, 1.5])]
    made = met(np.concatenate([np.stack([at[:-1], at[1:]], axis=1) for at in rings]))
    assert (len(made.joints), len(made.walls)) == (13, 15)


def test_a_network_meets_itself_again():
    """Nothing changes when its walls are drawn as lines, in another order and direction."""
    rng = np.random.default_rng(0)
    lines = rng.uniform(0.0, 1.0, (40, 2, 2))
    made = met(lines)
    crossings = len(made.walls) - len(made.joints)  # Euler: cells - pieces
    assert crossings > 100
    again = met(rng.permutation(made.joints[made.walls])[:, ::-1])
    np.testing.assert_array_equal(again.walls, made.walls)
    np.testing.assert_allclose(again.joints, made.joints, atol=1e-8)


def test_what_would_not_end_or_not_be_right_is_refused():
    x = np.linspace(0.0, 1.0, 20_000)
    fine = np.column_stack([x, 0.1 * np.sin(9.0 * x)])
    with pytest.raises(MeetingError, match="more closely than"):
        met(np.stack([fine[:-1], fine[1:]], axis=1))
    with pytest.raises(MeetingError, match=f"more than {MOST_JOINTS:,} times"):
        met(np.random.default_rng(1).uniform(0.0, 1.0, (1_000, 2, 2)))
