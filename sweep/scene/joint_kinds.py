"""C of the arms of solid joints, by the openings between them: kinds of joints, tables, look-up.

`joints.py` says what C is. `joints.csv` has it for each kind of joint at several angles; between
them it is interpolated. All arms of a joint have the same C, a mean over the states in which a
lattice of such joints deforms.
"""

from collections.abc import Callable, Iterator
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from sweep.design.drawing import Floats

NEAR = 6.0  # degrees: difference of an opening from that of a known joint
SHORTEST, BEYOND = 0.6, 0.05  # the least reach of an arm, and that beyond an overlap


def _halves(angle: float) -> float:
    return 90.0 - 0.5 * angle


KINDS: dict[str, Callable[[float], tuple[float, ...]]] = {  # openings by the first of them
    "V": lambda g: (g, 360.0 - g),
    "Y": lambda g: (g, 180.0 - 0.5 * g, 180.0 - 0.5 * g),
    "T": lambda g: (g, 180.0 - g, 180.0),
    "X": lambda g: (g, 180.0 - g, g, 180.0 - g),
    "K": lambda g: (g, _halves(g), 180.0, _halves(g)),
    "5": lambda g: (g, _halves(g), _halves(g), g, 180.0 - g),
    "6": lambda g: (g, _halves(g), _halves(g), g, _halves(g), _halves(g)),
}
GLUED = {  # an arm that stands on a row whose outer face is glued: within the row, and at its end
    (90.0, 90.0, 180.0): (
        *((-1.57, -0.224, -0.183), (-0.251, -0.88, 0.0)),
        *((0.037, 0.165, 0.0), (0.222, -0.129, -0.227)),
    ),
    (90.0, 270.0): (
        *((0.303, -0.264, -0.218), (-0.174, -0.773, 0.0)),
        *((0.4, 0.328, 0.0), (0.4, 0.007, -0.151)),
    ),
}


def reach(opened: Floats) -> float:
    """The length of the arms over t: a little beyond the overlap of any two, cot(g / 2) / 2."""
    return max(SHORTEST, float(0.5 / np.tan(np.radians(0.5 * opened.min()))) + BEYOND)


def compliance(opened: Floats, in_row: NDArray[np.bool_]) -> Floats | None:
    """Coefficients in nu' of MM, MV, VV, NN of C, (4, 3); None where they are not known.

    opened (k,): openings round the joint, degrees. in_row (k,): arms that are part of a glued row.
    """
    if in_row.any() and np.count_nonzero(~in_row) == 1:
        for openings, known in GLUED.items():
            if any(_off(turned, openings) < NEAR for turned in _turned(opened)):
                return np.array(known)
    fits = [
        (_off(turned, drawn(turned[0])), kind, turned[0])
        for turned in _turned(opened)
        for kind, drawn in KINDS.items()
        if table()[kind][0][0] <= turned[0] <= table()[kind][0][-1]
    ]
    off, kind, angle = min(fits, default=(NEAR, "", 0.0))
    if off >= NEAR:
        return None
    angles, values = table()[kind]
    mm, mv, vv, nn, mv_nu, vv_nu, nn_nu = (np.interp(angle, angles, column) for column in values)
    return np.array([[mm, 0.0, 0.0], [mv, mv_nu, 0.0], [vv, vv_nu, 0.0], [nn, nn_nu, 0.0]])


def _turned(opened: Floats) -> Iterator[Floats]:
    """The openings, begun at each of them, in both ways round."""
    for way in (opened, opened[::-1]):
        for k in range(len(opened)):
            yield np.roll(way, k)


def _off(opened: Floats, openings: tuple[float, ...]) -> float:
    """Greatest difference of two sets of openings, degrees."""
    if len(openings) != len(opened):
        return np.inf
    return float(np.max(np.abs(opened - openings)))


@lru_cache(maxsize=1)
def table() -> dict[str, tuple[Floats, Floats]]:
    """Angles (k,) and values (7, k) of each kind of joint, in the columns of `joints.csv`."""
    lines = (Path(__file__).parent / "joints.csv").read_text("utf-8").splitlines()
    rows = [line.split(",") for line in lines if not line.startswith(("#", "kind"))]
    found = {}
    for kind in KINDS:
        values = np.array([row[1:] for row in rows if row[0] == kind], np.float64).T
        found[kind] = values[0], values[1:]
    return found
