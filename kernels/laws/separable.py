"""The function of one stretch behind a separable energy, from a nominal stress curve.

An incompressible material with W = w(l1) + w(l2) + w(l3) has under uniaxial stress the nominal
stress P(l) = w'(l) - l^(-3/2) w'(l^(-1/2)). Times l, with x = ln l, h(x) = l w'(l) and the Cauchy
stress S(x) = l P(l), that is

    S(x) = h(x) - h(-x / 2)

Putting the equation into itself again and again gives the sum

    h(x) = S(x) + S(-x / 2) + S(x / 4) + S(-x / 8) + ..

which converges, as S(x) is of the order of x at rest, and is the only solution that is smooth there
(but for a constant h(0), which adds nothing to W, as the sum of all x is 0): P in tension and in
compression determines w (E. Kearsley and L. Zapas, J. Rheology 24, 1980, p. 483). Its slope follows
from S' in the same way, so that cubics through values and slopes are C1 like the curve itself.

S must be known for all x; where the curve ends, it is continued so that the walls of a fold close
only at infinite stress: in compression by S + S' (1 - exp(x_end - x)), as that of a neo-Hookean
material rises; in tension by the tangent of the nominal stress.
"""

import numpy as np

TERMS = 60
WIDEST = 6.0  # of x: a stretch of 400
FINEST, COUNT = 1e-3, 96  # first knot beside the rest state, and knots on either side of it


def knots():
    """Return the knots (2 COUNT + 1,) in x, closer to each other near the rest state."""
    side = np.geomspace(FINEST, WIDEST, COUNT)
    return np.concatenate([-side[::-1], [0.0], side])


def continued(nominal, least, x):
    """Return S and dS/dx (n,) in Pa at ``x`` (n,).

    nominal: function of strains (n,) that returns the stress P and its slope, both (n,) in Pa, for
    all strains from ``least`` on, a nominal strain above -1 at which S rises with x.
    """
    end = np.log1p(least)
    inside = np.maximum(x, end)
    stretch = np.exp(inside)
    stress, slope = nominal(np.expm1(inside))
    value, rise = stretch * stress, stretch * (stress + stretch * slope)
    growth = np.exp(inside - x)
    return value + rise * (1.0 - growth), rise * growth


def principal(nominal, least, x):
    """Return h and dh/dx (n,) in Pa at ``x`` (n,); nominal, least: see `continued`.

    Raises ValueError where the stress at ``least`` falls with the stretch.
    """
    _, rise = continued(nominal, least, np.array([np.log1p(least)]))
    if not rise[0] > 0.0:
        raise ValueError(
            f"the Cauchy stress falls with the stretch at a strain of {least:g}: allowed are curves"
            " whose Cauchy stress rises there"
        )
    value, slope, factor = np.zeros_like(x), np.zeros_like(x), 1.0
    for _ in range(TERMS):
        stress, rise = continued(nominal, least, factor * x)
        value += stress
        slope += factor * rise
        factor *= -0.5
    return value, slope


def cubics(x, value, slope):
    """Return the coefficients (n - 1, 4) of the C1 cubics through values and slopes (n,), and their
    integral (n,) from 0, which is one of the knots ``x`` (n,).
    """
    step, rise = np.diff(x), np.diff(value) / np.diff(x)
    first, last = slope[:-1], slope[1:]
    second = (3.0 * rise - 2.0 * first - last) / step
    third = (first + last - 2.0 * rise) / step**2
    rows = np.column_stack([value[:-1], first, second, third])
    powers = np.arange(1, 5)
    gained = np.sum(rows / powers * step[:, None] ** powers, axis=1)
    energy = np.concatenate([[0.0], np.cumsum(gained)])
    return rows, energy - energy[np.searchsorted(x, 0.0)]
