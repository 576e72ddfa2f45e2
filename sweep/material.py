"""The uniaxial law of a material: nominal stress over nominal strain, a C1 piecewise cubic.

Tension: the record, shape-preserving (pchip); below 1 % a straight line from the origin, since the
toe of a record is slack and grip. Compression: the material's own branch where its record has one,
else `0.7 lower + 0.3 upper` with the tension curve P, nominal strain e < 0 and stretch s = 1 + e:

    lower(e) = -P(-e)                    stress odd in nominal strain
    upper(e) = -P(1/s - 1) / s^2         Cauchy stress odd in log strain, incompressible

(weights from one moulded grade; good to about 30 % beyond 15 % compression).
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from sweep.params import Material
from sweep.record import TOE, stress_at

Floats = NDArray[np.float64]

LOWER_WEIGHT, UPPER_WEIGHT = 0.7, 0.3
COMPRESSION = -np.array(
    [
        *(0.7, 0.65, 0.6, 0.55, 0.5, 0.45, 0.4, 0.35, 0.3, 0.25),
        *(0.2, 0.15, 0.125, 0.1, 0.075, 0.05, 0.04, 0.03, 0.02, TOE),
    ]
)


@dataclass(frozen=True)
class StressLaw:
    """Stress (Pa) = c0 + c1 s + c2 s^2 + c3 s^3, with s = strain - knots[i] in interval i.

    knots (k,) increase; coefficients (k - 1, 4). Beyond the ends: the last tangent.
    """

    knots: Floats
    coefficients: Floats


@lru_cache(maxsize=64)
def stress_law(material: Material) -> StressLaw:
    """The law of a material under uniaxial stress; the plane-strain factor is not in it."""
    if material.stretch == "linear":
        slope = material.modulus
        return StressLaw(np.array([0.0, 1.0]), np.array([[0.0, slope, 0.0, 0.0]]))
    return _cubics(*_knots(material.curve_strain, material.curve_stress))


def _cubics(knots: Floats, values: Floats, slopes: Floats) -> StressLaw:
    """The law with these values and slopes at its knots, (k,) each."""
    width, secant = np.diff(knots), np.diff(values) / np.diff(knots)
    bend = (slopes[:-1] + slopes[1:] - 2.0 * secant) / width
    square = (secant - slopes[:-1]) / width - bend
    return StressLaw(knots, np.column_stack([values[:-1], slopes[:-1], square, bend / width]))


def _knots(
    curve_strain: tuple[float, ...], curve_stress: tuple[float, ...]
) -> tuple[Floats, Floats, Floats]:
    """Strains (k,), stresses (k,) and slopes (k,) of the law."""
    strain, stress = np.array(curve_strain), np.array(curve_stress)
    own, above = strain < 0.0, strain > TOE
    toe = stress_at(TOE, curve_strain, curve_stress)
    knots = np.r_[strain[own], 0.0, TOE, strain[above]]
    values = np.r_[stress[own], 0.0, toe, stress[above]]
    slopes = shape_preserving_slopes(knots, values)
    slopes[own.sum() : own.sum() + 2] = toe / TOE  # both ends of the straight line
    if own.any():
        return knots, values, slopes
    values_below, slopes_below = _compression(COMPRESSION, knots, values, slopes)
    return (
        np.r_[COMPRESSION, knots],
        np.r_[values_below, values],
        np.r_[slopes_below, slopes],
    )


def shape_preserving_slopes(knots: Floats, values: Floats) -> Floats:
    """Slopes at the knots (k,), k > 2, by which the cubics between them make no new extremum.

    Inside: weighted harmonic mean of the secants on both sides, 0 where they differ in sign
    (Fritsch & Butland 1984). At the ends: three-point formula, bounded (Moler 2004, section 3.6).
    """
    width, secant = np.diff(knots), np.diff(values) / np.diff(knots)
    before, after = secant[:-1], secant[1:]
    weight = 2.0 * width[1:] + width[:-1], width[1:] + 2.0 * width[:-1]
    monotone = before * after > 0.0
    safe = np.where(monotone, before, 1.0), np.where(monotone, after, 1.0)
    mean = (weight[0] + weight[1]) / (weight[0] / safe[0] + weight[1] / safe[1])
    inner = np.where(monotone, mean, 0.0)
    return np.r_[_end_slope(width, secant), inner, _end_slope(width[::-1], secant[::-1])]


def _end_slope(width: Floats, secant: Floats) -> float:
    """Slope at the end where the first of these intervals begins."""
    slope = ((2.0 * width[0] + width[1]) * secant[0] - width[0] * secant[1]) / width[:2].sum()
    if slope * secant[0] <= 0.0:
        return 0.0
    if secant[0] * secant[1] <= 0.0 and abs(slope) > 3.0 * abs(secant[0]):
        return float(3.0 * secant[0])
    return float(slope)


def _compression(
    strain: Floats, knots: Floats, values: Floats, slopes: Floats
) -> tuple[Floats, Floats]:
    """Stress and slope at compressive strains, from the tension curve through the knots."""
    stretch = 1.0 + strain
    lower, lower_slope = _tension(-strain, knots, values, slopes)
    cauchy, cauchy_slope = _tension(1.0 / stretch - 1.0, knots, values, slopes)
    stress = -LOWER_WEIGHT * lower - UPPER_WEIGHT * cauchy / stretch**2
    upper_slope = cauchy_slope / stretch**4 + 2.0 * cauchy / stretch**3
    return stress, LOWER_WEIGHT * lower_slope + UPPER_WEIGHT * upper_slope


def _tension(
    strain: Floats, knots: Floats, values: Floats, slopes: Floats
) -> tuple[Floats, Floats]:
    """Stress and slope of the tension curve; beyond its end it goes on with the last tangent."""
    law, inside = _cubics(knots, values, slopes), np.minimum(strain, knots[-1])
    interval = np.searchsorted(knots[1:-1], inside, side="right")
    s, (c0, c1, c2, c3) = inside - knots[interval], law.coefficients[interval].T
    tangent = c1 + s * (2.0 * c2 + s * 3.0 * c3)
    return c0 + s * (c1 + s * (c2 + s * c3)) + tangent * (strain - inside), tangent
