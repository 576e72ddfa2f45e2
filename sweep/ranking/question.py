"""The question of a ranking: its arguments, as text with a unit or as numbers in SI."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from sweep.config.faults import ReportedError
from sweep.ranking.requirement_table import MEASURES

Quantity = float | str
"""A number in SI, or text with a unit such as "25 g"."""


class RankError(ReportedError, ValueError):
    """A ranking that is not possible; the text is one sentence with the allowed values."""


class Question(NamedTuple):
    """The arguments of `rank` after its source, explained there; numbers are in SI."""

    budget: Quantity | Sequence[Quantity] | None = None
    panel: Sequence[Quantity] | None = None
    by: str | None = None
    top: int | None = 10
    allowed_force: Quantity | None = None
    require: Mapping[str, Quantity | None] | None = None
    per: str = "specimen"

    @property
    def budgets(self) -> list[Quantity]:
        """The budgets as a list, which may be empty."""
        if self.budget is None:
            return []
        return [self.budget] if isinstance(self.budget, float | int | str) else list(self.budget)


def in_si(value: Any, unit: str) -> float:
    """A positive number in SI, from a number or from text with a unit."""
    number = value
    if isinstance(value, str):
        from sweep.config.faults import ConfigError
        from sweep.config.units import quantity

        try:
            number = quantity(value, unit)
        except ConfigError as error:
            raise RankError(str(error)) from None
    if not number > 0.0:
        written = value if isinstance(value, str) else f"{value:g} {unit}"
        raise RankError(f"{written}: budgets, panels, forces and heights must be above zero")
    return float(number)


def check_units(arguments: Mapping[str, Any]) -> None:
    """Refuse arguments with a number that has no unit."""
    examples = {"budget": "25 g", "panel": "100 mm", "allowed_force": "50 N"}
    examples |= {name: measure.example for name, measure in MEASURES.items()}
    for name, value in arguments.items():
        for item in [value] if isinstance(value, str) or not isinstance(value, Iterable) else value:
            if not isinstance(item, str | None):
                allowed = f'text with a unit, such as "{examples.get(name, "50 N")}"'
                raise RankError(f"{name} = {item!r}: a bare number; allowed: {allowed}")
