"""The direction in which a lattice is pressed: across its cells, in the plane, or along them.

Along the cells the drawing is extruded to `lattice.depth`, which is then the height pressed, and
its walls are plates (`scene.plates`).
"""

from typing import Any, ClassVar, Final, Literal

from sweep.config.kinds.table import Given, Length, Table

Direction = Literal["in_plane", "out_of_plane"]
ACROSS: Final = "in_plane"
ALONG: Final = "out_of_plane"
BASE_PATCH = 5e-3  # m
WHERE = f'if loading.direction is "{ALONG}"'


class Directed(Table):
    """A loading across the cells or along them.

    base_patch: width of the patch of the base over which its greatest pressure is taken.
    """

    neutral: ClassVar[dict[str, Any]] = {"direction": ACROSS, "base_patch": BASE_PATCH}

    direction: Direction = ACROSS
    base_patch: Length = BASE_PATCH

    @property
    def along(self) -> bool:
        """Whether the lattice is pressed along its cells."""
        return self.direction == ALONG


def is_along(loading: Given) -> bool:
    """Whether these values of a loading press along the cells."""
    return loading.get("direction") == ALONG
