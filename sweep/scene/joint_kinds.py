"""The compliance C of solid joints, by the openings between their arms: kinds, tables, look-up.

`joints.py` defines C. `joints.csv` has its values for each kind of joint at several angles; between
them C is interpolated. C is a mean over the states in which a lattice of such joints deforms, and
the same for all arms, except at joints with an axis. The columns NM, NV and NV_nu are not used.
"""

from collections.abc import Callable, Iterator
from csv import DictReader
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from sweep.array_types import Floats, Ints

NEAR = 6.0  # degrees: largest difference of an opening from a known joint
DIGITS = 6  # decimals of a degree, beyond which openings are equal
COLUMNS = ("MM", "MV", "VV", "NN", "VV_nu", "NN_nu")
MV_NU = -1.2  # slope of MV in nu' at all joints: as in the shear of a beam, with the sign changed
LENGTHS = np.linspace(0.6, 3.0, 241)  # x, length of an element over t: the first stable one
CONTRACTIONS = np.array([0.0, 0.25, 0.5, 0.75, 1.0])  # nu' for which it is stable
FLAT = 179.0  # degrees: two arms with a wider opening between them form no corner
LEAST = 0.1  # eigenvalue of F in V, M / t: F of a beam of that length has 0.5 to 1


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
AXIS = {"Y": 2, "T": 1}  # number of the arm that is the axis of the other two


class Joint(NamedTuple):
    """The arms of a joint. compliance (k, 4, 3): coefficients of 1, nu', nu'^2 in MM, MV,
    VV, NN of C. length (k,): x.
    """

    compliance: Floats
    length: Floats


def find_joint(opened: Floats, in_row: NDArray[np.bool_]) -> Joint | None:
    """The joint with some openings; None if it is not known.

    opened (k,): openings round the joint, degrees; opening i follows arm i. in_row (k,): arms that
    are part of a glued row. A lattice has few different joints: each is looked up once.
    """
    return _joint(tuple(opened.round(DIGITS).tolist()), tuple(in_row.tolist()))


@lru_cache(maxsize=1024)
def _joint(around: tuple[float, ...], glued: tuple[bool, ...]) -> Joint | None:
    """`find_joint` with its arguments as tuples."""
    opened, in_row = np.array(around), np.array(glued)
    if in_row.any() and np.count_nonzero(~in_row) == 1:
        for openings, matrix in on_glued_rows().items():
            if any(_off(turned, openings) < NEAR for turned, _ in _turned(opened)):
                shape = len(opened), 1, 1
                return _read_only(np.tile(matrix, shape), np.full(len(opened), LENGTHS[0]))
    fits = [
        (_off(turned, drawn(turned[0])), kind, turned[0], tuple(arms))
        for turned, arms in _turned(opened)
        for kind, drawn in KINDS.items()
        if _has(kind, turned[0])
    ]
    off, kind, angle, arms = min(fits, default=(NEAR, "", 0.0, ()))
    if off >= NEAR:
        return None
    compliance = np.empty((len(arms), 4, 3))
    length = np.empty(len(arms))
    for place, arm in enumerate(arms):
        part = "all" if kind not in AXIS else "axis" if place == AXIS[kind] else "side"
        compliance[arm], length[arm] = _arm(kind, part, float(angle))
    return _read_only(compliance, length)


def _read_only(compliance: Floats, length: Floats) -> Joint:
    """A joint that several callers share: its arrays are read-only."""
    compliance.flags.writeable = length.flags.writeable = False
    return Joint(compliance, length)


def unequal(joint: Joint, opened: Floats, thickness: Floats) -> Joint:
    """The joint of arms of unequal thickness (k,), from the ``joint`` of equal arms with the same
    openings (k,).

    Beside a thicker arm, an arm yields up to their corner as beside an equal one, and the corner is
    farther out, by d in the mean of both sides: F is unchanged in V and M - V d, and C is F less a
    beam from the centre,

        MM - 12 d,  MV - MM d + 6 d^2,  VV - (2.4 + 2 MV) d + MM d^2 - 4 d^3,  x + d,

    with MV at nu' = 0, as its slope is the slope of the beam.

    Axial forces pass straight through and spread into about half of d: NN - d / 2. Beside a thinner
    arm, C is multiplied by the ratio of the thicknesses: without the other arm it is 0.
    """
    if np.all(thickness == thickness[0]):
        return joint
    gap = np.stack([opened, np.roll(opened, 1)])  # after and before each arm
    corner, beside = gap < FLAT, np.stack([np.roll(thickness, way) for way in (-1, 1)]) / thickness
    beyond = np.where(corner, np.maximum(beside - 1.0, 0.0) / np.sin(np.radians(gap)), 0.0)
    d = 0.5 * beyond.mean(axis=0)
    share = np.minimum(beside, 1.0).mean(axis=0, where=corner)
    c = joint.compliance * share[:, None, None]
    mm, mv = c[:, :2, 0].T.copy()
    c[:, 0, 0] -= 12.0 * d
    c[:, 1, 0] += 6.0 * d**2 - mm * d
    c[:, 2, 0] += mm * d**2 - 2.0 * mv * d - 2.4 * d - 4.0 * d**3
    c[:, 3, 0] -= 0.5 * d
    return Joint(c, joint.length + d)


