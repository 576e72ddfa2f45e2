"""The function of one stretch behind a separable energy, from a nominal stress curve.

Under uniaxial stress, an incompressible material with W = w(l1) + w(l2) + w(l3) has the nominal
stress P(l) = w'(l) - l^(-3/2) w'(l^(-1/2)). Multiplied by l, with x = ln l, h(x) = l w'(l) and the
Cauchy stress S(x) = l P(l), this is

    S(x) = h(x) - h(-x / 2)

Repeated substitution of the equation into itself gives

    h(x) = S(x) + S(-x / 2) + S(x / 4) + S(-x / 8) + ..

which converges, as S(x) is of the order of x at rest. This is the only solution that is smooth
there (up to a constant, which adds nothing to W, as the sum of all x is 0): tension and compression
determine w (E. Kearsley and L. Zapas, J. Rheology 24, 1980, p. 483).

A material is stable only if h rises (then greater stretches have greater stresses: M. Baker and J.
Ericksen, 1954). The measured tension is reproduced exactly. Compression, which mostly follows from
a rule (`sweep.scene.material`), is followed as far as h rises on both sides: outwards from the rest
state,

    h'(-y) = S'(-y) - h'(y / 2) / 2, but at least r and at most 2 (S'(2 y) - r)
    h'(y) = S'(y) - h'(-y / 2) / 2

with r = `LEAST` of the slope at rest. Neighbouring knots have a constant ratio, so that y / 2 and 2
y are knots too.

The piece that contains x follows from the logarithm of |x|, without a search.

S must be known for all x. Beyond the end of the curve, it is continued in compression by S + S' (1
- exp(x_end - x)), as for a neo-Hookean material, so that a fibre vanishes only at infinite stress;
in tension by the tangent of the nominal stress.
"""

import math
from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit
from kernels.laws.elastic import curve, least_of_fibre

TERMS = 60
OCTAVE = 16  # knots between y and 2 y
FIRST, OCTAVES = 2.0**-10, 12  # knots from 0.001 to 4 in |x|, a stretch of 55
LEAST = 0.02


@jit
def piece(law, x):
    """Return the index of the cubic at ``x``, clipped to the first or the last one.

    The knots are those that `rising` returns. If the logarithm is rounded into the next piece, the
    index is corrected.
    """
    knots, half, size = law.knots, law.knots.size // 2, abs(x)
    if not size >= FIRST:
        return half if x >= 0.0 else half - 1
    place = OCTAVE * math.log2(size / FIRST)
    step = int(place) if place < half - 2 else half - 2
    i = half + 1 + step if x >= 0.0 else half - 2 - step
    if x < knots[i] and i > 0:
        return i - 1
    return i + 1 if x >= knots[i + 1] and i < knots.size - 2 else i


class OctaveCurve(NamedTuple):
    """h over x; fields as in `elastic.FibreCurve`, with the knots of `rising`."""

    knots: np.ndarray
    coefficients: np.ndarray
    energy: np.ndarray
    modulus: float

    piece = piece
    respond = curve
    least = least_of_fibre


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
    """Return h by its series, and its slope, (n,) in Pa at ``x`` (n,), whether or not h rises."""
    value, slope, factor = np.zeros_like(x), np.zeros_like(x), 1.0
    for _ in range(TERMS):
        stress, rise = continued(nominal, least, factor * x)
        value += stress
        slope += factor * rise
        factor *= -0.5
    return value, slope


def _check(nominal, least, tension, size):
    """Raise ValueError where the Cauchy stress falls with the stretch. tension (n,): slopes; size:
    S' at 0.
    """
    rise = continued(nominal, least, np.array([np.log1p(least)]))[1][0]
    if not (size > 0.0 and rise > 0.0 and tension.min() > 2.0 * LEAST * size):
        raise ValueError(
            "the Cauchy stress of a sheet must rise with the stretch: in all of tension and at its"
            f" last compressive strain ({least:g})"
        )


def rising(nominal, least):
    """Return knots x (n,), h and dh/dx (n,) in Pa, h rising; nominal, least: see `continued`.

    Raises ValueError where the Cauchy stress falls with the stretch.
    """
    y = FIRST * 2.0 ** (np.arange(OCTAVE * OCTAVES + 1) / OCTAVE)
    tension = continued(nominal, least, np.append(y, 2.0 * y[-OCTAVE:]))
    at_rest = 2.0 / 3.0 * continued(nominal, least, np.zeros(1))[1][0]
    _check(nominal, least, tension[1], at_rest)
    down, down_rise = _of_compression(nominal, least, y, tension, LEAST * at_rest)
    up, up_rise = principal(nominal, least, y[:OCTAVE])
    up = np.append(up, tension[0][OCTAVE : y.size] + down[:-OCTAVE])
    up_rise = np.append(up_rise, tension[1][OCTAVE : y.size] - 0.5 * down_rise[:-OCTAVE])
    value = np.concatenate([down[::-1], [0.0], up])
    slope = np.concatenate([down_rise[::-1], [at_rest], up_rise])
    return np.concatenate([-y[::-1], [0.0], y]), value, slope


def _of_compression(nominal, least, y, tension, floor):
    """Return h(-y) and h'(-y) at the knots y (n,). tension: S(y), S'(y), with one octave more."""
    pressed, pressed_rise = continued(nominal, least, -y)
    value, slope = np.empty_like(y), np.empty_like(y)
    one, two = OCTAVE, 2 * OCTAVE
    value[:two], slope[:two] = principal(nominal, least, -y[:two])
    slope[:two] = np.maximum(slope[:two], floor)
    apart, before = 0.0, 0.0  # change of the slope by the limits, and its integral
    for k in range(two, y.size):
        wanted = pressed_rise[k] - 0.5 * (tension[1][k - one] - 0.5 * slope[k - two])
        slope[k] = min(max(wanted, floor), 2.0 * (tension[1][k + one] - floor))
        added = slope[k] - wanted
        apart += 0.5 * (before + added) * (y[k] - y[k - 1])
        before = added
        value[k] = pressed[k] + tension[0][k - one] + value[k - two] - apart
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
    at = np.searchsorted(x, 0.0)  # sums from here on lose no digits of small energies
    below, above = -np.cumsum(gained[:at][::-1])[::-1], np.cumsum(gained[at:])
    return rows, np.concatenate([below, [0.0], above])
