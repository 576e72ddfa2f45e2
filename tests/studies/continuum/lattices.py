"""Stiffness of endless lattices at small strain: the table of joints against the solid joints.

python -m tests.studies.continuum.lattices prints the errors in three minutes, also of lattices with
lines of unequal thickness. The solid is exact: as stresses away from the joints are the stresses of
beams, an axial force, a shear and a moment in the middle of every wall determine everything, and
they minimise the energy C of `openings` + beams under a mean stress.
"""

import sys
from dataclasses import replace
from functools import cache, cached_property
from pathlib import Path

import numpy as np

from sweep.design.geometry import Geometry
from sweep.design.infill import families
from sweep.design.period import build_period
from sweep.scene.joints import find_arms
from tests.studies.continuum.arms import axes
from tests.studies.continuum.joint_compliance import KINDS, Star, beam, matrix

TABLE = Path(__file__).parents[3] / "sweep/scene/joints.csv"
NEAR = 0.01  # of openings, degrees
POISSON, SLENDER = 0.48, (0.1, 0.2)
HEIGHTS = (1.0, 1.3)  # of a period of a width of 1
TWO_ROWS = ("brick", "hex", "reentrant", "triangle", "kagome")  # a period is two cells high
UNEQUAL = (("square", 1.0), ("brick", 1.0), ("diamond", 1.3))
RATIOS = (1.25, 1.5, 2.0, 3.0)


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
def exact(openings, thickness, poisson):
    """C of all arms, (n, 3, n, 3)."""
    return Star(openings, thickness).beyond(poisson)


def first_line(kind, span):
    """The walls of one of the two lines that cross: level, or rising to the right."""
    x, y = span.T
    return x * y > 0.0 if kind == "diamond" else np.isclose(y, 0.0)


class Lattice:
    """One period; lengths in thicknesses. slender: t over the length of the shortest wall.

    ratio: thickness of the walls of the `first_line` over t, the thickness of the others.
    """

    def __init__(self, kind, height, slender, ratio=1.0):
        cells = (1, 2) if kind in TWO_ROWS else (1, 1)
        box = (1.0, height * cells[1])
        made = build_period(Geometry(kind, None, cells, box, 0.01, periodic=(True, True)))
        start, end = made.walls[: made.own].T
        span = made.points[end] - made.points[start]
        thickness = slender * np.hypot(*span.T).min()
        self.span, self.area = span / thickness, np.prod(made.period) / thickness**2
        self.wide = (
            np.where(first_line(kind, span), ratio, 1.0) if ratio != 1.0 else np.ones(made.own)
        )
        self.joints = made.origin[np.column_stack([start, end])]
        self.size = 3 * made.own
        self.network = replace(made, wall_thickness=thickness * self.wide[made.original])

    @cached_property
    def arms(self):
        """The ends of the walls as they are in a run."""
        return find_arms(self.network, self.joints, (), self.joints[:0])

    def filled(self):
        """The greatest share of a wall that its joints take."""
        taken = self.arms.length.sum(axis=1) / self.network.wall_thickness[: len(self.span)]
        return np.max(taken * self.wide / np.hypot(*self.span.T))

    def of_scene(self, poisson):
        """C of both ends of the walls, (w, 2, 3, 3)."""
        known = self.arms.compliance @ poisson ** np.arange(3)
        return np.array([[matrix((*one, 0.0, 0.0)) for one in wall] for wall in known])

    def joint(self, at):
        """Arms of a joint in order: wall and end; and openings, angles, half lengths, and matrices
        (3, size) of their (N, V, M).
        """
        arms = []
        for wall, end in np.argwhere(self.joints == at):
            x, y = self.span[wall] * (1, -1)[end]
            half, bears = 0.5 * np.hypot(x, y), np.zeros((3, self.size))
            bears[:, 3 * wall : 3 * wall + 3] = [[1, 0, 0], [0, 1, 0], [0, half, (1, -1)[end]]]
            arms.append((np.arctan2(y, x) % (2.0 * np.pi), half, bears, (wall, end)))
        arms.sort(key=lambda arm: arm[0])
        angles, halves, bears, ends = (np.array(part) for part in zip(*arms, strict=True))
        gaps = np.degrees(np.diff(np.append(angles, angles[0] + 2.0 * np.pi))).round(6)
        return ends, tuple(gaps.tolist()), angles, halves, bears

    def yields(self, poisson, joints):
        """Compliance (3, 3) for mean stresses xx, yy, xy.

        joints: exact, a table, C of both ends of the walls (w, 2, 3, 3), or None.
        """
        energy, balance = np.zeros((self.size, self.size)), []
        for at in np.unique(self.joints):
            ends, openings, angles, halves, bears = self.joint(at)
            wide = self.wide[ends[:, 0]]
            along, left = np.array([axes(angle) for angle in angles]).swapaxes(0, 1)
            force = along[:, :, None] * bears[:, :1] + left[:, :, None] * bears[:, 1:2]
            balance += [*force.sum(axis=0), bears[:, 2].sum(axis=0)]
            bears[:, 2] /= wide[:, None]  # M / t
            own = np.array([beam(half, poisson) for half in halves / wide])
            if joints is exact:
                form = exact(openings, tuple(wide.tolist()), poisson)
                energy += np.einsum("iax,iajb,jby->xy", bears, form, bears, optimize=True)
            elif callable(joints):
                own += joints(openings, poisson)
            elif joints is not None:
                own += joints[*ends.T]
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
        """Errors of the stiffness along x, along y and in shear, %, against the solid."""
        solid, other = (np.diag(self.yields(poisson, how)) for how in (exact, joints))
        return 100.0 * (solid / other - 1.0)


def uniform(openings, poisson):
    """The same C for all arms of a joint."""
    return from_table(openings, poisson, by_arm=False)


def row(lattice, cells, rules):
    """A line of a table: names and errors of some rules."""
    errors = (
        " / ".join(f"{error:+.1f}" for error in lattice.errors(POISSON, joints)) for joints in rules
    )
    return f"| {' | '.join([*cells, *errors])} |\n"


def main(out):
    """Print the errors of equal walls, then of unequal ones."""
    out.write("| infill | height | t / L | table | one C a joint | beams to the centre |\n")
    out.write("|---|---|---|---|---|---|\n")
    for kind in families():
        for height in HEIGHTS:
            for slender in SLENDER:
                lattice, rules = Lattice(kind, height, slender), (from_table, uniform, None)
                out.write(row(lattice, (kind, f"{height:g}", f"{slender:g}"), rules))
                out.flush()
    out.write("\n| infill | height | ratio | in a run | C of equals | beams to the centre |\n")
    out.write("|---|---|---|---|---|---|\n")
    for kind, height in UNEQUAL:
        for ratio in (*RATIOS, *(1.0 / r for r in RATIOS)):
            lattice = Lattice(kind, height, SLENDER[1] / max(ratio, 1.0), ratio)
            rules = lattice.of_scene(POISSON), from_table, None
            out.write(row(lattice, (kind, f"{height:g}", f"{ratio:.3g}"), rules))
            out.flush()


if __name__ == "__main__":
    main(sys.stdout)
