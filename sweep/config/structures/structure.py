"""Custom structures: the content of the JSON file `lattice.file`.

Each key names its unit. Nodes are numbered from 0, in the order of the file.
"""

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from sweep.config.kinds.table import Few, Positive
from sweep.constants import MM

Pair = tuple[float, float]
Node = Annotated[int, Field(ge=0)]
BESIDE_WALLS = (
    *("supports", "loads", "prescribed", "pins", "springs", "masses"),
    *("floor_y_mm", "gravity_mm_s2", "initial_velocity_mm_s", "probes"),
)
"""Keys that no structure has which is pressed between platens."""


class Part(BaseModel):
    """A part of a structure; its keys are keys of the file."""

    model_config = ConfigDict(frozen=True, strict=True, extra="forbid", allow_inf_nan=False)


class Support(Part):
    """The directions in which a node never moves."""

    node: Node
    fix: Annotated[tuple[Literal["x", "y", "rotation"], ...], Field(min_length=1)]


class Load(Part):
    """A dead force and a moment at a node; moments are positive anticlockwise."""

    node: Node
    force_N: Pair = (0.0, 0.0)  # noqa: N815 as in the file
    moment_Nmm: float = 0.0  # noqa: N815 as in the file


class Prescribed(Part):
    """A prescribed displacement of a node along x or y, or an anticlockwise rotation."""

    node: Node
    direction: Literal["x", "y", "rotation"]
    displacement_mm: float | None = None
    angle_rad: float | None = None

    @property
    def move(self) -> float:
        """Displacement, m, or rotation, rad."""
        turned = self.direction == "rotation"
        return (self.angle_rad if turned else MM * (self.displacement_mm or 0.0)) or 0.0


class PointMass(Part):
    """A mass at a node, in addition to the mass of the walls."""

    node: Node
    mass_g: Annotated[float, Field(ge=0)]


class SpringPart(Part):
    """A linear spring between two nodes."""

    nodes: tuple[Node, Node]
    stiffness_N_mm: Positive  # noqa: N815 as in the file
    rest_length_mm: Positive | None = None


class Structure(Part):
    """Nodes, walls, supports, loads and other parts of a structure."""

    nodes_mm: Annotated[tuple[Pair, ...], Field(min_length=2)]
    walls: Annotated[tuple[tuple[Node, Node], ...], Field(min_length=1)]
    wall_thickness_mm: Positive | tuple[Positive, ...] = 0.8
    depth_mm: Positive = 12.0
    subdivide: Few | tuple[Few, ...] = 8
    rest_angles: Literal["as_drawn"] = "as_drawn"
    supports: tuple[Support, ...] = ()
    loads: tuple[Load, ...] = ()
    prescribed: tuple[Prescribed, ...] = ()
    pins: tuple[Node, ...] = ()
    masses: tuple[PointMass, ...] = ()
    springs: tuple[SpringPart, ...] = ()
    initial_velocity_mm_s: Pair | tuple[Pair, ...] = (0.0, 0.0)
    gravity_mm_s2: Pair = (0.0, 0.0)
    floor_y_mm: float | None = None
    probes: tuple[Node, ...] = ()

    @property
    def thickness_mm(self) -> tuple[float, ...]:
        """Thickness of every wall, mm."""
        thickness = self.wall_thickness_mm
        return thickness if isinstance(thickness, tuple) else (thickness,) * len(self.walls)

    def with_thickness(self, mean_mm: float) -> "Structure":
        """The structure with all walls thickened by one factor, so that their mean is `mean_mm`."""
        each = self.thickness_mm
        factor = mean_mm * len(each) / sum(each)
        alike = min(each) == max(each)
        walls = mean_mm if alike else tuple(factor * thickness for thickness in each)
        return self.model_copy(update={"wall_thickness_mm": walls})

    @property
    def pieces(self) -> tuple[int, ...]:
        """Number of elements of every wall."""
        count = self.subdivide
        return count if isinstance(count, tuple) else (count,) * len(self.walls)

    @property
    def velocity_mm_s(self) -> tuple[Pair, ...]:
        """Initial velocity of every node, mm/s."""
        velocity = self.initial_velocity_mm_s
        if not velocity or isinstance(velocity[0], tuple):
            return velocity
        return (velocity,) * len(self.nodes_mm)

    @property
    def beside_walls(self) -> list[str]:
        """The keys of `BESIDE_WALLS` that it gives."""
        fields = type(self).model_fields
        return [key for key in BESIDE_WALLS if getattr(self, key) != fields[key].default]

    @property
    def restraints(self) -> set[tuple[int, str]]:
        """Nodes and directions that supports fix."""
        return {(support.node, direction) for support in self.supports for direction in support.fix}

    @property
    def size_mm(self) -> tuple[float, float]:
        """Extent of the nodes in x and y, mm."""
        xs, ys = zip(*self.nodes_mm, strict=True)
        return max(xs) - min(xs), max(ys) - min(ys)


def pieces_of(count: int, pairs: Any) -> list[int]:
    """The number of the connected piece of each of ``count`` items; pairs (p, 2) connect two of
    them.
    """
    import numpy as np
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    ends = np.array(pairs, np.int64).reshape(-1, 2).T
    graph = coo_array((np.ones(len(pairs)), tuple(ends)), shape=(count, count))
    pieces: list[int] = connected_components(graph, directed=False)[1].tolist()
    return pieces
