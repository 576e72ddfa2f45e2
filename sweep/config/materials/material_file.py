"""Material records: the tables in `configs/materials/`, which are in SI.

A record is a csv file. Its comment lines hold the source and, one per line, `# key: value` for
`density_kg_m3`, `poisson` and, optionally, `modulus_Pa`; `reference_time_s`, the time after loading
for which the curve holds if the material relaxes; and the measured `loss`, `softening_r`,
`softening_m_Pa` and `softening_beta`, which are used if a config requests them. Any of them may
have a range, and most may have another unit (`material_header`). The columns `strain,stress_Pa`
follow, or `strain_percent` and `stress_MPa` and the like (nominal, tension positive, strains
increasing; the origin is implied and may be left out). Rows of negative strain, if there are any,
are the material's own compression branch.

A plastic that yields has `yield_stress_Pa` instead of columns, a `modulus_Pa`, and optionally
`hardening_Pa` and `fracture_strain`.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from math import inf, isfinite
from pathlib import Path
from typing import Literal

from sweep.config.faults import MisfitError
from sweep.config.materials.material_header import (
    STRAIN_UNITS,
    STRESS_UNITS,
    Stated,
    assumed,
    comments,
    stated,
    with_units,
)
from sweep.config.materials.plausibility import in_percent, suspicion, unit_meant
from sweep.config.reading.text import rows_of, text_of
from sweep.numbers import text_in

Numbers = tuple[float, ...]

FOLDER = Path(__file__).parents[3] / "configs" / "materials"
STRAINS = with_units("strain", STRAIN_UNITS)
STRESSES = with_units("stress", STRESS_UNITS)
STRETCH = "stretch"  # a head instead of the strain: 1 + strain
TOE = 0.01  # below this strain a record is replaced by a straight line from the origin
NOISE = 0.1  # largest stress below that strain of the wrong sign, or at no strain, / that at `TOE`
REFERENCE_TIME = 1.0  # s; for a record that states none
SECANT = (0.01, 0.04)  # strains of the secant that defines the modulus of a curve
MEMORY = ("loss", "softening_r", "softening_m", "softening_beta")
PLASTICITY = ("yield_stress", "hardening", "fracture_strain")
LIMITS = {
    "loss": (0.0, 0.8, "above 0, at most 0.8; 38 % is 0.38"),
    "fracture_strain": (0.0, 1.0, "above 0, at most 1; 2.5 % is 0.025"),
    "poisson": (-1e-12, 0.5 - 1e-12, "at least 0, below 0.5"),
    "softening_r": (1.0, inf, "above 1"),
}
"""Numbers of a header and both ends of their ranges: above, at most, in words."""
RANGE_ALONE = ("modulus", "friction")  # numbers for which a range may be stated alone


class RecordError(MisfitError):
    """A record that cannot be used; the text is one line with the file and the fault."""


class UnknownMaterialError(RecordError):
    """A name that is neither a shipped material nor a file."""


@dataclass(frozen=True)
class Record:
    """One material: nominal strain (k,), nominal stress (k,) in Pa, and its numbers in SI.

    memory: measured loss and softening, by the keys of a case. plasticity: numbers of a material
    that yields, which has no curve; else empty. ranges: low and high end of every number that has a
    range, by the same keys. comments: the text of the header.
    """

    name: str
    strain: Numbers
    stress: Numbers
    density: float
    poisson: float
    modulus: float
    reference_time: float
    memory: Mapping[str, float]
    plasticity: Mapping[str, float]
    ranges: Mapping[str, tuple[float, float]]
    comments: tuple[str, ...]

    @property
    def derived(self) -> Literal["compression", "tension"] | None:
        """The branch of the curve that is not measured: the file does not have it, or calls it an
        assumption.
        """
        if self.strain and self.strain[0] >= 0.0:
            return "compression"
        return "tension" if "Tension" in assumed(self.comments) else None


def available() -> list[str]:
    """Names of the records that come with the project."""
    return sorted(path.stem for path in FOLDER.glob("*.csv"))


def in_words() -> str:
    """What `material.name` may be, in words."""
    return f"{', '.join(available())}, or the path of a .csv file"


def locate(name: str, folder: Path | None = None) -> Path:
    """The file of a shipped material, or of a user's own csv, relative to `folder`."""
    if name.endswith(".csv"):
        path = (folder or Path()) / name
        if path.is_file():
            return path
    elif name in available():
        return FOLDER / f"{name}.csv"
    raise UnknownMaterialError(f'"{name}" is no material; allowed: {in_words()}')


