"""Converts a number with a unit, such as "100 mm/min", to SI.

A unit is a product such as "kg m/s^2", in which a slash divides only by the next factor. Names may
have a prefix and a plural. No regular expression here backtracks: a long text costs no time.
"""

import re
from collections.abc import Iterator
from math import pi
from typing import NamedTuple

from sweep.config.faults import ConfigError, Fault, MisfitError, in_words
from sweep.constants import STANDARD_GRAVITY


class Unit(NamedTuple):
    """Value of a unit in SI, and its powers of m, kg, s and rad."""

    size: float
    powers: tuple[int, ...]


UNITS = {
    "m": Unit(1.0, (1, 0, 0, 0)),
    "g": Unit(1e-3, (0, 1, 0, 0)),
    "s": Unit(1.0, (0, 0, 1, 0)),
    "rad": Unit(1.0, (0, 0, 0, 1)),
    "1": Unit(1.0, (0, 0, 0, 0)),
    "%": Unit(1e-2, (0, 0, 0, 0)),
}
OTHERS = {
    "meter metre": "1 m",
    "gram": "1 g",
    "second sec": "1 s",
    "radian": "1 rad",
    "percent": "1 %",
    "deg degree": f"{pi / 180.0} rad",
    "min minute": "60 s",
    "h hour": "60 min",
    "in inch inches": "0.0254 m",
    "thou": "0.001 in",
    "ft foot feet": "12 in",
    "oz ounce": "28.349523125 g",
    "lb pound": "16 oz",
    "g0 gn standard_gravity": f"{STANDARD_GRAVITY} m/s^2",
    "N newton": "1 kg m/s^2",
    "kgf kilogram_force": "1 kg g0",
    "lbf pound_force": "4.4482216152605 N",
    "Pa pascal": "1 N/m^2",
    "bar": "1e5 Pa",
    "psi": "1 lbf/in^2",
    "J joule": "1 N m",
}
"""Names of other units -> their definition."""
PREFIXES = {
    "": 1.0,
    **dict.fromkeys(("u", "µ", "μ", "micro"), 1e-6),
    **dict.fromkeys(("m", "milli"), 1e-3),
    **dict.fromkeys(("c", "centi"), 1e-2),
    **dict.fromkeys(("k", "kilo"), 1e3),
    **dict.fromkeys(("M", "mega"), 1e6),
    **dict.fromkeys(("G", "giga"), 1e9),
}
SIGNS = {"**": "^", "²": "^2", "³": "^3", "·": "*", " per ": "/"}
"""Other signs in a unit -> the signs that are understood."""
QUANTITIES = {
    "m": 'a length with a unit, such as "0.8 mm"',
    "m^2": 'an area with a unit, such as "8 mm^2"',
    "s": 'a time with a unit, such as "0.2 s"',
    "1/s": 'a rate with a unit, such as "5 1/s"',
    "m/s": 'a speed with a unit, such as "100 mm/min"',
    "m/s^2": 'an acceleration with a unit, such as "80 g0", of standard gravity (g is a gram)',
    "N": 'a force with a unit, such as "10 N"',
    "J": 'an energy with a unit, such as "0.1 J"',
    "Pa": 'a stress with a unit, such as "12 MPa"',
    "kg": 'a mass with a unit, such as "25 g"',
    "1": 'a share in percent, such as "20 %"',
    "rad": 'an angle with a unit, such as "45 deg"',
    "kg/m^3": 'a density with a unit, such as "1190 kg/m^3"',
}
SMALLEST, LARGEST = 1e-30, 1e30  # in SI, so that products neither overflow nor vanish

_NUMBER = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)(.*)", re.ASCII)
_POWER = re.compile(r"(.+)\^(-?\d)|(.*[^\W\d_])([23])")  # m^3, or m3


def in_si(text: object, unit: str) -> float:
    """A number with a unit, in the given SI unit, rounded to 15 digits; raises `MisfitError` with
    the reason if it cannot be read.
    """
    if isinstance(text, bool) or not isinstance(text, str | int | float):
        raise MisfitError("no quantity")
    match = _NUMBER.fullmatch(str(text).strip())
    if match is None:
        raise MisfitError("not a number with a unit")
    number, written = match[1], match[2].strip()
    if not written:
        raise MisfitError("a bare number")
    if written.startswith(","):
        raise MisfitError("a decimal comma, in place of a point")
    size, powers = _unit(written)
    if powers != _unit(unit).powers:
        raise MisfitError(f"{in_words(written)} is a unit of another kind")
    value = float(number) * size
    if abs(value) > LARGEST:
        raise MisfitError("too large")
    if abs(value) < SMALLEST and number.lower().partition("e")[0].strip("+-0."):
        raise MisfitError("too small")
    return float(f"{value:.15g}")


def quantity(text: object, unit: str) -> float:
    """`in_si` for one value that a user gives; raises `ConfigError` with a line."""
    try:
        return in_si(text, unit)
    except MisfitError as error:
        line = f"{in_words(text)}: {error}; allowed: {QUANTITIES[unit]}"
        raise ConfigError([Fault(unit, line)]) from None


def _unit(text: str) -> Unit:
    """A product of units."""
    size, powers = UNITS["1"]
    try:
        for name, exponent in _factors(text):
            factor = _named(name)
            size *= factor.size**exponent
            powers = tuple(p + exponent * q for p, q in zip(powers, factor.powers, strict=True))
    except LookupError:
        raise MisfitError(f"unknown unit {in_words(text)}") from None
    return Unit(size, powers)


def _factors(text: str) -> Iterator[tuple[str, int]]:
    """Names and exponents of a product."""
    if text.count("%") > 1:
        raise LookupError(text)
    for sign, read in SIGNS.items():
        text = text.replace(sign, read)
    for sign in "*/^":
        text = sign.join(part.strip() for part in text.split(sign))
    text = f"1{text}" if text.startswith("/") else text
    for piece in "*".join(text.split()).split("*"):
        for place, factor in enumerate(piece.split("/")):
            power = _POWER.fullmatch(factor)
            name, exponent = (power[1] or power[3], power[2] or power[4]) if power else (factor, 1)
            exponent = int(exponent)
            yield name, -exponent if place else exponent


def _named(name: str) -> Unit:
    """A unit by its name, which may have a prefix and end in the s of a plural."""
    if name in UNITS:
        return UNITS[name]
    for word in (name, name.removesuffix("s")):
        for prefix, factor in PREFIXES.items():
            unit = UNITS.get(word[len(prefix) :])
            if unit and word.startswith(prefix) and word[-1].isalpha():
                return unit._replace(size=factor * unit.size)
    raise LookupError(name)


for _names, _definition in OTHERS.items():
    _number, _, _text = _definition.partition(" ")
    _size, _powers = _unit(_text)
    UNITS |= dict.fromkeys(_names.split(), Unit(float(_number) * _size, _powers))
