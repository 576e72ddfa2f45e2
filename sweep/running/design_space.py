"""The designs that a search may choose, as the points of a unit cube.

Every key of [search] is one coordinate, from 0 to 1. The wall thickness, or the mass, is the share
of the way from its least value to the greatest one that the budget and the cells allow, so that the
budget is kept by construction: near the best design it is used up, and a penalty would make half of
the neighbours worthless.
"""

from collections.abc import Sequence
from functools import cached_property
from math import inf

from scipy.optimize import brentq

from sweep.config.axis import Interval, Written, rounded_down
from sweep.config.case import Case, Lattice
from sweep.config.grid import Config, Values, chosen_case
from sweep.design.lattice import build_network
from sweep.design.network import mass
from sweep.design.panel import specimens

SIZES = ("lattice.wall_thickness", "lattice.mass")
USED_UP = 1.05  # shares above 1 / USED_UP stand for the greatest value: the whole budget
OPEN = 0.999  # of the greatest wall thickness that leaves openings
EXACT = 1e-10  # m, of a wall thickness


class DesignSpace:
    """What the [search] of a config allows.

    budget: greatest mass (kg) of a specimen, or of a `panel` of two sides (m) filled with them.
    """

    def __init__(
        self, config: Config, budget: float = inf, panel: tuple[float, float] | None = None
    ) -> None:
        self.config, self.budget, self.panel = config, budget, panel
        self._limits: dict[str, Interval | None] = {}

    @property
    def dimension(self) -> int:
        """Number of coordinates."""
        return len(self.config.search)

    def case(self, point: Sequence[float]) -> Case | None:
        """The case of a point (dimension,); None if no such lattice exists, or within no budget."""
        shares = dict(zip(self.config.search, map(float, point), strict=True))
        chosen = {key: self.config.search[key].at(share) for key, share in shares.items()}
        if self._size is not None:
            size = self._sized(chosen, shares[self._size.name])
            if size is None:
                return None
            chosen[self._size.name] = size
        case = chosen_case(self.config, chosen)
        return case if case and self._weight(case, case.lattice) <= self.budget else None

    @cached_property
    def _size(self) -> Interval | None:
        """The axis that the budget limits."""
        found = (self.config.search.get(key) for key in SIZES)
        return next((axis for axis in found if isinstance(axis, Interval)), None)

    def _sized(self, chosen: Values, share: float) -> Written | None:
        """The wall thickness, or the mass, at a share of what the other chosen values allow."""
        assert self._size is not None
        least = chosen_case(self.config, chosen | {self._size.name: self._size.at(0.0)})
        if least is None:
            return None
        if least.case_id not in self._limits:
            self._limits[least.case_id] = self._limited(self._size, least)
        axis = self._limits[least.case_id]
        used = min(1.0, USED_UP * share) if self.budget < inf else share
        return axis.at(used) if axis else None

    def _limited(self, size: Interval, least: Case) -> Interval | None:
        """The axis up to its greatest value within the budget; None if its least exceeds that."""
        by_mass = size.name == "lattice.mass"
        grams = size.high if by_mass else inf

        def excess(thickness: float, count: float) -> float:
            specimen = _mass(least, _with_walls(least.lattice, thickness))
            return max(count * specimen - self.budget, specimen - grams)

        def count(thickness: float) -> float:
            return self._panels(_with_walls(least.lattice, thickness))

        low = least.lattice.wall_thickness
        high = min(inf if by_mass else size.high, OPEN * _widest(least.lattice))
        weighs = by_mass or self.budget < inf
        if not low <= high or (weighs and excess(low, count(low)) > 0.0):
            return None
        while weighs and high > low and excess(high, count(high)) > 0.0:
            # thinner walls make narrower specimens, of which a panel may have one more
            high = max(low, brentq(excess, low, high, (count(high),), EXACT) - 2.0 * EXACT)
        most = _mass(least, _with_walls(least.lattice, high)) if by_mass else high
        top = size.high if most >= size.high else max(size.low, rounded_down(most))
        return Interval(size.name, size.low, top, size.unit)

    def _weight(self, case: Case, lattice: Lattice) -> float:
        """Mass (kg) that the budget limits."""
        return self._panels(lattice) * _mass(case, lattice) if self.budget < inf else 0.0

    def _panels(self, lattice: Lattice) -> float:
        """Number of specimens in a panel, as a ranking counts them; 1 without a panel."""
        if self.panel is None:
            return 1.0
        area = self.panel[0] * self.panel[1]
        return float(specimens(area, lattice.outer_size[0], lattice.depth))


def _widest(lattice: Lattice) -> float:
    """Wall thickness (m) that leaves no openings, between walls or beside an outline."""
    beside = [lattice.opening - outline for outline in lattice.outline if outline]
    return min([lattice.thickest, *beside])


def _with_walls(lattice: Lattice, thickness: float) -> Lattice:
    return lattice.model_copy(update={"wall_thickness": thickness})


def _mass(case: Case, lattice: Lattice) -> float:
    """Mass of the print (kg)."""
    return mass(build_network(lattice.geometry), lattice.depth, case.material.density)
