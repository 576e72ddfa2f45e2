"""A note on narrow lattices in rankings of patterns: for the terminal, the page and files."""

from collections.abc import Collection, Iterator
from textwrap import fill

from sweep.ranking.narrow import WIDE
from sweep.report.tables.requirement_notes import WIDTH

NARROW = (
    f"Some lattices have fewer than {WIDE} cells between free sides, which favours some patterns: "
    "a wide part may be ranked in another order."
)
BESIDE = (
    "Energy per gram of 3 cells between free sides, beside the middle of a wide panel, between "
    "glued / loose platens (to 50 %, walls a tenth of a cell): {}."
)
OF_THREE = {
    "brick": (12, 0),
    "circle": (-26, -39),
    "diamond": (-41, -50),
    "hex": (-24, -25),
    "kagome": (-20, -23),
    "reentrant": (-15, -22),
    "square": (5, -1),
    "triangle": (-10, -24),
}
"""Change in %, between glued and loose platens, as `make sides` measures it."""


def narrow_note(patterns: Collection[str]) -> Iterator[str]:
    """The known effect of narrow lattices on these patterns; nothing if there are none."""
    if not patterns:
        return
    gains = [
        f"{kind} {glued:+d} / {loose:+d} %"
        for kind, (glued, loose) in OF_THREE.items()
        if kind in patterns
    ]
    beside = [BESIDE.format(", ".join(gains))] if gains else []
    yield fill(" ".join([NARROW, *beside]), WIDTH)
