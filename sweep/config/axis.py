"""The values of a key in a config: a single written value, or the values of an axis of a search."""

from dataclasses import dataclass
from math import floor, log10
from typing import Any, NamedTuple

DIGITS = 4  # digits of a searched number: no printer resolves more


class Written(NamedTuple):
    """A value in SI (None: not set), its text in the file, and its key in the file.

    implied: whether it follows from a profile, so that it need not have an effect.
    """

    value: Any
    text: str
    name: str = ""
    implied: bool = False


@dataclass(frozen=True)
class Interval:
    """A key that takes numbers from `low` to `high`: whole ones, or any of `unit`, in SI."""

    name: str
    low: float
    high: float
    unit: str = ""

    @property
    def whole(self) -> bool:
        """Whether it takes whole numbers only."""
        return isinstance(self.low, int)

    def at(self, share: float) -> Written:
        """The value at a share, 0 to 1, of the interval; every whole number has an equal part of
        it.
        """
        if self.whole:
            count = self.high - self.low + 1
            return self.written(self.low + min(int(share * count), int(count) - 1))
        return self.written(between(self.low, self.high, share))

    def written(self, value: float) -> Written:
        """A value with its text."""
        return Written(value, f"{value:g} {self.unit}".rstrip(), self.name)

    @property
    def probes(self) -> tuple[Written, ...]:
        """The middle, then both ends."""
        return self.at(0.5), self.at(0.0), self.at(1.0)


@dataclass(frozen=True)
class Choice:
    """A key that takes one of some values."""

    values: tuple[Written, ...]

    def at(self, share: float) -> Written:
        """The value at a share, 0 to 1, of the list; every value has an equal part of it."""
        return self.values[min(int(share * len(self.values)), len(self.values) - 1)]

    @property
    def probes(self) -> tuple[Written, ...]:
        """All values, the middle one first."""
        middle = len(self.values) // 2
        return self.values[middle:] + self.values[:middle]


def between(low: float, high: float, share: float) -> float:
    """The number at a share, 0 to 1, of the way from low to high, with `DIGITS` digits."""
    value = float(f"{low + share * (high - low):.{DIGITS}g}")
    return min(max(value, low), high)


def rounded_down(value: float) -> float:
    """The greatest number with `DIGITS` digits that is no greater than a positive value."""
    near = float(f"{value:.{DIGITS}g}")
    last = 10.0 ** (floor(log10(value)) + 1 - DIGITS)
    return near if near <= value else float(f"{near - last:.{DIGITS}g}")