def read_record(path: Path) -> Record:
    """Read and check one record. Modulus: the stated one, else the secant between 1 and 4 %."""
    try:
        lines = text_of(path, "a csv file").splitlines()
        numbers = stated(lines)
        _check_numbers(numbers)
        strain, stress = _curve(lines, "yield_stress" in numbers)
        return _record(path.stem, strain, stress, numbers, comments(lines))
    except MisfitError as error:
        raise RecordError(f"{path.name}: {error}") from None


def _record(
    name: str, strain: Numbers, stress: Numbers, numbers: dict[str, Stated], texts: tuple[str, ...]
) -> Record:
    values = {key: number.value for key, number in numbers.items() if number.value is not None}
    ranges = {
        key: (low, high)
        for key, (_, low, high) in numbers.items()
        if low is not None and high is not None
    }
    return Record(
        name=name,
        strain=strain,
        stress=stress,
        density=values["density"],
        poisson=values["poisson"],
        modulus=values["modulus"] if "modulus" in values else secant_modulus(strain, stress),
        reference_time=values.get("reference_time", REFERENCE_TIME),
        memory={key: values[key] for key in MEMORY if key in values},
        plasticity={key: values[key] for key in PLASTICITY if key in values},
        ranges=ranges,
        comments=texts,
    )


def _check_numbers(numbers: Mapping[str, Stated]) -> None:
    """Refuse a header without the numbers that every material needs."""
    if "density" not in numbers or "poisson" not in numbers:
        needed = "needs the lines # density_kg_m3: ... and # poisson: ..."
        raise RecordError(f"{needed}; of a test, `crumple materials fit` makes such a file")
    for key, number in numbers.items():
        _check_number(key, number)
    alone = [key for key, number in numbers.items() if number.value is None]
    if any(key not in RANGE_ALONE for key in alone):
        raise RecordError(f"{alone[0]} needs a number beside its range")
    if ("softening_r" in numbers) != ("softening_m" in numbers):
        raise RecordError("softening needs the lines # softening_r: ... and # softening_m_Pa: ...")
    yields = "yield_stress" in numbers
    if not yields and (other := [key for key in PLASTICITY if key in numbers]):
        raise RecordError(f"{other[0]} needs the line # yield_stress_Pa: ...")
    if yields and ("modulus" not in numbers or "modulus" in alone):
        raise RecordError("a material that yields needs the line # modulus_Pa: ...")


def _check_number(key: str, number: Stated) -> None:
    """Refuse a number, or an end of its range, that no case or no printed material has."""
    above, at_most, words = LIMITS.get(key, (-inf, inf, ""))
    for value in (value for value in number if value is not None):
        if not above < value <= at_most:
            raise RecordError(f"# {key}: {value:g}; allowed: {words}")
        if why := suspicion(key, value):
            unit = unit_meant(key, value)
            write = f" write # {key}_{unit.replace('/', '_')}" if unit else ""
            raise RecordError(f"# {key}: {value:g} in SI; allowed: {why}{write}")


def _curve(lines: list[str], yields: bool) -> tuple[Numbers, Numbers]:
    """The checked curve of a record; none if it yields."""
    if not yields:
        strain, stress = _columns(lines)
        check_curve(strain, stress)
        return strain, stress
    if any(line.strip() and not line.startswith("#") for line in lines):
        raise RecordError("a material that yields has no curve")
    return (), ()


def _columns(lines: list[str]) -> tuple[Numbers, Numbers]:
    """Strain and stress below the header."""
    rows = rows_of(line for line in lines if line.strip() and not line.startswith("#"))
    heads = [word.strip() for word in rows[0]] if rows else []
    sizes = STRAINS | {STRETCH: 1.0}
    if len(heads) != 2 or heads[0] not in sizes or heads[1] not in STRESSES:
        wrong = "the first row must read strain,stress_Pa, with a comma between the heads"
        raise RecordError(f"{wrong}; in other units: {', '.join([*sizes, *STRESSES][1:])}")
    pairs = [_pair(row) for row in rows[1:]]
    if heads[0] == STRETCH:
        pairs = [(float(f"{stretch - 1.0:.12g}"), stress) for stretch, stress in pairs]
    strain, stress = (
        tuple(float(f"{size * pair[k]:.15g}") if size != 1.0 else pair[k] for pair in pairs)
        for k, size in enumerate((sizes[heads[0]], STRESSES[heads[1]]))
    )
    return strain, stress


