"""One test of a rubber strip and one of a puck, written as testing machines write them."""

from typing import NamedTuple

import numpy as np

GAUGE, AREA = 50e-3, 8e-6  # m, m^2
PUCK = {"gauge": 10e-3, "area": np.pi * 0.01**2}
SHEAR = 4e6  # Pa


class Rows(NamedTuple):
    """Time in s, displacement in mm, force in N, strain, stress in Pa."""

    time: np.ndarray
    displacement: np.ndarray
    force: np.ndarray
    strain: np.ndarray
    stress: np.ndarray


def strip():
    """Loaded to 50 %, unloaded, loaded and unloaded: 6 MPa (l - 1/l^2), less on the ways back."""
    time = np.arange(0.0, 40.01, 0.1)
    strain = np.interp(time, [0.0, 10.0, 20.0, 30.0, 40.0], [0.0, 0.5, 0.0, 0.5, 0.0])
    share = np.select([time <= 10.0, time <= 20.0, time <= 30.0], [1.0, 0.75, 0.9], 0.75)
    stress = share * 6e6 * (1.0 + strain - (1.0 + strain) ** -2)
    return Rows(time, 1e3 * GAUGE * strain, AREA * stress, strain, stress)


def puck(sign):
    """Neo-Hookean, pressed by 40 % and back; sign: of the numbers that the machine writes."""
    time = np.arange(0.0, 16.01, 0.05)
    strain = np.interp(time, [0.0, 8.0, 16.0], [0.0, 0.4, 0.0])
    stretch = 1.0 - strain
    stress = SHEAR * (stretch**-2 - stretch) * np.where(time > 8.0, 0.97, 1.0)
    values = (1e3 * PUCK["gauge"] * strain, PUCK["area"] * stress, strain, stress)
    return Rows(time, *(sign * value for value in values))


def text(heads, rows, form="{:.5f}", separator=",", decimal="."):
    """The text of a file: lines of heads, and columns (k,) of numbers in one form."""
    forms = form if isinstance(form, list) else [form] * len(rows)
    lines = [
        separator.join(f.format(v).replace(".", decimal) for f, v in zip(forms, row, strict=True))
        for row in np.column_stack(rows).tolist()
    ]
    return "\n".join([*heads, *lines, ""])


def measured(rows, force=1.0):
    """Time, displacement and force; force: its unit in N."""
    return [rows.time, rows.displacement, rows.force / force]
