"""Stored energy of walls, written a second time: numpy over all elements and pairs, from the
formulas.

It shares with the kernels the data of a scene, and no code.
"""

from typing import NamedTuple

import numpy as np
from scipy.interpolate import PPoly
from scipy.spatial import cKDTree

FOLD, GUARD = np.radians(20.0), -0.7
CRUSHED, TOUCHING = 0.3, 2.0 * np.sqrt(0.15)  # of sections
TANGENT = 1  # measure of bending


class Stored(NamedTuple):
    """Energies (3,) of stretching, bending and contact in J; gradient (n,); largest force in it."""

    energy: np.ndarray
    gradient: np.ndarray
    scale: float


def stored(x, terms):
    """Stored energy of the walls of a scene at ``x`` (n,)."""
    g, edges, stretch = np.zeros_like(x), terms.walls.edges, terms.stretch
    vector = np.diff(x[: 2 * terms.layout.n_nodes].reshape(-1, 2)[edges], axis=1)[:, 0]
    length, turn = np.hypot(*vector.T), _turns(x, vector, terms.walls)
    same, mixed = stretch.arc
    strain = length / stretch.l0 - 1.0 + same * np.sum(turn**2, axis=0) + mixed * turn[0] * turn[1]
    density, stress = _guarded(terms.law.relaxing.elastic.curve, strain)
    volume = stretch.area * stretch.l0
    stretching = np.sum(volume * density)
    bending, moments, by_strain = _bending(turn, strain, terms.bend)
    by_strain += volume * stress
    tension = by_strain / stretch.l0
    moments += by_strain * (2.0 * same * turn + mixed * turn[::-1])
    np.add.at(g, terms.walls.dofs[:, [2, 5]].T, -moments)
    along, across = vector / length[:, None], moments.sum(axis=0) / length
    force = tension[:, None] * along + across[:, None] * np.column_stack(
        [-along[:, 1], along[:, 0]]
    )
    np.add.at(g, _coordinates(edges[:, 1]), force)
    np.add.at(g, _coordinates(edges[:, 0]), -force)
    bending += _folding(x, terms.fold, g)
    elastic = np.abs(force).max()
    stretching += _springs(x, terms.spring, g)
    touching, push = _walls(x, terms.contact, g)
    touching += _platens(x, terms.contact, g)
    return Stored(np.array([stretching, bending, touching]), g, max(elastic, push))


def barrier(s):
    """Value and slope of -(s - 1)^2 ln s below 1."""
    s = np.asarray(s, float)
    inside = np.where(s < 1.0, s, 1.0)
    log, r = np.log(inside), inside - 1.0
    return -r * r * log, -r * (2.0 * log + r / inside)


def _coordinates(nodes):
    return 2 * nodes[:, None] + np.arange(2)


def _wrapped(angle):
    return np.pi - np.mod(np.pi - angle, 2.0 * np.pi)


def _curve(law, strain):
    """Energy density and stress of the measured curve, continued by its last tangents."""
    stress = PPoly(law.coefficients[:, ::-1].T, law.knots)
    density, tangent = stress.antiderivative(), stress.derivative()
    inside = np.clip(strain, law.knots[0], law.knots[-1])
    before = np.nextafter(inside, -np.inf)  # at the last knot, of the last piece
    beyond, slope = strain - inside, tangent(np.where(strain > inside, before, inside))
    energy = density(inside) - density(0.0) + beyond * (stress(inside) + 0.5 * beyond * slope)
    return energy, stress(inside) + beyond * slope


def _guarded(law, strain):
    energy, stress = _curve(law, strain)
    width = 1.0 + GUARD
    value, slope = barrier((1.0 + strain) / width)
    return energy + law.modulus * width**2 * value, stress + law.modulus * width * slope


def _curvature(bend, turn):
    if bend.measure == TANGENT:
        t = np.tan(turn / bend.side)
        return bend.side * t, 1.0 + t**2
    return turn, np.ones_like(turn)


def _fibre(m, q):
    """Stretch q^(1/m) of fibres and its slope, a parabola where they are crushed."""
    inside = np.maximum(q, CRUSHED**m)
    a, beyond = inside ** (1.0 / m), q - inside
    slope = a / (m * inside)
    second = (1.0 / m - 1.0) * slope / inside
    return a + beyond * slope + 0.5 * beyond**2 * second, slope + beyond * second


