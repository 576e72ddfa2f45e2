"""The arrays that the steps of a march share, made once."""

from typing import NamedTuple

import numpy as np

from kernels.terms import damping as damp, friction
from kernels.solve.residual import reduce
from kernels.terms.elements import Shape, Stiffness
from kernels.compile.jit import jit_owning
from kernels.solve.newton import Work
from kernels.planar.potential import At

PREDICTED, LAGGED, CHANGE, HEAVY = range(4)


class Room(NamedTuple):
    """before: `damp.Before`. at: `step.At`. work: `newton.Work`. grips: `friction.Grips`.

    way (4, n): predicted position; where friction was lagged; how far from there the step ended; 1
    for what moves by its mass or by that of what is tied to it, else 0.
    """

    before: object
    at: object
    work: object
    grips: object
    way: np.ndarray


@jit_owning
def _shape(terms):
    """Return room for the shape and the stiffness of all walls."""
    m, arms = terms.stretch.l0.size, terms.walls.rotation.size
    shape = Shape(
        np.zeros((2, m)), np.zeros(m), np.zeros(m), np.zeros(arms), np.zeros((2, m)), np.zeros(arms)
    )
    twist = np.zeros(arms // 2)
    return shape, Stiffness(np.zeros((3, m)), np.zeros((4, m)), np.zeros((3, arms)), twist)


@jit_owning
def make_room(terms, near):
    """Return the arrays of all steps."""
    n = terms.mass.size
    shape, stiffness = _shape(terms)
    frame = np.full((terms.walls.rotation.size, 3), np.inf)  # none yet
    before = damp.Before(np.zeros(n), np.zeros(n), frame, shape, stiffness)
    shape, stiffness = _shape(terms)
    five = np.zeros((5, n))
    stored, total, least = np.zeros(3), np.zeros(2), np.zeros(2)
    at = At(five[0], five[1], five[2], five[3], five[4], stored, total, least, shape, stiffness)
    more = np.zeros((5, n))
    work = Work(more[0], more[1], more[2], more[3], more[4], np.full(1, np.inf))
    grips = friction.room(near.pairs, terms.contact, terms.friction)
    way, layout = np.zeros((4, n)), terms.layout
    reduce(terms.mass, layout, work.residual)
    for i in range(n):
        leader = layout.leader[i]
        if leader >= 0 and leader != layout.driven and work.residual[leader] > 0.0:
            way[HEAVY, i] = 1.0
    return Room(before, at, work, grips, way)
