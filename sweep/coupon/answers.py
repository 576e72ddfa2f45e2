"""The user's answers about a record, for data that its file does not state."""

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Answers:
    """The user's answers about a record, in SI; empty: as the file says.

    gauge: m. area: m^2. speed: m/s, of the travel, if no time was recorded. test: "pulled" or
    "pressed". zero: see `zero`. columns, units: by the quantities of `unit.SI`.
    """

    gauge: float | None = None
    area: float | None = None
    speed: float | None = None
    test: str | None = None
    zero: str | None = None
    columns: Mapping[str, str] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
