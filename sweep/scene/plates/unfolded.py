"""The whole lattice from the quarter between two mirror planes, for stored shapes."""

from dataclasses import dataclass

import numpy as np

from sweep.array_types import Floats, Ints
from sweep.scene.plates.shell_mesh import ShellMesh


@dataclass(frozen=True)
class Unfolded:
    """N nodes and M quads of the whole, from the nodes and quads of a part.

    node (N,): node of the part; at (N, 2): whether it is mirrored in x and in y; quads (M, 4),
    whose normals point to the same side as in the part, mirrored. quad (M,): quad of the part.
    triangles (2 M, 3): as in `ShellMesh`.
    """

    planes: Floats
    node: Ints
    at: np.ndarray
    quads: Ints
    quad: Ints
    triangles: Ints

    def positions(self, part: Floats) -> Floats:
        """Positions (f, N, 3) in m from the positions of the part, (f, n, 3)."""
        whole = part[:, self.node]
        whole[..., :2] = np.where(self.at, 2.0 * self.planes - whole[..., :2], whole[..., :2])
        return whole


def unfolded(mesh: ShellMesh) -> Unfolded:
    """The whole of a mesh; its period if it repeats. Images of a node on a mirror plane are one
    node.
    """
    n, m = mesh.n_nodes, len(mesh.quads)
    if mesh.copies == 1:
        shown, parts = mesh.shown, (mesh.quads, mesh.triangles[: 2 * m])
        of_quads, of_triangles = (np.searchsorted(shown, part) for part in parts)
        none = np.zeros((len(shown), 2), np.bool_)
        return Unfolded(mesh.planes, shown, none, of_quads, np.arange(m), of_triangles)
    images = np.array([[False, False], [True, False], [False, True], [True, True]])  # bits of k
    own = np.empty((4, n), np.int64)  # the node of the whole for each image of a node
    node: list[Ints] = []
    at: list[np.ndarray] = []
    for k, image in enumerate(images):
        new = ~(mesh.on & image).any(axis=1)
        own[k, new] = sum(len(each) for each in node) + np.arange(new.sum())
        for axis in (0, 1):
            on = ~new & mesh.on[:, axis] & image[axis]
            own[k, on] = own[k - 2**axis, on]  # the node of the image that is not mirrored there
        node.append(np.flatnonzero(new))
        at.append(np.broadcast_to(image, (int(new.sum()), 2)))
    turned_over = [image.sum() == 1 for image in images]  # two mirrors are a turn
    quads, triangles = (
        [own[k][nodes[:, ::-1] if turned else nodes] for k, turned in enumerate(turned_over)]
        for nodes in (mesh.quads, mesh.triangles)
    )
    return Unfolded(
        mesh.planes, np.concatenate(node), np.concatenate(at), np.concatenate(quads),
        np.tile(np.arange(m), 4), np.concatenate(triangles),
    )  # fmt: skip
