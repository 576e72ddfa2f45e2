"""The curve of a material, at a few strains, from the first loading of a coupon.

The material relaxes during the test, so that the first loading is not the curve at one time after
loading. The stresses of the curve are therefore chosen such that the law, taken through the same
test, reproduces the first loading: each is multiplied by record / law until they agree. Record and
law are compared as least-squares fits of straight lines between the points.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from kernels.laws.one_point import stresses
from sweep.array_types import Floats
from sweep.config.kinds.material import Material, material
from sweep.config.materials.material_file import SECANT
from sweep.coupon import legs
from sweep.coupon.hyperelastic import rubber
from sweep.coupon.record import Coupon, CouponError
from sweep.coupon.uncertainty import standard_errors
from sweep.scene.material import UPPER_WEIGHT, law_in_stretch

STRAINS = np.array(
    [0.01, 0.02, 0.03, 0.05, 0.075, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0]
)
LAST = 0.9  # share of the greatest strain: no point but the last beyond
FEWEST = 3  # points
UNSURE = 0.05  # greatest standard error of a stress, relative
ROUNDS = 4  # rounds of record / law
RISE = 1e-3  # least relative rise of the stress from point to point
MIDDLE = 0.025  # strain: the middle of the secant modulus
DENSITY, POISSON = 1200.0, 0.48  # of a material that serves only as a law


class Loading:
    """The first loading of a coupon, and the path of the whole test, for laws to follow."""

    def __init__(self, coupon: Coupon, rows: list[int]) -> None:
        self.name, self.sign = coupon.name, coupon.sign
        self.time, self.strain = legs.path(coupon, rows)
        self.all_times = coupon.time
        self.rows = _first_time(self.sign * coupon.strain, rows)
        reached = self.sign * coupon.strain[self.rows]
        stress = self.sign * coupon.stress[self.rows]
        self.points = _sure_points(reached, stress)
        self.fitting = np.linalg.pinv(_hats(reached, self.points))
        self.record = _monotonic_stress(self.fitting @ stress)
        self.modulus_error = _modulus_error(reached, stress)
        first = np.maximum.accumulate(self.sign * coupon.strain[: rows[1] + 1])
        self.reference_time = float(np.interp(MIDDLE, first, coupon.time[: rows[1] + 1]))

    def follow(self, memory: dict[str, float]) -> tuple[Floats, Floats]:
        """Stresses (k,) at the points, in Pa, with which a law with this memory reproduces the
        first loading of the record; and the stress (n,) of that law in all rows.
        """
        at_points, stress = self.record, self.replay(self.record, memory)
        for _ in range(ROUNDS):
            model = _monotonic_stress(self.fitting @ (self.sign * stress[self.rows]))
            at_points = _monotonic_stress(at_points * self.record / model)
            stress = self.replay(at_points, memory)
        return at_points, stress

    def replay(self, at_points: Floats, memory: dict[str, float]) -> Floats:
        """The stress (n,) in all rows of a material with these stresses at the points."""
        law = law_in_stretch(self.material(at_points, memory), 1.0)
        return np.interp(self.all_times, self.time, stresses(law, self.time, self.strain))

    def material(self, at_points: Floats, memory: dict[str, float]) -> Material:
        """A material with these stresses at the points and this memory."""
        strain, stress = self.curve(at_points)
        numbers: dict[str, Any] = dict(memory)
        if "loss" in memory:
            numbers["reference_time"] = self.reference_time
        try:
            return self._law(numbers, strain, stress, at_points)
        except ValueError:  # refused, or not rising at all
            raise CouponError(
                f"{self.name}: the stress hardly rises towards a strain of {self.points[-1]:.3g}, "
                "and no law with a loss has such a curve; leave out the rows of larger strains, or "
                "of a strip that slips"
            ) from None

    def _law(
        self, numbers: dict[str, Any], strain: Floats, stress: Floats, at_points: Floats
    ) -> Material:
        values = {
            "name": "coupon",
            "modulus": float(at_points[0] / self.points[0]),
            "density": DENSITY,
            "poisson": POISSON,
            "curve_strain": tuple(strain.tolist()),
            "curve_stress": tuple(stress.tolist()),
        }
        return material(values | numbers)

    def curve(self, at_points: Floats) -> tuple[Floats, Floats]:
        """Strains and stresses of the curve; the curve of a puck has both signs, see `tension`."""
        if self.sign > 0.0:
            return self.points, at_points
        pulled = tension(self.points, at_points)
        return np.r_[-self.points[::-1], self.points], np.r_[-at_points[::-1], pulled]


def tension(strain: Floats, stress: Floats) -> Floats:
    """Stress in tension of a material whose compression is known: by the `rubber` that fits it,
    else by `tension_by_rules`.
    """
    law = rubber(strain, stress)
    return tension_by_rules(strain, stress) if law is None else law.at(strain)


def tension_by_rules(strain: Floats, stress: Floats, cauchy: float = UPPER_WEIGHT) -> Floats:
    """Stress in tension by the inverse of the rule in `scene.material`: a mean of stress odd in
    nominal strain and, with the share ``cauchy``, of Cauchy stress odd in log strain.

    It recovers a tension from its compression to 5 % up to 10 % strain, to 20 % up to 30 %.
    """
    return _monotonic_stress((1.0 - cauchy) * stress + cauchy * cauchy_odd(strain, stress))


def with_tension(
    curve_strain: tuple[float, ...], curve_stress: tuple[float, ...], cauchy: float
) -> tuple[Floats, Floats]:
    """Strains and stresses of a curve whose tension is replaced by `tension_by_rules`."""
    pressed = np.array(curve_strain) < 0.0
    strain, stress = -np.array(curve_strain)[pressed][::-1], -np.array(curve_stress)[pressed][::-1]
    pulled = tension_by_rules(strain, stress, cauchy)
    return np.r_[-strain[::-1], strain], np.r_[-stress[::-1], pulled]


def cauchy_odd(strain: Floats, stress: Floats) -> Floats:
    """Stress in tension whose Cauchy stress is odd in log strain."""
    stretch = 1.0 + strain
    cauchy = np.interp(strain / stretch, np.r_[0.0, strain], np.r_[0.0, stress])
    odd: Floats = cauchy / stretch**2
    return odd


def _first_time(strain: Floats, rows: list[int]) -> NDArray[np.intp]:
    """The rows of all loadings in which the strain exceeds its past maximum."""
    loadings, most = [np.arange(rows[1] + 1)], strain[rows[1]]
    for low, high in zip(rows[2::2], rows[3::2], strict=False):
        loading = np.arange(low, high + 1)
        loadings.append(loading[strain[loading] > most])
        most = max(most, strain[high])
    return np.concatenate(loadings)


def _sure_points(strain: Floats, stress: Floats) -> Floats:
    """The points whose stresses a noisy record determines to within `UNSURE`."""
    most = strain.max()
    points = np.r_[STRAINS[LAST * most > STRAINS], most]
    while True:
        hats = _hats(strain, points)
        inverse = np.linalg.pinv(hats.T @ hats)
        fitted = inverse @ hats.T @ stress
        noise = np.std(stress - hats @ fitted)
        unsure = noise * np.sqrt(np.diag(inverse)) / np.maximum(fitted, RISE * fitted.max())
        if points.size <= FEWEST or unsure.max() < UNSURE:
            return points
        points = np.delete(points, int(np.argmax(unsure[:-1])))


def _modulus_error(strain: Floats, stress: Floats) -> float:
    """Standard error of the slope between 1 and 4 % over that slope, by a line through the rows."""
    least, most = SECANT
    beyond = np.sort(strain[strain >= least])
    rows = (strain >= least) & (strain <= max(most, beyond[min(FEWEST, beyond.size - 1)]))
    line = np.column_stack([strain[rows], np.ones(int(rows.sum()))])
    fitted = np.linalg.pinv(line) @ stress[rows]
    error = standard_errors(line, stress[rows] - line @ fitted)[0]
    return float(error / max(fitted[0], RISE * stress.max() / strain.max()))


def _hats(strain: Floats, points: Floats) -> Floats:
    """Values (n, k) at ``strain`` of the k functions that are 1 at one of the points, 0 at the
    others and at the origin, and straight in between.
    """
    knots = np.r_[0.0, points]
    return np.column_stack([np.interp(strain, knots, row) for row in np.eye(knots.size)[1:]])


def _monotonic_stress(stress: Floats) -> Floats:
    """Stresses (k,), Pa, each raised to at least (1 + RISE) times the previous one."""
    values = np.array(stress)
    values[0] = max(values[0], RISE * values[-1])
    for k in range(1, values.size):
        values[k] = max(values[k], (1.0 + RISE) * values[k - 1])
    return values
