"""The faults of a config: all of them at once, one line each."""

import json
from collections import Counter
from typing import NamedTuple

SHOWN = 12  # most faults that the text of a ConfigError lists


class Fault(NamedTuple):
    """One fault: its key, and one line with key, value and allowed values.

    understood: the value is used in spite of it, so that no other fault follows from it.
    """

    key: str
    line: str
    understood: bool = False


class ReportedError(Exception):
    """An error whose text is all that a user needs: the command line prints nothing else."""


class MisfitError(ReportedError, ValueError):
    """An input that cannot be used; the text says why, in our own words.

    Only this class is caught to be shown, as the text of a library's `ValueError` tells users
    nothing, and would be blamed on the key that is being read.
    """


class ConfigError(MisfitError):
    """A config that cannot be run. `faults`: all faults; the text lists `SHOWN` of them.

    notes: sentences about what was read until then.
    """

    def __init__(self, faults: list[Fault], notes: tuple[str, ...] = ()) -> None:
        super().__init__(faults, notes)
        self.faults, self.notes = faults, notes

    def __str__(self) -> str:
        return "\n".join(_shown(self.faults))


def _shown(faults: list[Fault]) -> list[str]:
    """One line each for `SHOWN` faults; the first fault of every key goes before further ones."""
    counts: Counter[str] = Counter()
    repeats = []  # number of earlier faults of the same key
    for fault in faults:
        repeats.append(counts[fault.key])
        counts[fault.key] += 1
    chosen = sorted(range(len(faults)), key=repeats.__getitem__)[:SHOWN]
    more = len(faults) - len(chosen)
    counted = (
        [f"and {more:,} more mistake{'s' if more > 1 else ''}, shown after these are fixed"]
        if more
        else []
    )
    return [faults[k].line for k in sorted(chosen)] + counted


def in_words(raw: object) -> str:
    """A value as TOML writes it, on one line of at most 60 characters."""
    text = json.dumps(raw, default=str, ensure_ascii=False)
    return one_line(text if len(text) <= 60 else f"{text[:57]}...")


def one_line(text: str) -> str:
    """A text with a question mark for each character that is not printable."""
    return "".join(char if char.isprintable() else "?" for char in text)
