"""Self-contact of a solid by the barrier of the incremental potential contact toolkit (ipctk).

The polygon through the nodes of the boundary is in contact. Surfaces are apart by less than
``reach``, which must be small compared with a wall.
"""

import ipctk
import numpy as np
from scipy.sparse import csc_array, csr_array

ROOM = 0.8  # of the way to the first touch that a step may go


class Touch:
    """reach: gap in mm at which the barrier starts. stiffness: a modulus times the depth, N/mm."""

    def __init__(self, solid, reach, stiffness):
        ends = solid.basis.mesh.facets[:, solid.mesh.boundary_facets()]
        middle = solid.basis.facet_dofs[0, solid.mesh.boundary_facets()]
        corner = solid.basis.nodal_dofs[0]
        nodes, edges = np.unique(
            np.concatenate([[corner[ends[0]], middle], [middle, corner[ends[1]]]], axis=1).T,
            return_inverse=True,
        )
        self.nodes, self.size, self.reach = nodes, solid.size, reach
        self.coordinates = (2 * nodes[:, None] + np.arange(2)).ravel()
        self.rest = np.asfortranarray(solid.points[nodes])
        edges = np.asfortranarray(edges.reshape(-1, 2), np.int32)
        self.mesh = ipctk.CollisionMesh(self.rest, edges)
        self.barrier = ipctk.BarrierPotential(reach, stiffness, use_physical_barrier=True)

    def _placed(self, u):
        return np.asfortranarray(self.rest + u.reshape(-1, 2)[self.nodes])

    def _pairs(self, at):
        pairs = ipctk.NormalCollisions()
        pairs.use_area_weighting = True
        pairs.collision_set_type = ipctk.NormalCollisions.IMPROVED_MAX_APPROX
        pairs.build(self.mesh, at, self.reach)
        return pairs

    def energy(self, u):
        """Energy in mJ of a placing without crossings."""
        at = self._placed(u)
        return self.barrier(self._pairs(at), self.mesh, at)

    def gradient(self, u):
        """Gradient of the energy, N."""
        at, whole = self._placed(u), np.zeros(self.size)
        whole[self.coordinates] = self.barrier.gradient(self._pairs(at), self.mesh, at)
        return whole

    def hessian(self, u):
        """Exact Hessian of the energy."""
        at = self._placed(u)
        inner = csr_array(self.barrier.hessian(self._pairs(at), self.mesh, at)).tocoo()
        places = self.coordinates[inner.row], self.coordinates[inner.col]
        return csc_array((inner.data, places), shape=(self.size, self.size))

    def room(self, u, step):
        """Share of a step that leads to no crossing."""
        start, end = self._placed(u), self._placed(u + step)
        free = ipctk.compute_collision_free_stepsize(self.mesh, start, end)
        return 1.0 if free >= 1.0 else ROOM * free

    def crosses(self, u):
        """True if the boundary cuts itself."""
        return ipctk.has_intersections(self.mesh, self._placed(u))
