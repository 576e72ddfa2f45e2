"""Crushes of the square grid as a solid, kept in solids.csv: a minute each, or several.

python -m tests.studies.continuum.solids computes all of them and prints the file; with the number
of a case, only that one. Surfaces can touch, because walls of a tenth of their length and more
would cross themselves at the inner corners that close.
"""

import sys
from typing import NamedTuple

import numpy as np

from tests.studies.continuum.grid import Grid
from tests.studies.continuum.press import Press
from tests.studies.continuum.rubber import RUBBERS
from tests.studies.continuum.solid import Solid
from tests.studies.continuum.touch import Touch

HEAD = """\
# Crushes of a grid of 3 x 3 cells as a solid body: force and energy over strain.
# Source: python -m tests.studies.continuum.solids, quadratic finite elements with self-contact
# Outer centre lines 12.5 mm apart, depth 12 mm, bow 0.01 t, glued platens; neo-Hookean rubber,
# Y = 12 MPa, nu = 0.48. L: a third of 12.5 mm. across: elements through a wall.
t_over_l,plane,across,strain,force_N,energy_mJ
"""
MODULUS, POISSON = 12.0, 0.48
REACH = {2: 0.006, 4: 0.006, 6: 0.002}  # of contact, thicknesses; by elements through a wall
STEP = 0.01  # of the strain
SLENDER = {0.05: 0.3, 0.1: 0.3, 0.19: 0.3, 0.29: 0.29}  # t / L: greatest strain
STOUT = 0.15  # t / L of walls that need finer meshes


class Crush(NamedTuple):
    """A crush to ``strain``. slenderness: t / L. across: elements through a wall."""

    slenderness: float
    plane: str
    across: int
    strain: float

    def grid(self):
        """The shape of the solid."""
        return Grid(thickness=self.slenderness * Grid().pitch, across=self.across)

    def rubber(self):
        """The rubber of the solid."""
        return RUBBERS[self.plane](MODULUS, POISSON)


def pair(slenderness, plane, strain):
    """A crush by a coarser and a finer mesh."""
    meshes = (4, 6) if slenderness > STOUT else (2, 4)
    return tuple(Crush(slenderness, plane, across, strain) for across in meshes)


PAIRS = tuple(pair(t, plane, strain) for t, strain in SLENDER.items() for plane in RUBBERS)
PACKED = pair(0.192, "stress", 0.6)  # walls of 0.8 mm


def press(case):
    """The body of a case between platens, able to touch itself."""
    grid = case.grid()
    body = Solid(grid.mesh(), case.rubber(), grid.depth)
    reach = REACH[case.across] * grid.thickness
    return Press(body, grid.width, Touch(body, reach, MODULUS * grid.depth))


def crushed(case):
    """Rows (strain, force in N, energy in mJ)."""
    return press(case).crush(STEP * np.arange(1, round(case.strain / STEP) + 1)).rows


def main(chosen):
    """Print the rows of all cases, or of the chosen one."""
    sys.stdout.write(HEAD)
    for number, case in enumerate(case for cases in (*PAIRS, PACKED) for case in cases):
        if chosen in (None, number):
            for row in crushed(case):
                cells = *case[:3], *(f"{x:.7g}" for x in row)
                sys.stdout.write(",".join(map(str, cells)) + "\n")
            sys.stdout.flush()


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else None)
