"""What a ranking of patterns says about narrow lattices: in the terminal, the page and files."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from textwrap import fill

from sweep.ranking.narrow import WIDE
from sweep.report.tables.requirement_notes import WIDTH

NARROW = (
    f"Some lattices have fewer than {WIDE} cells between free sides, which favours some patterns: "
    "a wide part may be ranked in another order."
)
LOOSE = (
    "From 3 to 24 cells across, with equal walls and cells between loose plates, energy per gram "
    "changes by {}."
)
ACROSS = {"diamond": "+52 %", "triangle": "+22 %", "hex": "+5 %", "square": "-1 to -5 %"}
"""Change of the energy per gram from 3 to 24 cells across, by pattern."""
OTHERS = {
    "square": "3 x 3 square cells have 1.7 to 2.4 times the plateau of a wide lattice.",
    "reentrant": "Reentrant cells lose a third from 3 x 3 to 6 x 6 cells.",
}


def narrow_note(patterns: Collection[str]) -> Iterator[str]:
    """What is known of narrow lattices of these patterns; nothing if there is none."""
    if not patterns:
        return
    sizes = [f"{change} ({kind})" for kind, change in ACROSS.items() if kind in patterns]
    known = [LOOSE.format(", ".join(sizes))] if sizes else []
    known += [line for kind, line in OTHERS.items() if kind in patterns]
    yield fill(" ".join([NARROW, *known]), WIDTH)
