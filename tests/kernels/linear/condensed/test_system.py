"""The linear system: condensed, open and rigid walls between joints, against dense algebra."""

import numpy as np
import pytest

from kernels.linear.condensed import system
from kernels.linear.pivots import SOFT
from tests.support.kernels.frames import frame, layout_of
from tests.support.kernels.terms import by_home
from tests.support.kernels.webs import (
    COUPLINGS,
    MIXED,
    SUPPORTS,
    Problem,
    couplings,
    random_stiffness,
    supported,
    web,
)


@pytest.mark.parametrize("pieces", [3, MIXED])
@pytest.mark.parametrize("coupled", COUPLINGS)
@pytest.mark.parametrize("support", SUPPORTS)
def test_factor_and_solve(support, coupled, pieces):
    of = web(pieces)
    problem = Problem(of, supported(of, support), couplings(of, coupled))
    for seed in range(2):  # the second time in place of the first
        rng = np.random.default_rng(seed)
        problem.stiffness = random_stiffness(of, rng)
        assert problem.factor() == (False, 0.0)
        assert problem.found.matrix.missing[0] == 0
        assert problem.is_factored(rng.uniform(-1, 1, problem.n))


def weakened(problem, c):
    """Make the stiffness of coordinate ``c`` and of all coordinates tied to it negative."""
    moved = (problem.layout.leader == c).astype(float)
    problem.diagonal[c] -= 1.5 * moved @ problem.dense() @ moved


@pytest.mark.parametrize("coupled", COUPLINGS)
@pytest.mark.parametrize("support", SUPPORTS)
def test_descent_along_a_negative_pivot(support, coupled):
    """d^T A d is that pivot; d is admissible: tied coordinates move together, held ones do not
    move.
    """
    of = web(MIXED)
    problem = Problem(of, supported(of, support), couplings(of, coupled))
    rng = np.random.default_rng(0)
    free = np.flatnonzero(problem.layout.leader == np.arange(problem.n))
    free = free[free != problem.layout.driven]
    for c in rng.choice(free, 12, replace=False):
        kept = problem.diagonal[c]
        weakened(problem, c)
        failed, pivot = problem.factor()
        assert failed
        assert pivot < 0.0
        d = np.full(problem.n, 7.0)
        system.descend(problem.found, problem.layout, d)
        assert d @ problem.dense() @ d == pytest.approx(pivot, rel=1e-8)
        R = problem.reduction()
        np.testing.assert_allclose(R @ np.linalg.lstsq(R, d)[0], d, rtol=0, atol=1e-12)
        problem.diagonal[c] = kept


@pytest.mark.parametrize("pieces", [3, MIXED])
def test_of_several_walls_with_a_negative_pivot_the_first_is_named(pieces):
    """The first wall is named in whatever bundles the walls are."""
    of = web(pieces)
    problem = Problem(of, supported(of, "clamped"), couplings(of, "condensed"))
    for wall in (7, 3, 2, 1):
        weakened(problem, 2 * of.edges[of.start[wall], 1] + 1)
        assert problem.factor()[0]
        assert (*problem.found.place[0],) == (wall, 1)
        d = np.zeros(problem.n)
        system.descend(problem.found, problem.layout, d)
        assert d @ problem.dense() @ d == pytest.approx(problem.factor()[1], rel=1e-8)


def test_nan_inside_a_condensed_wall_fails():
    of = web(MIXED)
    problem = Problem(of, supported(of, "clamped"), couplings(of, "condensed"))
    problem.stiffness.own[0, of.start[1]] = np.nan
    failed, pivot = problem.factor()
    assert failed
    assert np.isnan(pivot)


def test_what_has_no_stiffness_inside_a_wall_gets_a_share_of_the_scale():
    of = web(MIXED)
    problem = Problem(of, supported(of, "clamped"), couplings(of, "condensed"))
    for part in problem.stiffness:
        part[:, of.start[1] : of.start[2]] = 0.0
    node, b = of.edges[of.start[1], 1], np.zeros(problem.n)
    loose = [2 * node, 2 * node + 1, 2 * len(of.points) + node]
    problem.diagonal[loose], b[loose] = [3.0, 0.0, 0.0], 6.0
    assert problem.factor() == (False, 0.0)
    little = 6.0 / SOFT / np.array(problem.layout.scale)[1:]
    np.testing.assert_allclose(problem.solve(b)[loose], [2.0, *little])


@pytest.mark.parametrize("coupled", ["condensed", "some open", "all open", "in contact"])
@pytest.mark.parametrize("size", [1.0, 1e6, 1e-6])
def test_a_frame_that_floats_is_not_moved_as_a_whole(size, coupled):
    """Without mass it has no stiffness against translations: no failure, and loads are borne."""
    of = web(MIXED)
    problem = Problem(of, layout_of(of), couplings(of, coupled), mass=0.0)
    problem.contacts = []
    for part in problem.stiffness:
        part *= size
    problem.diagonal[-2:] = size
    problem.layout = problem.layout._replace(scale=(7.0 * size,) * 3)
    assert problem.factor() == (False, 0.0)
    full = problem.dense()
    values = np.linalg.eigvalsh(full)
    assert np.all(np.abs(values[:2]) < 1e-9 * values[-1])
    b = full @ np.random.default_rng(2).uniform(-1, 1, problem.n)
    y = problem.solve(b)
    assert np.abs(y).max() < 1e4
    y[-2] = 0.0
    b[-2] = 0.0
    np.testing.assert_allclose(full @ y, b, rtol=0, atol=1e-7 * size)


def test_where_all_joints_are_held_walls_are_solved_one_by_one():
    """No block is left."""
    of = frame([(0, 0), (4, 0), (4, 3)], [(0, 1), (1, 2)], [3, 5])
    joints = np.arange(3)
    held = np.concatenate([2 * joints, 2 * joints + 1, 2 * len(of.points) + joints])
    layout = layout_of(of, held, driven=True)
    problem = Problem(of, layout, np.empty((0, 3), np.int64))
    assert problem.factor() == (False, 0.0)
    assert by_home(problem.found.matrix).size == 0
    assert problem.is_factored(np.random.default_rng(0).uniform(-1, 1, problem.n))
