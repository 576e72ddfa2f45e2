"""Notes on the cases of a sweep, before it runs: which are one period of a wide panel, and which
are too short or too long for a relaxing material, which loses no energy in them.
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


FAR = 100.0  # factor from a time of relaxation beyond which its branch loses next to nothing


def sentences_on_lossless(cases: Sequence[Case]) -> list[str]:
    """A sentence about the cases that are too short for their relaxation times, and another one
    about those that are too long; none if all are fine.
    """
    lasting = [
        (case.loading.loaded_for(case.height), case.material.relaxation_times)
        for case in cases
        if case.material.relaxation_times
    ]
    short = [(time, min(times)) for time, times in lasting if FAR * time < min(times)]
    long = [(time, max(times)) for time, times in lasting if time > FAR * max(times)]
    return [
        *_sentence(short, len(cases), "less than a hundredth of the shortest"),
        *_sentence(long, len(cases), "more than a hundred times the longest"),
    ]


def _sentence(times: list[tuple[float, float]], count: int, how: str) -> list[str]:
    """A sentence about cases with these durations and times, s; none without cases."""
    if not times:
        return []
    time, limit = times[0]
    return [
        f"{len(times)} of {count} cases last {how} material.relaxation time "
        f"({time:.2g} s and {limit:.2g} s): the material loses next to nothing in them"
    ]
