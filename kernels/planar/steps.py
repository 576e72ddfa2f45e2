"""Start and end of a step of a lattice: data of damping, commit, roll back, projection."""

from kernels.compile.jit import jit_exact
from kernels.planar import position_based
from kernels.planar.potential import recall
from kernels.shared.rows import BEND, STRETCH
from kernels.terms import bend, damping, stretch


@jit_exact
def begin(problem, step, ahead, scratch):
    """Set the pace of the laws, renew the frames of the elements at x0, and measure the shape from
    which damping starts.
    """
    buffers, memory = problem.buffers, recall(problem, step.duration)
    damping.prepare(
        step.x0, problem.scene, memory, buffers.before, ahead, scratch, buffers.shape,
        buffers.resultants,
    )  # fmt: skip


@jit_exact
def commit(problem, x, step, evaluation):
    """Commit the state of the laws; correct stored energies, add the dissipation of the step."""
    scene, memory, shape = problem.scene, problem.buffers.memory, problem.buffers.shape
    if scene.law.state_size() > 0:
        released, dissipated = stretch.commit(scene.stretch, scene.law, memory, shape)
        evaluation.stored[STRETCH] -= released
        evaluation.sums[0].dissipated += dissipated
        released, dissipated = bend.commit(scene.bend, scene.stretch, memory, shape)
        evaluation.stored[BEND] -= released
        evaluation.sums[0].dissipated += dissipated


@jit_exact
def roll_back(problem, step):
    """Reset the shortest element and opening, which belong to the rejected point.

    The committed state of the laws changes only at `commit`, so that nothing else is restored.
    """
    least = problem.buffers.least[0]
    least.length, least.opening = 0.0, 0.0


@jit_exact
def project(problem, x):
    """Move nodes of ``x`` (n,) apart that are too close; return whether any has moved."""
    return position_based.move_apart(x, problem.scene.project, problem.neighbours.projection_pairs)
