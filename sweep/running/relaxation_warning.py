"""Warns of cases in which a relaxing material loses no energy: they are too short or too long."""

from collections.abc import Sequence
from math import inf

from sweep.config.case import Case
from sweep.config.kinds.crush import Crush
from sweep.config.kinds.dead_load import DeadLoad
from sweep.config.kinds.impact import Impact
from sweep.config.kinds.of_file import OfFile

FAR = 100.0  # factor from a time of relaxation beyond which its branch loses next to nothing


def sentences_on_lossless(cases: Sequence[Case]) -> list[str]:
    """A sentence about the cases that are too short for their times of relaxation, and another one
    about those that are too long; none if all are fine.
    """
    lasting = [(case, loading_time(case)) for case in cases if case.material.relaxation_times]
    short = [
        (time, min(case.material.relaxation_times))
        for case, time in lasting
        if FAR * time < min(case.material.relaxation_times)
    ]
    long = [
        (time, max(case.material.relaxation_times))
        for case, time in lasting
        if time > FAR * max(case.material.relaxation_times)
    ]
    return [
        *_sentence(short, len(cases), "less than a hundredth of the shortest"),
        *_sentence(long, len(cases), "more than a hundred times the longest"),
    ]


def loading_time(case: Case) -> float:
    """About how long the walls are loaded, s: a stroke down and back up with the pause between, or
    a striker's passage.
    """
    match case.loading:
        case Crush(stroke=stroke, speed=speed, hold_time=pause):
            return 2.0 * stroke / (speed or inf) + (pause or 0.0)
        case Impact(striker_speed=speed):
            return 2.0 * case.height / speed
        case DeadLoad(duration=duration) | OfFile(duration=duration):
            return duration


def _sentence(times: list[tuple[float, float]], count: int, how: str) -> list[str]:
    """A sentence about cases with these durations and times, s; none without cases."""
    if not times:
        return []
    time, limit = times[0]
    return [
        f"{len(times)} of {count} cases last {how} material.relaxation time "
        f"({time:.2g} s and {limit:.2g} s): the material loses next to nothing in them"
    ]
