"""Start and end of a step of a lattice of plates: commit, roll back."""

from kernels.compile.jit import jit_exact
from kernels.plates.contacts import thickness
from kernels.plates.element import rotation, shell
from kernels.plates.potential import recall
from kernels.shared.rows import BEND, STRETCH


@jit_exact
def begin(problem, step, ahead, scratch):
    """Prepare the law of the walls; the frames of the nodes stay as at the last commit."""
    recall(problem, step.x0, step.duration)


@jit_exact
def commit(problem, x, step, evaluation):
    """Commit the state of the law; correct stored energies, and add the dissipation of the step.

    The rotations of the nodes are moved into their frames, so that the rotational coordinates
    become zero. This does not change the energy, which depends on the directors alone.
    """
    scene, buffers = problem.scene, problem.buffers
    if scene.law.state_size() > 0:
        released = buffers.parts
        evaluation.sums[0].dissipated += shell.commit(
            x, buffers.committed, scene.shell, scene.law, buffers.memory, buffers.shell, released
        )
        evaluation.stored[STRETCH] -= released[0]
        evaluation.stored[BEND] -= released[1] + released[2]
    rotation.rebase(buffers.committed, x)


@jit_exact
def roll_back(problem, step):
    """Do nothing: frames and memory change only at `commit`."""


@jit_exact
def project(problem, x):
    """Renew the contact thickness of the walls; return whether contact may have changed."""
    return thickness.renew(problem, x)
