"""The designs that a search may choose, as the points of a unit cube.

Every key of [search] is one coordinate, from 0 to 1. The coordinate of the wall thickness, of the
mass, or of a slicer's infill goes from its least value to the greatest one that the budget and the
cells allow. Designs thus meet the budget by construction: near the best design it is used up, and a
penalty would make half of the neighbours worthless. A budget counts the same mass as `rank`: the
mass as extruded if there is a slicer, else the mass of the union of the walls.
"""

from collections.abc import Sequence
from functools import cached_property
from math import inf

from scipy.optimize import brentq

from sweep.config.axis import Interval, Written, rounded_down
from sweep.config.case import Case
from sweep.config.grid import Config, Values, chosen_case
from sweep.config.kinds.sliced import Sliced
from sweep.config.kinds.specimen import WallLattice
from sweep.design.lattice import counted_area
from sweep.design.panel import BEHIND, panel_of
from sweep.ranking.budget import greatest_mass

SIZES = ("lattice.wall_thickness", "lattice.mass", "lattice.infill")
USED_UP = 1.05  # shares above 1 / USED_UP stand for the greatest value: the whole budget
OPEN = 0.999  # share of the greatest wall thickness that leaves openings
EXACT = 1e-10  # m of a wall thickness, or a share of infill


class DesignSpace:
    """The designs that the [search] of a config allows.

    budget: greatest mass (kg) of a specimen, or of a `panel` of two sides (m) filled with
    specimens.
    """

    def __init__(
        self, config: Config, budget: float = inf, panel: tuple[float, float] | None = None
    ) -> None:
        self.config, self.budget, self.panel = config, budget, panel
        self._limits: dict[str, Interval | None] = {}

    @property
    def dimension(self) -> int:
        """Number of coordinates."""
        return len(self.config.recipe.search)

    def case(self, point: Sequence[float]) -> Case | None:
        """The case of a point (dimension,); None if no such lattice exists, or none within the
        budget.
        """
        shares = dict(zip(self.config.recipe.search, map(float, point), strict=True))
        chosen = {key: self.config.recipe.search[key].at(share) for key, share in shares.items()}
        if self._size is not None:
            size = self._sized(chosen, shares[self._size.name])
            if size is None:
                return None
            chosen[self._size.name] = size
        case = chosen_case(self.config.recipe, chosen)
        if case is None or not self._specimens(case):
            return None
        return case if self.weight(case) <= greatest_mass(self.budget) else None

    @cached_property
    def _size(self) -> Interval | None:
        """The axis that the budget limits."""
        axes = (self.config.recipe.search.get(key) for key in SIZES)
        return next((axis for axis in axes if isinstance(axis, Interval)), None)

    def _sized(self, chosen: Values, share: float) -> Written | None:
        """The wall thickness, or the mass, at a share of the range that the other chosen values
        allow.
        """
        assert self._size is not None
        least = chosen_case(self.config.recipe, chosen | {self._size.name: self._size.at(0.0)})
        if least is None:
            return None
        if least.case_id not in self._limits:
            self._limits[least.case_id] = self._limited(self._size, least)
        axis = self._limits[least.case_id]
        used = min(1.0, USED_UP * share) if self.budget < inf else share
        return axis.at(used) if axis else None

    def _limited(self, size: Interval, least: Case) -> Interval | None:
        """The axis up to its greatest value within the budget; None if its least value exceeds the
        budget.
        """
        match least.lattice:
            case Sliced():
                return self._limited_of_slicer(size, least)
            case WallLattice() if size.name != "lattice.infill":
                return self._limited_walls(size, least)
        return size

    def _limited_of_slicer(self, size: Interval, least: Case) -> Interval | None:
        """The axis of the mass as extruded, or of the share of infill, up to the budget."""
        most = self.budget / (self._specimens(least) or inf)
        if size.name == "lattice.infill":
            most = _greatest_share(least, size, most)
        if most < size.low:
            return None
        top = size.high if most >= size.high else max(size.low, rounded_down(most))
        return Interval(size.name, size.low, top, size.unit)

    def _limited_walls(self, size: Interval, least: Case) -> Interval | None:
        """The axis of the wall thickness, or of the mass that sets it."""
        by_mass = size.name == "lattice.mass"
        grams = size.high if by_mass else inf

        def excess(thickness: float, count: float) -> float:
            specimen = _mass(_with_walls(least, thickness))
            return max(count * specimen - self.budget, specimen - grams)

        def count(thickness: float) -> float:
            return self._specimens(_with_walls(least, thickness))

        assert isinstance(least.lattice, WallLattice)
        low = least.lattice.wall_thickness
        high = min(inf if by_mass else size.high, OPEN * _widest(least.lattice))
        weighs = by_mass or self.budget < inf
        if not low <= high or (weighs and excess(low, count(low)) > 0.0):
            return None
        while weighs and high > low and excess(high, count(high)) > 0.0:
            # thinner walls make narrower specimens, of which a panel may have one more
            high = max(low, brentq(excess, low, high, (count(high),), EXACT) - 2.0 * EXACT)
        most = _mass(_with_walls(least, high)) if by_mass else high
        top = size.high if most >= size.high else max(size.low, rounded_down(most))
        return Interval(size.name, size.low, top, size.unit)

    def weight(self, case: Case) -> float:
        """Mass (kg) that the budget limits, of a specimen or of the panel; 0 without a budget."""
        if self.budget == inf:
            return 0.0
        return self._specimens(case) * _mass(case)

    def _specimens(self, case: Case) -> float:
        """Number of specimens in a panel, as a ranking counts them; 1 without a panel."""
        if self.panel is None:
            return 1.0
        gap = BEHIND[case.loading.direction]
        return float(panel_of(self.panel, *case.footprint, gap).specimens)


def _widest(lattice: WallLattice) -> float:
    """Wall thickness (m) that leaves no openings, between walls or beside an outline."""
    beside = [lattice.opening - outline for outline in lattice.outline if outline]
    return min([lattice.thickest, *beside])


def _with_walls(case: Case, thickness: float) -> Case:
    lattice = case.lattice.model_copy(update={"wall_thickness": thickness})
    return case.model_copy(update={"lattice": lattice})


def _mass(case: Case) -> float:
    """Mass of a specimen (kg) as budgets count it."""
    return case.material.density * case.lattice.counted_volume


def _greatest_share(least: Case, size: Interval, budget: float) -> float:
    """The greatest share of a slicer's infill with which a specimen weighs at most the budget (kg);
    0 if even the least share exceeds it.
    """
    lattice = least.lattice
    assert isinstance(lattice, Sliced)
    geometry, pattern = lattice.geometry, lattice.printed_as
    per_area = least.material.density * lattice.depth

    def excess(share: float) -> float:
        distance = pattern.spacing * lattice.lines / share
        sliced = geometry.sliced and geometry.sliced._replace(distance=distance)
        return per_area * counted_area(geometry._replace(sliced=sliced)) - budget

    high = min(size.high, pattern.most)
    if excess(size.low) > 0.0:
        return 0.0
    if excess(high) <= 0.0:
        return size.high
    return brentq(excess, size.low, high, xtol=EXACT) - EXACT
