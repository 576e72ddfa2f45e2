"""Writes the material of a coupon as a csv file for `material.name`, with comments on a derived
tension, and reports how well it fits.
"""

import os
from collections.abc import Iterator
from math import inf
from pathlib import Path
from textwrap import wrap

import numpy as np

from sweep.array_types import Floats
from sweep.config.materials.material_file import LIMITS, Record, secant_modulus
from sweep.coupon.curve import cauchy_odd
from sweep.coupon.fit import Fit
from sweep.coupon.hyperelastic import rubber
from sweep.coupon.legs import leg_name
from sweep.coupon.record import CouponError
from sweep.numbers import in_unit, significant, text_in

DENSITY = 1200.0, "1190 .. 1220", "of printed TPU"  # kg/m^3
USUAL_RATES = 2e-4, 1.0  # 1/s: strain rates of coupon tests
SOFT = 5e6  # Pa
POOR = 0.03  # root mean square of record - law over the greatest stress
SURE = 5e-4  # relative: smaller standard errors are not written
LEAST = 0.01  # share of a number: the low end of its range if that were not positive
POISSON = "0.48 (0.45 .. 0.48)"


def file_beside(coupon: Path, out: str | os.PathLike[str] | None, option: str) -> Path:
    """The file of the material of a coupon: ``out``, by default FILE_material.csv beside it.

    option: how an error names ``out``.
    """
    file = Path(out or coupon.with_name(f"{coupon.stem}_material.csv"))
    if file.suffix != ".csv" or file.resolve() == coupon.resolve():
        raise CouponError(f"{option} {file}; allowed: another file, whose name ends in .csv")
    return file


def material_text(fit: Fit, density: float | None = None) -> str:
    """The csv file; density in kg/m^3, assumed if it is not given."""
    lines = [*_header(fit, density), "strain,stress_Pa"]
    rows = zip(fit.strain.tolist(), fit.stress.tolist(), strict=True)
    return "\n".join([*lines, *(f"{e:.6g},{s:.6g}" for e, s in rows), ""])


def _header(fit: Fit, density: float | None) -> Iterator[str]:
    coupon = fit.coupon
    pulled = "pulled" if coupon.sign > 0.0 else "pressed"
    yield f"# {coupon.name}: a printed coupon, {pulled}."
    yield "# Marks: [D] derived from the test, [A] an assumption."
    yield "# Source: own coupon: fitted by crumple materials fit [D]."
    for sentence in (f"{', '.join(coupon.notes)}." if coupon.notes else "", fit_sentence(fit)):
        yield from wrap(sentence, 100, initial_indent="#   ", subsequent_indent="#   ")
    if "loss" in fit.memory:
        yield "# Curve [D]: at the reference time after loading. The test, in which the material"
        yield '#   relaxes meanwhile, follows from it with material.memory = "measured".'
    if coupon.sign < 0.0:
        yield from tension_lines(fit.strain, fit.stress)
    if fit.errors["modulus"] > SURE:
        yield "# Modulus [D]: the secant of the curve between 1 and 4 %, with its standard error."
        yield f"# modulus_Pa: {modulus_range(fit)}"
    yield "# Reference time [D]: in which the test reaches a strain of 2.5 %."
    yield f"# reference_time_s: {fit.reference_time:.4g}"
    if density is None:
        value, ends, why = DENSITY
        yield f"# Density [A]: {why}."
        yield f"# density_kg_m3: {value:g} ({ends})"
    else:
        yield f"# density_kg_m3: {density:.6g}"
    yield "# Poisson's ratio [A]: no measurement; others use 0.45-0.48."
    yield f"# poisson: {POISSON}"
    yield from _memory(fit)


def _memory(fit: Fit) -> Iterator[str]:
    memory = fit.memory
    if "loss" in memory:
        yield "# Loss [D]: share of the work of a cycle that is lost without softening."
        yield f"# loss: {_with_error(fit, 'loss')}"
    if "softening_r" in memory:
        yield "# Softening on reuse [D]: Ogden and Roxburgh."
        yield f"# softening_r: {_with_error(fit, 'softening_r')}"
        yield f"# softening_m_Pa: {_with_error(fit, 'softening_m')}"
        if not fit.knows_beta:
            yield "# Softening beta [A]: the cycles of the test are of one size."
        yield f"# softening_beta: {_with_error(fit, 'softening_beta')}"


def _with_error(fit: Fit, key: str) -> str:
    """A fitted number with its standard error, limited to the range that a file may have."""
    value, error = fit.memory[key], fit.errors.get(key, 0.0)
    if error <= SURE * value:
        return f"{value:.4g}"
    above, at_most, _ = LIMITS.get(key, (0.0, inf, ""))
    low, high = value - error, value + error
    if above < low and high <= at_most:
        return f"{value:.4g} +- {error:.2g}"
    low, high = max(low, above + LEAST * (value - above)), min(high, at_most)
    return f"{value:.4g} ({low:.4g} .. {high:.4g})"


def modulus_range(fit: Fit) -> str:
    """The range of the modulus, a standard error around the secant of the curve."""
    modulus = secant_modulus(tuple(fit.strain.tolist()), tuple(fit.stress.tolist()))
    error = min(fit.errors["modulus"], 1.0 - LEAST)
    return f"{(1.0 - error) * modulus:.4g} .. {(1.0 + error) * modulus:.4g}"


