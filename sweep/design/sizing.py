"""What a maker asks for instead of cells and a wall thickness: a share of infill, or a mass."""

from functools import lru_cache

from sweep.design.box import infill_walls
from sweep.design.drawing import FEW, pitch
from sweep.design.geometry import Geometry
from sweep.design.lattice import build_network
from sweep.design.network import mass

SLACK = 1 / 3  # by which a share may be missed: what one cell or two can differ by
CLOSE = 1e-14  # of the greatest mass
THIN = 1e-6  # of the thickest wall: as good as none


def infill_share(geometry: Geometry) -> float:
    """Share of the box that lines fill, as slicers count: length x thickness, crossings twice.

    The box is that over the centre lines; an outline is no infill.
    """
    (length, _), (width, height) = infill_walls(geometry), geometry.box
    return float(length.sum()) * geometry.wall_thickness / (width * height)


def cells_for(geometry: Geometry, share: float, most: int) -> tuple[int, int] | None:
    """Columns and rows, as regular as they can be, whose lines fill the share nearest to ``share``.

    None where one cell fills too much, or more than ``most`` would be needed.
    """
    width, height = pitch(geometry.kind, geometry.orientation)
    beside = geometry.box[0] / geometry.box[1] * height / width

    def cells(rows: int) -> tuple[int, int]:
        return max(1, round(rows * beside)), rows

    def filled(rows: int) -> float:
        return infill_share(geometry._replace(cells=cells(rows)))

    def missed(rows: int) -> float:
        return abs(filled(rows) - share)

    few, more = filled(FEW), filled(FEW + 2)
    guess = FEW + round(2 * (share - few) / (more - few))
    near = range(max(1, guess - 2), max(1, guess) + 3)
    if near[-1] * cells(near[-1])[0] > most:
        return None
    best = min(near, key=missed)
    return cells(best) if missed(best) <= SLACK * share else None


@lru_cache(maxsize=4096)
def thickness_for(
    geometry: Geometry, wanted: float, thickest: float, depth: float, density: float
) -> tuple[float, float, float]:
    """Wall thickness (m) for a mass (kg), and the masses between which it can be.

    ``thickest``: the greatest thickness that may be, m. Regula falsi (Illinois) on the exact mass;
    NaN where it cannot be.
    """

    def weight(thickness: float) -> float:
        return mass(build_network(geometry._replace(wall_thickness=thickness)), depth, density)

    high = thickest
    low = THIN * high
    light, heavy = weight(low), weight(high)
    if not light < wanted < heavy:
        return float("nan"), light, heavy
    below, above = light - wanted, heavy - wanted
    middle = low
    for _ in range(60):
        middle = (low * above - high * below) / (above - below)
        excess = weight(middle) - wanted
        if abs(excess) <= CLOSE * heavy:
            break
        if excess < 0.0:
            low, below, above = middle, excess, 0.5 * above
        else:
            high, above, below = middle, excess, 0.5 * below
    return middle, light, heavy
