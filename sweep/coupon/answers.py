"""What a user says of a record, where its file does not, and the options for it."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from sweep.config.faults import MisfitError
from sweep.coupon.unit import SI


@dataclass(frozen=True)
class Answers:
    """What a user says of a record, in SI; empty: as the file says.

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


def by_quantity(words: list[str] | None, option: str) -> dict[str, str]:
    """Words such as "force=kN" of an option, by what is measured."""
    pairs = [word.partition("=") for word in words or []]
    for quantity, _, value in pairs:
        if quantity not in SI or not value:
            raise MisfitError(f"--{option} {quantity}; allowed: {'=..., '.join(SI)}=...")
    return {quantity: value for quantity, _, value in pairs}
