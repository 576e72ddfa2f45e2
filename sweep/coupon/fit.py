"""Fits the curve, the loss and the softening of a material to the test of a coupon.

Loss and softening (r, m, beta) minimise the squared differences between the record and the law,
taken through the same test (`Loading.follow`). Effects that the record does not show are left out:
without unloading there is no loss, without reloading no softening, and unless a second cycle is
larger than the first one only m + beta W is known, W being the greatest energy: beta is then an
assumption. Of the laws that are as good as the best, the one with the fewest numbers is chosen.
Standard errors follow from the Jacobian of the least squares (`uncertainty`).
"""

from dataclasses import dataclass

import numpy as np

from sweep.array_types import Floats
from sweep.coupon import legs
from sweep.coupon.curve import Loading
from sweep.coupon.record import Coupon, CouponError
from sweep.coupon.uncertainty import standard_errors
from sweep.numbers import text_in

BETA = 0.1  # assumed where the record does not show it
LARGER = 1.2  # ratio to the first peak from which a second peak determines beta
SLACK = 0.02  # share of the greatest stress below which a strip may be slack
ABOVE = 0.02  # share of the work by which noise may raise unloading above loading
UNLOADED = 0.05  # share of the greatest stress
AS_GOOD = 1.05, 5e-4  # share of the least misfit, and of the greatest stress
STEP = 1e-3  # relative step of the numbers for finite differences
BOUNDS = {
    "loss": (0.005, 0.7),
    "softening": (0.0, 0.95),
    "width": (0.01, 3.0),
    "softening_beta": (0.0, 2.0),
}
"""Bounds of the fitted numbers; softening: 1 / r; width: m over the work of the first loading."""
START = {"loss": 0.3, "softening": 0.4, "width": 0.3, "softening_beta": BETA}


@dataclass(frozen=True)
class Fit:
    """A material that follows a coupon.

    strain, stress (k,): curve at ``reference_time`` (s) after loading. memory: loss and softening.
    errors: standard errors of the fitted ones of these numbers, and of the modulus over the
    modulus. model (n,): stress of the law in every row, Pa. misfit: root mean square of record -
    law over the greatest stress. worst: the greatest difference, with its row. shares: lost share
    of the work of the first cycle and of the second, None for a missing cycle.
    """

    coupon: Coupon
    rows: list[int]
    strain: Floats
    stress: Floats
    reference_time: float
    memory: dict[str, float]
    errors: dict[str, float]
    knows_beta: bool
    model: Floats
    misfit: float
    worst: tuple[float, int]
    shares: tuple[float | None, float | None]


def fit(coupon: Coupon) -> Fit:
    """The material of a coupon."""
    rows = legs.turns(coupon)
    _check_unloading(coupon, rows)
    loading = Loading(coupon, rows)
    if loading.record[0] <= 0.0:
        raise CouponError(f"{coupon.name}: the stress does not rise with the strain")
    grows = len(rows) > 3 and _peak(coupon, rows[3]) > LARGER * _peak(coupon, rows[1])
    scale = legs.work(coupon, 0, rows[1])
    fits = [_fitted(coupon, loading, names, scale) for names in _laws(rows, grows)]
    least = min(misfit for *_, misfit in fits)
    memory, errors = next(
        (memory, errors)
        for memory, errors, misfit in fits
        if misfit <= AS_GOOD[0] * least + AS_GOOD[1]
    )
    at_points, model = loading.follow(memory)
    strain, stress = loading.curve(at_points)
    apart = _apart(coupon, model)
    worst = int(np.argmax(np.abs(apart)))
    return Fit(
        coupon=coupon,
        rows=rows,
        strain=strain,
        stress=stress,
        reference_time=loading.reference_time,
        memory=memory,
        errors={"modulus": loading.modulus_error, **errors},
        knows_beta=grows,
        model=model,
        misfit=float(np.sqrt(np.mean(apart**2))),
        worst=(float(abs(apart[worst])), worst),
        shares=(_lost_share(coupon, rows, 0), _lost_share(coupon, rows, 2)),
    )


