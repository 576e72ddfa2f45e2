"""A kind of lattice with no more than a new one needs (CONTRIBUTING.md)."""

from typing import ClassVar, Literal, Self

import pytest

from sweep.config.case import Case
from sweep.config.kinds import lattice as lattices
from sweep.config.kinds.specimen import WallLattice
from sweep.config.kinds.table import Few, Inputs, own_values
from sweep.design.geometry import Drawing, Geometry
from sweep.running.batches import cost
from tests.support.converged import converged


class Ladder(WallLattice):
    """Two posts with rungs between them."""

    because: ClassVar[str] = 'lattice.kind is "ladder"'
    words: ClassVar[tuple[str, ...]] = ("ladder",)

    kind: Literal["ladder"] = "ladder"
    rungs: Few = 3

    @classmethod
    def of(cls, inputs: Inputs, density: float, along: bool) -> Self:
        """The ladder of these values."""
        return cls.model_validate({"nodes_per_wall": 5} | own_values(inputs, cls))

    @property
    def cells_x(self) -> int:
        """Number of cells side by side."""
        return 1

    @property
    def cells_y(self) -> int:
        """Number of cells above one another."""
        return self.rungs

    @property
    def opening(self) -> float:
        """Clear width of a cell, m."""
        return min(self.width, self.height / self.rungs)

    @property
    def geometry(self) -> Geometry:
        """The numbers that define the drawing."""
        heights = [self.height * k / self.rungs for k in range(self.rungs + 1)]
        joints = tuple((x, y) for y in heights for x in (0.0, self.width))
        rungs = tuple((2 * k, 2 * k + 1) for k in range(self.rungs + 1))
        posts = tuple((k, k + 2) for k in range(2 * self.rungs))
        box, drawing = (self.width, self.height), Drawing(joints, rungs + posts)
        return Geometry("ladder", None, (1, 1), box, self.wall_thickness, drawing=drawing)


@pytest.fixture
def known(monkeypatch):
    """The kind of lattice, as if it were named in `Lattice`."""
    monkeypatch.setattr(lattices, "KINDS", (*lattices.KINDS, Ladder))
    monkeypatch.setattr(lattices, "WORDS", (*lattices.WORDS, "ladder"))


@pytest.mark.parametrize("direction", ["in_plane", "out_of_plane"])
def test_it_is_completed_counted_and_crushed(known, direction):
    crush = {"mode": "displacement", "strain": 0.02, "direction": direction, "unload": False}
    case = Case.of(lattice={"kind": "ladder", "rungs": 2}, loading=crush)
    assert case.lattice.counts == (6, 7)
    assert cost(case) > 0.0
    assert case.changed(lattice={"rungs": 3}).lattice.rungs == 3
    result = converged(case)
    assert (result.summary["lattice_kind"], result.summary["cells_y"]) == ("ladder", 2)
