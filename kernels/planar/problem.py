"""The lattice of walls in the plane: data of a scene, and the problem assembled from it.

Coordinates are x and y of every node, the rotations of the nodes, and the surfaces of the platens.
"""

from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit_exact, jit_owning
from kernels.laws.law import Law, Memory, in_python
from kernels.linear.condensed.analysis import Layout
from kernels.planar import base_pressure, constraints, factoring, neighbour_lists, potential, steps
from kernels.planar.neighbour_lists import Neighbours
from kernels.planar.position_based import Projection
from kernels.shared import lagging, moves, rows
from kernels.solve import history
from kernels.solve.problem import Coordinates
from kernels.terms.bend import Bend
from kernels.terms.contact import Contact
from kernels.terms.damping import Before, Damp
from kernels.terms.elements import Resultants, Shape, Stiffness, Walls
from kernels.terms.fold import Fold
from kernels.terms.friction import Friction
from kernels.terms.spring import Spring
from kernels.terms.stretch import Stretch


class Buffers(NamedTuple):
    """Arrays that are allocated once per march.

    before: data of the start of the step for damping. shape, resultants, stiffness: of the walls at
    the last `evaluate`; least (1,): smallest measures there, see `potential.LEAST`. memory: memory
    of the laws; its material points are the elements, then the points of bending.
    """

    before: Before
    shape: Shape
    resultants: Resultants
    stiffness: Stiffness
    least: np.ndarray
    memory: Memory


class Planar(NamedTuple):
    """The problem. neighbours: pair lists, matrix and lagged friction."""

    scene: "PlanarScene"
    neighbours: Neighbours
    buffers: Buffers

    begin = steps.begin
    evaluate = potential.evaluate
    store = potential.store
    commit = steps.commit
    roll_back = steps.roll_back

    factor = factoring.factor
    solve = factoring.solve
    descend = factoring.descend
    unstable = factoring.unstable
    stiffest = factoring.stiffest

    reduce = constraints.reduce
    lead = constraints.lead
    pull = constraints.pull
    tie = constraints.tie

    travel = moves.travel
    step_limit = neighbour_lists.step_limit
    covers = moves.covers
    longest = neighbour_lists.longest
    drift = neighbour_lists.drift
    least_gap = neighbour_lists.least_gap

    lag = lagging.lag
    exchange = lagging.exchange
    follow = lagging.follow
    forget = lagging.forget

    project = steps.project
    covers_projection = neighbour_lists.covers_projection
    write = base_pressure.write
    write_share = rows.write_share


@jit_owning
def _zero_shape(m):
    """Return zero `Shape` and `Stiffness` of ``m`` elements."""
    shape = Shape(np.zeros((2, m)), np.zeros(m), np.zeros((2, m)), np.zeros((4, m)))
    return shape, Stiffness(np.zeros((3, m)), np.zeros((4, m)), np.zeros((3, m)))


@jit_owning
def make_buffers(scene, committed):
    """Return the `Buffers`. committed: `solve.history.State.memory`."""
    m = scene.stretch.l0.size
    shape, stiffness = _zero_shape(m)
    frame = np.full((m, 3), np.inf)  # far off: the first step renews it
    before = Before(frame, shape, np.zeros(m), stiffness)
    shape, stiffness = _zero_shape(m)
    resultants = Resultants(np.zeros((3, m)), np.zeros((6, m)))
    least = np.zeros(1, potential.LEAST)
    memory = Memory(committed, np.zeros((committed.shape[0], 2)), scene.law.make_pace())
    return Buffers(before, shape, resultants, stiffness, least, memory)


@jit_exact
def assemble(scene, neighbours, buffers):
    """Return the problem."""
    return Planar(scene, neighbours, buffers)


def at_rest(scene, x):
    """Return the `history.State` of a lattice at rest at ``x`` (n,), with a virgin material.

    Every material point has a row of memory.
    """
    numbers, elements = in_python(scene.law, "state_size"), scene.stretch.l0.size
    points = elements * (2 + in_python(scene.bend.section, "points"))
    memory = (points, numbers) if numbers > 0 else (0, 0)
    return history.at_rest(x, rows.STORED, memory)


class PlanarScene(NamedTuple):
    """One scene: the data of every term. A term that is absent has empty arrays."""

    coordinates: Coordinates
    law: Law
    walls: Walls
    stretch: Stretch
    bend: Bend
    fold: Fold
    spring: Spring
    contact: Contact
    friction: Friction
    damp: Damp
    layout: Layout
    project: Projection

    find_neighbours = neighbour_lists.find_neighbours
    renew_neighbours = neighbour_lists.renew_neighbours
    make_buffers = make_buffers
    assemble = assemble
