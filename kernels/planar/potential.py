"""The potential of one step of a lattice: the sum of all terms, with its gradient.

    E(x) = |x - x~|_M^2 / (2 h^2) + E_s + E_b + E_f + E_c - f . u + D(u) + D_f(u),   u = x - y

in J. |v|_M^2 = sum m v^2. E_s includes the springs, and its W the barrier of short elements
(`laws.elastic`). u / h is the velocity at the end of the step (`solve.integrators`). In a static
step y = x0, and inertia and damping vanish. A term that is absent from a scene has empty arrays.
The Hessian is in `factoring`.
"""

import numpy as np

from kernels.arrays import add, copy, zero_rows
from kernels.compile.jit import jit_exact
from kernels.planar.neighbour_lists import drift
from kernels.shared import lagging, moves
from kernels.shared.rows import BEND, CONTACT, STRETCH
from kernels.terms import bend, contact, damping, elements, fold, inertia, loads, spring, stretch

LEAST = np.dtype(
    (
        np.record,  # fields are attributes in plain Python too
        [
            ("length", np.float64),  # shortest element, m
            ("opening", np.float64),  # smallest opening between two elements at a node, rad
        ],
    )
)


@jit_exact
def evaluate(problem, x, step, evaluation):
    """Return E in J; fill ``evaluation`` and the Hessian of the walls."""
    scene, neighbours, coordinates = problem.scene, problem.neighbours, problem.scene.coordinates
    moves.begin(x, step.y, evaluation)
    store_walls(problem, x, evaluation)
    evaluation.stored[CONTACT] = contact.evaluate(
        x,
        scene.contact,
        neighbours.pairs,
        drift(problem, x),
        neighbours.touching,
        evaluation.elastic,
    )
    total = evaluation.stored[STRETCH] + evaluation.stored[BEND] + evaluation.stored[CONTACT]
    copy(evaluation.elastic, evaluation.g)
    total += loads.evaluate(evaluation.u, coordinates.load, step.factor, evaluation.g)
    if step.dynamic:
        total += inertia.evaluate(x, step.x_pred, coordinates.mass, step.h, evaluation.g)
        total += _damping(problem, step, evaluation)
    total += lagging.friction(problem, step, evaluation)
    return moves.end(evaluation, total)


@jit_exact
def store(problem, x, step, evaluation):
    """Fill the stored energies of the walls at ``x``; add their gradient to ``evaluation.elastic``.

    The duration is zero: the step is accepted, and its time has passed. Scenes with a projection
    have no E_c.
    """
    recall(problem, 0.0)
    store_walls(problem, x, evaluation)


@jit_exact
def recall(problem, duration):
    """Prepare the laws for a step of ``duration`` in s; return their `Memory`."""
    scene, memory = problem.scene, problem.buffers.memory
    if scene.law.state_size() > 0:
        scene.law.set_pace(duration, memory.pace)
        stretch.begin(scene.stretch, scene.law, memory)
        bend.begin(scene.bend, memory)
    return memory


@jit_exact
def store_walls(problem, x, evaluation):
    """Fill stored energies, shape and stiffness of the walls and the `LEAST` measures; add the
    gradient to ``evaluation.elastic``.
    """
    scene, buffers = problem.scene, problem.buffers
    shape, stiffness, resultants = buffers.shape, buffers.stiffness, buffers.resultants
    memory, least = buffers.memory, buffers.least[0]
    least.length = elements.measure(x, scene.walls, buffers.before.frame, shape)
    evaluation.stored[STRETCH] = stretch.evaluate(
        scene.stretch, scene.law, memory, shape, resultants, False
    )
    evaluation.stored[BEND] = bend.evaluate(
        scene.bend, scene.stretch, memory, shape, resultants, False
    )
    elements.clear(shape, stiffness)
    elements.add(resultants, scene.stretch.geometric, False, shape, stiffness)
    elements.gather(scene.walls, shape, evaluation.elastic)
    evaluation.stored[STRETCH] += spring.evaluate(x, scene.spring, evaluation.elastic)
    folding, least.opening = fold.evaluate(x, scene.fold, evaluation.elastic)
    evaluation.stored[BEND] += folding


@jit_exact
def _damping(problem, step, evaluation):
    """Return D in J; fill ``evaluation.material`` and add it to the gradient."""
    buffers = problem.buffers
    zero_rows(buffers.shape.slope)
    total = damping.evaluate(
        evaluation.u, problem.scene, buffers.before, step.h,
        buffers.shape, buffers.resultants, buffers.stiffness, evaluation.material,
    )  # fmt: skip
    add(evaluation.material, evaluation.g)
    return total