def _pair(row: list[str]) -> tuple[float, float]:
    """Strain and stress of a row."""
    try:
        strain, stress = map(float, row)
    except ValueError:
        needed = "needed: two numbers with a comma between them"
        wrong = f'one is "{",".join(row)}"; {needed}'
        raise RecordError(f"every row must hold two numbers, but {wrong}") from None
    return strain, stress


def check_curve(strain: Numbers, stress: Numbers) -> None:
    """Refuse a curve that is not a function of strain, that does not pass through the origin, whose
    stress does not rise at first or does not resist the strain.
    """
    if len(strain) != len(stress):
        raise RecordError("a curve needs a stress for every strain")
    for point in zip(strain, stress, strict=True):
        if not all(map(isfinite, point)):
            raise RecordError(f"a point of a curve at {point}; allowed: finite numbers")
    for before, after in pairwise((-1.0, *strain)):
        if after <= before:
            place = f" after {before:g}" if before > -1.0 else ""
            must = "the strains of a curve must increase, from above -1"
            raise RecordError(f"a strain of {after:g}{place}; {must}")
    if in_percent(strain):
        wrong = f"a curve to a strain of {max(strain):g}, which is {text_in(max(strain), '%')}"
        raise RecordError(f"{wrong}: is it in percent? write strain_percent, or 0.1 for 10 %")
    if max(strain, default=0.0) < SECANT[1]:
        raise RecordError(f"a curve must reach a strain of {SECANT[1]:g}")
    if (toe := stress_at(TOE, strain, stress)) <= 0.0:
        raise RecordError(f"the stress of a curve must be positive at 1 % strain, not {toe:g} Pa")
    for e, s in zip(strain, stress, strict=True):
        opposed = abs(s) if e == 0.0 else -s if e > 0.0 else s
        if opposed > (NOISE * toe if abs(e) < TOE else 0.0):
            must = "negative in compression, 0 at the origin, positive in tension"
            raise RecordError(f"a stress of {s:g} Pa at a strain of {e:g}; a curve must be {must}")
    modulus = secant_modulus(strain, stress)
    if modulus > 0.0 and (why := suspicion("curve_modulus", modulus)):
        unit = unit_meant("curve_modulus", modulus)
        write = f" write stress_{unit}" if unit else ""
        raise RecordError(f"a curve with a modulus of {modulus:.3g} Pa; allowed: {why}{write}")


def not_rising(strain: Numbers, stress: Numbers) -> float | None:
    """The first strain from which the stress of a curve does not rise; None if it rises throughout.

    Beyond its ends a curve continues with the end slope of a shape-preserving cubic: level, if its
    last secant is so much flatter than the previous one that a parabola through the last three
    points would fall.
    """
    pairs = list(zip(strain, stress, strict=True))
    below = [(e, s) for e, s in pairs if e < 0.0]
    toe = (TOE, stress_at(TOE, strain, stress))
    points = [*below, (0.0, 0.0), toe, *((e, s) for e, s in pairs if e > TOE)]
    steps = [(a, b - a, (t - s) / (b - a)) for (a, s), (b, t) in pairwise(points)]
    for at, _, slope in steps:
        if slope <= 0.0:
            return at
    ends = [(points[-1][0], steps[-1], steps[-2])]
    if below:
        ends.append((points[0][0], steps[0], steps[1]))
    for at, (_, last, slope), (_, width, before) in ends:
        if (2.0 * last + width) * slope <= last * before:
            return at
    return None


def secant_modulus(strain: Numbers, stress: Numbers) -> float:
    """Slope of the record between 1 and 4 % tension (Pa)."""
    low, high = SECANT
    rise = stress_at(high, strain, stress) - stress_at(low, strain, stress)
    return rise / (high - low)


def stress_at(at: float, strain: Numbers, stress: Numbers) -> float:
    """Stress (Pa) at a tensile strain, linear between the origin and the points of the record."""
    points = [(0.0, 0.0), *((e, s) for e, s in zip(strain, stress, strict=True) if e > 0.0)]
    for (e0, s0), (e1, s1) in pairwise(points):
        if at <= e1:
            return s0 + (s1 - s0) * (at - e0) / (e1 - e0)
    raise RecordError(f"the record ends below a strain of {at:g}")
