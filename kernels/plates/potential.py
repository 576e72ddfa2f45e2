"""The potential of one step of a lattice of plates: the sum of all terms, with its gradient.

    E(x) = |x - x~|_M^2 / (2 h^2) + E_s + E_b + E_c - f . u + D_f(u),   u = x - y

in J. E_s: strain of the mid-surfaces; E_b: bending, transverse shear and folds; if the material
relaxes, both are its potentials of the step. E_c: contact, also of images. u / h is the velocity at
the end of the step (`solve.integrators`). In a static step y = x0, and inertia vanishes. The
Hessian is in `factoring`.
"""

from kernels.arrays import copy, zero
from kernels.compile.jit import jit_exact
from kernels.plates.contacts import contact, mirror
from kernels.plates.element import shell
from kernels.plates.neighbour_lists import drift
from kernels.shared import lagging, moves
from kernels.shared.rows import BEND, CONTACT, STRETCH
from kernels.terms import inertia, loads


@jit_exact
def evaluate(problem, x, step, evaluation):
    """Return E in J; fill ``evaluation``."""
    coordinates = problem.scene.coordinates
    moves.begin(x, step.y, evaluation)
    _store(problem, x, evaluation)
    total = evaluation.stored[STRETCH] + evaluation.stored[BEND] + evaluation.stored[CONTACT]
    copy(evaluation.elastic, evaluation.g)
    total += loads.evaluate(evaluation.u, coordinates.load, step.factor, evaluation.g)
    if step.dynamic:
        total += inertia.evaluate(x, step.x_pred, coordinates.mass, step.h, evaluation.g)
    total += lagging.friction(problem, step, evaluation)
    return moves.end(evaluation, total)


@jit_exact
def store(problem, x, step, evaluation):
    """Fill the stored energies at ``x``; add their gradient to ``evaluation.elastic``.

    The duration is zero: the step is accepted, and its time has passed.
    """
    recall(problem, x, 0.0)
    _store(problem, x, evaluation)


@jit_exact
def recall(problem, x, duration):
    """Prepare the law of the walls for a step of ``duration`` in s from ``x``."""
    scene, buffers = problem.scene, problem.buffers
    if scene.law.state_size() > 0:
        scene.law.set_pace(duration, buffers.memory.pace)
        shell.begin(x, buffers.committed, scene.shell, scene.law, buffers.memory, buffers.shell)


@jit_exact
def _store(problem, x, evaluation):
    """Fill the energies of walls and contact; add their gradient to ``evaluation.elastic``."""
    scene, buffers = problem.scene, problem.buffers
    zero(buffers.parts)
    total = shell.evaluate(
        x, buffers.committed, scene.shell, scene.law, buffers.memory, buffers.shell,
        evaluation.elastic, buffers.parts,
    )  # fmt: skip
    evaluation.stored[STRETCH], evaluation.stored[BEND] = buffers.parts[0], total - buffers.parts[0]
    evaluation.stored[CONTACT] = contact.evaluate(
        x, scene.contact, problem.neighbours.pairs, drift(problem, x),
        problem.neighbours.touching, evaluation.elastic,
    )  # fmt: skip
    evaluation.stored[CONTACT] += mirror.evaluate(
        x, scene.contact, scene.mirror, evaluation.elastic
    )
