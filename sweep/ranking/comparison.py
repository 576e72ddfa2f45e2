"""Compares a measured value with its prediction: two ranges in one unit, and whether they
overlap.
"""

from dataclasses import dataclass
from typing import NamedTuple


class Range(NamedTuple):
    """Least and greatest value."""

    low: float
    high: float

    def misses(self, other: "Range") -> float:
        """Distance to the nearest value of another range; 0 if they meet, positive if above."""
        if self.low > other.high:
            return self.low - other.high
        return min(self.high - other.low, 0.0)


@dataclass(frozen=True)
class Comparison:
    """One row of a table of predictions.

    open: what the source leaves open, in a few words. predicted: over all that is open; measured:
    the value with its scatter; each None as long as it is not known. The unit is in `quantity`.
    """

    source: str
    quantity: str
    open: str
    predicted: Range | None
    measured: Range | None

    @property
    def off(self) -> float | None:
        """How far the prediction misses the measured range, as a share of its middle; 0: inside."""
        if self.predicted is None or self.measured is None:
            return None
        return self.predicted.misses(self.measured) / (0.5 * sum(self.measured))


def inside(comparisons: list[Comparison]) -> tuple[int, int]:
    """How many predictions overlap the measured range, and of how many."""
    misses = [one.off for one in comparisons if one.off is not None]
    return misses.count(0.0), len(misses)
