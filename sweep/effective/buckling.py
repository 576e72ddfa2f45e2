"""The stress at which an endless frame buckles, by modes of any wavelength.

A mode repeats from period to period with a phase, u = U exp(i k . n) after n periods (Bloch's
theorem). Under a mean stress s the frame is stable while K + s K_G is positive definite at all
phases k; K_G is the geometric stiffness of the forces N and moments M of a unit stress,

    N n n / l - M (t n + n t) / l^2 of e,    N l (2 c_s, c_m; c_m, 2 c_s) of the turns a_1, a_2,

with e, t, n and a as in `kernels.terms.elements`, and c of the arc (`scene.beams`). Deformation
before buckling is linear.
"""

from collections.abc import Iterator

import numpy as np
from scipy.linalg import LinAlgError, eigh

from sweep.array_types import Floats
from sweep.effective.cell import Frame
from sweep.effective.stiffness import (
    carried,
    coordinates,
    deformations,
    element_stiffness,
    response,
)

PHASES = 12  # phases of a period, so that modes repeat after 2, 3, 4, 6 or 12 periods
LONG = 0.01  # share of 2 pi: a wave so long that the frame shears as a whole
DIRECTIONS = 24  # directions of long waves, in half a turn


def buckling_stress(frame: Frame, depth: float, axis: int) -> float:
    """Compressive stress (Pa) along x (axis 0) or y (1) at which the frame buckles; inf if it never
    does.
    """
    own = element_stiffness(frame)
    geometric = geometric_stiffness(frame, *_resultants(frame, depth, axis))
    at = coordinates(frame)
    most = max(_softest(frame, own, geometric, at, phase) for phase in _phases())
    return 1.0 / most if most > 0.0 else np.inf


def _phases() -> Iterator[Floats]:
    """Phases (2,), rad, in half of the plane: a phase and its opposite have the same modes."""
    for j in range(PHASES // 2 + 1):
        for k in range(PHASES):
            yield 2.0 * np.pi * np.array([j, k]) / PHASES
    for angle in np.pi * np.arange(DIRECTIONS) / DIRECTIONS:
        yield 2.0 * np.pi * LONG * np.array([np.cos(angle), np.sin(angle)])


def _softest(frame: Frame, own: Floats, geometric: Floats, at: np.ndarray, phase: Floats) -> float:
    """Greatest of 1 / s over all modes of a phase."""
    turn = np.repeat(np.exp(1j * frame.shift @ phase), 3, axis=1)  # (m, 6)
    size = 3 * frame.nodes
    matrices = []
    for elements in (own, -geometric):
        whole = np.zeros((size, size), complex)
        np.add.at(
            whole,
            (at[:, :, None], at[:, None, :]),
            turn[:, :, None].conj() * elements * turn[:, None, :],
        )
        matrices.append(whole)
    stiff, soft = matrices
    if not phase.any():  # the first node holds the frame
        stiff, soft = stiff[2:, 2:], soft[2:, 2:]
    scale = 1.0 / np.sqrt(np.diag(stiff).real)
    stiff, soft = (scale[:, None] * matrix * scale for matrix in (stiff, soft))
    try:
        (greatest,) = eigh(soft, stiff, eigvals_only=True, subset_by_index=[len(soft) - 1] * 2)
    except LinAlgError:
        return np.inf
    return float(greatest)


def _resultants(frame: Frame, depth: float, axis: int) -> tuple[Floats, Floats]:
    """Force N (N) and the sum of both moments (N m) of elements (m,) under a compressive stress of
    1 Pa.
    """
    stiffness, moved = response(frame)
    stress = np.zeros(3)
    stress[axis] = -depth
    strain = np.linalg.solve(stiffness, stress)
    b = deformations(frame)
    coordinate = (moved @ strain)[coordinates(frame)] + carried(frame) @ strain
    stretch, *turns = np.einsum("mai,mi->am", b, coordinate)
    k11, k12, k22 = frame.bending
    force = frame.axial * stretch
    return force, (k11 + k12) * turns[0] + (k12 + k22) * turns[1]


def geometric_stiffness(frame: Frame, force: Floats, moment: Floats) -> Floats:
    """The geometric stiffness of elements at rest, (m, 6, 6), from their forces N (m,) and the sums
    M (m,) of the moments at both ends.
    """
    return _of_chord(frame, force, moment) + _of_arc(frame, force, deformations(frame))


def _of_chord(frame: Frame, force: Floats, moment: Floats) -> Floats:
    t, n = frame.along, np.stack([-frame.along[:, 1], frame.along[:, 0]], axis=1)
    outer = np.einsum("mi,mj->mij", t, n)
    block = np.einsum("m,mi,mj->mij", force / frame.length, n, n)
    block -= (moment / frame.length**2)[:, None, None] * (outer + np.swapaxes(outer, 1, 2))
    whole = np.zeros((len(t), 6, 6))
    for i, j, sign in ((0, 0, 1.0), (3, 3, 1.0), (0, 3, -1.0), (3, 0, -1.0)):
        whole[:, i : i + 2, j : j + 2] = sign * block
    return whole


def _of_arc(frame: Frame, force: Floats, b: Floats) -> Floats:
    own, mixed = frame.arc
    curved = np.zeros((len(force), 2, 2))
    curved[:, 0, 0] = curved[:, 1, 1] = 2.0 * own
    curved[:, 0, 1] = curved[:, 1, 0] = mixed
    curved *= (force * frame.length)[:, None, None]
    return np.asarray(np.einsum("mai,mab,mbj->mij", b[:, 1:], curved, b[:, 1:]))
