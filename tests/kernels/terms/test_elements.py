"""Elements: deformations of the chord and the ends, the chain rule, products with a stiffness."""

import numpy as np
import pytest

from kernels.terms import elements
from tests.support.kernels.frames import carried, frame, joint_of_four, scaled, shaken, walls_of
from tests.support.kernels.terms import (
    Term,
    assembled,
    derivative_error,
    least_share,
    of_walls,
    room,
)

FRAME = joint_of_four()
WALLS = walls_of(FRAME)
BAR = frame([(0, 0), (2.0, 1.0)], [(0, 1)], 1)


def measured(x, x0=None, of=FRAME):
    """Shape of the elements, and the shortest length; turns count from x0 (or x)."""
    walls, frame = walls_of(of), np.full((len(of.edges), 3), np.inf)
    shape, *_ = room(walls)
    elements.renew_frame(x if x0 is None else x0, walls, frame)
    return elements.measure(x, walls, frame, shape), shape


def quadratic(of, seed, definite=True) -> Term:
    """1/2 q K q + k q of the deformations q of each element, a different K and k for each."""
    rng, m = np.random.default_rng(seed), len(of.edges)
    half = rng.uniform(-1, 1, (m, 3, 3))
    square = half @ half.transpose(0, 2, 1) if definite else half + half.transpose(0, 2, 1)
    line = rng.uniform(-1, 1, (m, 3)) * (not definite)
    unit = np.array([of.millimetre, 1.0, 1.0])
    square, line = square / np.outer(unit, unit), line / unit

    def write(shape, resultants, projected):
        q = np.column_stack([shape.length - of.l0, *shape.turn])
        pull = np.einsum("kij,kj->ki", square, q)
        resultants.force[:] = (pull + line).T
        resultants.rigidity[:] = square[:, [0, 0, 0, 1, 1, 2], [0, 1, 2, 1, 2, 2]].T
        return np.sum(q * (0.5 * pull + line))

    return of_walls(walls_of(of), write)


@pytest.mark.parametrize("turn", [0.3, np.pi / 2, 3.1, 3.2, -40.0])
def test_a_rigid_motion_changes_no_deformation(turn):
    """Any number of turns: ends are measured against their own rotation and never wrap."""
    x = shaken(FRAME, 5)
    moved = carried(FRAME, x, turn)
    _, expected = measured(x)
    assert np.abs(expected.turn).max() > 0.1
    for x0 in (moved, carried(FRAME, x, turn - 2.0), carried(FRAME, x, turn + 4.0)):
        _, shape = measured(moved, x0)
        np.testing.assert_allclose(shape.length, expected.length, rtol=1e-12)
        np.testing.assert_allclose(shape.turn, expected.turn, rtol=0, atol=1e-12)


@pytest.mark.parametrize("place", [0, 2])
def test_a_point_that_is_no_number_has_turns_that_are_none(place, monkeypatch):
    """Newton tries such points and rejects them by their energy, in plain Python too."""
    x = FRAME.rest.copy()
    x[WALLS.dofs[0, place]] = np.nan
    plain = getattr(elements.measure, "__wrapped__", elements.measure)
    for measure in (elements.measure, plain):
        monkeypatch.setattr(elements, "measure", measure)
        assert np.isnan(measured(x, FRAME.rest)[1].turn[:, 0]).all()


@pytest.mark.parametrize("definite", [True, False])
@pytest.mark.parametrize("length", [1.0, 1e-3])
@pytest.mark.parametrize("seed", range(2))
def test_the_chain_rule(seed, length, definite):
    of = scaled(FRAME, length)
    term, x = quadratic(of, seed, definite), shaken(of, seed, 0.3)
    assert derivative_error(term, x, of.unit, 3e-4) < 1e-7


@pytest.mark.parametrize("seed", range(2))
def test_projected_second_derivatives_are_semi_definite(seed):
    term, x = quadratic(FRAME, seed), shaken(FRAME, seed, 0.5)
    assert np.linalg.eigvalsh(term.hessian(x))[0] < -0.1
    assert least_share(term, x, FRAME.unit) > -1e-12


def test_without_the_geometric_part_a_pulled_bar_resists_nothing_across():
    walls, x = walls_of(BAR), BAR.rest
    for geometric, expected in ((True, 5.0 / np.sqrt(5.0)), (False, 0.0)):
        (shape, resultants, stiffness) = room(walls)
        elements.measure(x, walls, np.array([[*BAR.direction[0], 0.0]]), shape)
        resultants.force[0] = 5.0
        elements.add(resultants, geometric, False, shape, stiffness)
        across = np.array([-1.0, 2.0]) / np.sqrt(5.0)
        found = across @ assembled(walls, stiffness, x.size)[2:4, 2:4] @ across
        assert found == pytest.approx(expected, abs=1e-14)
