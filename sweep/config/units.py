"""From TOML to a sweep in SI: the only place that reads a unit.

Columns of results have their unit in their name.
"""

import re
import sys
import tomllib
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import lru_cache
from math import isfinite
from os import PathLike
from pathlib import Path
from typing import Any

from sweep.config.grid import MAX_CASES, Config, ConfigError, Fault, case_count, check, expand
from sweep.config.keys import QUANTITIES
from sweep.config.reading.examples import examples, find_config
from sweep.config.reading.reader import Reader, in_words
from sweep.config.reading.unclosed import unclosed
from sweep.constants import STANDARD_GRAVITY

__all__ = ["MAX_CASES", "Config", "ConfigError", "case_count", "expand", "load_config", "quantity"]

_UNITS = f"""
micro- = 1e-6 = µ- = u-
milli- = 1e-3 = m-
centi- = 1e-2 = c-
kilo- = 1e3 = k-
mega- = 1e6 = M-
giga- = 1e9 = G-
meter = [length] = m = metre
second = [time] = s = sec
gram = [mass] = g
minute = 60 * second = min
hour = 60 * minute = h
inch = 0.0254 * meter = in = inches
thou = 1e-3 * inch
foot = 12 * inch = ft = feet
ounce = 28.349523125 * gram = oz
pound = 16 * ounce = lb
standard_gravity = {STANDARD_GRAVITY} * meter / second ** 2 = g0 = gn
newton = kilogram * meter / second ** 2 = N
kilogram_force = {STANDARD_GRAVITY} * newton = kgf
pound_force = 4.4482216152605 * newton = lbf
pascal = newton / meter ** 2 = Pa
joule = newton * meter = J
bar = 1e5 * pascal
psi = pound_force / inch ** 2
percent = 0.01 = %
radian = [angle] = rad
degree = 3.14159265358979323846 / 180 * radian = deg = degrees
"""
_NUMBER_AND_UNIT = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*")


def load_config(path: str | PathLike[str]) -> Config:
    """Read a sweep and check all of its cases; `ConfigError` holds all faults.

    path: path of a TOML file; if there is no such file, the name of an example, such as "smoke".
    """
    if not isinstance(path, str | PathLike):
        needed = "the path of a TOML file, or the name of an example"
        raise ConfigError([Fault("path", f"{in_words(path)} is no path; needed: {needed}")])
    path = find_config(path)
    reader = Reader(path.parent, converted)
    config = reader.config(_document(path), path)
    try:
        check(config)
    except ConfigError as error:
        reader.faults += [fault for fault in error.faults if reader.trusts(fault)]
    if reader.faults:
        raise ConfigError(reader.faults)
    return config


def quantity(text: object, unit: str) -> float:
    """A quantity such as "25 g" in the SI unit given, rounded to 15 digits."""
    try:
        return converted(text, unit)
    except ValueError as error:
        line = f"{in_words(text)}: {error}; allowed: {QUANTITIES[unit]}"
        raise ConfigError([Fault(unit, line)]) from None


def _document(path: Path) -> dict[str, Any]:
    """The TOML of a file."""
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        needed = f"a TOML file, or an example: {', '.join(examples())}"
        wrong = f"cannot be read ({error.strerror}); needed: {needed}"
    except (ValueError, RecursionError) as error:
        wrong = f"not TOML ({_open_place(path) or error})"
    raise ConfigError([Fault("path", f"{path}: {wrong}")])


def _open_place(path: Path) -> str | None:
    """What a file that is no TOML does not close, with its line; None if it has another fault."""
    with suppress(ValueError):  # no text
        return unclosed(path.read_text(encoding="utf-8"))
    return None


def converted(text: object, unit: str) -> float:
    """A number with a unit in SI, or ValueError with the reason."""
    if isinstance(text, bool) or not isinstance(text, str | int | float):
        raise ValueError("no quantity")
    match = _NUMBER_AND_UNIT.fullmatch(str(text))
    if match is None:
        raise ValueError("not a number with a unit")
    number, written = match.groups()
    if not written:
        raise ValueError("a bare number")
    if written.count("%") > 1:
        raise ValueError(f"unknown unit {in_words(written)}")
    registry = _registry()
    try:
        found = registry.parse_units(f"1{written}" if written.startswith("/") else written)
    except Exception:  # noqa: BLE001 any error of pint means that this is no unit
        raise ValueError(f"unknown unit {in_words(written)}") from None
    if found.dimensionality != registry.parse_units(unit).dimensionality:
        raise ValueError(f"{in_words(written)} is a unit of another kind")
    value = registry.Quantity(float(number), found).m_as(unit)
    if not isfinite(value):
        raise ValueError("not finite")
    return float(f"{value:.15g}")


@lru_cache(maxsize=1)
def _registry() -> Any:
    """The units of `_UNITS`; to read pint's own list takes 0.15 s."""
    with _without("numpy", "dask"):
        import pint
    registry: Any = pint.UnitRegistry(None)
    registry.load_definitions(_UNITS.splitlines())
    return registry


@contextmanager
def _without(*names: str) -> Iterator[None]:
    """Hide libraries that are not loaded yet: pint loads them (0.3 s) only to support arrays."""
    hidden = [name for name in names if name not in sys.modules]
    sys.modules.update(dict.fromkeys(hidden))  # type: ignore[arg-type]
    try:
        yield
    finally:
        for name in hidden:
            del sys.modules[name]
