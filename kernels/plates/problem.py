"""The lattice of plates: data of a scene, and the problem assembled from it.

Coordinates are the positions and rotations of the nodes, and the heights of the platens (`layout`).
"""

from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit_exact, jit_owning
from kernels.laws.law import Law, Memory, in_python
from kernels.plates import factoring, neighbour_lists, potential, steps
from kernels.plates.contacts import thickness
from kernels.plates.contacts.contact import Contact
from kernels.plates.contacts.mirror import Mirror
from kernels.plates.element import relaxing_shear, shell
from kernels.plates.layout import Layout
from kernels.plates.neighbour_lists import Neighbours
from kernels.shared import followers, lagging, moves, rows
from kernels.solve import history
from kernels.solve.problem import Coordinates
from kernels.terms.friction import Friction


class Buffers(NamedTuple):
    """Arrays that are allocated once per march.

    committed (n_nodes, k): frames of the nodes and their `thickness.THICKENING`; memory: memory of
    the law at its material points (`shell`). Both are rows of `history.State.memory`. shell:
    scratch of one quad; second (24, 24): its Hessian. part (12, 12): Hessian of one contact. parts
    (3,): energies of the walls, J. pull (n,): derivatives of the gradient in the driven coordinate.
    diagonal (n,), unknowns (u,), weight (n_nodes,): scratch.
    """

    committed: np.ndarray
    memory: Memory
    shell: shell.Scratch
    second: np.ndarray
    part: np.ndarray
    parts: np.ndarray
    pull: np.ndarray
    diagonal: np.ndarray
    unknowns: np.ndarray
    weight: np.ndarray


class Plates(NamedTuple):
    """The problem. neighbours: pair lists, matrix and lagged friction."""

    scene: "PlateScene"
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

    reduce = followers.reduce
    lead = followers.lead
    pull = factoring.pull
    tie = followers.tie

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
    write = rows.write
    write_share = rows.write_share


@jit_owning
def make_buffers(scene, committed):
    """Return the `Buffers`, and recall the thickness of the walls.

    committed: `solve.history.State.memory`.
    """
    layout, n = scene.layout, scene.layout.block.size
    thickness.recall(scene.contact, committed)
    line = np.zeros((committed.shape[0] - n, relaxing_shear.LINE))
    return Buffers(
        committed[:n], Memory(committed[n:], line, scene.law.make_pace()),
        shell.make_scratch(), np.zeros((24, 24)), np.zeros((12, 12)),
        np.zeros(3),
        np.zeros(layout.leader.size), np.zeros(layout.leader.size), np.zeros(layout.scale.size),
        np.zeros(layout.block.size),
    )  # fmt: skip


@jit_exact
def assemble(scene, neighbours, buffers):
    """Return the problem."""
    return Plates(scene, neighbours, buffers)


def at_rest(scene, frames, x):
    """Return the `history.State` at rest at ``x`` (n,), with ``frames`` (n_nodes, 9) of nodes and a
    virgin material.
    """
    n, numbers = len(frames), in_python(scene.law, "state_size")
    points = (shell.POINTS_OF_LAYERS + 1) * len(scene.shell.quads) if numbers > 0 else 0
    memory = (n + points, max(numbers, thickness.THICKENING + 1))
    state = history.at_rest(x, rows.STORED, memory)
    state.memory[:n, : thickness.THICKENING] = frames
    state.memory[:n, thickness.THICKENING] = 1.0
    return state


class PlateScene(NamedTuple):
    """One scene: the data of every term. A term that is absent has empty arrays."""

    coordinates: Coordinates
    law: Law
    shell: shell.Shell
    contact: Contact
    mirror: Mirror
    friction: Friction
    layout: Layout

    find_neighbours = neighbour_lists.find_neighbours
    renew_neighbours = neighbour_lists.renew_neighbours
    make_buffers = make_buffers
    assemble = assemble
