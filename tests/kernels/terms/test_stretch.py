"""Stretching: derivatives along the curve, the arc, geometric stiffness, rigid motions."""

import numpy as np
import pytest
from scipy.integrate import quad

from kernels.terms import stretch
from tests.support.kernels.frames import (
    curve_law,
    frame,
    joint_of_four,
    linear_law,
    point_of,
    scaled,
    shaken,
    stretch_of,
    walls_of,
)
from tests.support.kernels.terms import (
    NO_MEMORY,
    Term,
    derivative_error,
    difference,
    least_share,
    of_walls,
)

BAR = frame([(0, 0), (2.0, 1.0)], [(0, 1)], 1)
FRAME = joint_of_four()


ARCS = {"slender": (1 / 15, -1 / 30), "sheared": (-1 / 12, -1 / 3)}  # c_s and c_m


def term_of(of, law=curve_law, is_elastic=True, arc=ARCS["slender"]) -> Term:
    point = point_of(law(of.modulus))._replace(is_elastic=is_elastic)
    elements = stretch_of(of, arc)

    def write(shape, resultants, projected):
        return stretch.evaluate(elements, point, NO_MEMORY, shape, resultants, projected)

    return of_walls(walls_of(of), write)


def stretched(of, strain):
    """All elements at one strain."""
    x = of.rest.copy()
    x[: 2 * len(of.points)] *= 1.0 + strain
    return x


def test_an_elastic_law_is_one_whose_memory_is_empty():
    """Laws with and without memory are compiled separately."""
    assert (
        difference(term_of(FRAME), term_of(FRAME, is_elastic=False), shaken(FRAME, 0, 0.3)) < 1e-12
    )


@pytest.mark.parametrize("length", [1.0, 1e-3])
@pytest.mark.parametrize(
    ("strain", "step", "within"),
    [
        *((e, 1e-4, 1e-7) for e in (0.001, -0.01, 0.25, 1.4, -0.69)),
        *((knot, 1e-4, 2e-4) for knot in (0.0, 0.1)),  # the slope of the tangent jumps
        *((e, 1e-5, 1e-6) for e in (-0.701, -0.95)),  # under the guard
    ],
)
def test_derivatives_along_the_curve(strain, step, within, length):
    bar = scaled(BAR, length)
    assert derivative_error(term_of(bar), stretched(bar, strain), bar.unit, step) < within


@pytest.mark.parametrize("arc", ARCS)
@pytest.mark.parametrize("seed", range(2))
def test_derivatives_in_random_states(seed, arc):
    x = shaken(FRAME, seed)
    assert derivative_error(term_of(FRAME, arc=ARCS[arc]), x, FRAME.unit, 1e-4) < 1e-7


@pytest.mark.parametrize("strain", [-0.9, -0.3, 0.0, 0.2, 0.8])
def test_stiffness_of_a_bar_along_and_across(strain):
    """Across, with ends that do not turn: N / l of the chord, and A h sigma / 5 l^2 of the arc."""
    bar = frame([(0, 0), (2.0, 0)], [(0, 1)], 1)
    term, x = term_of(bar, linear_law), stretched(bar, strain)
    k, area, length = term.hessian(x), 0.8 * bar.depth, 2.0 * (1 + strain)
    if strain > -0.7:
        assert term.energy(x) == pytest.approx(0.5 * bar.modulus * area * 2.0 * strain**2)
        assert k[2, 2] == pytest.approx(bar.modulus * area / 2.0)
        across = bar.modulus * area * strain / length * (1.0 + 0.2 * 2.0 / length)
        assert k[3, 3] == pytest.approx(across, abs=1e-12)
    else:
        assert k[2, 2] > 2 * bar.modulus * area / 2.0
        assert k[3, 3] < 1.5 * bar.modulus * area * strain / length


@pytest.mark.parametrize("arc", ARCS)
@pytest.mark.parametrize("seed", range(2))
def test_projected_hessian_is_semi_definite_in_random_states(seed, arc):
    """It is so also for stout elements, which shorten as they shear: in tension they are
    unstable.
    """
    x, term = shaken(FRAME, seed, 0.4), term_of(FRAME, arc=ARCS[arc])
    assert np.linalg.eigvalsh(term.hessian(x))[0] < -1.0
    assert least_share(term, x) > -1e-12


def test_projection_changes_nothing_in_tension():
    x = stretched(FRAME, 0.08)
    exact, projected = (term_of(FRAME).hessian(x, p) for p in (False, True))
    np.testing.assert_allclose(projected, exact, rtol=0, atol=1e-12 * np.abs(exact).max())


def length_of_cubic(chord, one, two):
    """Length of a cubic with slopes tan(-one) and tan(-two) against its chord, by quadrature."""
    a, b = np.tan(-one), np.tan(-two)

    def speed(s):
        return np.sqrt(1.0 + (a * (1 - 4 * s + 3 * s * s) + b * (3 * s * s - 2 * s)) ** 2)

    return chord * quad(speed, 0.0, 1.0, epsabs=1e-13)[0]


@pytest.mark.parametrize(("one", "two"), [(1.0, 0.0), (1.0, 1.0), (1.0, -1.0), (-0.3, 0.8)])
def test_the_strain_is_that_of_the_arc(one, two):
    """The strain of the arc, to the fourth order in the turns."""
    apart = []
    for size in (0.1, 0.05):
        x = BAR.rest.copy()
        x[4:6] = -size * one, -size * two
        energy = term_of(BAR, linear_law).energy(x)
        l0, axial = BAR.l0[0], BAR.modulus * BAR.depth * BAR.thickness[0]
        strain = length_of_cubic(1.0, size * one, size * two) - 1.0
        apart.append(np.sqrt(2.0 * energy / (axial * l0)) - strain)
    assert apart[1] != 0.0
    assert np.log2(apart[0] / apart[1]) == pytest.approx(4.0, abs=0.1)
