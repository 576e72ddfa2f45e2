"""The direction in which a lattice is pressed: across its cells, in the plane, or along them.

Along the cells the drawing is extruded to `lattice.depth`, which is then the pressed height, and
its walls are plates (`scene.plates`).
"""

from typing import Final, Literal

from sweep.config.kinds.table import Inputs

Direction = Literal["in_plane", "out_of_plane"]
ACROSS: Final = "in_plane"
ALONG: Final = "out_of_plane"
WHERE = f'if loading.direction is "{ALONG}"'


def is_along(loading: Inputs) -> bool:
    """Whether these values of a loading press along the cells."""
    return loading.get("direction") == ALONG
