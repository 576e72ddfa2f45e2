"""Notes on cases in which one period represents a wide panel: whether the period keeps its
width.
"""

from collections.abc import Sequence

from sweep.config.case import Case

HELD = "glued platens, friction or inertia hold it"
FREE = "platens without friction hold nothing: the mean lateral force is zero"


def sentences_on_periods(cases: Sequence[Case]) -> list[str]:
    """A sentence about cases whose period is fixed, and one about cases whose period is free."""
    tied = [case.widens for case in cases if case.lattice.tied_sides]
    free = sum(tied)
    return [
        f"{number} of {len(cases)} cases are one period of a wide panel, whose "
        f"masses, forces and energies are reported; its width is {how}"
        for number, how in ((len(tied) - free, f"fixed, as {HELD}"), (free, f"free, as {FREE}"))
        if number
    ]
