"""Whether the time steps of a motion resolve it, by energy and by momentum.

Energy: the energy that the integrator itself removes vanishes with its steps. Its share of the work
done measures the error of all integrators: in 13 impacts with 3 to 1000 steps each, force and
strain err by a median of 3 % for shares below 5 %, by 2 to 15 % for shares of 5 to 20 %, and by up
to 98 % above.

A dead load excites waves from which the integrator may remove much or little energy without an
error of the greatest strain. The error of this strain follows from the local errors of the path on
which the top goes down, C h^(p+1) times its derivative of order p + 1 (Hairer, Norsett and Wanner,
Solving Ordinary Differential Equations I, sections II.2 and III.2), relative to its length. The
measurements are in docs/accuracy.md.

A lattice without damping vibrates, and energy that the integrator removes from its vibrations is no
error of the striker: with a share of 27 %, force and strain err by 1 % where 900 steps are one
contact. So an impact is unresolved if the steps are also long compared with the time in which the
striker is stopped. Its loss by backward Euler is a measure, sum m (v' - v)^2 / 2: pi^2 / 2n of the
energy in a half wave of n steps, more if the force has a peak.

Momentum: the momentum of striker and lattice at the start, p = 2 E / v with their kinetic energy E,
and the impulse of the weight in the time t go into the support: sum F dt = p + m g t - m v' - q,
with q the momentum of the lattice at the end, q^2 <= 2 m_l K_l. Damping of the mass by the rate
alpha takes alpha sum q dt of it.
"""

from math import inf, nan

import numpy as np

from sweep.array_types import Floats
from sweep.config.case import Case
from sweep.config.kinds.dead_load import DeadLoad
from sweep.config.kinds.impact import Impact
from sweep.config.kinds.loading import Loading
from sweep.config.kinds.solver import InTime
from sweep.simulation.striker import Curves, closing_speed, kinetic

MOST_LOST = 0.2  # share of energy or momentum that an impact may lose to its steps
OF_STRIKER = 0.05  # share of its energy that a striker may lose to steps of backward Euler
LOCAL = {"backward_euler": (1, 1 / 2), "newmark": (2, 1 / 12), "bdf2": (2, 2 / 9)}
"""Order p and constant C of the local error of each integrator."""
LOCAL_OF_STEP_ERROR = 0.1  # of `step_error`: below this error steps are lengthened
RESOLVED = 0.9  # share of a resolved peak: the greater force of the rows before and after it


def integrator_share(loading: Loading, history: Curves) -> float:
    """Greatest energy that the integrator removes or creates / greatest work; NaN in statics."""
    work = float(np.abs(history["work_in_J"]).max())
    if loading.quasi_static or work == 0.0:
        return nan
    return float(np.abs(history["dissipated_integrator_J"]).max()) / work


def path_error(case: Case, history: Curves, peak: float) -> float:
    """Greatest local error of the path of the top under a dead load until its greatest strain,
    ``peak``, / the length of this path; NaN for other loadings, in statics and without a motion.

    Infinite if the path has fewer rows than its derivative needs.
    """
    loading, solver, strain = case.loading, case.solver, history["strain"]
    if not isinstance(loading, DeadLoad) or not isinstance(solver, InTime) or not peak > 0.0:
        return nan
    if solver.step_error is not None:  # steps are shorter than rows
        return LOCAL_OF_STEP_ERROR * solver.step_error / (peak * case.height)
    order, constant = LOCAL[solver.integrator]
    jumps = np.abs(np.diff(strain[: int(strain.argmax()) + 2], order + 1))
    return constant * float(jumps.max()) / peak if len(jumps) else inf


def known_peak(case: Case, force: Floats, most: float) -> float:
    """The greatest of the forces (rows,) of a run and of its shares (``most``), N; NaN if in equal
    steps `peak_row` finds no resolved peak.
    """
    equal = isinstance(case.solver, InTime) and case.solver.step_error is None
    unknown = equal and peak_row(case.loading, force) is None
    return nan if unknown else max(most, float(force.max()))


def peak_row(loading: Loading, force: Floats) -> int | None:
    """Row of the greatest of forces or pressures (rows,); None under a dead load if no neighbouring
    row has nearly the same value, so that the true peak may lie in between.
    """
    row = int(force.argmax())
    beside = np.append(force[max(row - 1, 0) : row], force[row + 1 : row + 2])
    alone = isinstance(loading, DeadLoad) and beside.max(initial=0.0) < RESOLVED * force[row]
    return None if alone else row


def striker_share(history: Curves) -> float:
    """Energy that backward Euler would take from the striker in these rows / its greatest kinetic
    energy, both relative to the base.
    """
    speed = closing_speed(history)
    return float(np.sum(np.diff(speed) ** 2) / np.max(speed**2))


def momentum_share(loading: Impact, history: Curves, mass: float, alpha: float) -> float:
    """Momentum of an impact that the support has not taken, or has taken in excess / momentum at
    first.

    mass: of the lattice, kg. alpha: rate by which its mass is damped, 1/s. Momentum that the
    lattice may still have, or that damping may have taken from it, does not count.
    """
    speed, force = history["striker_speed_m_per_s"], history["reaction_bottom_N"]
    initial = 2.0 * float(history["work_in_J"][0]) / loading.striker_speed
    times = np.diff(history["time_s"])
    impulse = float(np.sum(force[1:] * times))
    swing = (history["kinetic_J"] - kinetic(loading, history)).clip(min=0.0)
    carried = np.sqrt(2.0 * mass * swing)
    of_lattice = float(carried[-1] + alpha * np.sum(carried[1:] * times))
    total = initial + loading.weight * float(history["time_s"][-1])
    missing = abs(total - loading.striker_mass * float(speed[-1]) - impulse)
    return max(missing - of_lattice, 0.0) / initial


def resolving_step(case: Case) -> float:
    """The usual time step of an impact, or a quarter of its own if that is shorter, s."""
    loading, solver = case.loading, case.solver
    assert isinstance(loading, Impact)
    assert isinstance(solver, InTime)
    usual = loading.contact_step(case.pressed, case.material.modulus)
    return min(usual, 0.25 * solver.time_step)
