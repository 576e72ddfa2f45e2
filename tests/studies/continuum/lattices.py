"""Stiffness of endless lattices at small strain: the table of joints against the solid joints.

python -m tests.studies.continuum.lattices prints the errors in two minutes. The solid is exact: as
stresses away from the joints are those of beams, an axial force, a shear and a moment in the middle
of every wall tell all, and they make the energy C of `openings` + beams least under a mean stress.
"""

import sys
from functools import cache
from pathlib import Path

import numpy as np

from sweep.design.geometry import Geometry
from sweep.design.infill import families
from sweep.design.period import build_period
from tests.studies.continuum.arms import axes
from tests.studies.continuum.openings import KINDS, Star, beam, matrix

TABLE = Path(__file__).parents[3] / "sweep/scene/joints.csv"
NEAR = 0.01  # of openings, degrees
POISSON, SLENDER = 0.48, (0.1, 0.2)
HEIGHTS = (1.0, 1.3)  # of a period of a width of 1


@cache
def table():
    """Angles and values (k, 10) of each kind and arm."""
    found = {}
    for line in TABLE.read_text("utf-8").splitlines():
        if not line.startswith(("#", "kind")):
            kind, angle, arm, *values = line.split(",")
            found.setdefault((kind, arm), []).append([float(x) for x in (angle, *values)])
    return {key: np.array(lines) for key, lines in found.items()}


def placed(openings):
    """Kind of a joint, angle, and which of its openings is the first of the kind, either way."""
    n = len(openings)
    for kind, (make, (low, high)) in KINDS.items():
        for way in (1, -1):
            for first in range(n):
                order = (first + way * np.arange(n)) % n
                turned = np.array(openings)[order]
                for angle in set(turned[(turned > low - NEAR) & (turned < high + NEAR)]):
                    if len(make(angle)) == n and np.allclose(make(angle), turned, atol=NEAR):
                        return kind, angle, order
    raise ValueError(f"no kind of joint has the openings {openings}")


def from_table(openings, poisson, by_arm=True):
    """C of the arms by the table, (n, 3, 3); arm i is before opening i."""
    kind, angle, order = placed(openings)
    arms, signs = ["all"] * len(openings), [1.0] * len(openings)
    if by_arm and (kind, "axis") in table():
        # the side arms are before and after the first opening, which is to the left of the former
        first = order[0]
        arms = [{first: "side", (first + 1) % 3: "side"}.get(i, "axis") for i in range(3)]
        signs[(first + 1) % 3] = -1.0
    found = []
    for arm, sign in zip(arms, signs, strict=True):
        rows = table()[kind, arm]
        mm, mv, vv, nn, nm, nv, vv_nu, nn_nu, nv_nu = (
            np.interp(angle, rows[:, 0], rows[:, k]) for k in range(1, 10)
        )
        vv, nn, nv = np.array([vv, nn, nv]) + poisson * np.array([vv_nu, nn_nu, nv_nu])
        found.append(matrix((mm, mv - 1.2 * poisson, vv, nn, sign * nm, sign * nv)))
    return np.array(found)


@cache
def exact(openings, poisson):
    """C of all arms, (n, 3, n, 3)."""
    return Star(openings).beyond(poisson)


class Lattice:
    """One period; lengths in thicknesses. slender: t over the length of the shortest wall."""

    def __init__(self, kind, height, slender):
        cells = (1, 2) if kind in ("brick", "hex", "reentrant", "triangle", "kagome") else (1, 1)
        box = (1.0, height * cells[1])
        made = build_period(Geometry(kind, None, cells, box, 0.01, periodic=True))
        start, end = made.walls[: made.own].T
        span = made.points[end] - made.points[start]
        scale = 1.0 / (slender * np.hypot(*span.T).min())
        self.span, self.area = span * scale, np.prod(made.period) * scale**2
        self.joints = made.origin[np.column_stack([start, end])]
        self.size = 3 * made.own

    def joint(self, at):
        """Openings round a joint, and per arm the matrix (3, size) of its (N, V, M), and axes."""
        arms = []
        for wall, end in np.argwhere(self.joints == at):
            x, y = self.span[wall] * (1, -1)[end]
            half, bears = 0.5 * np.hypot(x, y), np.zeros((3, self.size))
            bears[:, 3 * wall : 3 * wall + 3] = [[1, 0, 0], [0, 1, 0], [0, half, (1, -1)[end]]]
            arms.append((np.arctan2(y, x) % (2.0 * np.pi), half, bears))
        arms.sort(key=lambda arm: arm[0])
        angles, halves, bears = (np.array(part) for part in zip(*arms, strict=True))
        gaps = np.degrees(np.diff(np.append(angles, angles[0] + 2.0 * np.pi))).round(6)
        return tuple(gaps.tolist()), angles, halves, bears

    def yields(self, poisson, joints):
        """Compliance (3, 3) for mean stresses xx, yy, xy; joints: exact, a table, or None."""
        energy, balance = np.zeros((self.size, self.size)), []
        for at in np.unique(self.joints):
            openings, angles, halves, bears = self.joint(at)
            along, left = np.array([axes(angle) for angle in angles]).swapaxes(0, 1)
            force = along[:, :, None] * bears[:, :1] + left[:, :, None] * bears[:, 1:2]
            balance += [*force.sum(axis=0), bears[:, 2].sum(axis=0)]
            own = np.array([beam(half, poisson) for half in halves])
            if joints is exact:
                form = exact(openings, poisson)
                energy += np.einsum("iax,iajb,jby->xy", bears, form, bears, optimize=True)
            elif joints is not None:
                own += joints(openings, poisson)
            energy += np.einsum("iax,iab,iby->xy", bears, own, bears, optimize=True)
        stress = np.zeros((3, self.size))
        for wall, (x, y) in enumerate(self.span):
            along, left = np.array([x, y]) / np.hypot(x, y), np.array([-y, x]) / np.hypot(x, y)
            for k, way in enumerate((along, left)):
                stress[:, 3 * wall + k] = way[0] * x, way[1] * y, 0.5 * (way[0] * y + way[1] * x)
        held = np.vstack([balance, stress / self.area])
        rest = np.zeros((len(held), len(held)))
        system = np.block([[energy, held.T], [held, rest]])
        load = np.zeros((len(system), 3))
        load[-3:] = np.eye(3)
        found = np.linalg.lstsq(system, load, rcond=1e-12)[0][: self.size]
        return found.T @ energy @ found / self.area

    def errors(self, poisson, joints):
        """Of the stiffness along x, along y and in shear, %, against the solid."""
        solid, other = (np.diag(self.yields(poisson, how)) for how in (exact, joints))
        return 100.0 * (solid / other - 1.0)


def uniform(openings, poisson):
    """The same C for all arms of a joint."""
    return from_table(openings, poisson, by_arm=False)


def main(out):
    """Print the errors."""
    out.write("| infill | height | t / L | table | one C a joint | beams to the centre |\n")
    out.write("|---|---|---|---|---|---|\n")
    for kind in families():
        for height in HEIGHTS:
            for slender in SLENDER:
                lattice = Lattice(kind, height, slender)
                cells = (
                    " / ".join(f"{error:+.1f}" for error in lattice.errors(POISSON, joints))
                    for joints in (from_table, uniform, None)
                )
                out.write(f"| {kind} | {height:g} | {slender:g} | {' | '.join(cells)} |\n")
                out.flush()


if __name__ == "__main__":
    main(sys.stdout)
