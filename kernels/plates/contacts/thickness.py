"""Thickness of walls in contact: walls keep their volume, so that they thicken where squeezed.

    t_p = t_p0 min(j_p, MOST_THICKENING),   j_p = sum_e A_e j_e / sum_e A_e

p: nodes; e: the quads at p, of area A_e at rest; j_e: mean of the thickening j (`layers`) at their
Gauss points. The thickness is taken from the last accepted step. When it is renewed the energy of
contact jumps, and the energy book enters the jump as injected.
"""

from kernels.compile.jit import jit_exact
from kernels.plates.contacts.contact import MOST_THICKENING, is_absent
from kernels.plates.contacts.pairs import renew_distances
from kernels.plates.element import shell

THICKENING = 9  # column of the committed state of a node: j_p, after its frame


@jit_exact
def measure(x, committed, walls, original, scratch, weight):
    """Fill the column `THICKENING` of ``committed`` (n, 10) at ``x``.

    original (n,): of `contact.Contact`; weight (n,): scratch.
    """
    for p in range(weight.size):
        committed[p, THICKENING], weight[p] = 0.0, 0.0
    for e in range(walls.quads.shape[0]):
        area = walls.area[e].sum()
        j = shell.thickening(x, committed, walls, e, scratch)
        for a in range(4):
            p = original[walls.quads[e, a]]
            committed[p, THICKENING] += area * j
            weight[p] += area
    for p in range(weight.size):
        if weight[p] > 0.0:
            committed[p, THICKENING] /= weight[p]
    for p in range(weight.size):
        committed[p, THICKENING] = committed[original[p], THICKENING]


@jit_exact
def recall(contact, committed):
    """Set the thickness of ``contact`` to the thickness in the ``committed`` state (n, 10)."""
    for p in range(contact.thickness.size):
        j = min(committed[p, THICKENING], MOST_THICKENING)
        contact.thickness[p] = j * contact.rest_thickness[p]


@jit_exact
def renew(problem, x):
    """Renew the thickness at ``x``; return False if the scene has no contact."""
    scene, buffers = problem.scene, problem.buffers
    if is_absent(scene.contact):
        return False
    measure(
        x, buffers.committed, scene.shell, scene.contact.original, buffers.shell, buffers.weight
    )
    recall(scene.contact, buffers.committed)
    renew_distances(scene.contact, problem.neighbours.pairs)
    return True
