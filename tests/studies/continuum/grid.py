"""The square grid as a mesh: rectangles for the walls, squares for the joints."""

from dataclasses import dataclass

import numpy as np

CROWDING = 2.5  # exponent: stress is singular at the inner corners of the joints


def crowded(pieces):
    """Ends of the pieces of a unit length, which are shorter towards both of its ends."""
    from_middle = np.linspace(-1.0, 1.0, pieces + 1)
    return 0.5 + 0.5 * np.sign(from_middle) * (1.0 - (1.0 - np.abs(from_middle)) ** CROWDING)


@dataclass(frozen=True)
class Grid:
    """cells x cells over centre lines of ``width`` mm, walls of ``thickness`` mm.

    across: elements through a wall. bow: stress-free shift in x,
    bow * thickness * sin(pi y / width).
    """

    cells: int = 3
    width: float = 12.5
    thickness: float = 0.8
    depth: float = 12.0
    across: int = 2
    bow: float = 0.01

    @property
    def pitch(self):
        """Distance of the centre lines, mm."""
        return self.width / self.cells

    @property
    def along(self):
        """Elements along a wall between two joints, an even number; a few times as long as wide."""
        slender = self.pitch / self.thickness - 1.0
        return 2 * max(self.across, round(0.8 * self.across * slender**0.5))

    def lines(self):
        """Coordinates of the element lines, mm."""
        half, at = 0.5 * self.thickness, self.pitch * np.arange(self.cells + 1)
        joints = [centre - half + self.thickness * crowded(self.across) for centre in at]
        room = (self.pitch - self.thickness) * crowded(self.along)[1:-1]
        inside = [centre + half + room for centre in at[:-1]]
        return np.sort(np.concatenate([*joints, *inside]))

    def mesh(self):
        """Elements where there is wall."""
        from skfem import MeshQuad  # not needed for the network

        lines = self.lines()
        full = MeshQuad.init_tensor(lines, lines)
        centre = full.p[:, full.t].mean(axis=1)
        off = np.abs(centre - self.pitch * np.round(centre / self.pitch))
        walls = full.restrict(np.flatnonzero(off.min(axis=0) < 0.5 * self.thickness))
        shift = self.bow * self.thickness * np.sin(np.pi * walls.p[1] / self.width)
        return MeshQuad(walls.p + np.array([shift, 0.0 * shift]), walls.t)
