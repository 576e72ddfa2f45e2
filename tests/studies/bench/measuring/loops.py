"""Kernels repeated inside compiled code, where a march calls them: a call from Python costs more.

The one file of the bench that knows how the kernels of a step are called.
"""

from kernels.arrays import copy
from kernels.compile.jit import jit_exact, jit_owning
from kernels.linear.condensed import block_ldlt, system
from kernels.linear.pivots import ROUNDED
from kernels.planar import reach
from kernels.terms import (  # fmt: skip
    bend,
    contact,
    damping,
    elements,
    fold,
    friction,
    inertia,
    stretch,
)

(
    NOTHING, EVALUATE, FACTOR, SOLVE, LIMIT, SHAPE, STRETCH, BEND, FOLD, INERTIA, DAMP, CONTACT,
    FRICTION, WALLS, BLOCKS, CONTACT_HESSIAN,
) = range(16)  # fmt: skip


@jit_exact
def repeat(which, count, x, dx, most, problem, step, found, ones):
    """Call one kernel ``count`` times at the state of ``found``, for a move ``dx`` of ``most`` m at
    most; ``ones``: values to factor.
    """
    terms, neighbours, buffers = problem.scene, problem.neighbours, problem.buffers
    shape, stiffness, before = buffers.shape, buffers.stiffness, buffers.before
    resultants = buffers.resultants
    memory = buffers.memory
    total, walls, matrix, b = 0.0, terms.walls, neighbours.system.matrix, found.material
    for _ in range(count):
        if which == EVALUATE:
            total += problem.evaluate(x, step, found, False)
        elif which == FACTOR:
            total += problem.factor(x, step, found, False, False)[1]
        elif which == SOLVE:
            b[:] = 1.0
            problem.solve(b)
        elif which == LIMIT:
            total += problem.covers(x, most)
            total += problem.step_limit(x, dx, most)
        elif which == SHAPE:
            total += elements.measure(x, walls, before.frame, shape)
            elements.clear(shape, stiffness)
            elements.add(resultants, True, False, shape, stiffness)
            elements.gather(walls, shape, found.elastic)
        elif which == STRETCH:
            total += stretch.evaluate(terms.stretch, terms.law, memory, shape, resultants, False)
        elif which == BEND:
            total += bend.evaluate(terms.bend, terms.stretch, memory, shape, resultants, False)
        elif which == FOLD:
            total += fold.evaluate(x, terms.fold, found.elastic)[0]
        elif which == INERTIA:
            total += inertia.evaluate(x, step.x_pred, terms.coordinates.mass, step.h, found.elastic)
        elif which == DAMP:
            total += damping.evaluate(
                found.u, terms, before, step.h, shape, resultants, stiffness, False, found.material
            )
        elif which == CONTACT:
            total += contact.evaluate(
                x, terms.contact, neighbours.pairs, 0.0, neighbours.touching, found.elastic
            )
        elif which == CONTACT_HESSIAN:
            contact.hessian(x, terms.contact, neighbours.pairs, neighbours.touching, matrix, False)
        elif which == FRICTION:
            problem.exchange(step, found)
            total += found.sums[0].friction
        elif which == WALLS:
            total += system.add_walls(neighbours.system, terms.layout, stiffness, ROUNDED)[2]
        elif which == BLOCKS:
            copy(ones, matrix.values)
            total += block_ldlt.factor(matrix, terms.layout.scale, ROUNDED)[1]
    return total


@jit_owning
def search(count, x, terms, move):
    """List the pairs for moves up to ``move`` (m) ``count`` times."""
    found = 0
    for _ in range(count):
        found += reach.list_neighbours(terms, x, move)[0].node.size
    return found


@jit_owning
def analyse(count, x, terms, pairs):
    """Make the system of the matrix, with room for ``pairs``, ``count`` times."""
    made = 0
    for _ in range(count):
        made += reach.make_system(terms, x, pairs, friction.none()).scattered.target.size
    return made
