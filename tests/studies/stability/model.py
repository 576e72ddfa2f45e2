"""What walls store, written a second time: numpy over all elements and pairs, from the formulas.

It shares with the kernels the data of a scene, and no code.
"""

from typing import NamedTuple

import numpy as np
from scipy.interpolate import PPoly
from scipy.spatial import cKDTree

FOLD, GUARD = np.radians(20.0), -0.7
TANGENT = 1  # measure of bending


class Stored(NamedTuple):
    """Energies (3,) of stretching, bending and contact in J; gradient (n,); largest force in it."""

    energy: np.ndarray
    gradient: np.ndarray
    scale: float


def stored(x, terms, x0):
    """What the walls of a scene store at ``x`` (n,) in a step from ``x0``, see `_bending`."""
    g, edges = np.zeros_like(x), terms.walls.edges
    vector = np.diff(x[: 2 * terms.layout.n_nodes].reshape(-1, 2)[edges], axis=1)[:, 0]
    length = np.hypot(*vector.T)
    strain = length / terms.stretch.l0 - 1.0
    density, stress = _guarded(terms.law, strain)
    tension = terms.stretch.area * stress
    stretching = np.sum(terms.stretch.area * terms.stretch.l0 * density)
    bearing = np.arctan2(vector[:, 1], vector[:, 0])
    bending, moment = _bending(x, x0, bearing, terms, g)
    along, across = vector / length[:, None], moment / length
    force = tension[:, None] * along + across[:, None] * np.column_stack(
        [-along[:, 1], along[:, 0]]
    )
    np.add.at(g, _coordinates(edges[:, 1]), force)
    np.add.at(g, _coordinates(edges[:, 0]), -force)
    bending += _folding(x, terms.fold, g)
    elastic = np.abs(force).max()
    stretching += _springs(x, terms.spring, g)
    touching, push = _walls(x, terms.contact, g)
    touching += _plates(x, terms.contact, g)
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


def _response(section, surface, kappa):
    """Energy and moment over the stiffness; linear where no strain of the surface is given."""
    if len(surface) == 0:
        return 0.5 * kappa**2, kappa
    energy, moment = _curve(section, np.abs(surface * kappa))
    return energy / surface**2, np.sign(kappa) * moment / surface


def _curvature(measure, turn):
    if measure == TANGENT:
        return 2.0 * np.tan(0.5 * turn), 1.0 + np.tan(0.5 * turn) ** 2
    return turn, np.ones_like(turn)


def _bending(x, x0, bearing, terms, g):
    """Energy, and the moment on the bearing of every element; rotations get theirs in ``g``.

    An arm turns less than half round from where its joint held it when the step began.
    """
    bend, moment, before = terms.bend, np.zeros_like(bearing), terms.bend.hinges
    angle = _wrapped(bearing[before + 1] - bearing[before])
    kappa, slope = _curvature(bend.measure, angle - bend.hinge_angle)
    value, response = _response(bend.section, bend.hinge_surface, kappa)
    opened, rest = np.pi - np.abs(angle), np.pi - np.sign(angle) * bend.hinge_angle
    limit, fold = np.minimum(FOLD, 0.5 * rest), bend.hinge_stiffness * (0.5 * rest) ** 2
    folded, closing = barrier(opened / limit)
    turning = bend.hinge_stiffness * response * slope - np.sign(angle) * fold / limit * closing
    np.add.at(moment, before + 1, turning)
    np.add.at(moment, before, -turning)
    total = np.sum(bend.hinge_stiffness * value + fold * folded)

    element, rotation = terms.walls.arm_element, terms.walls.rotation
    rest = np.arctan2(*bend.arm_rest.T[::-1])
    turn = _wrapped(bearing[element] - rest - x0[rotation]) - (x[rotation] - x0[rotation])
    kappa, slope = _curvature(bend.measure, turn)
    value, response = _response(bend.section, bend.arm_surface, kappa)
    coupled, other = np.repeat(bend.coupling, 2), kappa.reshape(-1, 2)[:, ::-1].ravel()
    turning = (bend.arm_stiffness * response + coupled * other) * slope
    np.add.at(moment, element, turning)
    np.add.at(g, rotation, -turning)
    return total + np.sum(bend.arm_stiffness * value + 0.5 * coupled * kappa * other), moment


def _folding(x, fold, g):
    """Energy of the openings between neighbouring arms of joints."""
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
    weight[own] = contact.special_weight[at[own]]
    start[own] = contact.special_distance[at[own]]
    off[own] = contact.special_subtract[at[own]]
    acts = weight > 0.0
    weight, start = np.where(acts, weight, 0.0), np.where(acts, start, 1.0)
    return weight, start, off


def _plates(x, contact, g):
    """Energy of nodes that touch a platen."""
    nodes, total = contact.plate_nodes, 0.0
    start, y = 0.5 * contact.node_thickness[nodes], x[2 * nodes + 1]
    for plate, side in ((contact.low, 1.0), (contact.high, -1.0)):
        value, slope = barrier(side * (y - x[plate]) / start)
        force = side * contact.tributary[nodes] * contact.stiffness * slope
        np.add.at(g, 2 * nodes + 1, force)
        g[plate] -= force.sum()
        total += np.sum(contact.tributary[nodes] * contact.stiffness * start * value)
    return total
