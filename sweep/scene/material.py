"""The uniaxial law of a material: nominal stress over nominal strain, a C1 piecewise cubic.

Tension: the record, with shape-preserving interpolation (pchip); below 1 % a straight line from the
origin, since the toe of a record shows slack and slip in the grips. Compression: the material's own
branch if its record has one, else `0.7 lower + 0.3 upper` with the tension curve P, nominal strain
e < 0 and stretch s = 1 + e:

    lower(e) = -P(-e)                    stress odd in nominal strain
    upper(e) = -P(1/s - 1) / s^2         Cauchy stress odd in log strain, incompressible

(weights fitted to one moulded grade; error about 30 % beyond 15 % compression).
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from kernels.compile.simd import LANES
from kernels.laws.elastic import ElasticCurve, FibreCurve
from kernels.laws.fibre import Fibre
from kernels.laws.relaxation import Relaxing
from kernels.laws.softening import Softening
from kernels.laws.yielding import Yielding
from kernels.terms.section import CRUSHED, BentSection
from sweep.array_types import Floats
from sweep.config.kinds.material import Material
from sweep.config.materials.material_file import TOE, stress_at
from sweep.scene.relaxation import relaxation_of

SECTION_FIBRES = 5  # with three, the moment has a dip of 2 to 4 % where walls fold
FIBRE = np.sqrt(3.0 / 20.0)  # place of the outer of three Gauss points, as a share of the thickness
OUTER = 5.0 / 18.0  # weight of this point
RADIAL = 0.5  # strain at which c of `kernels.terms.section` is found
LINEAR = 5.0 / 3.0  # least c, for a linear curve
MIDDLE = 1e-9  # share of half a thickness: nearer points are in the middle
UPPER_WEIGHT = 0.3  # of `upper`; the rest is of `lower`
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

    def at(self, strain: Floats) -> Floats:
        """Stress (n,) in Pa at strains (n,)."""
        return self.with_slope(strain)[0]

    def with_slope(self, strain: Floats) -> tuple[Floats, Floats]:
        """Stress and its slope (n,) in Pa at strains (n,)."""
        last = len(self.coefficients) - 1
        piece = np.clip(np.searchsorted(self.knots, strain, side="right") - 1, 0, last)
        inside = np.clip(strain, self.knots[0], self.knots[-1])
        c, s = self.coefficients[piece].T, inside - self.knots[piece]
        tangent = c[1] + s * (2.0 * c[2] + s * 3.0 * c[3])
        stress: Floats = c[0] + s * (c[1] + s * (c[2] + s * c[3])) + tangent * (strain - inside)
        return stress, np.asarray(tangent)


def linear_law(slope: float) -> StressLaw:
    """The law stress = slope x strain; slope in Pa."""
    return StressLaw(np.array([0.0, 1.0]), np.array([[0.0, slope, 0.0, 0.0]]))


@lru_cache(maxsize=64)
def stress_law(material: Material) -> StressLaw:
    """The law of stretching under uniaxial stress, without the factor of plane strain.

    A law with a formula is sampled here as a `StressLaw`; sections and plates then follow it too.
    """
    if material.stretch == "linear":
        return linear_law(material.modulus)
    return _record_law(material)


def section_law(material: Material) -> StressLaw:
    """The law of the fibres of a bent section: the law of stretching, or the curve where stretching
    is linear.
    """
    if material.stretch == "linear" and material.curve_strain:
        return _record_law(material)
    return stress_law(material)


def monotonic_law(material: Material) -> StressLaw:
    """The law of the first loading: `stress_law`, or the straight lines of a plastic."""
    if material.yield_stress is None or material.hardening is None:
        return stress_law(material)
    modulus, hardening = material.modulus, material.hardening
    knee = material.yield_stress / modulus
    tangent = modulus * hardening / (modulus + hardening)
    knots = np.array([-1.0, -knee, knee, 1.0])
    starts = [-material.yield_stress - tangent * (1.0 - knee), *(modulus * knots[1:3])]
    slopes = [tangent, modulus, tangent]
    lines = [[start, slope, 0.0, 0.0] for start, slope in zip(starts, slopes, strict=True)]
    return StressLaw(knots, np.array(lines))


def _record_law(material: Material) -> StressLaw:
    return _spline(*_knots(material.curve_strain, material.curve_stress))


@lru_cache(maxsize=64)
def law_in_stretch(material: Material, factor: float) -> Fibre:
    """The law of stretching for the kernels, with all stresses times ``factor``."""
    return _fibre(material, stress_law(material), ElasticCurve, factor)


@lru_cache(maxsize=64)
def law_of_section(material: Material, factor: float, nu: float) -> BentSection:
    """The law of bent sections for the kernels, with all stresses times ``factor``; nu: nu'.

    The radial stress of a wall that yields is left out.
    """
    curve = section_law(material)
    fibre = _fibre(material, curve, FibreCurve, factor)
    radial = 0.0 if material.yields else 2.0 / 3.0 * (1.0 - nu**2) * fibre.modulus
    bound = _bound(curve, material.modulus)
    fibres = _fibres(material.fibres or SECTION_FIBRES)
    return bent_section(fibre, fibres, 1.0 + nu, (radial, bound), fibre.modulus)


def bent_section(
    curve: Fibre,
    fibres: tuple[Floats, Floats],
    m: float,
    radial: tuple[float, float],
    stop: float,
) -> BentSection:
    """A section with these fields of `BentSection`; fibres: their places and weights, (f,) each."""
    place, weight = fibres
    whole = np.zeros(-(-place.size // LANES) * LANES)
    whole[: place.size] = place
    middle = 2.0 * float(weight.sum())
    return BentSection(curve, whole, weight, middle, m, CRUSHED**m, *radial, stop)


def _bound(curve: StressLaw, modulus: float) -> float:
    """The c of `kernels.terms.section`, from the mean stress of a curve at +-`RADIAL`, Pa."""
    stress = float(np.mean(np.abs(curve.at(np.array([-RADIAL, RADIAL])))))
    return float(max((modulus / stress) ** 2 - RADIAL**-2, LINEAR))


def _fibres(count: int) -> tuple[Floats, Floats]:
    """Places and weights of ``count`` Gauss points except the middle one, relative to the outer two
    of three.
    """
    place, weight = np.polynomial.legendre.leggauss(count)
    outer = np.abs(place) > MIDDLE
    return 0.5 / FIBRE * place[outer], 0.5 / OUTER * weight[outer]


@lru_cache(maxsize=64)
def law_of_hinge(material: Material) -> Fibre:
    """The law of linear springs for the kernels, of unit stiffness at the reference time."""
    shares, times, instant = relaxation_of(material)
    curve = FibreCurve(*as_law(linear_law(1.0), instant, 1.0))
    relaxing = Relaxing(Softening(curve, 0.0, 0.0, 0.0), shares, times, 1.0)
    return Fibre(relaxing, Yielding(1.0, 0.0, 0.0, 0.0), 1.0, not material.relaxes)


def _fibre(
    material: Material, curve: StressLaw, kind: type[ElasticCurve | FibreCurve], factor: float
) -> Fibre:
    """The law of a material point; kind: a wall, which has a barrier, or a fibre of its section."""
    shares, times, instant = relaxation_of(material)
    elastic = kind(*as_law(curve, factor * instant, material.modulus))
    modulus = factor * material.modulus
    relaxing = Relaxing(_softening(elastic, material, instant * factor), shares, times, modulus)
    guarded = modulus if kind is ElasticCurve else 0.0
    limit, hardening = material.yield_stress or 0.0, material.hardening or 0.0
    yielding = Yielding(modulus, factor * limit, factor * hardening, guarded)
    return Fibre(relaxing, yielding, modulus, not material.remembers)


def _softening(curve: ElasticCurve | FibreCurve, material: Material, factor: float) -> Softening:
    """A curve that softens on reloading; factor: of all stresses."""
    r, m, beta = material.softening_r, material.softening_m, material.softening_beta
    if r is None or m is None or beta is None:
        return Softening(curve, 0.0, 0.0, 0.0)
    return Softening(curve, 1.0 / r, factor * m, beta)


def as_law(curve: StressLaw, factor: float, modulus: float) -> ElasticCurve:
    """A law and its integral for the kernels, with all stresses times ``factor``."""
    knots, coefficients = curve.knots, factor * np.ascontiguousarray(curve.coefficients)
    powers = np.arange(1, 5)
    gained = np.sum(coefficients / powers * np.diff(knots)[:, None] ** powers, axis=1)
    energy = np.concatenate([[0.0], np.cumsum(gained)])
    at = np.clip(np.searchsorted(knots, 0.0, side="right") - 1, 0, len(coefficients) - 1)
    energy -= energy[at] + np.sum(coefficients[at] / powers * (-knots[at]) ** powers)
    return ElasticCurve(knots, coefficients, energy, factor * modulus)


def _spline(knots: Floats, values: Floats, slopes: Floats) -> StressLaw:
    from scipy.interpolate import CubicHermiteSpline

    spline = CubicHermiteSpline(knots, values, slopes)
    return StressLaw(spline.x, np.ascontiguousarray(spline.c[::-1].T))


def with_compression(
    curve_strain: tuple[float, ...], curve_stress: tuple[float, ...], cauchy: float
) -> tuple[Floats, Floats]:
    """Strains and stresses of a curve with another compression, derived from its tension: the share
    ``cauchy`` of `upper`, and the rest of `lower`.
    """
    pulled = np.array(curve_strain) >= 0.0
    strain, stress = np.array(curve_strain)[pulled], np.array(curve_stress)[pulled]
    _, values, _ = _knots(tuple(strain.tolist()), tuple(stress.tolist()), cauchy)
    return np.r_[COMPRESSION, strain], np.r_[values[: len(COMPRESSION)], stress]


def _knots(
    curve_strain: tuple[float, ...], curve_stress: tuple[float, ...], cauchy: float = UPPER_WEIGHT
) -> tuple[Floats, Floats, Floats]:
    """Strains (k,), stresses (k,) and slopes (k,) of the law at its knots; cauchy: the share of
    `upper` in the compression of a record without its own.
    """
    strain, stress = np.array(curve_strain), np.array(curve_stress)
    own, above = strain < 0.0, strain > TOE
    toe = stress_at(TOE, curve_strain, curve_stress)
    knots = np.r_[strain[own], 0.0, TOE, strain[above]]
    values = np.r_[stress[own], 0.0, toe, stress[above]]
    slopes = _shape_preserving_slopes(knots, values)
    slopes[own.sum() : own.sum() + 2] = toe / TOE  # both ends of the straight line
    if own.any():
        return knots, values, slopes
    values_below, slopes_below = _compression(COMPRESSION, knots, values, slopes, cauchy)
    return (
        np.r_[COMPRESSION, knots],
        np.r_[values_below, values],
        np.r_[slopes_below, slopes],
    )


def _shape_preserving_slopes(knots: Floats, values: Floats) -> Floats:
    from scipy.interpolate import PchipInterpolator

    return np.asarray(PchipInterpolator(knots, values).derivative()(knots))


def _compression(
    strain: Floats, knots: Floats, values: Floats, slopes: Floats, cauchy: float
) -> tuple[Floats, Floats]:
    """Stress and slope at compressive strains, derived from the tension curve."""
    stretch = 1.0 + strain
    lower, lower_slope = _tension(-strain, knots, values, slopes)
    upper, upper_slope = _tension(1.0 / stretch - 1.0, knots, values, slopes)
    stress = -(1.0 - cauchy) * lower - cauchy * upper / stretch**2
    slope = upper_slope / stretch**4 + 2.0 * upper / stretch**3
    return stress, (1.0 - cauchy) * lower_slope + cauchy * slope


def _tension(
    strain: Floats, knots: Floats, values: Floats, slopes: Floats
) -> tuple[Floats, Floats]:
    """Stress and slope of the tension curve, which continues with its last tangent."""
    from scipy.interpolate import CubicHermiteSpline

    curve = CubicHermiteSpline(knots, values, slopes)
    inside = np.minimum(strain, knots[-1])
    tangent = curve(inside, 1)
    return curve(inside) + tangent * (strain - inside), tangent
