"""Families of infill. A file here is a family: its name is the `lattice.kind` that draws it.

Each has `draw(columns, rows)`: the centre lines of the cells with these numbers, as groups of
polylines (n, k, 2) whose vertices are joints, in a unit of its own, y upwards. Columns and rows are
consecutive and may be negative; what neighbouring cells share may be drawn twice. The drawing is
stretched to the box. `ORIENTED = True`: it may be turned by a quarter (`lattice.orientation`).
`STAGGERED = True`: every other row is another; two of them are what repeats.

Numpy is loaded only to draw, so that a config is refused at once.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from importlib import import_module
from pkgutil import iter_modules
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Floats = NDArray[np.float64]
    Drawing = list[Floats]
    Draw = Callable[[Sequence[int], Sequence[int]], Drawing]


@cache
def families() -> tuple[str, ...]:
    """Names of all families, in the order of the alphabet."""
    return tuple(sorted(module.name for module in iter_modules(__path__)))


def trait(kind: str, name: str) -> Any:
    """What the file of a family has under a name; None without it."""
    return getattr(import_module(f"{__name__}.{kind}"), name, None)


@cache
def drawer(kind: str, orientation: str | None) -> Draw:
    """The `draw` of a family; "flat": x and y, and so columns and rows, exchanged."""
    upright: Draw = trait(kind, "draw")
    if orientation != "flat":
        return upright
    return lambda columns, rows: [lines[..., ::-1] for lines in upright(rows, columns)]


def tile(
    motif: ArrayLike,
    columns: Sequence[int],
    rows: Sequence[int],
    pitch: tuple[float, float] = (1.0, 1.0),
    stagger: float = 0.0,
) -> Floats:
    """A polyline (k, 2) repeated at all cells, (n, k, 2); odd rows are shifted by a share."""
    import numpy as np

    column, row = np.meshgrid(columns, rows)
    at = np.stack([(column + stagger * (row % 2)) * pitch[0], row * pitch[1]], axis=-1)
    return at.reshape(-1, 1, 2) + np.asarray(motif, dtype=float)
