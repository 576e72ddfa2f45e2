"""The origin of strain and stress: travel that was not set to zero, preload, and slack.

"first": at the first row, from which both are measured. "line": where the straight line through the
beginning of the loading meets zero stress, as in the toe compensation of ASTM D638: slack is cut
off, and a preload is joined to the origin.
"""

import numpy as np

from sweep.array_types import Floats
from sweep.coupon.direction import sides_of
from sweep.numbers import text_in, with_unit

Path = tuple[Floats, Floats, Floats]

CHOICES = ("first", "line")
OFFSET = 0.005, 0.05  # greatest first strain, and first stress over the greatest one
NO_STRAIN = 1e-4
UNLOADED = 0.002  # share of the greatest stress
SLACK = 0.005  # strain
SLACK_SHARE = 0.03  # share of the greatest strain, if strain is not to scale
WINDOW = 0.02, 0.08  # shares of the greatest stress: the line goes through the rows between
FEWEST = 4  # least number of rows of the line


def doubt(strain: Floats, stress: Floats, to_scale: bool) -> str | None:
    """Why the zero of strain and stress (n,) cannot be decided; None if it can.

    to_scale: false if the strains are known only up to a factor.
    """
    share = abs(float(stress[0])) / float(np.abs(stress).max())
    if share > OFFSET[1]:
        return (
            f"the record begins with {text_in(share, '%', 2)} of its greatest force: a sensor that "
            "was not set to zero (first), or a preload (line)?"
        )
    sign, _ = sides_of(strain, stress)
    moved = sign * (strain - strain[0])
    slack = _line(moved, sign * (stress - stress[0]))
    if slack > (SLACK if to_scale else SLACK_SHARE * moved.max()):
        share = slack / float(moved.max())
        return (
            f"there is hardly any force in the first {text_in(share, '%', 2)} of the travel: slack "
            "(line), or the material itself (first)?"
        )
    return None


def begins_at_zero(strain: Floats, stress: Floats) -> bool:
    """Whether a record begins at zero, or at a small strain with the corresponding stress."""
    share = abs(float(stress[0])) / float(np.abs(stress).max())
    if abs(strain[0]) <= NO_STRAIN:
        return share <= OFFSET[1]
    return abs(strain[0]) <= OFFSET[0] and UNLOADED < share <= OFFSET[1]


def from_first(time: Floats, strain: Floats, stress: Floats) -> tuple[Path, str]:
    """Time, strain and stress (n,) from the first row, and a sentence."""
    at = with_unit(float(stress[0]), "Pa") if stress[0] else "no stress"
    begin = f"a strain of {strain[0]:.3g} and {at}"
    note = f"the record begins at {begin}, which are both set to zero"
    return (time, strain - strain[0], stress - stress[0]), note


def from_line(time: Floats, strain: Floats, stress: Floats) -> tuple[Path, str]:
    """Time, strain and stress (m,) from the point at which the line meets zero, and a sentence."""
    sign, _ = sides_of(strain, stress)
    start = _line(sign * (strain - strain[0]), sign * stress)
    moved = strain - strain[0] - sign * start
    first = int(np.argmax(sign * moved > 0.0))
    last = min(first + FEWEST, strain.size - 1)
    speed = abs(moved[last] - moved[first]) / (time[last] - time[first])
    begin = time[first] - abs(moved[first]) / speed if speed > 0.0 else time[first] - 1.0
    path = tuple(
        np.r_[value, values[first:]]
        for value, values in ((begin, time), (0.0, moved), (0.0, stress))
    )
    note = f"zero strain is {start:.2g} after the first row, where the first line meets zero stress"
    return path, note


def _line(strain: Floats, stress: Floats) -> float:
    """The strain at which the line through the beginning of a loading meets zero stress; 0 if the
    stress does not rise there. Both (n,) are positive in the loading.
    """
    turn = int(np.argmax(stress)) + 1
    least, more = (share * stress[turn - 1] for share in WINDOW)
    least = max(least, float(stress[0]))
    begin = int(np.argmax(stress[:turn] > least))
    end = max(begin + FEWEST, int(np.argmax(stress[:turn] > least + more)))
    rows = slice(begin, min(end, turn))
    if np.ptp(strain[rows]) <= 0.0:
        return 0.0
    slope, height = np.polyfit(strain[rows], stress[rows], 1)
    return float(-height / slope) if slope > 0.0 else 0.0
