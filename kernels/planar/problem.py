"""The lattice of walls in the plane: the data of a scene, and the problem that is made of it.

Coordinates are x and y of every node, the rotations of joints, and the surfaces of the platens.
"""

from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit_exact, jit_owning
from kernels.planar import constraints, factoring, lagging, potential, reach, rows, steps
from kernels.planar.reach import Near
from kernels.solve import history
from kernels.solve.problem import Coordinates
from kernels.terms.damping import Before
from kernels.terms.elements import Shape, Stiffness


class Room(NamedTuple):
    """Arrays that are made once. before: what damping measures from. shape, stiffness: of the walls
    at the last `evaluate`; least (1,): shortest element and narrowest opening there, see `LEAST`.
    committed (p, k): what the material remembers (`law.Memory`): elements, then hinges, then arms.
    """

    before: Before
    shape: Shape
    stiffness: Stiffness
    least: np.ndarray
    committed: np.ndarray


class Planar(NamedTuple):
    """The problem. scene: `PlanarScene`. near: pairs that may touch, the matrix, friction."""

    scene: object
    near: Near
    room: Room

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

    travel = reach.travel
    step_limit = reach.step_limit
    covers = reach.covers

    lags = lagging.lags
    lag = lagging.lag
    exchange = lagging.exchange
    follow = lagging.follow
    forget = lagging.forget

    project = steps.project
    covers_projection = reach.covers_projection
    write = rows.write


@jit_owning
def _measured(scene):
    """Return room for the shape and the stiffness of all walls."""
    m, arms = scene.stretch.l0.size, scene.walls.rotation.size
    shape = Shape(
        np.zeros((2, m)), np.zeros(m), np.zeros(m), np.zeros(arms), np.zeros((2, m)), np.zeros(arms)
    )
    twist = np.zeros(arms // 2)
    return shape, Stiffness(np.zeros((3, m)), np.zeros((4, m)), np.zeros((3, arms)), twist)


@jit_owning
def make_room(scene, memory):
    """Return the arrays of all steps. memory: `history.State.memory`."""
    frame = np.full((scene.walls.rotation.size, 3), np.inf)  # none yet
    shape, stiffness = _measured(scene)
    before = Before(frame, shape, stiffness)
    shape, stiffness = _measured(scene)
    return Room(before, shape, stiffness, np.zeros(1, potential.LEAST), memory)


@jit_exact
def assemble(scene, near, room):
    """Return the problem."""
    return Planar(scene, near, room)


def _numbers(law):
    """Return how many numbers a law keeps at a point. As plain Python: no kernel is compiled or
    loaded for it.
    """
    verb = type(law).remembers
    return getattr(verb, "__wrapped__", verb)(law)


def at_rest(scene, x):
    """Return the `history.State` of a lattice that begins at ``x`` (n,), with a virgin material.

    Elements, hinges and arms have a row of memory each, as long as that of the law that keeps most.
    """
    numbers = max(_numbers(scene.law), _numbers(scene.bend.section))
    points = scene.stretch.l0.size + scene.bend.hinges.size + scene.walls.rotation.size
    memory = (points, numbers) if numbers > 0 else (0, 0)
    return history.at_rest(x, potential.STORED, memory)


class PlanarScene(NamedTuple):
    """One scene: the data of every term. A term that the scene lacks has empty arrays."""

    coordinates: Coordinates
    law: object
    walls: object
    stretch: object
    bend: object
    fold: object
    spring: object
    contact: object
    friction: object
    damp: object
    layout: object
    project: object

    find_near = reach.find_near
    renew_near = reach.renew_near
    make_room = make_room
    assemble = assemble
