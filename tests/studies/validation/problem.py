"""A reference problem, and its results on three meshes."""

from collections.abc import Callable
from dataclasses import dataclass
from math import isnan, log, nan

from tests.support.designs.structures import DEPTH, MATERIAL, MM

NOISE = 1e-7  # differences below it are the solver's tolerance

ELASTICA, EULER, RODS = "elastica", "Euler", "exact rods"
SOURCES = {
    ELASTICA: "by elliptic integrals, Bisshopp & Drucker 1945",
    EULER: "with the column's own shortening",
    RODS: "by collocation (SciPy)",
}


@dataclass(frozen=True)
class Problem:
    """value: of a mesh (elements a wall, or steps of a time). truth: a number, or how to find it.

    source: of the truth. meshes: three of one ratio. order: expected, 0 where the value does not
    depend on the mesh. within: greatest relative error at the finest.
    """

    name: str
    value: Callable[[int], float]
    truth: float | Callable[[], float]
    source: str
    meshes: tuple[int, int, int] = (4, 8, 16)
    order: int = 4
    within: float = 1e-4


@dataclass(frozen=True)
class Finding:
    """Values at three meshes, the truth, and derived numbers."""

    values: tuple[float, ...]
    truth: float
    ratio: float

    @property
    def order(self) -> float:
        """Order from the differences of the values alone; NaN where they are round-off."""
        first, second, third = self.values
        if min(abs(second - first), abs(third - second)) < NOISE * abs(third):
            return nan
        return log(abs((second - first) / (third - second))) / log(self.ratio)

    @property
    def error(self) -> float:
        """Relative, at the finest mesh."""
        return abs(self.values[-1] / self.truth - 1.0)

    @property
    def extrapolated(self) -> float:
        """Relative error of the Richardson limit of the two finest meshes."""
        if isnan(self.order):
            return self.error
        _, second, third = self.values
        limit = third + (third - second) / (self.ratio ** round(self.order) - 1.0)
        return abs(limit / self.truth - 1.0)


def find(problem: Problem) -> Finding:
    """Solve a problem at its three meshes."""
    truth = problem.truth() if callable(problem.truth) else problem.truth
    meshes = problem.meshes
    return Finding(tuple(map(problem.value, meshes)), truth, meshes[1] / meshes[0])


def bending(thickness: float) -> float:
    """Y I of a wall of a thickness in mm, N m^2."""
    return MATERIAL.modulus * DEPTH * thickness**3 / 12 * MM**4


def axial(thickness: float) -> float:
    """Y A of a wall of a thickness in mm, N."""
    return MATERIAL.modulus * DEPTH * thickness * MM**2