def _through_sections(turn, strain, bend):
    """Energy (m,) of bent sections, its derivatives in the turns (2, m) and in the strain (m,)."""
    law, stretched = bend.section, 1.0 + strain
    m, (across, along) = law.m, bend.spread
    rows = np.array([[along - across, along + across], [-along - across, across - along]])
    theta = np.einsum("pik,ik->pk", rows, turn)
    curve = law.curve.relaxing.elastic.curve
    middle, stress = _curve(curve, strain)
    energy, by_strain = -law.middle * middle, -law.middle * stress
    by_theta = np.zeros_like(theta)
    for p in range(2):
        q, c = theta[p] ** 2, law.bound
        beyond = np.maximum(np.abs(theta[p]) - TOUCHING, 0.0)
        energy += law.stop * beyond**3 / (3.0 * TOUCHING) - law.radial * q**2 / (1.0 + c * q)
        by_theta[p] += law.stop * np.sign(theta[p]) * beyond**2 / TOUCHING
        by_theta[p] -= law.radial * theta[p] * q * (4.0 + 2.0 * c * q) / (1.0 + c * q) ** 2
        for out, weight in zip(law.place, law.weight, strict=True):
            bent, slope = _fibre(m, stretched**m + m * out * theta[p])
            value, pulled = _curve(curve, bent - 1.0)
            energy += weight * value
            by_strain += weight * pulled * slope * m * stretched ** (m - 1.0)
            by_theta[p] += weight * out * m * pulled * slope
    sheared = bend.shear * turn.sum(axis=0)
    moments = bend.volume * np.einsum("pik,pk->ik", rows, by_theta) + sheared
    energy = bend.volume * energy + 0.5 * sheared * turn.sum(axis=0)
    return energy, moments, bend.volume * by_strain


def _turns(x, vector, walls):
    """Turns of both ends of every element, (2, m); their mean is at most half round."""
    rotation = walls.dofs[:, [2, 5]].T
    bearing, rest = np.arctan2(*vector.T[::-1]), np.arctan2(*walls.rest.T[::-1])
    mean = x[rotation].mean(axis=0)
    return _wrapped(bearing - rest - mean) - (x[rotation] - mean)


def _bending(turn, strain, bend):
    """Energy, the moments of both ends of every element (2, m), derivatives in its strain (m,)."""
    kappa, slope = _curvature(bend, turn)
    k11, k12, k22 = bend.stiffness
    moments = np.stack([k11 * kappa[0] + k12 * kappa[1], k12 * kappa[0] + k22 * kappa[1]])
    energy, moments = 0.5 * np.sum(moments * kappa, axis=0), moments * slope
    by_strain = np.zeros_like(strain)
    if bend.volume.size:
        through = bend.volume > 0.0
        for linear, found in zip(
            (energy, moments, by_strain), _through_sections(turn, strain, bend), strict=True
        ):
            linear[..., through] = found[..., through]
    return np.sum(energy), moments, by_strain


