"""Tests of coupons that the law itself makes, with noise if wished."""

from pathlib import Path

import numpy as np

from kernels.laws.one_point import stresses
from sweep.coupon.record import Coupon
from sweep.scene.material import law_in_stretch
from tests.support.designs.tables import material_with

RATE = 0.05  # 1/s
ROWS = 200  # of a leg


def ninjaflex(**memory):
    """A material of that curve, at the reference time of a test at `RATE`."""
    reference = {"reference_time": 0.025 / RATE} if "loss" in memory else {}
    return material_with(name="ninjaflex", **memory, **reference)


def coupon(*ends, noise=0.0, **memory):
    """A coupon that is taken from each strain to the next; noise: over the greatest stress."""
    law = law_in_stretch(ninjaflex(**memory), 1.0)
    ways = zip((0.0, *ends), ends, strict=False)
    strain = np.concatenate([[0.0], *(np.linspace(a, b, ROWS + 1)[1:] for a, b in ways)])
    time = np.r_[0.0, np.cumsum(np.abs(np.diff(strain)))] / RATE
    stress = stresses(law, time, strain)
    random = np.random.default_rng(7).standard_normal(stress.size)
    random[0] = 0.0
    return Coupon("trial", time, strain, stress + noise * np.abs(stress).max() * random)


def written(folder, test, heads="time_s,strain,stress_Pa", scales=(1.0, 1.0, 1.0)):
    """The csv file of a coupon, with columns of other names and units if wished."""
    path = Path(folder) / "coupon.csv"
    columns = np.column_stack([test.time, test.strain, test.stress]) * scales
    np.savetxt(path, columns, delimiter=",", header=heads, comments="")
    return path
