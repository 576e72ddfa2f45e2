"""Kernels repeated inside compiled code, where a march calls them: a call from Python costs more.

The one file of the bench that knows how the kernels of a step are called.
"""

from kernels.terms import bend, elements as chain, contact, damping as damp, fold, friction, inertia, stretch
from kernels.linear import block_ldlt as blocks, condense, system
from kernels.planar import potential as step  # fmt: skip
from kernels.compile.jit import jit_exact, jit_owning
from kernels.linear.analysis import RIGID
from kernels.arrays import copy

(
    NOTHING, EVALUATE, FACTOR, SOLVE, LIMIT, SHAPE, STRETCH, BEND, FOLD, INERTIA, DAMP, CONTACT,
    FRICTION, WALLS, BLOCKS, CONTACT_HESSIAN,
) = range(16)  # fmt: skip


@jit_exact
def _condense(terms, near, at):
    """Fill the rows of all walls and eliminate their inner unknowns."""
    solver, failed = near.system, 0
    for w in range(solver.kind.size):
        if solver.kind[w] == RIGID:
            continue
        span = slice(solver.row_start[w], solver.row_start[w + 1])
        rows, own = solver.rows[span], solver.own[span]
        first, last = terms.walls.start[w], terms.walls.start[w + 1]
        condense.fill(first, last, w, at.stiffness, rows, solver.outer)
        failed += condense.eliminate(
            rows, own, own, solver.outer, terms.layout.scale, blocks.ROUNDED
        )[0]
    return failed


@jit_exact
def repeat(which, count, x, dx, most, whole, at, ones):
    """Call one kernel ``count`` times at the state of ``at``, for a move ``dx`` of ``most`` m at
    most; ``ones``: values to factor.
    """
    terms, one, near = whole
    total, walls, matrix, b = 0.0, terms.walls, near.system.matrix, at.material
    for _ in range(count):
        if which == EVALUATE:
            total += step.evaluate(x, terms, one, near, at, False)
        elif which == FACTOR:
            total += step.factor(x, terms, one, near, at, False, False)[2]
        elif which == SOLVE:
            b[:] = 1.0
            system.solve(near.system, terms.layout, b)
        elif which == LIMIT:
            total += step.covers(near, x, terms, most)
            total += step.step_limit(x, dx, most, terms, near, at)
        elif which == SHAPE:
            total += chain.measure(x, walls, at.shape)
            total += bend.turns(x, walls, terms.bend, one.before.frame, at.shape)
            chain.clear(at.shape, at.stiffness)
            chain.gather(walls, at.shape, at.elastic)
        elif which == STRETCH:
            total += stretch.evaluate(terms.stretch, terms.law, at.shape, at.stiffness, False)
        elif which == BEND:
            total += bend.evaluate(walls, terms.bend, at.shape, at.stiffness, False)
        elif which == FOLD:
            total += fold.evaluate(x, terms.fold, at.elastic)[0]
        elif which == INERTIA:
            total += inertia.evaluate(x, one.x_pred, terms.mass, one.dt, at.elastic)
        elif which == DAMP:
            total += damp.evaluate(
                at.u, terms, one.before, one.dt, at.shape, at.stiffness, False, at.material
            )
        elif which == CONTACT:
            total += contact.evaluate(x, terms.contact, near.pairs, 0.0, at.elastic)
        elif which == CONTACT_HESSIAN:
            contact.hessian(x, terms.contact, near.pairs, matrix, False)
        elif which == FRICTION:
            step.rub(terms, one, at)
            total += at.sum[step.RUBBED]
        elif which == WALLS:
            total += _condense(terms, near, at)
        elif which == BLOCKS:
            copy(ones, matrix.values)
            total += blocks.factor(matrix, terms.layout.scale, False)[1]
    return total


@jit_owning
def search(count, x, terms, move):
    """List the pairs for moves up to ``move`` (m) ``count`` times."""
    found = 0
    for _ in range(count):
        found += step.list_near(x, terms, move)[0].node.size
    return found


@jit_owning
def analyse(count, x, terms, pairs):
    """Make the system of the matrix, with room for ``pairs``, ``count`` times."""
    made = 0
    for _ in range(count):
        made += step.make_system(x, terms, pairs, friction.none()).target.size
    return made