def _check_unloading(coupon: Coupon, rows: list[int]) -> None:
    """Refuse a record whose first unloading returns more work than the loading has taken."""
    if len(rows) < 3:
        return
    strain, stress = coupon.sign * coupon.strain, coupon.sign * coupon.stress
    loading, unloading = slice(rows[1] + 1), slice(rows[1], rows[2] + 1)
    upwards = np.maximum.accumulate(strain[loading])
    taken = np.interp(strain[unloading], upwards, stress[loading])
    path = np.diff(strain[unloading])
    more, all_taken = (
        -float(0.5 * (s[1:] + s[:-1]) @ path) for s in (stress[unloading] - taken, taken)
    )
    if all_taken <= 0.0:
        raise CouponError(
            f"{coupon.name}: the record begins with an unloading, from its row {rows[1] + 1}; "
            "needed: a loading first, so leave out the rows before it"
        )
    if more > ABOVE * all_taken:
        raise CouponError(
            f"{coupon.name}: the unloading lies above the loading, by "
            f"{text_in(more / all_taken, '%', 2)} of its work, but no material returns more than "
            "it absorbs; are the rows in the order in which they were measured, and of one test?"
        )


def _peak(coupon: Coupon, row: int) -> float:
    return float(coupon.sign * coupon.strain[row])


def _most(coupon: Coupon) -> float:
    return float(np.abs(coupon.stress).max())


def _laws(rows: list[int], grows: bool) -> list[tuple[str, ...]]:
    """The numbers of each law that the record determines, the fewest first."""
    softening = ("softening", "width", *(("softening_beta",) if grows else ()))
    if len(rows) < 3:
        return [()]
    if len(rows) < 4:
        return [(), ("loss",)]
    return [(), ("loss",), softening, ("loss", *softening)]


def _fitted(
    coupon: Coupon, loading: Loading, names: tuple[str, ...], scale: float
) -> tuple[dict[str, float], dict[str, float], float]:
    """The memory by least squares with these numbers, its standard errors, and its misfit."""

    def apart(numbers: Floats) -> Floats:
        memory = _memory(dict(zip(names, numbers.tolist(), strict=True)), scale)
        return _apart(coupon, loading.follow(memory)[1])

    if not names:
        return {}, {}, float(np.sqrt(np.mean(apart(np.empty(0)) ** 2)))
    from scipy.optimize import least_squares

    start = np.array([START[name] for name in names])
    bounds = np.array([BOUNDS[name] for name in names]).T
    done = least_squares(apart, start, bounds=bounds, diff_step=STEP, x_scale=start, ftol=1e-6)
    numbers = dict(zip(names, done.x.tolist(), strict=True))
    errors = dict(zip(names, standard_errors(done.jac, done.fun).tolist(), strict=True))
    misfit = float(np.sqrt(np.mean(done.fun**2)))
    return _memory(numbers, scale), _errors(numbers, errors, scale), misfit


def _memory(numbers: dict[str, float], scale: float) -> dict[str, float]:
    """The keys of a material from fitted numbers."""
    memory = {"loss": numbers["loss"]} if "loss" in numbers else {}
    if numbers.get("softening", 0.0) > 0.0:
        memory["softening_r"] = 1.0 / numbers["softening"]
        memory["softening_m"] = scale * numbers["width"]
        memory["softening_beta"] = numbers.get("softening_beta", BETA)
    return memory


def _errors(numbers: dict[str, float], errors: dict[str, float], scale: float) -> dict[str, float]:
    """Standard errors of the keys of `_memory`, from the errors of the fitted numbers."""
    of_keys = {key: error for key, error in errors.items() if key in ("loss", "softening_beta")}
    if numbers.get("softening", 0.0) > 0.0:
        of_keys["softening_r"] = errors["softening"] / numbers["softening"] ** 2
        of_keys["softening_m"] = scale * errors["width"]
    return of_keys


def _apart(coupon: Coupon, model: Floats) -> Floats:
    """Law - record over the greatest stress, where the specimen is not slack."""
    most = _most(coupon)
    taut = coupon.sign * coupon.stress > SLACK * most
    return np.where(taut, model - coupon.stress, 0.0) / most


def _lost_share(coupon: Coupon, rows: list[int], first: int) -> float | None:
    """Lost share of the work of the cycle that begins with a leg, if it ends unloaded."""
    if len(rows) < first + 3:
        return None
    if coupon.sign * coupon.stress[rows[first + 2]] > UNLOADED * _most(coupon):
        return None
    done = legs.work(coupon, *rows[first : first + 2])
    return 1.0 + legs.work(coupon, *rows[first + 1 : first + 3]) / done