def fit_sentence(fit: Fit) -> str:
    """How well the law follows the record, in words."""
    apart, row = fit.worst
    where = f"{leg_name(fit.rows, row)} at a strain of {fit.coupon.strain[row]:.3g}"
    return (
        f"The law follows the record within {text_in(fit.misfit, '%', 2)} of the greatest stress "
        f"(root mean square), and at worst within {text_in(apart, '%', 2)}, in {where}."
    )


def sentences_on_fit(fit: Fit, record: Record) -> Iterator[str]:
    """The results of a fit, a line each; record: the file that was written, read again."""
    yield from (f"read            {note}" for note in fit.coupon.notes)
    yield f"first loading   {_first_loading(fit)}"
    modulus = _plus_minus(record.modulus, fit.errors["modulus"] * record.modulus, "MPa", 4)
    yield f"modulus         {modulus}, secant from 1 to 4 % strain"
    yield f"reference time  {fit.reference_time:.3g} s"
    shares = [share for share in fit.shares if share is not None]
    cycles = " and ".join(text_in(share, "%", 3) for share in shares)
    of = "first cycle" if len(shares) == 1 else "first and second cycle"
    if shares:
        yield f"lost work       {cycles} of the {of} of the record"
    yield from _memory_lines(fit)
    yield fit_sentence(fit)
    yield from doubts(fit, record)


def doubts(fit: Fit, record: Record) -> Iterator[str]:
    """Warnings about unusual results that may be a mistake; record: as in `sentences_on_fit`."""
    coupon, turn = fit.coupon, fit.rows[1]
    rate = abs(float(coupon.strain[turn])) / float(coupon.time[turn])
    low, high = USUAL_RATES
    if not low <= rate <= high:
        unit = "ms" if rate < low else "min"
        yield (
            f"Warning: the first loading is at {rate:.2g} 1/s, usual are {low:g} to {high:g} "
            f"1/s: is the time in {unit}? --units time={unit}"
        )
    if record.modulus < SOFT:
        yield (
            f"Warning: printed TPU usually has a modulus above {text_in(SOFT, 'MPa')}: is the "
            "strain in percent (--units strain=%), or the gauge length or the area wrong?"
        )
    if fit.misfit > POOR:
        yield (
            f"Warning: that is more than {text_in(POOR, '%')}. Look at the picture: did the strip "
            "slip or go slack, or did the test pause at a turn?"
        )


def _memory_lines(fit: Fit) -> Iterator[str]:
    memory = fit.memory
    if len(fit.rows) < 3:
        yield "loss            not known, as the record has no unloading: the curve alone is fitted"
        return
    if "loss" in memory:
        yield f"loss            {_memory_text(fit, 'loss')}, without softening"
    else:
        yield "loss            none: the law follows the record as well without"
    if len(fit.rows) < 4:
        yield "softening       not known, as the record has no reloading"
    elif "softening_r" not in memory:
        yield "softening       none: the law follows the record as well without"
    else:
        m = _plus_minus(memory["softening_m"], fit.errors["softening_m"], "MPa", 3)
        numbers = f"r {_memory_text(fit, 'softening_r')}, m {m}"
        doubt = "" if fit.knows_beta else ", which is assumed: the cycles are of one size"
        yield f"softening       {numbers}, beta {_memory_text(fit, 'softening_beta')}{doubt}"


def _first_loading(fit: Fit) -> str:
    """The part of the record to which the curve is fitted, in words."""
    to = f"to a strain of {fit.coupon.strain[fit.rows[1]]:.3g}"
    loadings = len(fit.rows) // 2
    if loadings < 2:
        return f"{to}: the curve"
    return f"{to}: the curve, of {loadings} loadings; loss and softening are of all of them"


def _memory_text(fit: Fit, key: str) -> str:
    """A number of a memory with its standard error, if it is fitted."""
    return _plus_minus(fit.memory[key], fit.errors.get(key, 0.0), "", 3)


def _plus_minus(value: float, error: float, unit: str, digits: int) -> str:
    """A number and its standard error in a unit that people read, as text."""
    if unit:
        value, error = in_unit(value, unit), in_unit(error, unit)
    shown = significant(value, digits)
    if error > SURE * abs(value):
        shown += f" \N{PLUS-MINUS SIGN} {significant(error, 2)}"
    return f"{shown} {unit}".strip()


COMPARED = 0.2  # strain, or the end of a shorter record


def tension_lines(strain: Floats, stress: Floats) -> Iterator[str]:
    """Comment lines on the rule, and on how far the other rules deviate; strain, stress: of the
    curve.
    """
    pressed = strain < 0.0
    shortening, pressure = -strain[pressed][::-1], -stress[pressed][::-1]
    at = min(COMPARED, float(shortening[-1]))
    rules = [pressure, cauchy_odd(shortening, pressure)]
    low, high = sorted(float(np.interp(at, shortening, rule)) for rule in rules)
    if rubber(shortening, pressure) is None:
        yield "# Tension [A]: derived from compression; no rubber (Mooney and Rivlin) follows that."
    else:
        yield "# Tension [A]: of the rubber (Mooney and Rivlin) that follows the compression."
    stated = text_in(float(np.interp(at, strain, stress)), "MPa", 3)
    ends = f"{text_in(low, 'MPa', 3)} (Cauchy stress odd) to {text_in(high, 'MPa', 3)} (nominal)"
    yield f"#   At {text_in(at, '%', 3)} strain {stated}; other rules give {ends}."
