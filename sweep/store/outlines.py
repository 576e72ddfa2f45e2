"""Outlines of strikers and ribs, for pictures of the shapes of a case: they follow from the case."""

import json
from collections.abc import Mapping

import numpy as np


def outlines(case: bytes, frames: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Outlines `striker_m` and `base_m`, (k, v, 2): x, and y above the platen in whose place they
    are; empty if both are flat.

    case: as JSON. frames: of `Result.frames`.
    """
    loading = json.loads(case or b"{}").get("loading", {})
    if {loading.get(key, "flat") for key in ("striker", "base")} == {"flat"}:
        return {}
    from sweep.config.case import Case
    from sweep.config.kinds.striker import Struck

    struck = Case.from_json(case).loading
    assert isinstance(struck, Struck)
    low, high = (end(frames["position_m"][0], axis=0) for end in (np.min, np.max))
    box = float(low[0]), *map(float, high - low)
    drawn = {key: struck.profiles(key, *box) for key in ("striker", "base")}
    return {
        f"{key}_m": np.stack([shape.outline() for shape in shapes])
        for key, shapes in drawn.items()
        if shapes
    }
