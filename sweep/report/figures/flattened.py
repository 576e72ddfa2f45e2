"""Plates as drawings of lines: their plan, and the lines of their grid as a camera sees them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from sweep.report.figures import shaded

if TYPE_CHECKING:
    from numpy.typing import NDArray

THIN = 0.1  # of a wall's thickness: lines of a grid
LEVEL = 1e-6  # of the height: nodes no farther apart have one height


def plan(frames: Mapping[str, Any]) -> dict[str, Any]:
    """The shape at rest as walls in the plan: `frames` with `edges`, and one frame."""
    edges, thickness = _sides(frames)
    position = frames["position_m"][:1]
    height = position[0, :, 2]
    bottom = np.all(height[edges] <= height.min() + LEVEL * np.ptp(height), axis=1)
    return {
        **{name: frames[name][:1] for name in ("strain", "time_s", "plate_y_m")},
        "position_m": position[..., :2],
        "edges": edges[bottom],
        "edge_thickness_m": thickness[bottom],
    }


def lines(frames: Mapping[str, Any]) -> dict[str, Any]:
    """The lines of the grid as thin walls on the screen; there are no platens."""
    edges, thickness = _sides(frames)
    screen: NDArray[Any] = shaded.seen(np.asarray(frames["position_m"], float))[0]
    return {
        **{name: frames[name] for name in ("strain", "time_s")},
        "plate_y_m": np.full_like(frames["plate_y_m"], np.nan),
        "position_m": screen,
        "edges": edges,
        "edge_thickness_m": THIN * thickness,
    }


def _sides(frames: Mapping[str, Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    """The sides of the quads as edges (m, 2), and the thickness of a quad of each one, (m,) m."""
    sides = np.concatenate([frames["quads"][:, [k, (k + 1) % 4]] for k in range(4)])
    edges, first = np.unique(np.sort(sides, axis=1), axis=0, return_index=True)
    return edges, np.tile(frames["quad_thickness_m"], 4)[first]
