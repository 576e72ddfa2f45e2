"""The user's answers about a record, for data that its file does not state."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from sweep.config.units import quantity

UNITS = {"gauge": "m", "area": "m^2", "speed": "m/s", "density": "kg/m^3"}
"""The SI units of sizes."""


@dataclass(frozen=True)
class Answers:
    """The user's answers about a record, in SI; empty: as the file says.

    gauge: m. area: m^2. speed: m/s, of the travel, if no time was recorded. density: kg/m^3. test:
    "pulled" or "pressed". zero: see `zero`. columns, units: by the quantities of `unit.SI`.
    """

    gauge: float | None = None
    area: float | None = None
    speed: float | None = None
    density: float | None = None
    test: str | None = None
    zero: str | None = None
    columns: Mapping[str, str] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)

    @classmethod
    def of(
        cls,
        sizes: Mapping[str, str | None],
        test: str | None,
        zero: str | None,
        columns: Mapping[str, str] | None,
        units: Mapping[str, str] | None,
    ) -> "Answers":
        """The answers of which sizes are text with a unit."""
        given = {key: quantity(text, UNITS[key]) for key, text in sizes.items() if text is not None}
        return cls(**given, test=test, zero=zero, columns=columns or {}, units=units or {})
