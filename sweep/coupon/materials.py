"""Materials in Python: a table of the materials that come with Crumple, and a coupon fitted to a
file.
"""

import os
from collections.abc import Mapping
from pathlib import Path

from pandas import DataFrame

from sweep.config.materials.material_file import available, locate, read_record
from sweep.config.materials.material_header import source
from sweep.coupon.answers import Answers
from sweep.coupon.fit import fit
from sweep.coupon.record import read_coupon
from sweep.coupon.write import file_beside, material_text
from sweep.whole_file import write_whole

NUMBERS = {
    "modulus_Pa": "modulus",
    "density_kg_per_m3": "density",
    "poisson": "poisson",
    "reference_time_s": "reference_time",
}


def materials() -> DataFrame:
    """The materials that come with Crumple, a row each, by name.

    Each number has its value and both ends of its range, `..._low` and `..._high`, which are the
    value if no range is known; `loss`, `softening_r` and `yield_stress_Pa` are NaN if the file
    states none. `source`: origin of the numbers.
    """
    rows = {}
    for name in available():
        record = read_record(locate(name))
        row: dict[str, float | str] = {}
        for column, key in NUMBERS.items():
            row[column] = value = getattr(record, key)
            row[f"{column}_low"], row[f"{column}_high"] = record.ranges.get(key, (value, value))
        stated = {**record.memory, **record.plasticity}
        row |= {name: stated.get(name, float("nan")) for name in ("loss", "softening_r")}
        row |= {"yield_stress_Pa": stated.get("yield_stress", float("nan"))}
        rows[name] = row | {"source": source(record.comments)}
    return DataFrame.from_dict(rows, orient="index").rename_axis("name")


def fit_material(  # noqa: PLR0913  each answers one question that a record may leave open
    file: str | os.PathLike[str],
    out: str | os.PathLike[str] | None = None,
    *,
    gauge: str | None = None,
    area: str | None = None,
    density: str | None = None,
    speed: str | None = None,
    test: str | None = None,
    zero: str | None = None,
    units: Mapping[str, str] | None = None,
    columns: Mapping[str, str] | None = None,
) -> Path:
    """Fit a material to the test of a printed coupon and write it as a file for `material.name`.

    file: as the testing machine exports it. out: by default FILE_material.csv beside it. gauge,
    area, density, speed: text with a unit. test: "pulled" or "pressed". zero: where the record
    begins. units, columns: by quantity, such as {"force": "kN"}. All are the options of `crumple
    materials fit`, which `CouponError` refers to if the file leaves something open.
    """
    path = Path(file)
    target = file_beside(path, out, "out =")
    sizes = {"gauge": gauge, "area": area, "speed": speed, "density": density}
    answers = Answers.of(sizes, test, zero, columns, units)
    law = fit(read_coupon(path, answers))
    return write_whole(target, material_text(law, answers.density))
