"""Sentences on cases that a results file lacks, and that could lead its ranking."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping


def incomplete(count: int, about: Mapping[str, Any]) -> Iterator[str]:
    """Warnings that a file of ``count`` cases lacks some that could lead; about: its attributes."""
    if missing := missing_cases(count, about):
        yield (
            f"{missing} of {about['asked_cases']} cases of the last run are missing, and may "
            "change the order: the same crumple run computes them."
        )
    if part := about.get("part"):
        several = "s" * ("," in part)
        yield (
            f"This file has part{several} {part} of a sweep: designs of other parts may be better; "
            "crumple merge combines all parts."
        )


def missing_cases(count: int, about: Mapping[str, Any]) -> int:
    """How many cases of the last run a file of ``count`` cases does not contain, as the run was
    interrupted. about: its attributes.
    """
    return max(int(about["asked_cases"]) - count + int(about["other_cases"]), 0)
