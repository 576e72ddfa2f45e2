"""The header of a material record: comment lines with its source and, one per line, its numbers.

    # poisson: 0.48
    # poisson: 0.48 (0.45 .. 0.48)       and the range in which it may lie
    # modulus_Pa: 67e6 +- 6e6            the same, for a range around the number
    # modulus_Pa: 19e6 .. 27e6           a range alone; the number is that of the curve
    # Density [A]: of another grade.     a comment; [Q] quoted, [D] derived, [A] assumed

A comment goes on in the next line if that begins with "#  ".
"""

import re
from typing import NamedTuple

from sweep.config.faults import MisfitError

KEYS = {
    "density_kg_m3": "density",
    "poisson": "poisson",
    "modulus_Pa": "modulus",
    "reference_time_s": "reference_time",
    "friction": "friction",
    "loss": "loss",
    "softening_r": "softening_r",
    "softening_m_Pa": "softening_m",
    "softening_beta": "softening_beta",
    "yield_stress_Pa": "yield_stress",
    "hardening_Pa": "hardening",
    "fracture_strain": "fracture_strain",
}
"""Keys of a header, and what they are called in a case."""

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
    """The numbers of a header by their names in a case; `MisfitError` if one cannot be read."""
    matches = [match for line in lines if (match := _LINE.fullmatch(line.strip()))]
    return {KEYS[match[1]]: number_with_range(match[1], match[2].strip()) for match in matches}


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
    """The source in a few words: what the comment "Source:" says up to its first colon."""
    stated_source = next((text for text in texts if text.startswith("Source:")), "")
    return stated_source.removeprefix("Source:").split(":")[0].strip()


def assumed(texts: tuple[str, ...]) -> tuple[str, ...]:
    """What the comments call an assumption, such as "Poisson's ratio"."""
    return tuple(match[1].strip() for text in texts for match in _ASSUMED.finditer(text))
