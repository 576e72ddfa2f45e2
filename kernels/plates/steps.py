"""Start and end of a step of a lattice of plates: commit, roll back."""

from kernels.compile.jit import jit_exact
from kernels.plates import rotation, thickness


@jit_exact
def begin(problem, step, ahead, scratch):
    """Nothing is prepared: the frames of the nodes are those of the last commit."""


@jit_exact
def commit(problem, x, step, found):
    """Pass the rotations of the nodes on to their frames: the coordinates of rotations become zero.

    The energy does not change, as it depends on the directors alone.
    """
    rotation.rebase(problem.buffers.committed, x)


@jit_exact
def roll_back(problem, step):
    """Nothing is restored: frames change at `commit` only."""


@jit_exact
def project(problem, x):
    """Renew the thickness over which walls touch; return whether contact may have changed."""
    return thickness.renew(problem, x)
