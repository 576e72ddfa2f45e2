"""The legs of a test, from turn to turn of the strain: first loading, unloading, reloading, ..."""

from itertools import pairwise

import numpy as np

from sweep.array_types import Floats
from sweep.coupon.record import Coupon

TURN = 0.05  # share of the greatest strain: smaller turns are noise
POINTS = 80  # most points of the path of a leg
NAMES = ("the first loading", "unloading", "reloading")


def turns(coupon: Coupon) -> list[int]:
    """First row, rows at which the strain turns, and last row."""
    strain = coupon.sign * coupon.strain
    slack = TURN * strain.max()
    rows, extreme, way = [0], 0, 1.0
    for row in range(1, strain.size):
        if way * (strain[row] - strain[extreme]) > 0.0:
            extreme = row
        elif way * (strain[extreme] - strain[row]) > slack:
            rows.append(extreme)
            extreme, way = row, -way
    return [*rows, extreme] if extreme > rows[-1] else rows


def leg_name(rows: list[int], row: int) -> str:
    """The leg to which a row belongs, in words."""
    passed = sum(row > turn for turn in rows[1:-1])
    return NAMES[passed] if passed < len(NAMES) else "a later cycle"


def path(coupon: Coupon, rows: list[int]) -> tuple[Floats, Floats]:
    """Times and strains of at most `POINTS` points of each leg; between its ends, means of the rows
    around them, so that noise of the strain is no cycle.
    """
    time, strain = [coupon.time[0]], [coupon.strain[0]]
    for first, last in pairwise(rows):
        count = min(POINTS, last - first)
        for group in np.array_split(np.arange(first + 1, last), count)[: last - first - 1]:
            time.append(coupon.time[group].mean())
            strain.append(coupon.strain[group].mean())
        time.append(coupon.time[last])
        strain.append(coupon.strain[last])
    return np.array(time), np.array(strain)


def work(coupon: Coupon, first: int, last: int) -> float:
    """Work between two rows, J/m^3, over the rows in which stress and strain have the same sign."""
    strain, stress = coupon.sign * coupon.strain, np.maximum(coupon.sign * coupon.stress, 0.0)
    return float(np.trapezoid(stress[first : last + 1], strain[first : last + 1]))