def _has(kind: str, angle: float) -> bool:
    """Whether the table has joints of a kind at an angle, or at angles on both sides of it."""
    angles = table()[kind, "side" if kind in AXIS else "all"][0]
    return bool(angles[0] <= angle <= angles[-1])


@lru_cache(maxsize=256)
def _arm(kind: str, part: str, angle: float) -> tuple[Floats, float]:
    """C (4, 3) and x of an arm, the least of `LENGTHS` that is stable."""
    angles, columns = table()[kind, part]
    mm, mv, vv, nn, vv_nu, nn_nu = (np.interp(angle, angles, column) for column in columns)
    c = np.array([[mm, 0.0, 0.0], [mv, MV_NU, 0.0], [vv, vv_nu, 0.0], [nn, nn_nu, 0.0]])
    least = np.min(
        [np.linalg.eigvalsh(flexibility(c, LENGTHS, nu))[:, 0] for nu in CONTRACTIONS], axis=0
    )
    return c, float(LENGTHS[np.argmax(least >= LEAST)])


def flexibility(compliance: Floats, x: Floats, nu: float) -> Floats:
    """F of arms in V and M / t, (j, 2, 2). compliance (.., 4, 3), x (j,)."""
    mm, mv, vv, _ = np.moveaxis(compliance @ nu ** np.arange(3), -1, 0)
    across, mixed = vv + 2.4 * (1.0 + nu) * x + 4.0 * x**3, mv - 6.0 * x**2
    return np.stack([across, mixed, mixed, mm + 12.0 * x], axis=-1).reshape(-1, 2, 2)


def _turned(opened: Floats) -> Iterator[tuple[Floats, Ints]]:
    """The openings, starting with each of them, in both directions, and the arm before each."""
    n = len(opened)
    for first in range(n):
        yield opened[(first + np.arange(n)) % n], (first + np.arange(n)) % n
        yield opened[(first - np.arange(n)) % n], (first + 1 - np.arange(n)) % n


def _off(opened: Floats, openings: tuple[float, ...]) -> float:
    """Largest difference between two sets of openings, degrees."""
    if len(openings) != len(opened):
        return np.inf
    return float(np.max(np.abs(opened - openings)))


@lru_cache(maxsize=1)
def table() -> dict[tuple[str, str], tuple[Floats, Floats]]:
    """Angles (k,) and values (6, k) of `COLUMNS` by kind of joint and arm, from `joints.csv`."""
    rows, by_arm = _rows("joints.csv"), {}
    for key in {(row["kind"], row["arm"]) for row in rows}:
        mine = [row for row in rows if (row["kind"], row["arm"]) == key]
        angles = np.array([float(row["angle"]) for row in mine])
        by_arm[key] = angles, np.array([[float(row[name]) for row in mine] for name in COLUMNS])
    return by_arm


@lru_cache(maxsize=1)
def on_glued_rows() -> dict[tuple[float, ...], Floats]:
    """C (4, 3) of an arm that stands upright on a row whose outer face is glued, by the openings
    round their joint.
    """
    matrices: dict[tuple[float, ...], list[list[float]]] = {}
    for row in _rows("joints_on_glued_rows.csv"):  # MM, MV, VV, NN of each
        openings = tuple(float(angle) for angle in row["openings"].split())
        values = [float(row[power]) for power in ("constant", "nu", "nu2")]
        matrices.setdefault(openings, []).append(values)
    return {openings: np.array(values) for openings, values in matrices.items()}


def _rows(name: str) -> list[dict[str, str]]:
    """The rows of a table in the folder of this file, without its comments."""
    lines = (Path(__file__).parent / name).read_text("utf-8").splitlines()
    return list(DictReader(line for line in lines if line[0] != "#"))
