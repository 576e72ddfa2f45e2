"""What a lattice does between minima: it measures what damping needs, and keeps what it is told."""

from kernels.compile.jit import jit_exact
from kernels.planar.potential import BEND, STRETCH
from kernels.terms import bend, damping, position_based, stretch
from kernels.terms.law import Memory


@jit_exact
def begin(problem, step, ahead, scratch):
    """Aim the frames of the joints at the start of the step, and measure rates from there."""
    room, memory = problem.room, Memory(problem.room.committed, step.duration)
    damping.prepare(step.x0, problem.scene, memory, room.before, ahead, scratch, room.shape)


@jit_exact
def commit(problem, x, step, found):
    """Let the material remember what it does; enter what it has stored and dissipated."""
    scene, shape, sums = problem.scene, problem.room.shape, found.sums[0]
    memory = Memory(problem.room.committed, step.duration)
    if scene.law.remembers() > 0:
        released, dissipated = stretch.commit(scene.stretch, scene.law, memory, shape)
        found.stored[STRETCH] -= released
        sums.dissipated += dissipated
    if scene.bend.section.remembers() > 0:
        released, dissipated = bend.commit(scene.walls, scene.bend, memory, shape)
        found.stored[BEND] -= released
        sums.dissipated += dissipated


@jit_exact
def roll_back(problem, step):
    """Forget the shortest element and the least opening: they were found elsewhere."""
    least = problem.room.least[0]
    least.length, least.opening = 0.0, 0.0


@jit_exact
def project(problem, x):
    """Move nodes of ``x`` apart where they are too near; return whether any has moved."""
    return position_based.move_apart(x, problem.scene.project, problem.near.crowd)
