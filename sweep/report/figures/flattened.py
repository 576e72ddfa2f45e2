"""Draws plates as lines: their plan."""

from collections.abc import Mapping
from typing import Any

import numpy as np

LEVEL = 1e-6  # share of the height within which nodes have one height


def plan(frames: Mapping[str, Any]) -> dict[str, Any]:
    """The shape at rest as walls in the plan: `frames` with `edges`, and one frame."""
    sides = np.concatenate([frames["quads"][:, [k, (k + 1) % 4]] for k in range(4)])
    edges, first = np.unique(np.sort(sides, axis=1), axis=0, return_index=True)
    thickness = np.tile(frames["quad_thickness_m"], 4)[first]
    position = frames["position_m"][:1]
    height = position[0, :, 2]
    bottom = np.all(height[edges] <= height.min() + LEVEL * np.ptp(height), axis=1)
    return {
        **{name: frames[name][:1] for name in ("strain", "time_s", "plate_y_m")},
        "position_m": position[..., :2],
        "edges": edges[bottom],
        "edge_thickness_m": thickness[bottom],
    }
