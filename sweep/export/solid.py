"""The body of a layout: its outline extruded along the depth, with a check of its volume."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from sweep.array_types import Floats, Ints
from sweep.export.errors import ExportError
from sweep.export.outline import Layout, rings
from sweep.numbers import text_in

SHORTEST = 2e-3  # mm
CLOSE = 0.005  # greatest relative difference of the volume from the mass / density


class Body(NamedTuple):
    """A triangle mesh: points (n, 3) in mm, triangles (m, 3), anticlockwise seen from outside."""

    points: Floats
    triangles: Ints

    @property
    def volume(self) -> float:
        """Volume (mm^3): the sum of a . (b x c) / 6 over the triangles a, b, c."""
        a, b, c = (self.points[corner] for corner in self.triangles.T)
        return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0)

    @property
    def stood_up(self) -> "Body":
        """The same body with its y upwards, where its z was."""
        x, y, z = self.points.T
        return self._replace(points=np.column_stack([x, z.max() - z, y]))

    @property
    def is_closed(self) -> bool:
        """True if every edge belongs to two triangles, which pass it in opposite directions.

        Points that a file in single precision cannot distinguish count as one.
        """
        _, place = np.unique(self.points.astype(np.float32), axis=0, return_inverse=True)
        corner = place.ravel()[self.triangles]
        starts, ends = corner.ravel(), np.roll(corner, -1, axis=1).ravel()
        forth = np.unique(starts * len(self.points) + ends)
        back = np.unique(ends * len(self.points) + starts)
        return len(forth) == len(starts) and np.array_equal(forth, back)


def solid(layout: Layout, volume: float) -> Body:
    """The body of a layout, whose volume must be near the volume of its mass (mm^3)."""
    body = extruded(layout)
    if not abs(body.volume - volume) <= CLOSE * volume:
        raise ExportError(
            f"the mesh of case {layout.name} has {body.volume:.5g} mm^3, but its mass / density is "
            f"{volume:.5g} mm^3; allowed: a difference of {text_in(CLOSE, '%')}"
        )
    if not body.is_closed:
        raise ExportError(
            f"the mesh of case {layout.name} is not closed, as walls touch in a single line; "
            "allowed: another wall thickness, or .svg and .dxf"
        )
    return body


def extruded(layout: Layout) -> Body:
    """The outline of a layout, extruded along z."""
    from manifold3d import CrossSection, FillRule

    loops = [ring[:-1] for ring in rings(layout)]
    mesh = CrossSection(loops, FillRule.NonZero).extrude(layout.depth).to_mesh64()
    return Body(np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts, np.int64))


def within_box(body: Body, size: Sequence[float]) -> Body:
    """The largest piece of a body inside a box of this size (mm) at the origin, without edges below
    `SHORTEST`, whose ends a file in single precision may not distinguish.
    """
    from manifold3d import Manifold, Mesh64

    whole = Manifold(Mesh64(body.points, body.triangles.astype(np.uint64)))
    pieces = (whole ^ Manifold.cube(list(size))).simplify(SHORTEST).decompose()
    mesh = max(pieces, key=lambda piece: piece.volume()).to_mesh64()
    return Body(np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts, np.int64))
