"""Discrete elastic rods in numpy: what linear walls store that neither touch nor fold.

    E = sum k_s (l - l0)^2 / 2 + theta . K theta / 2

Elements run along e = l t with the bearing beta, joints turn by phi, and all that bends are angles
theta = D (beta, phi) - theta0. With n = (-t_y, t_x), dl/de = t and dbeta/de = n / l =: q

    dE/de = T t + M q,   T = k_s (l - l0),   (M, dE/dphi) = D^T K theta,   C = D^T K D
    d2E/de de' = C q q'^T + [k_s t t^T + T / l n n^T - M / l^2 (t n^T + n t^T)] (if e is e')

All elements at once, the Hessian by a linear map found before into a band for LAPACK's Cholesky.
"""

from typing import NamedTuple

import numpy as np
from scipy.linalg import lapack
from scipy.sparse import csr_array, diags_array
from scipy.sparse.csgraph import reverse_cuthill_mckee


class Found(NamedTuple):
    """Energy, gradient (n,), and what the Hessian is made of: q, t, l, T, M of every element."""

    energy: float
    gradient: np.ndarray
    q: np.ndarray
    t: np.ndarray
    length: np.ndarray
    tension: np.ndarray
    moment: np.ndarray


def sparse(rows, columns, values, shape):
    """Matrix from its entries; those at one place add up."""
    values = np.broadcast_to(values, np.shape(columns)).ravel()
    return csr_array((values, (np.ravel(rows), np.ravel(columns))), shape)


def angles(bend, walls, joint):
    """D, theta0 and K of hinges and then arms; ``joint`` (2 w,): number of the joint of an arm."""
    m, h, arms = len(walls.edges), len(bend.hinges), len(joint)
    both, arm = np.arange(h + arms), h + np.arange(arms)
    before = np.concatenate([bend.hinges, m + joint])
    after = np.concatenate([bend.hinges + 1, walls.arm_element])
    size = h + arms, m + joint.max() + 1
    turns = sparse(both, after, 1.0, size) - sparse(both, before, 1.0, size)
    rest = np.concatenate([bend.hinge_angle, np.arctan2(bend.arm_rest[:, 1], bend.arm_rest[:, 0])])
    own = np.concatenate([bend.hinge_stiffness, bend.arm_stiffness])
    other = arm.reshape(-1, 2)[:, ::-1]  # of the same wall
    coupled = sparse(arm, other, bend.coupling.repeat(2).reshape(-1, 2), (h + arms, h + arms))
    return turns, rest, diags_array(own) + coupled


class Rods:
    """What walls store, over the coordinates ``free`` (n,) that nothing holds, in an order that
    makes the Hessian a narrow band.
    """

    def __init__(self, scene):
        terms, walls, x = scene.terms, scene.terms.walls, scene.x_rest
        joints, joint = np.unique(walls.rotation, return_inverse=True)
        self.m, self.l0 = len(walls.edges), terms.stretch.l0
        self.axial = terms.law.modulus * terms.stretch.area / self.l0
        self.turns, self.rest, self.bending = angles(terms.bend, walls, joint)
        self.moments = (self.turns.T @ self.bending).tocsr()
        ends = np.concatenate([2 * walls.edges, 2 * walls.edges + 1, joints[:, None].repeat(2, 1)])
        signs = np.repeat([[-1.0, 1.0], [0.0, 1.0]], [2 * self.m, len(joints)], axis=0)
        one, two = self._pairs(len(joints))
        span = sparse(np.arange(len(ends)).repeat(2), ends, signs, (len(ends), x.size))
        linked = abs(span).T @ sparse(one, two, 1.0, (len(ends), len(ends))) @ abs(span)
        free = np.flatnonzero(scene.terms.layout.leader == np.arange(x.size))
        self.free = free[reverse_cuthill_mckee(linked[free][:, free].tocsr(), symmetric_mode=True)]
        self.span = span[:, self.free].tocsr()
        self.gather = self.span.T.tocsr()
        self.held = span @ x - self.span @ x[self.free]
        place = np.full(x.size, -1)
        place[self.free] = np.arange(self.free.size)
        self._assembly(place[ends[one]], place[ends[two]], signs[one], signs[two])

    def _pairs(self, joints):
        """Pairs of components of (e, phi) of which the Hessian has values, in their order."""
        m, size = self.m, 2 * self.m + joints
        angle = np.concatenate([np.arange(m), np.arange(m + joints)])
        of = sparse(angle, np.arange(size), 1.0, (m + joints, size))
        coupled = (of.T @ self.moments @ self.turns @ of).tocoo()
        self.coupling, self.coupled = coupled.data, np.stack(coupled.coords)
        x, y = np.arange(m), m + np.arange(m)
        return np.concatenate([self.coupled, [[*x, *x, *y, *y], [*x, *y, *x, *y]]], axis=1)

    def _assembly(self, i, j, sign, other):
        """Linear map from these values to the lower band, column by column.

        i, j, sign, other (values, 2): places and signs of what each moves.
        """
        value, i, j = np.arange(len(i))[:, None, None], i[:, :, None], j[:, None, :]
        sign = sign[:, :, None] * other[:, None, :]
        kept = (i >= j) & (j >= 0) & (sign != 0.0)
        i, j, value = (np.broadcast_to(a, kept.shape)[kept] for a in (i, j, value))
        self.width = 1 + (i - j).max()
        shape = self.free.size * self.width, len(kept)
        self.assemble = sparse(j * self.width + i - j, value, sign[kept], shape)

    def found(self, x):
        """All but the Hessian at ``x`` (n,)."""
        m, u = self.m, self.span @ x + self.held
        e, phi = u[: 2 * m].reshape(2, m), u[2 * m :]
        length = np.hypot(e[0], e[1])
        t = e / length
        q = np.stack([-t[1], t[0]]) / length
        theta = self.turns @ np.concatenate([np.arctan2(e[1], e[0]), phi]) - self.rest
        theta -= 2.0 * np.pi * np.round(theta / (2.0 * np.pi))
        longer, moment = length - self.l0, self.moments @ theta
        tension = self.axial * longer
        energy = 0.5 * (tension @ longer + theta @ (self.bending @ theta))
        slope = tension * t + moment[:m] * q
        g = self.gather @ np.concatenate([slope.ravel(), moment[m:]])
        return Found(energy, g, q, t, length, tension, moment)

    def band(self, found):
        """Lower band of the Hessian, (width, n)."""
        (tx, ty), (qx, qy) = found.t, found.q
        across, bent = found.tension * found.length, found.moment[: self.m] / found.length
        xx = self.axial * tx * tx + across * qx * qx - 2.0 * bent * tx * qx
        xy = self.axial * tx * ty + across * qx * qy - bent * (tx * qy + ty * qx)
        yy = self.axial * ty * ty + across * qy * qy - 2.0 * bent * ty * qy
        one, two = np.concatenate([qx, qy, np.ones(found.moment.size - self.m)])[self.coupled]
        values = self.assemble @ np.concatenate([self.coupling * one * two, xx, xy, xy, yy])
        return values.reshape(-1, self.width).T

    def towards(self, found, diagonal, g):
        """Newton's step, with more on the diagonal of the Hessian, which has to be positive."""
        band = self.band(found)
        band[0] += diagonal
        _, dx, failed = lapack.dpbsv(band, -g, lower=1, overwrite_ab=1)
        if failed:
            raise np.linalg.LinAlgError(f"pivot {failed} is not positive")
        return dx
