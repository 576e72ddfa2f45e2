"""What a ranking is asked."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

Quantity = float | str
"""A number in SI, or text with a unit such as "25 g"."""


class Question(NamedTuple):
    """The arguments of `rank` after its source, which has them explained; numbers are in SI."""

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
