"""What a maker asks for instead of cells and a wall thickness: a share of infill, or a mass."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

from sweep.design.drawing import FEW, pitch
from sweep.design.network import build_network, infill_walls, mass

if TYPE_CHECKING:
    from sweep.config.lattice_table import Lattice

SLACK = 1 / 3  # by which a share may be missed: what one cell or two can differ by
CLOSE = 1e-14  # of the greatest mass
THIN = 1e-6  # of the thickest wall: as good as none


def infill_share(lattice: Lattice) -> float:
    """Share of the box that lines fill, as slicers count: length x thickness, crossings twice.

    The box is that over the centre lines; an outline is no infill.
    """
    length, _ = infill_walls(lattice)
    return float(length.sum()) * lattice.wall_thickness / (lattice.width * lattice.height)


def cells_for(lattice: Lattice, most: int) -> dict[str, int]:
    """Cells, as regular as they can be, whose lines fill the share nearest to `infill`.

    Empty where one cell fills too much, or more than ``most`` would be needed.
    """
    wanted = lattice.infill or 0.0
    width, height = pitch(lattice.kind, lattice.orientation)
    beside = lattice.width / lattice.height * height / width

    def cells(rows: int) -> dict[str, int]:
        return {"cells_x": max(1, round(rows * beside)), "cells_y": rows}

    def missed(rows: int) -> float:
        return abs(infill_share(lattice.model_copy(update=cells(rows))) - wanted)

    few, more = (infill_share(lattice.model_copy(update=cells(n))) for n in (FEW, FEW + 2))
    guess = FEW + round(2 * (wanted - few) / (more - few))
    near = range(max(1, guess - 2), max(1, guess) + 3)
    if near[-1] * cells(near[-1])["cells_x"] > most:
        return {}
    best = min(near, key=missed)
    return cells(best) if missed(best) <= SLACK * wanted else {}


@lru_cache(maxsize=4096)
def thickness_for(lattice: Lattice, density: float) -> tuple[float, float, float]:
    """Wall thickness (m) for the `mass` of a lattice, and the masses (kg) between which it can be.

    Regula falsi (Illinois) on the exact mass; NaN where it cannot be.
    """
    wanted = lattice.mass or 0.0

    def weight(thickness: float) -> float:
        network = build_network(lattice.model_copy(update={"wall_thickness": thickness}))
        return mass(network, lattice.depth, density)

    high = lattice.thickest
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
