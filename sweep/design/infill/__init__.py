"""Families of infill. Each file here draws one family; its name is the value of `lattice.kind`.

A family has `draw(columns, rows)`, which returns the centre lines of the cells with these numbers:
groups of polylines (n, k, 2) whose vertices are joints, in a unit of the family, y upwards. Columns
and rows are consecutive and may be negative; walls that neighbouring cells share may be drawn
twice. The drawing is stretched to the box. `ORIENTED = True`: the family may be turned by 90
degrees (`lattice.orientation`). `STAGGERED = True`: rows alternate, so the pattern repeats every
two rows. Optional closed forms, which spare a drawing: `counts(columns, rows)` of joints and walls,
`opening(width, height)` of a cell. To add a family, copy `diamond`, the shortest, or `hex`, which
has both traits.

Numpy is loaded only to draw, so that a wrong config is refused at once.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from importlib import import_module
from pkgutil import iter_modules
from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

Floats: TypeAlias = "NDArray[np.float64]"
Drawing: TypeAlias = "list[Floats]"
Draw = Callable[[Sequence[int], Sequence[int]], Drawing]


@cache
def families() -> tuple[str, ...]:
    """Names of all families, in alphabetical order."""
    return tuple(sorted(module.name for module in iter_modules(__path__)))


@cache
def trait(kind: str, name: str) -> Any:
    """The object of this name in the file of a family; None if there is none."""
    return getattr(import_module(f"{__name__}.{kind}"), name, None)


@cache
def drawer(kind: str, orientation: str | None) -> Draw:
    """The `draw` of a family; "flat" exchanges x with y and columns with rows."""
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
    """A polyline (k, 2) repeated in all cells, (n, k, 2).

    ``stagger``: shift of odd rows in x, in pitches.
    """
    import numpy as np

    column, row = np.meshgrid(columns, rows)
    at = np.stack([(column + stagger * (row % 2)) * pitch[0], row * pitch[1]], axis=-1)
    return at.reshape(-1, 1, 2) + np.asarray(motif, dtype=float)
