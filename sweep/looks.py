"""How designs look in a chart: colour = cells, sign = material, size = wall thickness.

The same design looks the same in every panel.
"""

from __future__ import annotations

from itertools import cycle
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from pandas import DataFrame

RAMP = ((68, 1, 84), (59, 82, 139), (33, 145, 140), (94, 201, 98))  # of viridis: few to many cells
SIGNS = "o^sDvP"
AREAS = (15.0, 75.0)  # of the thinnest and the thickest wall, points^2
PLAIN = {"ls": "", "marker": "o", "ms": 6.0, "color": "#8a8a8a"}


class Looks(NamedTuple):
    """Colours by cells (x, y), signs by material, areas by wall thickness (m)."""

    colors: dict[tuple[int, int], str]
    signs: dict[str, str]
    areas: dict[float, float]

    def of(self, points: DataFrame) -> dict[str, Any]:
        """Keywords of a scatter plot for designs of one material."""
        cells = zip(points["cells_x"], points["cells_y"], strict=True)
        return {
            "c": [self.colors[pair] for pair in cells],
            "s": points["wall_thickness_m"].map(self.areas).to_numpy(),
            "marker": self.signs[points["material"].iloc[0]],
        }

    def legend(self, walls: bool = True) -> list[dict[str, Any]]:
        """Keywords of an empty line for each entry: what varies under a heading each."""
        groups = {
            "cells": {f"{x} x {y}": {"color": color} for (x, y), color in self.colors.items()},
            "material": {name: {"marker": sign} for name, sign in self.signs.items()},
            "wall": {f"{1e3 * t:.3g} mm": {"ms": area**0.5} for t, area in self.areas.items()},
        }
        shown = [name for name in groups if len(groups[name]) > 1 and (walls or name != "wall")]
        return [
            {**PLAIN, **look, "label": label}
            for name in shown
            for label, look in [(name, {"marker": ""}), *groups[name].items()]
        ]


def looks(designs: DataFrame) -> Looks:
    """The looks of all designs of a ranking."""
    cells = sorted(set(zip(designs["cells_x"], designs["cells_y"], strict=True)))
    walls = sorted(designs["wall_thickness_m"].unique())
    return Looks(
        dict(zip(cells, _ramp(len(cells)), strict=True)),
        dict(zip(sorted(designs["material"].unique()), cycle(SIGNS), strict=False)),
        dict(zip(walls, np.linspace(*AREAS, len(walls)), strict=True)),
    )


def _ramp(count: int) -> list[str]:
    """Evenly spaced colours from dark to light."""
    at = np.linspace(0.0, len(RAMP) - 1.0, count)
    channels = [np.interp(at, range(len(RAMP)), channel) for channel in zip(*RAMP, strict=True)]
    return [
        "#" + "".join(f"{round(c):02x}" for c in color) for color in zip(*channels, strict=True)
    ]