def _folding(x, fold, g):
    """Energy of the openings between neighbouring elements of nodes."""
    if len(fold.limit) == 0:
        return 0.0
    one, middle, two = x[: 2 * (len(x) // 2)].reshape(-1, 2)[fold.nodes].swapaxes(0, 1)
    u, v = one - middle, two - middle
    opened = np.mod(np.arctan2(v[:, 1], v[:, 0]) - np.arctan2(u[:, 1], u[:, 0]), 2.0 * np.pi)
    value, slope = barrier(opened / fold.limit)
    for arm, node, sign in ((u, 0, -1.0), (v, 2, 1.0)):
        turned = np.column_stack([-arm[:, 1], arm[:, 0]]) / np.sum(arm**2, axis=1)[:, None]
        force = (sign * fold.stiffness / fold.limit * slope)[:, None] * turned
        np.add.at(g, _coordinates(fold.nodes[:, node]), force)
        np.add.at(g, _coordinates(fold.nodes[:, 1]), -force)
    return np.sum(fold.stiffness * value)


def _springs(x, spring, g):
    """Energy of springs between two nodes."""
    if len(spring.l0) == 0:
        return 0.0
    points = x[: 2 * (len(x) // 2)].reshape(-1, 2)
    apart = points[spring.nodes[:, 1]] - points[spring.nodes[:, 0]]
    d = np.hypot(*apart.T)
    force = (spring.stiffness * (1.0 - spring.l0 / d))[:, None] * apart
    np.add.at(g, _coordinates(spring.nodes[:, 1]), force)
    np.add.at(g, _coordinates(spring.nodes[:, 0]), -force)
    return 0.5 * np.sum(spring.stiffness * (d - spring.l0) ** 2)


def _walls(x, contact, g):
    """Energy of walls that touch, and the largest force of a pair."""
    if len(contact.edges) == 0:
        return 0.0, 0.0
    points = x[: 2 * len(contact.tributary)].reshape(-1, 2)
    node, edge = _near(points, contact)
    weight, start, off = _weighed(node, edge, contact)
    a, b = contact.edges[edge].T
    p, along = points[node], points[b] - points[a]
    share = np.clip(np.sum((p - points[a]) * along, axis=1) / np.sum(along**2, axis=1), 0.0, 1.0)
    to_line = p - points[a] - share[:, None] * along
    total, most = _push(
        g, to_line, weight, start, contact, [(node, 1.0), (a, share - 1.0), (b, -share)]
    )
    for end, v in enumerate((a, b)):
        force = _push(
            g, p - points[v], -weight * off[:, end], start, contact, [(node, 1.0), (v, -1.0)]
        )
        total, most = total + force[0], max(most, force[1])
    return total, most


def _push(g, gap, weight, start, contact, shares):
    """Energy of barriers on the lengths of ``gap`` (n, 2); nodes get their ``shares`` of it."""
    d = np.hypot(*gap.T)
    value, slope = barrier(d / start)
    force = (0.5 * weight * contact.stiffness * slope / d)[:, None] * gap
    for node, share in shares:
        np.add.at(g, _coordinates(node), np.reshape(share, (-1, 1)) * force)
    total = np.sum(0.5 * weight * contact.stiffness * start * value)
    return total, np.abs(force).max(initial=0.0)


def _near(points, contact):
    """Nodes and segments that share no node and are closer than any distance of contact."""
    ends = points[contact.edges]
    radius = contact.reach + 0.5 * np.hypot(*np.diff(ends, axis=1)[:, 0].T)
    found = cKDTree(points).query_ball_point(ends.mean(axis=1), radius)
    edge = np.repeat(np.arange(len(found)), [len(nodes) for nodes in found])
    node = np.concatenate([np.array(nodes, int) for nodes in found])
    apart = np.all(contact.edges[edge] != node[:, None], axis=1)
    return node[apart], edge[apart]


def _weighed(node, edge, contact):
    """Contact length, distance where contact starts, and which ends are counted elsewhere."""
    weight, off = contact.tributary[node].copy(), contact.subtract[edge].copy()
    start = 0.5 * (contact.node_thickness[node] + contact.edge_thickness[edge])
    m = len(contact.edges)
    owner = np.repeat(np.arange(m), np.diff(contact.special_start))
    special = {key: k for k, key in enumerate((contact.special_node * m + owner).tolist())}
    at = np.array([special.get(key, -1) for key in (node * m + edge).tolist()], int)
    own = at >= 0
    counts = contact.special_weight[at[own]] > 0.0  # others are only kept from crossing
    weight[own] = np.where(counts, contact.special_weight[at[own]], weight[own])
    start[own] = contact.special_distance[at[own]]
    off[own] = np.where(counts[:, None], contact.special_subtract[at[own]], 0.0)
    acts = (weight > 0.0) & (start > 0.0)
    weight, start = np.where(acts, weight, 0.0), np.where(acts, start, 1.0)
    return weight, start, off


def _platens(x, contact, g):
    """Energy of nodes that touch a platen."""
    nodes, total = contact.platen_nodes, 0.0
    start, y = 0.5 * contact.node_thickness[nodes], x[2 * nodes + 1]
    for platen, side in ((contact.low, 1.0), (contact.high, -1.0)):
        value, slope = barrier(side * (y - x[platen]) / start)
        force = side * contact.tributary[nodes] * contact.stiffness * slope
        np.add.at(g, 2 * nodes + 1, force)
        g[platen] -= force.sum()
        total += np.sum(contact.tributary[nodes] * contact.stiffness * start * value)
    return total
