"""Comments in a material file on a tension that is derived from the compression of a puck."""

from collections.abc import Iterator

import numpy as np

from sweep.coupon.curve import cauchy_odd
from sweep.coupon.hyperelastic import rubber
from sweep.coupon.record import Floats
from sweep.numbers import text_in

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
