"""The header of a material record: comment lines with its source and, one per line, its numbers.

    # poisson: 0.48
    # poisson: 0.48 (0.45 .. 0.48)       and the range in which it may lie
    # modulus_Pa: 67e6 +- 6e6            the same, for a range around the number
    # modulus_Pa: 19e6 .. 27e6           a range alone; the number follows from the curve
    # density_g_cm3: 1.21                in another unit, which the key names
    # Density [A]: of another grade.     a comment; [Q] quoted, [D] derived, [A] assumed

A comment continues in the next line if that begins with "#  ".
"""

import re
from collections.abc import Mapping
from typing import NamedTuple

from sweep.config.faults import MisfitError

STRESS_UNITS = {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9}
STRAIN_UNITS = {"": 1.0, "percent": 1e-2}
UNITS = {
    "density": {"kg_m3": 1.0, "g_cm3": 1e3},
    "poisson": {"": 1.0},
    "modulus": STRESS_UNITS,
    "reference_time": {"s": 1.0},
    "friction": {"": 1.0},
    "loss": STRAIN_UNITS,
    "softening_r": {"": 1.0},
    "softening_m": STRESS_UNITS,
    "softening_beta": {"": 1.0},
    "yield_stress": STRESS_UNITS,
    "hardening": STRESS_UNITS,
    "fracture_strain": STRAIN_UNITS,
}
"""Numbers of a header by their names in a case, and the units that their keys may end in."""


def with_units(name: str, units: Mapping[str, float]) -> dict[str, float]:
    """Heads of a quantity in each unit -> the size of the unit in SI: stress_MPa -> 1e6."""
    return {"_".join(filter(None, (name, unit))): size for unit, size in units.items()}


KEYS = {
    key: (name, size)
    for name, units in UNITS.items()
    for key, size in with_units(name, units).items()
}
"""Keys of a header -> what they are called in a case, and the size of their unit in SI."""

NUMBER = r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)"
ALLOWED = '"1.2", "1.2 +- 0.1", "1.2 (1.1 .. 1.4)" or "1.1 .. 1.4"'
_LINE = re.compile(rf"#\s*({'|'.join(KEYS)}):(.*)")
_AROUND = re.compile(rf"{NUMBER}(?:\s*\+-\s*{NUMBER})?")
_BETWEEN = re.compile(rf"{NUMBER}\s*\(\s*{NUMBER}\s*\.\.\s*{NUMBER}\s*\)")
_RANGE = re.compile(rf"{NUMBER}\s*\.\.\s*{NUMBER}")
_ASSUMED = re.compile(r"(\w[\w' ]*?) \[A\]:")


class Stated(NamedTuple):
    """A number of a header; its range, if it has one. value None: only the range is stated."""

    value: float | None
    low: float | None = None
    high: float | None = None


def stated(lines: list[str]) -> dict[str, Stated]:
    """The numbers of a header, in SI, by their names in a case; `MisfitError` if one cannot be
    read, or is stated twice.
    """
    numbers: dict[str, Stated] = {}
    for match in filter(None, (_LINE.fullmatch(line.strip()) for line in lines)):
        name, size = KEYS[match[1]]
        if name in numbers:
            raise MisfitError(f"# {match[1]}: {name} is stated twice; needed: once")
        numbers[name] = _in_si(number_with_range(match[1], match[2].strip()), size)
    return numbers


def _in_si(number: Stated, size: float) -> Stated:
    """A number and its range in SI, rounded to 15 digits."""
    if size == 1.0:
        return number
    return Stated(*(None if value is None else float(f"{size * value:.15g}") for value in number))


def number_with_range(key: str, text: str) -> Stated:
    """A number, with its range if it has one; `MisfitError` with the key if it cannot be read."""
    if match := _AROUND.fullmatch(text):
        middle, half = float(match[1]), match[2]
        if half is None:
            return Stated(middle)
        return Stated(middle, middle - float(half), middle + float(half))
    if match := _RANGE.fullmatch(text):
        result = Stated(None, float(match[1]), float(match[2]))
    elif match := _BETWEEN.fullmatch(text):
        result = Stated(*map(float, match.groups()))
    else:
        raise MisfitError(f"# {key}: {text} is no number; allowed: {ALLOWED}")
    value, low, high = result
    if low is None or high is None or not (low < high and low <= (value or low) <= high):
        raise MisfitError(f"# {key}: {text} is no range; allowed: {ALLOWED}, the lower end first")
    return result


def comments(lines: list[str]) -> tuple[str, ...]:
    """The text of a header without its numbers, each comment on a line of its own."""
    texts: list[str] = []
    for line in lines:
        if not line.startswith("#") or _LINE.fullmatch(line.strip()):
            continue
        if line.startswith("#  ") and texts:
            texts[-1] += f" {line[1:].strip()}"
        else:
            texts.append(line[1:].strip())
    return tuple(texts)


def source(texts: tuple[str, ...]) -> str:
    """The source in a few words: the comment "Source:" up to its first colon."""
    stated_source = next((text for text in texts if text.startswith("Source:")), "")
    return stated_source.removeprefix("Source:").split(":")[0].strip()


def assumed(texts: tuple[str, ...]) -> tuple[str, ...]:
    """The quantities that the comments call an assumption, such as "Poisson's ratio"."""
    return tuple(match[1].strip() for text in texts for match in _ASSUMED.finditer(text))
