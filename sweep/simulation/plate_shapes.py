"""Stored shapes of plates: positions of the whole lattice, strains of its quads, crossings.

Strains are evaluated at the middles of the quads. The directors are not stored: bending is measured
with the normals of the wall at the corners, each the mean over the quads of the wall there, which
leaves out the turns by transverse shear.
"""

import numpy as np

from kernels.geometry.space import crossing, surface
from kernels.plates.layout import PER_NODE
from sweep.array_types import Floats
from sweep.scene.plates.scene import Scene
from sweep.scene.plates.shell_mesh import ShellMesh
from sweep.scene.plates.unfolded import unfolded

CORNERS = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])  # of a quad, in s and z


def positions(x: Floats, nodes: int) -> Floats:
    """Positions (f, n, 3) in m of the first coordinates of shapes x (f, 6 n + 2)."""
    return x[:, : PER_NODE * nodes].reshape(len(x), nodes, PER_NODE)[..., :3]


def plate_frames(x: Floats, strain: Floats, time: Floats, scene: Scene) -> dict[str, np.ndarray]:
    """Shapes x (f, 6 n + 2) as in `Result.frames`, of the whole lattice; strain, time (f,)."""
    whole = unfolded(scene.mesh)
    return {
        "strain": strain,
        "time_s": time,
        "position_m": whole.positions(positions(x, scene.mesh.n_nodes)),
        "plate_y_m": x[:, -2:].copy(),
        "quads": whole.quads,
        "quad_thickness_m": scene.mesh.thickness[whole.quad],
    }


def plate_strains(x: Floats, scene: Scene) -> tuple[Floats, Floats, Floats]:
    """Least and greatest strain of the mid-surface of each quad, and the greatest of its surfaces,
    (f, m) each, in shapes x (f, 6 n + 2).
    """
    mesh = scene.mesh
    position = positions(x, mesh.n_nodes)
    rest_stretch, rest_bend = _measures(mesh.rest[None], mesh)
    stretch, bend = _measures(position, mesh)
    stretch = np.array([1.0, 1.0, 0.0]) + _in_axes(stretch - rest_stretch, rest_stretch)
    bend = _in_axes(bend - rest_bend, rest_stretch)
    least, greatest = principal(stretch)
    half = 0.5 * mesh.thickness[:, None]
    surfaces = [principal(stretch + side * half * 2.0 * bend)[1] for side in (-1.0, 1.0)]
    return least, greatest, np.maximum(*surfaces)


def _in_axes(m: Floats, metric: Floats) -> Floats:
    """Tensors (f, m, 3) of 11, 22, 12 in orthonormal axes, where ``metric`` (1, m, 3) is the metric
    of s and z, as in `kernels.plates.element.axes`.
    """
    one, two, both = np.moveaxis(metric, -1, 0)
    c = np.sqrt(one / (one * two - both**2))
    a, b = 1.0 / np.sqrt(one), -c * both / one
    across = b**2 * m[..., 0] + c**2 * m[..., 1] + 2.0 * b * c * m[..., 2]
    return np.stack([a**2 * m[..., 0], across, a * (b * m[..., 0] + c * m[..., 2])], axis=-1)


def principal(c: Floats) -> tuple[Floats, Floats]:
    """Least and greatest nominal strain (f, m) from squared stretches c (f, m, 3): 11, 22, 12."""
    mean, across = 0.5 * (c[..., 0] + c[..., 1]), 0.5 * (c[..., 0] - c[..., 1])
    radius = np.hypot(across, c[..., 2])
    low, high = (np.sqrt(np.maximum(mean + sign * radius, 0.0)) - 1.0 for sign in (-1.0, 1.0))
    return low, high


def _measures(position: Floats, mesh: ShellMesh) -> tuple[Floats, Floats]:
    """First and second form (f, m, 3) of the quads: 11, 22, 12, at their middles; position (f, n,
    3) in m, the second form in 1/m.
    """
    along, up = _slopes(position[:, mesh.quads], mesh.size)
    normal = _normals(position, mesh)
    turned_along, turned_up = _slopes(normal, mesh.size)
    first = np.stack([_dot(along, along), _dot(up, up), _dot(along, up)], axis=-1)
    mixed = 0.5 * (_dot(along, turned_up) + _dot(up, turned_along))
    second = np.stack([_dot(along, turned_along), _dot(up, turned_up), mixed], axis=-1)
    return first, second


def _dot(a: Floats, b: Floats) -> Floats:
    return np.asarray((a * b).sum(axis=-1))


def _slopes(corner: Floats, size: Floats) -> tuple[Floats, Floats]:
    """Derivatives (f, m, 3) along s and z at the middle of each quad; corner (f, m, 4, 3)."""
    along, up = (np.einsum("fmci,c->fmi", corner, 0.5 * sign) for sign in CORNERS.T)
    return along / size[:, :1], up / size[:, 1:]


def _normals(position: Floats, mesh: ShellMesh) -> Floats:
    """Normals (f, m, 4, 3) of the wall of each quad at its corners."""
    corner = position[:, mesh.quads]
    diagonal = np.cross(corner[:, :, 2] - corner[:, :, 0], corner[:, :, 3] - corner[:, :, 1])
    place = mesh.smooth_corners
    total = np.zeros((place.max() + 1, len(position), 3))
    for c in range(4):
        np.add.at(total, place[:, c], diagonal.swapaxes(0, 1))
    total /= np.maximum(np.linalg.norm(total, axis=2, keepdims=True), np.finfo(float).tiny)
    return np.asarray(np.moveaxis(total[place], 2, 0))


def surface_crossings(position: Floats, mesh: ShellMesh) -> int:
    """Greatest number of edges that pass through triangles in a shape; position (f, N, 3) in m of
    the whole mesh, including images beyond mirror planes or a period away.

    The check is independent of the solver, apart from its triangles. Contact within round-off
    counts too.
    """
    triangles = unfolded(mesh).triangles
    if mesh.shift.any():
        triangles, position = mesh.triangles, mesh.with_images(position)
    edges, _ = surface.edges_of(triangles, position.shape[1])
    unsure = np.empty((0, 2), np.int64)
    shapes = map(np.ascontiguousarray, position)  # one layout: one machine code
    counts = [sum(crossing.count(shape, triangles, edges, unsure)) for shape in shapes]
    return int(max(counts))
