"""Reads the record of a coupon, a printed strip or puck that was loaded, unloaded and loaded again.

A csv file with the columns time_s, strain or displacement_mm, stress_Pa or force_N, in any order,
and others, which are not read. Nominal strain and stress, positive in tension: of a puck that is
pressed, both are negative. Displacements need the gauge length, forces the area of the section.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from sweep.config.faults import MisfitError
from sweep.config.materials.material_file import SECANT
from sweep.config.reading.text import rows_of, text_of
from sweep.constants import MM

Floats = NDArray[np.float64]

FEWEST = 20  # rows
MOST_STRAIN = 5.0
SOFTEST, STIFFEST = 1e5, 1e11  # Pa
OFFSET = 0.005, 0.05  # greatest first strain, and first stress over the greatest one
KNOWN = ("time_s", "strain", "displacement_mm", "stress_Pa", "force_N")
SEPARATORS = {";": "semicolons", "\t": "tabs"}


class CouponError(MisfitError):
    """A record that cannot be used; the text is one sentence with the file and the fault."""


@dataclass(frozen=True)
class Coupon:
    """Time (n,) in s from the first row, nominal strain (n,) and stress (n,) in Pa.

    sign: 1 of a strip that is pulled, -1 of a puck that is pressed.
    """

    name: str
    time: Floats
    strain: Floats
    stress: Floats

    @property
    def sign(self) -> float:
        """The sign of the strains."""
        return 1.0 if self.strain.max() > -self.strain.min() else -1.0


def read_coupon(path: Path, gauge: float | None = None, area: float | None = None) -> Coupon:
    """Read and check a record; gauge in m, area in m^2."""
    try:
        columns = _columns(path)
        time = _column(columns, "time_s")
        strain = _measured(columns, "strain", "displacement_mm", "gauge", gauge, MM)
        stress = _measured(columns, "stress_Pa", "force_N", "area", area, 1.0)
        coupon = Coupon(path.stem, time - time[0], strain, stress)
        _check(coupon)
    except MisfitError as error:
        raise CouponError(f"{path}: {error}") from None
    return coupon


def _columns(path: Path) -> dict[str, Floats]:
    """The columns of numbers of a csv file by their names."""
    heads, *rows = _rows(path)
    if twice := [head for head in KNOWN if heads.count(head) > 1]:
        raise CouponError(f"two columns {twice[0]}; needed: one")
    if not set(heads) & set(KNOWN):
        needed = "needed: names of columns, such as time_s, strain, stress_Pa"
        raise CouponError(f"its first row is {', '.join(heads)}; {needed}")
    if len(rows) < FEWEST:
        raise CouponError(f"{len(rows)} rows are too few for a curve; needed: at least {FEWEST}")
    for number, row in enumerate(rows, 1):
        if len(row) != len(heads):
            raise CouponError(
                f"row {number} has {len(row)} values, but there are {len(heads)} heads; needed: "
                "commas between values alone, and points in numbers (0.1, not 0,1)"
            )
    return {head: _numbers(head, [row[k] for row in rows]) for k, head in enumerate(heads)}


def _rows(path: Path) -> list[list[str]]:
    """The rows of a csv file, without comments and blanks; the first one has the heads."""
    lines = text_of(path, "a csv file").splitlines()
    lines = [line for line in lines if line.strip() and not line.startswith("#")]
    if not lines:
        raise CouponError("no rows; needed: columns time_s, strain, stress_Pa")
    for sign, word in SEPARATORS.items():
        if sign in lines[0]:
            raise CouponError(
                f"its columns are separated by {word}; needed: commas between columns, and points "
                "in numbers"
            )
    return [[text.strip() for text in row] for row in rows_of(lines)]


def _numbers(head: str, texts: list[str]) -> Floats:
    """The numbers of a column that is read; of another one, none."""
    values: list[float] = []
    for number, text in enumerate(texts if head in KNOWN else (), 1):
        try:
            values.append(float(text))
        except ValueError:
            wrong = f'{head} in row {number} is "{text}", not a number'
            raise CouponError(f"{wrong}; needed: numbers alone below the heads") from None
    return np.array(values)


def _column(columns: dict[str, Floats], name: str) -> Floats:
    if name not in columns:
        raise CouponError(f"no column {name}; its columns: {_names(columns)}")
    return columns[name]


def _names(columns: dict[str, Floats]) -> str:
    return ", ".join(filter(None, columns))


def _measured(
    columns: dict[str, Floats], name: str, raw: str, word: str, size: float | None, unit: float
) -> Floats:
    """A column, or what was measured over a size of the specimen; ``word``: the option for it."""
    if name in columns:
        if size is not None:
            raise CouponError(f"--{word} has no effect, as there is a column {name}")
        return columns[name]
    if raw not in columns:
        wrong = f"no column {name}, and no {raw} in its place"
        raise CouponError(f"{wrong}; its columns: {_names(columns)}; units are those of the names")
    if size is None:
        raise CouponError(f"{raw} in place of {name}: needed: --{word}")
    return unit * columns[raw] / size


def _check(coupon: Coupon) -> None:
    """Refuse what is no test of a coupon, and what has other units than its heads say."""
    time, strain, stress = coupon.time, coupon.strain, coupon.stress
    if not all(np.isfinite(column).all() for column in (time, strain, stress)):
        raise CouponError("every row must have three finite numbers")
    steps = np.diff(time)
    if (steps <= 0.0).any():
        row = int(np.argmax(steps <= 0.0)) + 2
        raise CouponError(
            f"time_s does not increase from row {row - 1} to row {row}: is it rounded?"
        )
    most = np.abs(strain).max()
    if most > MOST_STRAIN:
        raise CouponError(f"a strain of {most:g}: is it in percent? allowed: up to {MOST_STRAIN:g}")
    if most < SECANT[1]:
        wrong = f"strains up to {most:.3g}; needed: at least {SECANT[1]:g}"
        raise CouponError(f"{wrong}; is the displacement in mm, and the gauge length right?")
    if strain.min() <= -1.0:
        raise CouponError("a strain of -1 or less; allowed: above -1")
    if abs(strain[0]) > OFFSET[0] or abs(stress[0]) > OFFSET[1] * np.abs(stress).max():
        raise CouponError(
            f"begins at a strain of {strain[0]:.3g} and {stress[0]:.3g} Pa; needed: a record that "
            "begins unloaded, with both set to zero"
        )
    _check_modulus(coupon)


def _check_modulus(coupon: Coupon) -> None:
    """Refuse a modulus that no plastic has, and say which unit it may be."""
    modulus = coarse_modulus(coupon)
    if modulus == 0.0:
        raise CouponError("the stress does not rise between 1 and 4 % strain; needed: that it does")
    if modulus < 0.0:
        raise CouponError(
            "stress and strain have opposite signs between 1 and 4 %; allowed: both positive in "
            "tension, both negative in compression"
        )
    wrong = f"a modulus of {modulus:.3g} Pa between 1 and 4 % strain"
    if modulus < SOFTEST:
        raise CouponError(
            f"{wrong}: is stress_Pa in MPa or kPa (needed: Pa), a force (needed: a column force_N "
            "and --area), or the strain in percent (needed: 0.1 for 10 %)?"
        )
    if modulus > STIFFEST:
        raise CouponError(f"{wrong}: are stress_Pa or the size of the specimen in another unit?")


def coarse_modulus(coupon: Coupon) -> float:
    """Slope of the first loading between 1 and 4 %, Pa, by a straight line through its rows."""
    strain, stress = coupon.sign * coupon.strain, coupon.sign * coupon.stress
    end = int(np.argmax(strain >= SECANT[1])) + 1
    rows = strain[:end] >= SECANT[0]
    if rows.sum() < 2:
        return float(stress[end - 1] / strain[end - 1])
    return float(np.polyfit(strain[:end][rows], stress[:end][rows], 1)[0])
