"""A square tube between glued platens: bricks of an eighth of it, or of a quarter.

The walls bow in turn to the outside and the inside, so that planes through the middles of walls are
mirrors; an odd number of half waves up the height makes the middle plane across one, too.
"""

from dataclasses import dataclass

import numpy as np

from tests.studies.plates.brick import Solid
from tests.studies.plates.tied import Tied

CLAMPED, HINGED = "clamped", "hinged"


@dataclass(frozen=True)
class SolidTube:
    """pitch, thickness, height in mm; modulus in MPa. across: bricks from joint to mirror plane;
    through: of the thickness; up: to the middle of the height. bow: in thicknesses.
    """

    thickness: float
    across: int = 4
    through: int = 1
    up: int = 10
    pitch: float = 4.0
    height: float = 12.0
    modulus: float = 67.0
    bow: float = 0.02
    waves: int = 3
    half: bool = True
    ends: str = CLAMPED

    @property
    def driven(self):
        """Height that is pressed, mm."""
        return 0.5 * self.height if self.half else self.height

    @property
    def copies(self):
        """How many mirror images make the tube."""
        return 8 if self.half else 4

    def _lines(self):
        """Planes between bricks along the plan's axes and up."""
        side, face = 0.5 * self.pitch, 0.5 * self.thickness
        plan = np.append(
            np.linspace(-face, face, self.through + 1),
            np.linspace(face, side, self.across + 1)[1:],
        )
        middle = 0.5 * self.height
        up = np.append([0.0, face], np.linspace(0.0, middle, self.up + 1)[1:])
        if not self.half:
            up = np.append(up, (2.0 * middle - up)[-2::-1])
        return plan, up

    def mesh(self):
        """Points (n, 3) without the bow and bricks (e, 27)."""
        lines = [_with_middles(at) for at in (self._lines()[0], *self._lines())]
        shape = [len(at) for at in lines]
        first = np.indices([len(at) // 2 for at in lines]).reshape(3, -1).T
        first = 2 * first[(first[:, :2] < self.through).any(axis=1)]
        corner = np.indices((3, 3, 3)).reshape(3, -1).T
        every = np.ravel_multi_index((first[:, None] + corner).transpose(2, 0, 1), shape)
        used, nodes = np.unique(every, return_inverse=True)
        places = np.unravel_index(used, shape)
        points = np.column_stack([at[i] for at, i in zip(lines, places, strict=True)])
        return points, nodes.reshape(every.shape)

    def bowed(self, points):
        """Points of walls that have no stress where they bow."""
        size, half = self.bow * self.thickness, 0.5 * self.thickness + 1e-9
        up = size * np.sin(self.waves * np.pi * points[:, 2] / self.height)
        (x, y), found = points[:, :2].T, points.copy()
        found[:, 1] += np.where(np.abs(y) <= half, up * np.sin(np.pi * x / self.pitch), 0.0)
        found[:, 0] -= np.where(np.abs(x) <= half, up * np.sin(np.pi * y / self.pitch), 0.0)
        return found

    def build(self):
        """The tied solid, whose platen moves by u at the top, or at the middle of the height."""
        points, nodes = self.mesh()
        body = Solid(self.bowed(points), nodes, self.modulus)
        return Tied(body, *self._ties(points))

    def _ties(self, points):
        """Unknown and ratio of each coordinate; the platen's is the last."""
        n, (x, y, z) = len(points), points.T
        unknown, ratio = np.arange(3 * n).reshape(n, 3), np.ones((n, 3))
        side = 0.5 * self.pitch - 1e-9
        ratio[x > side, 0] = ratio[y > side, 1] = 0.0
        top = z > z.max() - 1e-9
        for end in (z < 1e-9,) if self.half else (z < 1e-9, top):
            self._hold(points, end, unknown, ratio)
        unknown[top, 2], ratio[top, 2] = 3 * n, 1.0
        return unknown.ravel(), ratio.ravel()

    def _hold(self, points, end, unknown, ratio):
        ratio[end] = 0.0
        if self.ends == CLAMPED:
            return
        half = 0.5 * self.thickness + 1e-9
        for along, off in ((0, 1), (1, 0)):
            wall = np.flatnonzero(end & (points[:, along] > half))
            image = points[wall].copy()
            image[:, off] *= -1.0
            apart = np.abs(points[wall][None] - image[:, None]).sum(axis=2)
            other = wall[apart.argmin(axis=1)]
            above = points[wall, off] > 1e-9
            below = points[wall, off] < -1e-9
            ratio[wall[above | below], off] = 1.0
            ratio[wall[above], 2] = 1.0
            unknown[wall[below], 2] = unknown[other[below], 2]
            ratio[wall[below], 2] = -1.0


def _with_middles(at):
    """Quadratic bricks have nodes between planes, too."""
    return np.sort(np.append(at, 0.5 * (at[1:] + at[:-1])))
